// SPDX-License-Identifier: Apache-2.0
// An energy is known up to a constant. Mechanisms that compare energies count from rest, so that a constant, even one
// that depends on a parameter, changes nothing.
#include <cmath>

#include <gtest/gtest.h>

#include "deformations.hpp"
#include "shelf.hpp"
#include "support/strip.hpp"

namespace tunica::energy_at_rest_test {
namespace {

constexpr double share = 0.3;

/// neo_hooke with W + share μ.
class Raised final : public Model {
 public:
  [[nodiscard]] const ModelDescription& describe() const override { return base_->describe(); }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const Status status = base_->evaluate(points, response);
    for (double& energy : response.energy) energy += share * points.parameters[0];
    return status;
  }
  Status evaluate_axes(const AxisPoints& points, const AxisResponse& response) const override {
    const Status status = base_->evaluate_axes(points, response);
    for (double& energy : response.energy) energy += share * points.parameters[0];
    for (std::size_t i = 0; i < points.count && !response.energy_dp.empty(); ++i) response.energy_dp[i] += share;
    return status;
  }

 private:
  std::unique_ptr<Model> base_ = testing::model("neo_hooke");
};

const std::vector<double> parameters{25, 0.45, 0.3};

TEST(EnergyAtRest, DoesNotSoftenAPoint) {
  const auto plain = testing::wrapped("stress_softening", testing::model("neo_hooke"));
  const auto raised = testing::wrapped("stress_softening", std::make_unique<Raised>());
  std::vector<double> state, raised_state;
  double softest = 1;
  for (const double stretch : {1.2, 1.5, 1.3, 1.05, 1.4, 1.6, 1.1}) {
    const std::vector<double> C = testing::uniaxial_deformation(stretch);
    const auto expected = testing::evaluate(*plain, C, parameters, {.state = true}, {}, state);
    const auto found = testing::evaluate(*raised, C, parameters, {.state = true}, {}, raised_state);
    for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(found.stress[c], expected.stress[c], 1e-10 * parameters[0]);
    for (std::size_t c = 0; c < 36; ++c) EXPECT_NEAR(found.tangent[c], expected.tangent[c], 1e-9 * parameters[0]);
    EXPECT_NEAR(found.state[0], expected.state[0], 1e-12 * parameters[0]) << "Wmax counts from rest";
    softest = std::min(softest, found.stress[0] / testing::evaluate(*plain, C, parameters).stress[0]);
    state = expected.state;
    raised_state = found.state;
  }
  EXPECT_LT(softest, 0.6);
}

TEST(EnergyAtRest, DoesNotSoftenAStripNorItsDerivatives) {
  const auto test = testing::make_strip({1, 1.2, 1.4, 1.3, 1.1, 1, 1.15, 1.35, 1.6, 1.2});
  const auto plain = testing::wrapped("stress_softening", testing::model("neo_hooke"));
  const auto raised = testing::wrapped("stress_softening", std::make_unique<Raised>());
  const std::size_t n = test->rows().count;
  const std::vector<double> own{0};
  std::vector<double> expected(n), found(n), expected_slopes(4 * n), found_slopes(4 * n);
  ASSERT_TRUE(test->predict({*plain, parameters, own}, {expected, expected_slopes, {}, {}}).ok());
  ASSERT_TRUE(test->predict({*raised, parameters, own}, {found, found_slopes, {}, {}}).ok());
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], expected[i], 1e-10 * parameters[0]) << "row " << i;
  for (std::size_t i = 0; i < 4 * n; ++i)
    EXPECT_NEAR(found_slopes[i], expected_slopes[i], 1e-9 * (1 + std::abs(expected_slopes[i]))) << "entry " << i;
}

}  // namespace
}  // namespace tunica::energy_at_rest_test
