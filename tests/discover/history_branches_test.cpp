// SPDX-License-Identifier: Apache-2.0
// Where a curve turns, and which tests an energy cannot tell apart.
#include <cmath>
#include <numeric>

#include <Eigen/QR>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/hand_made.hpp"
#include "discover/paths_of.hpp"

namespace tunica::discovery::history_branches_test {
namespace {

using trial::Measured;
using trial::PathsOf;

/// What polynomials of degree 6 leave of r over x: differences of branches are this at most.
double rough_part(const std::vector<double>& x, const std::vector<double>& r) {
  const auto n = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd powers(n, 7);
  Eigen::VectorXd values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (int d = 0; d <= 6; ++d) powers(i, d) = std::pow(10 * (x[static_cast<std::size_t>(i)] - 1.3), d);
    values[i] = r[static_cast<std::size_t>(i)];
  }
  return (values - powers * powers.colPivHouseholderQr().solve(values)).squaredNorm();
}

std::vector<double> steps(double from, double to, int rows) {
  std::vector<double> x;
  for (int i = 0; i < rows; ++i) x.push_back(from + (to - from) * i / (rows - 1));
  return x;
}

std::vector<double> behind(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// One value on each branch, written down row by row; all of it that is no common curve is a difference of branches.
void expect_branches(const std::vector<double>& x, const std::vector<double>& r,
                     const std::vector<bool>& left_out = {}) {
  const PathDependence found =
      PathsOf({{"axial", x}}).with([&](const std::string&, std::size_t row, double) { return r[row]; });
  std::vector<double> own_x, own_r;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (left_out.empty() || !left_out[i]) {
      own_x.push_back(x[i]);
      own_r.push_back(r[i]);
    }
  const double expected = rough_part(own_x, own_r);
  ASSERT_GT(expected, 1);
  EXPECT_NEAR(found.chi2, expected, 1e-6 * expected);
  EXPECT_TRUE(found.branches);
}

std::vector<double> levels(std::initializer_list<std::pair<int, double>> of) {
  std::vector<double> r;
  for (const auto& [rows, value] : of) r.insert(r.end(), static_cast<std::size_t>(rows), value);
  return r;
}

/// A row far from the one before turns at once, and so does the next.
TEST(BranchesOfACurve, BeginAtTheRowBehindTheTurn) {
  // Four rows near rest, one far out, and back.
  expect_branches(behind({1, 1.001, 1.002, 1.003, 1.5}, steps(1.4, 1.05, 8)), levels({{5, 30}, {8, -30}}));
  // Back for a single row, and on: rows of branches that short say nothing.
  std::vector<bool> single(17, false);
  single[8] = true;
  expect_branches(behind(behind(steps(1, 1.5, 8), {1.3}), steps(1.45, 1.6, 8)), levels({{8, 30}, {1, 0}, {8, -30}}),
                  single);
}

/// One way down in small steps is one branch.
TEST(BranchesOfACurve, AreOneOfAFallingStretch) {
  const PathDependence found =
      PathsOf({{"axial", steps(1.6, 1, 61)}}).with([](const std::string&, std::size_t row, double) {
        return row < 8 ? 4. : -4.;
      });
  EXPECT_EQ(found.p_value, 1);
  EXPECT_EQ(found.where, "");
}

/// Of a range of 0.5 a way back of 0.0225 is none, and one of 0.0275 is.
TEST(BranchesOfACurve, TurnByATwentiethOfTheRange) {
  const auto p_of = [](double back) {
    const std::vector<double> x = behind(steps(1, 1.4, 8), behind({1.4 - back}, steps(1.41, 1.5, 8)));
    return PathsOf({{"axial", x}})
        .with([](const std::string&, std::size_t row, double) { return row < 8    ? 5.
                                                                       : row == 8 ? 0.
                                                                                  : -5.; })
        .p_value;
  };
  EXPECT_EQ(p_of(0.0225), 1);
  EXPECT_LT(p_of(0.0275), 1);
}

/// Four rows make a branch, three do not.
TEST(BranchesOfACurve, HaveFourRowsAtLeast) {
  const auto p_of = [](int back) {
    const std::vector<double> x = behind(steps(1, 1.5, 10), steps(1.4, 1.1, back));
    return PathsOf({{"axial", x}})
        .with([](const std::string&, std::size_t row, double) { return row < 10 ? 5. : -5.; })
        .p_value;
  };
  EXPECT_EQ(p_of(3), 1);
  EXPECT_LT(p_of(4), 1e-4);
}

/// However small the difference, its place is named.
TEST(BranchesOfACurve, AreNamedWhereTheyHardlyDiffer) {
  const std::vector<double> x = behind(steps(1, 1.5, 10), steps(1.45, 1, 10));
  const PathDependence found =
      PathsOf({{"axial", x}}).with([](const std::string&, std::size_t row, double) { return row < 10 ? 0.01 : -0.01; });
  EXPECT_LT(found.chi2, 0.01);
  EXPECT_THAT(found.where, ::testing::HasSubstr("'axial'"));
}

/// Tests that hold one stretch have no curve along it.
TEST(TestsThatAreAlike, SayNothingAtASingleStretch) {
  const PathsOf held({{.name = "axial", .stretch = std::vector<double>(6, 1.3)},
                      {.name = "axial_2", .stretch = std::vector<double>(6, 1.3)},
                      {.name = "circumferential"}});
  const PathDependence found = held.with([](const std::string& test, std::size_t, double) {
    return test == "axial" ? 5. : test == "axial_2" ? -5. : 0.;
  });
  EXPECT_EQ(found.p_value, 1);
  EXPECT_EQ(found.share, 0);
  EXPECT_EQ(found.chi2, 0);
  EXPECT_EQ(found.where, "");
}

/// Where the misfit is hardly more than noise, and the branches differ by all of it.
TEST(BranchesOfACurve, HaveAShareOfTheLeastMisfit) {
  const PathsOf paths({{"axial", behind(steps(1, 1.5, 10), steps(1.45, 1, 10))}});
  const double level = std::sqrt(1 + 0.5 / paths.rows());
  const PathDependence found =
      paths.with([&](const std::string&, std::size_t row, double) { return row < 10 ? level : -level; });
  EXPECT_EQ(found.share, 1);
}

/// A sheet drawn out along its axis while its other stretch goes as `other` says; ten rows, noise 1 kPa.
struct Sheet {
  std::string name;
  std::function<double(int row)> other;
};

/// Of a neo-Hookean sheet of 30 kPa.
/// `held_first`: the axial stretch is the other one, so that what varies stands second.
PathsOf sheets(const std::vector<Sheet>& all, bool held_first = false) {
  return PathsOf([&](Measured& measured) {
    nlohmann::json& experiment = measured.experiment;
    experiment["models"] = {{"gho", {{"type", "neo_hooke"}}}};
    experiment["tests"] = nlohmann::json::object();
    for (const Sheet& sheet : all) {
      std::string text = "stretch_axial [1],stretch_circumferential [1],stress_axial [kPa],time [s]\n";
      for (int i = 0; i < 10; ++i) {
        double a = 1.05 + 0.05 * i, b = sheet.other(i);
        if (held_first) std::swap(a, b);
        text += fmt::format("{},{},{},{}\n", a, b, 30 * (a * a - 1 / (a * a * b * b)), i);
      }
      measured.folder.write(sheet.name + ".csv", text);
      nlohmann::json columns;
      for (const char* name : {"stretch_axial", "stretch_circumferential", "stress_axial", "time"})
        columns[name] = name;
      experiment["tests"][sheet.name] = {
          {"type", "biaxial"},
          {"protocol", "general"},
          {"data",
           {{"file", sheet.name + ".csv"}, {"columns", columns}, {"order", "loading"}, {"noise", {{"absolute", 1}}}}}};
    }
  });
}

double opening(const std::string& test, std::size_t, double x) { return (test == "a" ? 5 : -5) * x; }

/// A second stretch that is held is a part of the strain, and time is none.
TEST(TestsThatAreAlike, HoldTheSameOtherStretch) {
  const auto held = [](double at) { return [at](int) { return at; }; };
  const auto rising = [](int row) { return 1 + 0.01 * row; };
  EXPECT_LT(sheets({{"a", held(1.1)}, {"b", held(1.1)}}).with(opening).p_value, 1e-4);
  EXPECT_EQ(sheets({{"a", held(1.1)}, {"b", held(1.2)}}).with(opening).p_value, 1) << "another strain";
  EXPECT_EQ(sheets({{"a", rising}, {"b", rising}}).with(opening).p_value, 1) << "strains that differ row by row";
  EXPECT_LT(sheets({{"a", held(1.1)}, {"b", held(1.1)}, {"c", rising}}).with(opening).p_value, 1e-4)
      << "whatever a third test does";
}

/// Of the stretches of a sheet the one that varies is the path, wherever it stands.
TEST(TestsThatAreAlike, FollowTheStretchThatVaries) {
  const auto held = [](double at) { return [at](int) { return at; }; };
  const auto apart = [](const std::string& test, std::size_t, double) { return test == "a" ? 5. : -5.; };
  const double along_the_first = sheets({{"a", held(1.1)}, {"b", held(1.1)}}).with(apart).p_value;
  EXPECT_LT(along_the_first, 1e-4);
  EXPECT_EQ(sheets({{"a", held(1.1)}, {"b", held(1.1)}}, true).with(apart).p_value, along_the_first);
  EXPECT_EQ(sheets({{"a", held(1.1)}, {"b", held(1.2)}}, true).with(apart).p_value, 1) << "another strain";
}

/// Two tests of one channel whose residuals are far apart, and what the experiment says of them besides.
double p_of_two(const std::function<void(experiment::TestEntry& a, experiment::TestEntry& b)>& differ) {
  diagnosis::HandMade made;
  const std::vector<double> x = steps(1, 2, 10), y(10, 0.0);
  for (const char* name : {"a", "b"}) made.add(name, x, y, {.absolute = 1});
  made.close();
  differ(made.evidence.experiment.tests[0], made.evidence.experiment.tests[1]);
  diagnosis::Fit fit = made.evidence.fit;
  for (const diagnosis::Curve& curve : made.evidence.curves)
    fit.residuals.segment(curve.first, curve.count).setConstant(curve.test == "a" ? 5 : -5);
  fit.chi2 = fit.residuals.squaredNorm();
  return path_dependence(made.evidence, fit).p_value;
}

/// Parameters of the test and its layers, if there are any, are the same.
TEST(TestsThatAreAlike, HaveTheSameParametersAndLayers) {
  using experiment::TestEntry;
  EXPECT_LT(p_of_two([](TestEntry&, TestEntry&) {}), 1e-4);
  const auto of_parameters = [](std::optional<double> fixed, std::optional<double> initial) {
    return p_of_two([&](TestEntry& a, TestEntry& b) {
      a.parameters["held"].fixed = 0.0;
      b.parameters["held"].fixed = fixed;
      b.parameters["held"].initial = initial;
    });
  };
  EXPECT_LT(of_parameters(0.0, 7.0), 1e-4) << "a fixed value stands";
  EXPECT_EQ(of_parameters(2.0, {}), 1);
  EXPECT_EQ(of_parameters({}, 2.0), 1);
  EXPECT_LT(of_parameters({}, {}), 1e-4) << "nothing said is 0";
  const auto of_layers = [](const std::string& one, const std::string& other) {
    return p_of_two([&](TestEntry& a, TestEntry& b) {
      a.layers.emplace_back().model = one;
      b.layers.emplace_back().model = other;
    });
  };
  EXPECT_LT(of_layers("media", "media"), 1e-4);
  EXPECT_EQ(of_layers("media", "adventitia"), 1);
}

}  // namespace
}  // namespace tunica::discovery::history_branches_test
