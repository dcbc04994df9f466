// SPDX-License-Identifier: Apache-2.0
// What every mechanism that acts on a test promises, on every type of test that it applies to: at its null it is the
// bare test, derivatives there and elsewhere are those of what it predicts.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/mechanism_properties.hpp"
#include "subject.hpp"

namespace tunica::testing::null_of_tests_test {
namespace {

using Values = std::vector<double>;

struct Prediction {
  Values values, jacobian;
};

/// Fibres that carry load in compression too are smooth at rest; see the last test for those that do not.
Prediction predict(const Test& test, const Values& own, bool jacobian = true, const char* fibre_switch = "none") {
  const auto model = testing::model("gho", fibre_switch);
  const std::size_t size = test.rows().channels.size() * test.rows().count;
  Prediction p{Values(size), Values(jacobian ? size * (set_s.size() + own.size()) : 0)};
  const Status status = test.predict({*model, set_s, own}, {p.values, p.jacobian, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return p;
}

using Case = std::pair<std::string, std::string>;  // mechanism, type of test

class OnATest : public ::testing::TestWithParam<Case> {
 protected:
  const MechanismFactory& mechanism = catalogue().mechanisms().at(GetParam().first).factory;
  const Subject on = subject(GetParam().first, GetParam().second);
  const bool costly = on.bare->describe().costly;
  const double plausible = mechanism.plausible_max - mechanism.null;
};

/// The mechanism as the checks of every plugin see it, with fibres that carry load as `fibre_switch` says.
WrappedTest wrapped_test(const MechanismFactory& mechanism, const Subject& on, const char* fibre_switch) {
  const auto shared = [](const std::unique_ptr<Test>& test) {
    return std::shared_ptr<const Test>(test.get(), [](auto) {});
  };
  return {mechanism,
          shared(on.bare),
          shared(on.with),
          on.amplitude,
          on.bare_own,
          on.own,
          {"gho", testing::model("gho", fibre_switch), set_s}};
}

TEST_P(OnATest, TheNullIsTheBareTestBitForBit) {
  for (const char* fibre_switch : {"strain", "none"})
    EXPECT_EQ(null_is_the_bare_test(wrapped_test(mechanism, on, fibre_switch)).counter_example, "");
  EXPECT_EQ(limit_is_the_bare_test(wrapped_test(mechanism, on, "none")).counter_example, "");
}

TEST_P(OnATest, ItsParametersStandBehindThoseOfTheBase) {
  EXPECT_EQ(parameters_stand_behind_those_of_the_base(wrapped_test(mechanism, on, "none")).counter_example, "");
}

/// One-sided differences of fourth order, on each admissible side.
TEST_P(OnATest, ItsDerivativeAtTheNullIsThatOfWhatItPredicts) {
  EXPECT_EQ(derivative_at_the_null_matches_differences(wrapped_test(mechanism, on, "none")).counter_example, "");
  EXPECT_EQ(amplitude_has_an_effect(wrapped_test(mechanism, on, "none")).counter_example, "");
}

TEST_P(OnATest, AnEvenOneHasASecondDerivative) {
  if (mechanism.side != MechanismFactory::Side::even) return;
  const double h = 1e-2 * plausible;
  const Prediction at = predict(*on.with, on.own);
  const Prediction up = predict(*on.with, on.at(h)), down = predict(*on.with, on.at(-h));
  const std::size_t size = at.values.size(), column = (set_s.size() + on.amplitude) * size;
  double largest = 0;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(up.jacobian[column + i]) / h);
  EXPECT_GT(largest, 1e-4);
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_NEAR(up.values[i], down.values[i], 1e-11 * std::abs(at.values[i]));
    const double of_slopes = (up.jacobian[column + i] - down.jacobian[column + i]) / (2 * h);
    EXPECT_NEAR((up.values[i] - 2 * at.values[i] + down.values[i]) / (h * h), of_slopes, 1e-3 * largest);
  }
}

TEST_P(OnATest, AwayFromTheNullItIsATest) {
  const auto model = make_model("gho");
  const double amplitude = mechanism.null + 0.3 * plausible;
  const Simulation simulation{*on.with, *model, set_s, on.at(amplitude), {}};
  if (costly) {  // differences of load steps are not that sharp, and tests of fe_pressurisation see to its own
    EXPECT_EQ(given_abscissae_replace_the_bound_ones(simulation).counter_example, "");
    return;
  }
  for (const TestProperty& property : test_properties())
    EXPECT_EQ(property.check(simulation).counter_example, "") << property.name;
}

TEST_P(OnATest, WhyTheTestFailedIsPassedOn) {
  const auto model = make_model("gho");
  const Values overflowing{18.668, 0.1367, 24.905, 1e6, 46.44};
  Values values(on.with->rows().channels.size() * on.with->rows().count);
  const Status status =
      on.with->predict({*model, overflowing, on.at(mechanism.null + 0.1 * plausible)}, {values, {}, {}, {}});
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_NE(status.reason().find(GetParam().second), std::string::npos) << status.reason();
}

/// In an unloaded wall every fibre is about to carry load. Opened by a positive angle the outer half is taken up,
/// by a negative one the inner half: what is seen has a kink at the null, and the derivative there lies between.
TEST(ResidualStress, HasAnotherDerivativeOnEachSideWhereFibresOnlyPull) {
  const Subject on = subject("residual_stress", "thick_wall_pressurisation");
  const auto by_angle = [&](double angle) {
    const Prediction at = predict(*on.with, on.at(angle), true, "strain");
    return at.jacobian[(set_s.size() + on.amplitude) * at.values.size()];  // of the outer diameter in the first row
  };
  const double below = by_angle(-1e-4), above = by_angle(1e-4);
  EXPECT_GT(above - below, 1e-5);
  EXPECT_GT(by_angle(0), below);
  EXPECT_LT(by_angle(0), above);
}

INSTANTIATE_TEST_SUITE_P(Mechanisms, OnATest, ::testing::ValuesIn([] {
                           std::vector<Case> cases;
                           for (const auto& [id, entry] : catalogue().mechanisms()) {
                             if (entry.factory.stage < Stage::test) continue;
                             std::vector<std::string> types = entry.factory.applies_to;
                             if (types.empty()) types = {"uniaxial", "thick_wall_pressurisation"};
                             // Sheets, and what needs a clock, are held to the same in record_errors_test.cpp, and
                             // measured fields in tests/full_field.
                             for (const std::string& type : types)
                               if (type != "biaxial" && type != "full_field" && id != "channel_lag")
                                 cases.emplace_back(id, type);
                           }
                           return cases;
                         }()),
                         [](const auto& at) { return at.param.first + "_" + at.param.second; });

}  // namespace
}  // namespace tunica::testing::null_of_tests_test
