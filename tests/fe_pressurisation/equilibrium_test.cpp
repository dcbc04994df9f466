// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <numbers>

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernel.hpp"

namespace tunica::testing::equilibrium_test {
namespace {

constexpr double cross_section = std::numbers::pi * (5.77 * 5.77 - 3.71 * 3.71);

class FiniteElementTube : public ::testing::TestWithParam<std::size_t> {};

/// Walls that are isotropic stay homogeneous: r = R λz^(−1/2), and F = A (λz − λz⁻²) 2 (W1 + W2/λz), exactly.
TEST_P(FiniteElementTube, StretchesUniformlyWithoutPressure) {
  constexpr double lz = 1.35;
  const auto fung = [](const std::vector<double>& p) {  // gho with κ = ⅓, both families
    const double E = (lz * lz + 2 / lz) / 3 - 1;
    return p[0] / 2 + 2. / 3 * p[2] * E * std::exp(p[3] * E * E);
  };
  struct Case {
    const char* model;
    std::vector<double> p;
    double half_modulus;
  };
  const std::vector<double> isotropic{18.668, 1. / 3, 24.905, 0.2912, 46.44};
  for (const Case& wall : {Case{"neo_hooke", {60}, 30}, Case{"mooney_rivlin", {20, 15}, 20 + 15 / lz},
                           Case{"gho", isotropic, fung(isotropic)}}) {
    Kernel kernel(small_mesh(GetParam(), fe::Ends::sliding), make_model(wall.model), wall.p);
    const fe::Observed at = kernel.at({lz, 0});
    const double force = cross_section * (lz - 1 / (lz * lz)) * 2 * wall.half_modulus;
    EXPECT_NEAR(at[2], force, 1e-9 * force) << wall.model;
    const std::vector<double>& x = kernel.path.state().x;
    for (std::size_t i = 0; i < x.size(); i += 2) {
      EXPECT_NEAR(x[i], kernel.solver.rest().x[i] / std::sqrt(lz), 1e-9) << wall.model;
      EXPECT_NEAR(x[i + 1], kernel.solver.rest().x[i + 1] * lz, 1e-9) << wall.model;
    }
    const std::size_t modes = GetParam() == 1 ? 1 : 3;
    for (std::size_t i = 0; i < kernel.path.state().q.size(); ++i)
      if (i % modes == 0)
        EXPECT_NEAR(kernel.path.state().q[i], kernel.path.state().q[0], 1e-7) << wall.model;
      else
        EXPECT_NEAR(kernel.path.state().q[i], 0, 1e-7) << wall.model;
  }
}

/// J = 1 in the mean of every pressure mode, whatever γ stands in the matrix.
TEST_P(FiniteElementTube, IsIncompressibleToTheLastDigits) {
  Kernel kernel(small_mesh(GetParam(), fe::Ends::clamped), make_model("gho"), set_s);
  kernel.at({1.2, 20});
  fe::System system;
  system.gamma = 1;
  ASSERT_TRUE(kernel.solver.assembly().assemble(kernel.material, kernel.path.state(), 20, true, system).ok());
  EXPECT_LT(system.largest_dilation, 1e-12);
}

/// dΠ = F dl − V dP along any path, Π = W − P V: over legs of stretch, of pressure, and of both at once, with Gauss
/// points between. Fibres that always bear, so that the path has no kinks.
TEST_P(FiniteElementTube, TheWorkOfPressureAndEndForceIsTheChangeOfEnergy) {
  Options always;
  always.set("fibre_switch", std::string("none"));
  struct Leg {
    fe::Load from, to;
  };
  for (const fe::Ends ends : {fe::Ends::clamped, fe::Ends::sliding})
    for (const char* type : {"gho", "mooney_rivlin"}) {
      const bool gho = std::string(type) == "gho";
      Kernel kernel(small_mesh(GetParam(), ends), gho ? make_model(type, always) : make_model(type),
                    gho ? set_s : std::vector<double>{25, 15});
      const auto energies = [&](const fe::Load& load, double& lumen, double& stored) {
        const fe::Observed at = kernel.at(load);
        Kernel::expect(kernel.solver.assembly().energies(kernel.material, kernel.path.state(), lumen, stored));
        return at;
      };
      for (const Leg& leg : {Leg{{1, 0}, {1.2, 0}}, Leg{{1.2, 0}, {1.2, 14}}, Leg{{1.2, 14}, {1.35, 18}}}) {
        double lumen = 0, stored = 0;
        energies(leg.from, lumen, stored);
        const double start = stored - leg.from.pressure * lumen, stored_before = stored;
        const double work = boost::math::quadrature::gauss<double, 20>::integrate(
            [&](double t) {
              double V = 0, W = 0;
              const double dl = (leg.to.stretch - leg.from.stretch) * 7, dP = leg.to.pressure - leg.from.pressure;
              const fe::Observed at = energies(
                  {leg.from.stretch + t * (leg.to.stretch - leg.from.stretch), leg.from.pressure + t * dP}, V, W);
              return at[2] * dl - V * dP;
            },
            0, 1);
        energies(leg.to, lumen, stored);
        EXPECT_NEAR(stored - leg.to.pressure * lumen - start, work, 1e-6 * std::abs(stored - stored_before))
            << type << ", to stretch " << leg.to.stretch << " and pressure " << leg.to.pressure;
      }
    }
}

/// From a state far away, full steps: each error is at most a constant times the square of the one before, until
/// rounding. A step is the error before it, up to its square.
TEST_P(FiniteElementTube, NewtonsMethodConvergesQuadratically) {
  for (const char* type : {"gho", "mooney_rivlin"}) {
    const bool gho = std::string(type) == "gho";
    Kernel kernel(small_mesh(GetParam(), fe::Ends::clamped), make_model(type),
                  gho ? set_s : std::vector<double>{25, 15});
    kernel.at({1.2, 10});
    fe::State state = kernel.path.state();
    ASSERT_TRUE(kernel.solver.begin(kernel.material).ok());  // forgets the factor, so that every step is a full one
    ASSERT_TRUE(kernel.solver.solve({1.25, 16}, state, fe::Aim::factor).ok());
    const std::vector<double>& steps = kernel.solver.effort().steps;
    std::string history;
    for (const double step : steps) history += fmt::format(" {:.1e}", step);
    std::printf("  %s, %s nodes: steps%s\n", type, GetParam() == 1 ? "four" : "nine", history.c_str());
    ASSERT_GE(steps.size(), 4u) << history;
    EXPECT_LE(steps.size(), 7u) << history;
    EXPECT_EQ(kernel.solver.effort().factorisations, steps.size());
    for (std::size_t k = 2; k < steps.size(); ++k)
      EXPECT_LT(steps[k], std::max(30 * steps[k - 1] * steps[k - 1], 1e-12)) << history;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, FiniteElementTube, ::testing::Values(1, 2),
                         [](const auto& at) { return at.param == 1 ? "FourNodes" : "NineNodes"; });

}  // namespace
}  // namespace tunica::testing::equilibrium_test
