// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "support/strip.hpp"

// The mechanism inside a simulated test: state carried from row to row, lateral equilibrium with the overstress.
namespace tunica::viscoelastic_strip_test {
namespace {

using testing::make_strip;

std::vector<double> values_of(const Test& test, const Model& model, const std::vector<double>& parameters) {
  const testing::Prediction predicted = testing::predict(test, model, parameters);
  EXPECT_TRUE(predicted.status.ok()) << predicted.status.reason();
  return predicted.values;
}

TEST(ViscoelasticStrip, RelaxesAtConstantStretchAsTheClosedFormDoes) {
  // Held at once from rest, an isotropic strip: σ(t) = (1 + g e^{−t/τ}) μ (λ² − 1/λ).
  constexpr double mu = 12, g = 0.8, tau = 5, stretch = 1.4;
  const std::vector<double> time{0, 0.5, 2, 10, 200};
  const auto test =
      make_strip(std::vector<double>(5, stretch), {.channels = {"stress", "transverse_stretch"}, .time = time});
  const auto viscous = testing::wrapped("viscoelasticity", testing::model("neo_hooke"));
  const std::vector<double> values = values_of(*test, *viscous, {mu, g, tau});
  for (std::size_t i = 0; i < 5; ++i) {
    const double expected = (1 + g * std::exp(-time[i] / tau)) * mu * (stretch * stretch - 1 / stretch);
    EXPECT_NEAR(values[i], expected, 1e-9 * expected) << time[i] << " s";
    EXPECT_NEAR(values[5 + i], 1 / std::sqrt(stretch), 1e-9);
  }
}

TEST(ViscoelasticStrip, IsAtEquilibriumWithoutTime) {
  const std::vector<double> stretch{1, 1.1, 1.3, 1.5}, hgo{18.7, 24.9, 0.9, 46};
  const std::vector<double> with_branch{18.7, 24.9, 0.9, 46, 0.8, 5};
  const auto test = make_strip(stretch, {.channels = {"stress", "transverse_stretch"}});
  const auto viscous = testing::wrapped("viscoelasticity", testing::model("hgo"));
  EXPECT_LE(testing::relative_difference(values_of(*test, *viscous, with_branch),
                                         values_of(*test, *testing::model("hgo"), hgo)),
            1e-9);
}

TEST(ViscoelasticStrip, IsStifferTheFasterItIsPulled) {
  const std::vector<double> stretch{1, 1.1, 1.2, 1.3}, with_branch{18.7, 24.9, 0.9, 46, 0.8, 5};
  const auto viscous = testing::wrapped("viscoelasticity", testing::model("hgo"));
  const auto last_stress = [&](double duration) {
    const std::vector<double> time{0, duration / 3, 2 * duration / 3, duration};
    return values_of(*make_strip(stretch, {.time = time}), *viscous, with_branch).back();
  };
  EXPECT_GT(last_stress(0.1), 1.2 * last_stress(10));
  EXPECT_GT(last_stress(10), 1.2 * last_stress(1000));
}

}  // namespace
}  // namespace tunica::viscoelastic_strip_test
