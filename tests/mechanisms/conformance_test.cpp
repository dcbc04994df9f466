// SPDX-License-Identifier: Apache-2.0
// A model inside a mechanism is a model: every property of conformance/model_properties.hpp holds for it too. One seed,
// so the outcome is deterministic, and was a pass when this was committed.
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "shelf.hpp"

namespace tunica::testing::conformance_test {
using namespace conformance;
namespace {

using Case = std::tuple<const char*, const char*, ModelProperty>;  // mechanism, fibre_switch

class DecoratedModel : public ::testing::TestWithParam<Case> {};

TEST_P(DecoratedModel, KeepsTheProperties) {
  const auto& [mechanism, fibre_switch, property] = GetParam();
  EXPECT_EQ(property.check(*wrapped(mechanism, model("hgo", fibre_switch)), 20230211).counter_example, "");
}

INSTANTIATE_TEST_SUITE_P(
    Mechanisms, DecoratedModel,
    ::testing::Combine(::testing::Values("axial_fibres", "chain_extensibility", "circumferential_fibres",
                                         "fibre_dispersion", "matrix_stiffening", "second_invariant", "damage",
                                         "stress_softening", "viscoelasticity"),
                       ::testing::Values("strain", "none"), ::testing::ValuesIn(model_properties())),
    [](const auto& at) {
      return std::string(std::get<0>(at.param)) + "_" + std::get<1>(at.param) + "_" + std::get<2>(at.param).name;
    });

/// Fibres that always carry load are not taken up.
INSTANTIATE_TEST_SUITE_P(Recruitment, DecoratedModel,
                         ::testing::Combine(::testing::Values("fibre_recruitment"), ::testing::Values("strain"),
                                            ::testing::ValuesIn(model_properties())),
                         [](const auto& at) { return std::string(std::get<2>(at.param).name); });

}  // namespace
}  // namespace tunica::testing::conformance_test
