// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/next_experiment.hpp"

#include <gmock/gmock.h>

#include <array>
#include <cmath>

#include <Eigen/LU>

#include "diagnosis/base_fit.hpp"
#include "diagnosis/designs.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/refits.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<Addition> second_invariant{{"second_invariant", {}, {}}};

/// A circumferential strip alone, of a wall with more circumferential fibres than gho has, and these explanations of
/// it.
struct Rivals {
  explicit Rivals(const std::vector<Addition>& additions) : measured({trial::Strip{}}) {
    measured.measure(41, [](nlohmann::json& truth) {
      truth["models"]["gho"]["mechanisms"] = {trial::mechanism("circumferential_fibres", "k", 5)};
    });
    d.settings.model = "gho", d.settings.quick = true;
    prepare(d, measured.read(), testing::catalogue());
    fit_base(d, testing::catalogue());
    for (const Addition& addition : additions) {
      auto refitted = fit_with(d, {addition}, std::array{1.0}, testing::catalogue());
      if (!refitted) throw std::runtime_error(addition.id);
      d.rivals.push_back(*refitted);
      d.ambiguity_set.push_back(addition.id);
    }
  }
  [[nodiscard]] NextExperiment next() const { return *next_experiment(d, testing::catalogue()); }

  trial::Measured measured;
  Diagnosis d;
};

TEST(NextExperiment, IsOneInWhichTheRivalsDiffer) {
  const Rivals rivals({{"circumferential_fibres", {}, {}}, {"second_invariant", {}, {}}});
  const NextExperiment next = rivals.next();
  ASSERT_TRUE(next.repeats);
  EXPECT_GE(*next.repeats, 1u);
  EXPECT_LE(*next.repeats, 20u);
  EXPECT_EQ(next.separates, (std::vector<std::string>{"circumferential_fibres", "second_invariant"}));
  const auto at = next.description.find("the rivals differ by ");
  ASSERT_NE(at, std::string::npos) << next.description;
  const double distance = std::stod(next.description.substr(at + 21));
  EXPECT_GT(distance, 0);
  // (2 · 1.645)² in all the repeats together; the distance is printed to 0.1.
  EXPECT_GE(static_cast<double>(*next.repeats) * (distance + 0.05) * (distance + 0.05), 10.8);
  EXPECT_THAT(next.description, HasSubstr("equibiaxial beside uniaxial extension"));
}

TEST(NextExperiment, IsNoneOfTheLibraryWhereTheRivalsSayTheSameOfTheMaterial) {
  const Addition offset{"force_offset", {{"circumferential"}}, {}};
  const NextExperiment next = Rivals({offset, offset}).next();
  EXPECT_FALSE(next.repeats);
  EXPECT_THAT(next.description,
              AllOf(HasSubstr("No strip, sheet or inflation of the library tells them apart in 20 repeats"),
                    HasSubstr("force_offset: a reading of the load cell without specimen")));
}

TEST(NextExperiment, ConfirmsASingleCause) {
  const NextExperiment next = Rivals(second_invariant).next();
  EXPECT_THAT(next.description,
              ::testing::StartsWith("To confirm second_invariant: equibiaxial beside uniaxial extension."));
  // Beside that, what determines the parameters better.
  EXPECT_THAT(next.description, HasSubstr("makes that a factor of"));
  EXPECT_TRUE(next.repeats);
}

TEST(NextExperiment, IsNotAskedForWithoutACause) {
  Diagnosis nothing;
  EXPECT_FALSE(next_experiment(nothing, testing::catalogue()));
}

/// What the data leave of every parameter, in ln p or in shares of its box, with the box as a prior.
double loosest(const trial::Measured& measured) {
  Diagnosis d;
  d.settings.model = "gho", d.settings.quick = true;
  prepare(d, measured.read(), testing::catalogue());
  fit_base(d, testing::catalogue());
  Eigen::MatrixXd J = d.fit.jacobian, precision = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const auto& parameter = d.base->layout().parameters[static_cast<std::size_t>(k)];
    J.col(k) *= d.fit.free[static_cast<std::size_t>(k)];
    precision(k, k) = 12 / std::pow(std::log(parameter.max / parameter.min), 2);
  }
  precision += J.transpose() * J;
  return std::sqrt(precision.inverse().diagonal().maxCoeff());
}

// One strip, hardly pulled: of its fibres it tells nothing; pulled further, little.
TEST(NextExperiment, DeterminesWhatTheDataLeaveOpen) {
  const auto described = [](double longest) {
    trial::Measured measured({trial::Strip{.stretch = testing::evenly(1.01, longest, 15)}});
    measured.measure(45);
    EXPECT_GT(loosest(measured), 0.25);
    const Diagnosis found = measured.diagnose();
    EXPECT_EQ(found.verdict, Verdict::nothing_detected);
    return found.next.value();
  };
  const diagnosis::NextExperiment little = described(1.6), found = described(1.15);
  ASSERT_EQ(found.separates.size(), 1u);
  EXPECT_THAT(found.description,
              HasSubstr(found.separates.front() + " is not fixed by these data, only by its bounds; "));
  EXPECT_THAT(little.description,
              AllOf(HasSubstr(little.separates.at(0) + " is known to within a factor of "), HasSubstr(" only; ")));
  // Fibres that are hardly pulled: no library of strips that go no further tells.
  EXPECT_FALSE(found.repeats);
  EXPECT_THAT(found.description, HasSubstr("no strip, sheet or inflation of the library determines it"));
}

TEST(NextExperiment, IsNotAskedForWhereNothingIsOpen) {
  trial::Measured measured({{.sd = 0.03}, {.name = "axial", .sd = 0.03}});
  measured.measure(46);
  ASSERT_LT(loosest(measured), 0.25);
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.verdict, Verdict::nothing_detected);
  EXPECT_FALSE(found.next) << found.next->description;
}

TEST(Designs, ReachAsFarAsTheDataAndKnowTheirNoise) {
  const Rivals rivals(second_invariant);
  const auto library = designs(rivals.d, testing::catalogue(), rivals.d.rivals.front());
  ASSERT_GE(library.size(), 6u);
  EXPECT_THAT(library.front().description, HasSubstr("to a stretch of 1.6"));
  EXPECT_DOUBLE_EQ(library.front().sd.front(), 0.3);
  // P with 0.3 kPa and 2 % is known as a Cauchy stress λ P to λ times as much.
  Rivals nominal(second_invariant);
  for (auto& test : nominal.d.experiment.tests) test.data.stress_measure = "first_piola_kirchhoff";
  for (Curve& curve : nominal.d.curves) curve.noise.noise.relative = 0.02;
  const auto wider = designs(nominal.d, testing::catalogue(), nominal.d.rivals.front());
  std::vector<double> values;
  ASSERT_TRUE(predict(wider.front(), nominal.d.rivals.front(), nominal.d.rivals.front().fit.free, values));
  EXPECT_DOUBLE_EQ(wider.front().sd[19], 1.6 * std::hypot(0.3, 0.02 * values[19] / 1.6));
  for (const Design& design : library) {
    EXPECT_EQ(design.sd.size(), design.test->rows().count * design.test->rows().channels.size());
    for (const double sd : design.sd) EXPECT_GT(sd, 0) << design.description;
    // The data have no time: no cycle, no hold.
    EXPECT_THAT(design.description, Not(AnyOf(HasSubstr("cycle"), HasSubstr("held"))));
  }
}

}  // namespace
}  // namespace tunica::diagnosis
