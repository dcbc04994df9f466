// SPDX-License-Identifier: Apache-2.0
// Myocardium: the closed forms of Holzapfel & Ogden (2009) in all six shears of a cube, and the energy by vectors.
#include <cmath>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/sheet.hpp"
#include "support/strip.hpp"

namespace tunica::testing::holzapfel_ogden_test {
using namespace conformance;
namespace {

/// Table 1 of the paper, without the angle: a, b, a_f, b_f, a_s, b_s, a_fs, b_fs.
const std::vector<double> published{0.059, 8.023, 18.472, 16.026, 2.481, 11.12, 0.216, 11.436};

std::vector<double> at_angle(double theta) {
  std::vector<double> p = published;
  p.push_back(theta);
  return p;
}

std::unique_ptr<Model> myocardium(const std::string& sheet) {
  Options options;
  options.set("sheet", sheet);
  return make_model("holzapfel_ogden", options);
}

/// Where the three directions of the material lie in the block that is sheared.
struct Frame {
  std::string sheet;
  double theta, angle;  ///< of the fibres in the wall, and of the block
  std::map<char, std::string> axis;
};
const std::vector<Frame> frames{
    {"radial", 90, 0, {{'f', "circumferential"}, {'s', "radial"}, {'n', "axial"}}},
    {"radial", 0, 0, {{'f', "axial"}, {'s', "radial"}, {'n', "circumferential"}}},
    {"radial", 35, 35, {{'f', "axial"}, {'s', "radial"}, {'n', "circumferential"}}},
    {"in_plane", 90, 0, {{'f', "circumferential"}, {'s', "axial"}, {'n', "radial"}}},
    {"in_plane", 20, 110, {{'f', "circumferential"}, {'s', "axial"}, {'n', "radial"}}},
};

/// Shear stresses of the mode "normal, direction".
std::vector<double> sheared(const Frame& frame, char normal, char direction, const std::vector<double>& shear) {
  TestSetup setup;
  setup.options.set("direction", frame.axis.at(direction));
  setup.options.set("normal", frame.axis.at(normal));
  setup.options.set("angle", frame.angle);
  setup.rows.count = shear.size();
  setup.rows.abscissae = {{"shear", shear}};
  setup.rows.channels = {"shear_stress"};
  return stresses(*plugins::create(catalogue().tests().at("simple_shear"), setup), *myocardium(frame.sheet),
                  at_angle(frame.theta));
}

// Plate of normal N moved along D: I1 − 3 = γ², I4N − 1 = γ², and I8 = γ where N and D are f and s. With τ = dW/dγ
//   τ = a γ exp(b γ²) + 2 a_N γ³ exp(b_N γ⁴) + a_fs γ exp(b_fs γ²),   a_n = 0.
TEST(HolzapfelOgden, ShearsInSixModesAsTheClosedFormsDo) {
  const auto& p = published;
  const std::vector<double> shear{-0.5, -0.2, 0, 0.1, 0.3, 0.5};
  for (const Frame& frame : frames)
    for (const std::string mode : {"fs", "fn", "sf", "sn", "nf", "ns"}) {
      const std::vector<double> tau = sheared(frame, mode[0], mode[1], shear);
      for (std::size_t i = 0; i < shear.size(); ++i) {
        const double g = shear[i], g2 = g * g;
        double expected = p[0] * g * std::exp(p[1] * g2);
        if (mode[0] == 'f') expected += 2 * p[2] * g2 * g * std::exp(p[3] * g2 * g2);
        if (mode[0] == 's') expected += 2 * p[4] * g2 * g * std::exp(p[5] * g2 * g2);
        if (mode == "fs" || mode == "sf") expected += p[6] * g * std::exp(p[7] * g2);
        EXPECT_NEAR(tau[i], expected, 1e-12 * (1 + std::abs(expected))) << mode << " at " << g << ", " << frame.sheet;
      }
    }
}

// Dokos et al. (2002): fs is the stiffest, then fn, sf, sn, and the two modes of the normal are alike.
TEST(HolzapfelOgden, OrdersTheModesOfShearAsMyocardiumDoes) {
  std::vector<double> tau;
  for (const std::string mode : {"fs", "fn", "sf", "sn", "nf", "ns"})
    tau.push_back(sheared(frames.front(), mode[0], mode[1], {0.5}).front());
  for (std::size_t k = 0; k < 4; ++k) EXPECT_GT(tau[k], 1.1 * tau[k + 1]) << k;
  EXPECT_NEAR(tau[4], tau[5], 1e-14);
}

// The energy by the vectors f and s.
TEST(HolzapfelOgden, EnergyIsTheFormula) {
  for (const std::string sheet : {"radial", "in_plane"}) {
    const auto model = myocardium(sheet);
    Sampler sampler(5);
    for (int draw = 0; draw < 40; ++draw) {
      const auto [C, p] = sampler.point(*model);
      const double angle = p[8] * M_PI / 180;
      const Matrix c = to_matrix(C);
      const Eigen::Vector3d f(std::sin(angle), std::cos(angle), 0),
          s = sheet == "radial" ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(std::cos(angle), -std::sin(angle), 0);
      const auto pulled = [](double i4) { return std::max(0.0, i4 - 1); };
      const double x = c.trace() - 3, e_f = pulled(f.dot(c * f)), e_s = pulled(s.dot(c * s)), i8 = f.dot(c * s);
      const auto term = [](double stiffness, double rate, double y) {
        return stiffness / (2 * rate) * std::expm1(rate * y);
      };
      const double expected =
          term(p[0], p[1], x) + term(p[2], p[3], e_f * e_f) + term(p[4], p[5], e_s * e_s) + term(p[6], p[7], i8 * i8);
      EXPECT_NEAR(evaluate(*model, C, p).energy, expected, 1e-11 * std::max(1.0, std::abs(expected))) << sheet;
    }
  }
}

// One tilted family is no wall with paired fibres, so that it lacks the mirror image of one. Seed 20230211.
TEST(HolzapfelOgden, KeepsEveryOtherPropertyOfAModel) {
  for (const std::string sheet : {"radial", "in_plane"})
    for (const ModelProperty& property : model_properties())
      if (!property.advisory) {
        EXPECT_EQ(property.check(*myocardium(sheet), 20230211).counter_example, "") << sheet << ", " << property.name;
      }
}

TEST(HolzapfelOgden, OffersItsFibresInTheWallToMechanisms) {
  const auto fibres = [](const Model& model) {
    std::vector<std::string> names;
    for (const auto& part : model.parts())
      if (part->describe().role == EnergyPart::Role::fibre) names.push_back(part->describe().name);
    return names;
  };
  EXPECT_THAT(fibres(*myocardium("radial")), ::testing::ElementsAre("fibres"));
  EXPECT_THAT(fibres(*myocardium("in_plane")), ::testing::ElementsAre("fibres", "sheets"));
}

// Pulled along the fibres a strip is compressed in the two other directions, where sheets carry nothing.
TEST(HolzapfelOgden, StripsAlongTheFibresNarrowAlikeInBothDirections) {
  const auto strip = make_strip({1.2}, {.channels = {"transverse_stretch", "normal_stretch"}});
  const Prediction radial = predict(*strip, *myocardium("radial"), at_angle(90)),
                   in_plane = predict(*strip, *myocardium("in_plane"), at_angle(90));
  ASSERT_TRUE(radial.status.ok() && in_plane.status.ok());
  EXPECT_NEAR(radial.values[0], 1 / std::sqrt(1.2), 1e-9);
  EXPECT_NEAR(in_plane.values[0], 1 / std::sqrt(1.2), 1e-9);
}

}  // namespace
}  // namespace tunica::testing::holzapfel_ogden_test
