// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "data/written_file.hpp"
#include "support/sheet.hpp"

namespace tunica::testing::shear_test {
namespace {

std::unique_ptr<Test> make_shear(const std::string& direction, const std::string& normal,
                                 const std::vector<double>& shear, double angle = 0,
                                 const std::vector<double>& time = {}) {
  TestSetup setup;
  setup.options.set("direction", direction);
  setup.options.set("normal", normal);
  setup.options.set("angle", angle);
  setup.rows.count = shear.size();
  setup.rows.abscissae = {{"shear", shear}};
  setup.rows.channels = {"shear_stress", "normal_stress"};
  setup.rows.time = time;
  return plugins::create(catalogue().tests().at("simple_shear"), setup);
}

const std::vector<std::string> axes{"circumferential", "axial", "radial"};
const std::vector<double> gammas{-0.4, -0.1, 0, 0.2, 0.5, 1};

template <class Check>
void for_each_plane(const Check& check) {
  for (const std::string& direction : axes)
    for (const std::string& normal : axes)
      if (direction != normal) check(direction, normal);
}

// Rivlin (1948): τ = 2 (c10 + c01) γ, and σ_n = −2 c01 γ² with the third pair of faces free.
TEST(SimpleShear, OfMooneysRubberIsRivlinsInEveryPlane) {
  const double c10 = 120, c01 = 40;
  for_each_plane([&](const std::string& direction, const std::string& normal) {
    const auto values = stresses(*make_shear(direction, normal, gammas, 25), *make_model("mooney_rivlin"), {c10, c01});
    for (std::size_t i = 0; i < gammas.size(); ++i) {
      EXPECT_NEAR(values[i], 2 * (c10 + c01) * gammas[i], 1e-10);
      EXPECT_NEAR(values[gammas.size() + i], -2 * c01 * gammas[i] * gammas[i], 1e-10);
    }
  });
}

/// W at C = 1 + γ (a⊗b + b⊗a) + γ² b⊗b.
double energy(const Model& model, const std::vector<double>& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
              double gamma) {
  const Eigen::Matrix3d F = Eigen::Matrix3d::Identity() + gamma * a * b.transpose();
  return conformance::evaluate(model, conformance::to_tensor(F.transpose() * F), p).energy;
}

// The plates do the work: τ = dW/dγ, whatever the pressure. Central differences of the energy, in every plane of a
// wall with fibres, its specimen turned by 20 degrees.
TEST(SimpleShear, DoesTheWorkThatTheEnergyGains) {
  Options options;
  options.set("terms", R"([{"name": "m", "invariant": "I2", "law": "exponential"},
    {"name": "f", "invariant": "fibre", "family": "single", "law": "exponential_square", "fibre_switch": "none"},
    {"name": "r", "invariant": "radial", "law": "quadratic"}])");
  const auto model = make_model("composed", options);
  const std::vector<double> p{30, 0.4, 25, 0.6, 35, 80};  // m_mu, m_b, f_k1, f_k2, f_theta, r_k
  const double turn = 20 * M_PI / 180, h = 1e-5;
  const std::array<Eigen::Vector3d, 3> of_axis{Eigen::Vector3d(std::cos(turn), -std::sin(turn), 0),
                                               Eigen::Vector3d(std::sin(turn), std::cos(turn), 0),
                                               Eigen::Vector3d(0, 0, 1)};
  const auto index = [](const std::string& name) { return std::find(axes.begin(), axes.end(), name) - axes.begin(); };
  for_each_plane([&](const std::string& direction, const std::string& normal) {
    const auto values = stresses(*make_shear(direction, normal, gammas, 20), *model, p);
    const auto &a = of_axis[index(direction)], &b = of_axis[index(normal)];
    for (std::size_t i = 0; i < gammas.size(); ++i) {
      const double slope = (energy(*model, p, a, b, gammas[i] + h) - energy(*model, p, a, b, gammas[i] - h)) / (2 * h);
      EXPECT_NEAR(values[i], slope, 1e-6 * (1 + std::abs(slope))) << direction << ", " << normal;
    }
  });
}

TEST(SimpleShear, RelaxesAtConstantShearAsTheClosedFormDoes) {
  // Held at once from rest: τ(t) = (1 + g e^{−t/τ}) μ γ.
  constexpr double mu = 12, g = 0.8, tau = 5, shear = 0.4;
  const std::vector<double> time{0, 0.5, 2, 10, 200}, held(5, shear);
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const auto values = stresses(*make_shear("axial", "radial", held, 0, time), *viscous, {mu, g, tau});
  for (std::size_t i = 0; i < time.size(); ++i)
    EXPECT_NEAR(values[i], (1 + g * std::exp(-time[i] / tau)) * mu * shear, 1e-10);
  for (std::size_t i = 0; i < time.size(); ++i)  // without a clock: at equilibrium
    EXPECT_NEAR(stresses(*make_shear("axial", "radial", held), *viscous, {mu, g, tau})[i], mu * shear, 1e-10);
}

TEST(SimpleShear, RefusesAPlateThatSlidesAlongItsNormal) {
  EXPECT_THAT(message_of<InputError>([] { (void)make_shear("axial", "axial", {0.1}); }),
              ::testing::HasSubstr("both 'axial', and a plate slides across its normal"));
}

}  // namespace
}  // namespace tunica::testing::shear_test
