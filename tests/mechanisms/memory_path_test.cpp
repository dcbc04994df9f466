// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "support/row_by_row.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"
#include "support/tube.hpp"
#include "tunica/energy_scaled_model.hpp"
#include "tunica/maxwell_model.hpp"

// Models with memory in principal axes: against the same model row by row on tensors, and against differences.
namespace tunica::memory_path_test {
namespace {

using testing::model;
using testing::wrapped;

struct Subject {
  std::string name;
  std::unique_ptr<Model> remembering, on_tensors;
  std::vector<double> parameters, at_null;
  std::unique_ptr<Model> bare;
  std::vector<double> bare_parameters;
};

/// A base inside mechanisms, inner first; each with amplitude and nuisance.
Subject subject(const std::string& type, const std::vector<double>& base,
                const std::vector<std::pair<std::string, std::vector<double>>>& mechanisms) {
  const auto build = [&] {
    auto made = model(type);
    for (const auto& [id, own] : mechanisms) made = wrapped(id, std::move(made));
    return made;
  };
  Subject made{type, build(), std::make_unique<testing::TensorsOnly>(build()), base, base, model(type), base};
  for (const auto& [id, own] : mechanisms) {
    made.name += " + " + id;
    made.parameters.insert(made.parameters.end(), own.begin(), own.end());
    made.at_null.push_back(0);
    made.at_null.insert(made.at_null.end(), own.begin() + 1, own.end());
  }
  return made;
}

std::vector<Subject> subjects() {
  const std::pair<std::string, std::vector<double>> soft{"stress_softening", {0.4, 0.6}},
      viscous{"viscoelasticity", {0.8, 5}}, torn{"damage", {0.5, 6}};
  std::vector<Subject> all;
  const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44}, ogden{630, 1.3, 1.2, 5, -10, -2};
  all.push_back(subject("gho", gho, {soft}));
  all.push_back(subject("gho", gho, {viscous}));
  all.push_back(subject("gho", gho, {torn, viscous}));
  all.push_back(subject("gho", gho, {viscous, torn}));
  all.push_back(subject("gho", gho, {soft, viscous}));
  all.push_back(subject("gho", gho, {viscous, soft}));
  all.push_back(subject("gho", gho, {viscous, {"viscoelasticity", {0.3, 60}}}));
  all.push_back(subject("ogden", ogden, {soft, viscous}));
  all.push_back(subject("yeoh", {30, 4, 0.5}, {viscous, soft}));
  return all;
}

/// Two cycles, the second one further, and a hold.
std::vector<double> cycles() {
  std::vector<double> stretch;
  for (const double x : {0.0, 0.15, 0.3, 0.2, 0.05, 0.1, 0.25, 0.35, 0.35, 0.35, 0.2, 0.02}) stretch.push_back(1 + x);
  return stretch;
}
std::vector<double> clock_of(const std::vector<double>& rows) { return testing::evenly(0, 11, rows.size()); }

std::unique_ptr<Test> strip(bool timed) {
  const std::vector<double> stretch = cycles();
  testing::StripSetup setup{.direction = "axial", .channels = {"stress", "transverse_stretch"}};
  setup.measure = "first_piola_kirchhoff";
  if (timed) setup.time = clock_of(stretch);
  return testing::make_strip(stretch, setup);
}
std::unique_ptr<Test> sheet(bool timed) {
  const std::vector<double> stretch = cycles();
  std::vector<double> axial;
  for (const double x : stretch) axial.push_back(1 + 0.6 * (x - 1));
  testing::SheetSetup setup;
  if (timed) setup.time = clock_of(stretch);
  return testing::make_sheet("general", {{"stretch_circumferential", stretch}, {"stretch_axial", axial}}, setup);
}

struct Answer {
  std::vector<double> values, jacobian;
};
Answer ask(const Test& test, const Model& model, const std::vector<double>& p, bool jacobian) {
  const std::vector<double> own(test.describe().parameters.size(), 0.0);
  const std::size_t size = test.rows().count * test.rows().channels.size();
  Answer answer{std::vector<double>(size), std::vector<double>(jacobian ? (p.size() + own.size()) * size : 0)};
  const Status status = test.predict({model, p, own}, {answer.values, answer.jacobian, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return answer;
}

// Branches of Maxwell are followed in columns of all rows, whatever else remembers row by row.
TEST(MaxwellPath, PredictsWhatTheSamePathRowByRowDoes) {
  // Unequal steps of time, two rows at once among them, and more parameters than go together.
  const std::vector<double> stretch = cycles(), time{0.2, 1, 1, 2.5, 4, 5, 5.001, 6, 8, 30, 31, 300};
  const std::pair<std::string, std::vector<double>> fast{"viscoelasticity", {0.8, 0.5}},
      slow{"viscoelasticity", {0.3, 60}}, slowest{"viscoelasticity", {0.2, 2000}};
  const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44};
  for (const auto& base : {std::pair<std::string, std::vector<double>>{"gho", gho}, {"yeoh", {30, 4, 0.5}}})
    for (std::size_t branches = 1; branches <= 7; ++branches)
      for (const char* direction : {"circumferential", "axial"}) {
        auto made = model(base.first), other = model(base.first);
        std::vector<double> p = base.second;
        for (std::size_t b = 0; b < branches; ++b) {
          const auto& [id, own] = b % 3 == 0 ? fast : b % 3 == 1 ? slow : slowest;
          made = wrapped(id, std::move(made));
          other = wrapped(id, std::move(other));
          p.insert(p.end(), own.begin(), own.end());
        }
        std::vector<MaxwellModel::Branch> found;
        const auto* const maxwell = dynamic_cast<const MaxwellModel*>(made.get());
        ASSERT_NE(maxwell, nullptr) << "through the guard";
        ASSERT_TRUE(maxwell->add_branches(found));
        ASSERT_EQ(found.size(), branches);
        EXPECT_EQ(found.back().tau, p.size() - 1);
        const testing::RowByRow slowly(std::move(other));
        testing::StripSetup setup{.direction = direction, .channels = {"stress", "transverse_stretch"}};
        setup.time = time;
        const auto test = testing::make_strip(stretch, setup);
        const Answer columns = ask(*test, *made, p, true), rows = ask(*test, slowly, p, true);
        EXPECT_LE(testing::relative_difference(columns.values, rows.values), 1e-12) << base.first << branches;
        EXPECT_LE(testing::relative_difference(columns.jacobian, rows.jacobian), 1e-12) << base.first << branches;
        EXPECT_LE(testing::relative_difference(ask(*test, *made, p, false).values, rows.values), 1e-11);
      }
}

TEST(MaxwellPath, IsNotThatOfAModelThatRemembersMore) {
  const auto torn = wrapped("viscoelasticity", wrapped("damage", model("gho")));
  std::vector<MaxwellModel::Branch> found;
  const auto* const maxwell = dynamic_cast<const MaxwellModel*>(torn.get());
  EXPECT_FALSE(maxwell != nullptr && maxwell->add_branches(found));
  const auto softened = wrapped("stress_softening", wrapped("viscoelasticity", model("gho")));
  const auto* const outside = dynamic_cast<const MaxwellModel*>(softened.get());
  EXPECT_FALSE(outside != nullptr && outside->add_branches(found));
}

std::unique_ptr<Model> scaled(const std::string& id, const std::string& base, const std::string& law) {
  const auto& entry = testing::catalogue().mechanisms().at(id);
  Options options = testing::defaults(entry.factory.options);
  if (!law.empty()) options.set("law", law);
  return plugins::wrap(entry, model(base), options);
}

// A factor on the elastic stress leaves lateral equilibrium alone, and all rows are multiplied at once.
TEST(ScaledPath, PredictsWhatTheSamePathRowByRowDoes) {
  const std::vector<double> gho{18.668, 0.1367, 24.905, 0.2912, 46.44};
  for (const auto& base : {std::pair<std::string, std::vector<double>>{"gho", gho}, {"yeoh", {30, 4, 0.5}}})
    for (const auto& [id, own, law] :
         std::vector<std::tuple<std::string, std::vector<double>, std::string>>{{"stress_softening", {0.4, 0.6}, ""},
                                                                                {"damage", {0.5, 6}, "discontinuous"},
                                                                                {"damage", {1, 6, 2.5}, "failure"}})
      for (const char* direction : {"circumferential", "axial"}) {
        const auto made = scaled(id, base.first, law);
        const testing::RowByRow slowly(scaled(id, base.first, law));
        std::vector<double> p = base.second;
        p.insert(p.end(), own.begin(), own.end());
        const auto* const factors = dynamic_cast<const EnergyScaledModel*>(made.get());
        ASSERT_NE(factors, nullptr) << "through the guard";
        ASSERT_TRUE(factors->scale_path({p, {}, {}}, {})) << id;
        // Few rows with two channels, and many with the one whose derivatives are written in place.
        const testing::StripSetup both{.direction = direction, .channels = {"stress", "transverse_stretch"}};
        testing::StripSetup nominal{.direction = direction};
        nominal.measure = "first_piola_kirchhoff";
        std::vector<double> many;
        for (int k = 0; k < 50; ++k) many.push_back(1 + 0.008 * k * std::abs(std::sin(0.2 * k)));
        for (const auto& test : {testing::make_strip(cycles(), both), testing::make_strip(many, nominal),
                                 testing::make_strip(many, {.direction = direction})}) {
          const Answer columns = ask(*test, *made, p, true), rows = ask(*test, slowly, p, true);
          EXPECT_LE(testing::relative_difference(columns.values, rows.values), 1e-11) << base.first << id << law;
          EXPECT_LE(testing::relative_difference(columns.jacobian, rows.jacobian), 1e-10) << base.first << id << law;
          EXPECT_LE(testing::relative_difference(ask(*test, *made, p, false).values, rows.values), 1e-11);
        }
      }
}

TEST(ScaledPath, IsNotThatOfAModelThatRemembersMore) {
  for (const auto& made : {wrapped("damage", wrapped("viscoelasticity", model("gho"))),
                           wrapped("stress_softening", wrapped("damage", model("gho"))),
                           wrapped("viscoelasticity", wrapped("damage", model("gho")))}) {
    const auto* const factors = dynamic_cast<const EnergyScaledModel*>(made.get());
    const std::vector<double> p(made->describe().parameters.size(), 0.5);
    EXPECT_FALSE(factors != nullptr && factors->scale_path({p, {}, {}}, {}));
  }
}

class MemoryPath : public ::testing::TestWithParam<bool> {};

TEST_P(MemoryPath, PredictsWhatTheSamePathOnTensorsDoes) {
  for (const auto& test : {strip(GetParam()), sheet(GetParam())})
    for (const Subject& one : subjects()) {
      const auto fast = ask(*test, *one.remembering, one.parameters, false);
      const auto slow = ask(*test, *one.on_tensors, one.parameters, false);
      EXPECT_LE(testing::relative_difference(fast.values, slow.values), 1e-9) << one.name;
      EXPECT_LE(testing::relative_difference(ask(*test, *one.remembering, one.parameters, true).values, slow.values),
                1e-9)
          << one.name << " with derivatives";
    }
}

TEST_P(MemoryPath, CarriesDerivativesByAllParametersAsDifferencesFindThem) {
  for (const auto& test : {strip(GetParam()), sheet(GetParam())})
    for (const Subject& one : subjects()) {
      ASSERT_TRUE(test->describe().path_derivatives);
      const Answer exact = ask(*test, *one.remembering, one.parameters, true);
      const std::size_t size = exact.values.size();
      for (std::size_t j = 0; j < one.parameters.size(); ++j) {
        std::vector<double> p = one.parameters;
        const double h = 1e-5 * std::abs(p[j]);
        p[j] = one.parameters[j] + h;
        const auto ahead = ask(*test, *one.on_tensors, p, false).values;
        p[j] = one.parameters[j] - h;
        const auto behind = ask(*test, *one.on_tensors, p, false).values;
        std::vector<double> differences(size),
            column(exact.jacobian.begin() + static_cast<std::ptrdiff_t>(j * size),
                   exact.jacobian.begin() + static_cast<std::ptrdiff_t>((j + 1) * size));
        for (std::size_t i = 0; i < size; ++i) differences[i] = (ahead[i] - behind[i]) / (2 * h);
        // A derivative that is nothing beside what the values are worth is compared with that.
        double scale = 0;
        for (const double value : exact.values) scale = std::max(scale, std::abs(value));
        for (std::size_t i = 0; i < size; ++i)
          EXPECT_NEAR(column[i], differences[i], 1e-6 * std::abs(differences[i]) + 1e-8 * scale / std::abs(p[j]))
              << one.name << ", parameter " << j << ", value " << i;
      }
    }
}

TEST_P(MemoryPath, IsTheBareModelAtTheNulls) {
  for (const auto& test : {strip(GetParam()), sheet(GetParam())})
    for (const Subject& one : subjects())
      EXPECT_EQ(ask(*test, *one.remembering, one.at_null, false).values,
                ask(*test, *one.bare, one.bare_parameters, false).values)
          << one.name;
}

struct Tube {
  std::unique_ptr<Test> test;
  std::vector<double> own;
};
std::vector<Tube> tubes(bool timed) {
  const std::vector<double> pressure{1, 6, 12, 8, 3, 10, 16, 16, 9, 2};
  testing::TubeSetup setup{.channels = {"outer_diameter_stretch", "inner_diameter_stretch", "axial_force"},
                           .axial_stretches = {1.2, 1.2, 1.2, 1.2, 1.2, 1.35, 1.35, 1.35, 1.35, 1.35}};
  setup.options.set("gauss_points", std::int64_t{10});
  if (timed) setup.time = testing::evenly(0.5, 20, pressure.size());
  std::vector<Tube> all;
  all.push_back({testing::make_tube(pressure, setup), testing::bare_tube});
  all.push_back({testing::make_tube(pressure, setup), {60, 0.02, 0, 0.05, 1.4}});
  return all;
}

TEST_P(MemoryPath, OfATubeIsThatOnTensorsWithDerivativesByEverything) {
  for (const Tube& tube : tubes(GetParam()))
    for (const Subject& one : subjects()) {
      if (one.bare->describe().type == "ogden") continue;  // its one tube would be another pressure range
      const std::size_t size = tube.test->rows().count * 3, models = one.parameters.size();
      std::vector<double> p = one.parameters, own = tube.own;
      std::vector<double> values(size), slow(size), jacobian((models + 5) * size);
      const Status status = tube.test->predict({*one.remembering, p, own}, {values, jacobian, {}, {}});
      ASSERT_TRUE(status.ok()) << one.name << ": " << status.reason();
      ASSERT_TRUE(tube.test->predict({*one.on_tensors, p, own}, {slow, {}, {}, {}}).ok());
      // The sector of an opened tube is closed with the wall cut where fibres switch, on tensors without. Damage is
      // felt by the closing too, and doubles what that leaves.
      EXPECT_LE(testing::relative_difference(values, slow), own == testing::bare_tube ? 1e-8 : 2e-5) << one.name;
      for (std::size_t j = 0; j < models + 5; ++j) {
        if (j == models + testing::tethering) continue;  // the exception that the test declares
        double& moved = j < models ? p[j] : own[j - models];
        if (own == testing::bare_tube && j == models) continue;  // kinked at 0: fibres are at rest there
        const double at = moved, h = 1e-5 * std::max(0.1, std::abs(at));
        std::vector<double> ahead(size), behind(size);
        moved = at + h;
        ASSERT_TRUE(tube.test->predict({*one.remembering, p, own}, {ahead, {}, {}, {}}).ok());
        moved = at - h;
        ASSERT_TRUE(tube.test->predict({*one.remembering, p, own}, {behind, {}, {}, {}}).ok());
        moved = at;
        for (std::size_t k = 0; k < 3; ++k) {
          double largest = 0, off = 0;
          for (std::size_t i = k * size / 3; i < (k + 1) * size / 3; ++i) {
            const double difference = (ahead[i] - behind[i]) / (2 * h);
            largest = std::max(largest, std::abs(difference) + 1e-3 * std::abs(values[i]));
            off = std::max(off, std::abs(jacobian[j * size + i] - difference));
          }
          EXPECT_LE(off, 1e-5 * largest) << one.name << ", parameter " << j << ", channel " << k;
        }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Clock, MemoryPath, ::testing::Bool());

TEST(MemoryPathEnergy, HasDerivativesByParameters) {
  for (const auto& [type, parameters] :
       std::vector<std::pair<std::string, std::vector<double>>>{{"gho", {18.668, 0.1367, 24.905, 0.2912, 46.44}},
                                                                {"mooney_rivlin", {10, 4}},
                                                                {"holzapfel_2015", {}},
                                                                {"ogden", {630, 1.3, 1.2, 5, -10, -2}}}) {
    const auto made = model(type);
    std::vector<double> p = parameters;
    if (p.empty())
      for (const Parameter& parameter : made->describe().parameters) p.push_back(parameter.initial);
    ASSERT_TRUE(made->describe().energy_derivatives) << type;
    const std::vector<double> c{1.3, 1.0, 1.1, 1.2, 1 / (1.3 * 1.1), 1 / 1.2};
    const auto energy = [&](const std::vector<double>& at) {
      std::vector<double> W(2);
      EXPECT_TRUE(made->evaluate_axes({2, c, at}, {W, {}, {}, {}}).ok());
      return W;
    };
    std::vector<double> W(2), g(6), h(12), g_dp(6 * p.size()), W_dp(2 * p.size());
    ASSERT_TRUE(made->evaluate_axes({2, c, p}, {W, g, h, g_dp, W_dp}).ok());
    for (std::size_t j = 0; j < p.size(); ++j) {
      auto moved = p;
      const double step = 1e-5 * std::max(1e-2, std::abs(p[j]));
      moved[j] = p[j] + step;
      const auto ahead = energy(moved);
      moved[j] = p[j] - step;
      const auto behind = energy(moved);
      for (std::size_t i = 0; i < 2; ++i)
        EXPECT_NEAR(W_dp[2 * j + i], (ahead[i] - behind[i]) / (2 * step),
                    1e-7 * (1 + std::abs(W[i])) / std::max(1e-2, std::abs(p[j])))
            << type << ", parameter " << j;
    }
  }
}

}  // namespace
}  // namespace tunica::memory_path_test
