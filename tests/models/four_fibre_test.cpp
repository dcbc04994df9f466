// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/loaded.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

double exponential(double k1, double k2, double e) { return e > 0 ? k1 / (2 * k2) * (std::exp(k2 * e * e) - 1) : 0; }

TEST(FourFibre, EnergyIsHgoAndOneFamilyAlongEachAxis) {
  // p: mu, k1, k2, theta, k1_axial, k2_axial, k1_circumferential, k2_circumferential. Seed 6, deterministic.
  const auto model = make_model("four_fibre"), hgo = make_model("hgo");
  Sampler sampler(6);
  for (int draw = 0; draw < 50; ++draw) {
    std::vector<double> p = sampler.parameters(model->describe());
    p[5] = std::min(p[5], 10.0);
    p[7] = std::min(p[7], 10.0);
    const Tensor C = sampler.right_cauchy_green();
    const double expected = evaluate(*hgo, C, std::vector<double>(p.begin(), p.begin() + 4)).energy +
                            exponential(p[4], p[5], C[1] - 1) + exponential(p[6], p[7], C[0] - 1);
    EXPECT_NEAR(evaluate(*model, C, p).energy, expected, 1e-12 * std::max(1.0, std::abs(expected)));
  }
}

TEST(FourFibre, SwitchesEachFamilyByItself) {
  // Shortened along z, stretched along t: the axial family is silent, the circumferential one counts once.
  const auto model = make_model("four_fibre");
  const std::vector<double> p{10, 1e-9, 1, 45, 200, 2, 30, 1};
  const Tensor C{1.2, 0.8, 1 / 0.96, 0, 0, 0};
  const Tensor S = evaluate(*model, C, p).stress;
  EXPECT_NEAR(S[1], 10, 1e-6);
  EXPECT_NEAR(S[0], 10 + 2 * 30 * 0.2 * std::exp(0.04), 1e-6);
}

TEST(FourFibre, HasFourPartsThatMechanismsCanTransform) {
  const auto model = make_model("four_fibre");
  std::vector<std::string> names;
  std::size_t mirrored = 0;
  for (const auto& part : model->parts()) {
    names.push_back(part->describe().name);
    mirrored += part->describe().mirrored;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"matrix", "fibres", "axial_fibres", "circumferential_fibres"}));
  EXPECT_EQ(mirrored, 1u);
}

}  // namespace
}  // namespace tunica::testing
