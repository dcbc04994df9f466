// SPDX-License-Identifier: Apache-2.0
#include "assembly.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "kernel.hpp"
#include "support/tensors_only.hpp"

namespace tunica::testing::assembly_test {
namespace {

struct Case {
  const char* name;
  std::size_t order;
  const char* model;
  std::vector<double> parameters;
};

/// Set S, whose energy does not see C_zr, and a rubber with I2, whose energy does.
class FiniteElementAssembly : public ::testing::TestWithParam<Case> {
 protected:
  static constexpr double pressure = 9, gamma = 1e5;
  Case is = GetParam();
  std::unique_ptr<Model> model = make_model(is.model);
  fe::Material material{*model, is.parameters};
  fe::Mesh mesh = small_mesh(is.order, fe::Ends::clamped);
  fe::Solver solver{mesh};
  std::unique_ptr<fe::Assembly> assembly = fe::Assembly::make(mesh);

  fe::System assembled(const fe::State& state, double at_pressure, fe::Assembly& by) const {
    fe::System system;
    system.gamma = gamma;
    EXPECT_TRUE(by.assemble(material, state, at_pressure, true, system).ok());
    return system;
  }
  /// Π over 2π, from the energies that the assembly integrates and what it says of J − 1.
  double potential(const fe::State& state) {
    double lumen = 0, stored = 0;
    EXPECT_TRUE(assembly->energies(material, state, lumen, stored).ok());
    const fe::System system = assembled(state, pressure, *assembly);
    double sum = (stored - pressure * lumen) / (2 * std::numbers::pi);
    for (std::size_t i = 0; i < state.q.size(); ++i) sum -= state.q[i] * system.dilation[i];
    return sum;
  }
};

TEST_P(FiniteElementAssembly, TheForceIsTheGradientOfThePotential) {
  fe::State state = disturbed(solver, 0.1, 20, 1);
  const fe::System system = assembled(state, pressure, *assembly);
  double scale = 0;
  for (const double f : system.force) scale = std::max(scale, std::abs(f));
  constexpr double h = 1e-5;
  for (std::size_t i = 0; i < state.x.size(); i += 3) {
    const double x = state.x[i];
    state.x[i] = x + h;
    const double above = potential(state);
    state.x[i] = x - h;
    const double below = potential(state);
    state.x[i] = x;
    EXPECT_NEAR(system.force[i], (above - below) / (2 * h), 1e-7 * scale) << i;
  }
}

/// Along a seeded direction: with dq = −γ M⁻¹ Gᵀ dx the condensed matrix is the derivative of the force.
TEST_P(FiniteElementAssembly, TheMatrixIsTheDerivativeOfTheForce) {
  const fe::State state = disturbed(solver, 0.1, 20, 2);
  const fe::System system = assembled(state, pressure, *assembly);
  fe::State direction = disturbed(solver, 1, 0, 3), up = state, down = state;
  for (std::size_t i = 0; i < state.x.size(); ++i) direction.x[i] -= solver.rest().x[i];
  assembly->pressures(system, direction.x, {}, direction.q);
  constexpr double h = 1e-7;
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    up.x[i] += h * direction.x[i];
    down.x[i] -= h * direction.x[i];
  }
  for (std::size_t i = 0; i < state.q.size(); ++i) {
    up.q[i] += h * direction.q[i];
    down.q[i] -= h * direction.q[i];
  }
  const fe::System above = assembled(up, pressure, *assembly), below = assembled(down, pressure, *assembly);
  std::vector<double> product(state.x.size());
  system.matrix.multiply(direction.x, product);
  double scale = 0;
  for (const double entry : product) scale = std::max(scale, std::abs(entry));
  for (std::size_t i = 0; i < product.size(); ++i)
    EXPECT_NEAR(product[i], (above.force[i] - below.force[i]) / (2 * h), 1e-6 * scale) << i;
}

/// −right · ∂force/∂p + dilation · ∂c/∂p of arbitrary weights, at a state far from equilibrium.
TEST_P(FiniteElementAssembly, ChangesByParametersAndThicknessMatchDifferences) {
  const fe::State state = disturbed(solver, 0.1, 20, 4);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<fe::Weights> weights(2);
  for (fe::Weights& weight : weights) {
    weight.right.resize(state.x.size());
    weight.dilation.resize(state.q.size());
    for (double& value : weight.right) value = any(generator);
    for (double& value : weight.dilation) value = any(generator);
  }
  const std::size_t count = is.parameters.size();
  fe::State residual;
  fe::Changes changes;
  ASSERT_TRUE(assembly->multiply(material, state, pressure, {}, {}, residual, &changes).ok());
  const auto contracted = [&](const fe::Material& at, fe::Assembly& on, const fe::Weights& weight) {
    fe::System system;
    EXPECT_TRUE(on.assemble(at, state, pressure, true, system).ok());
    return std::inner_product(weight.dilation.begin(), weight.dilation.end(), system.dilation.begin(), 0.0) -
           std::inner_product(weight.right.begin(), weight.right.end(), system.force.begin(), 0.0);
  };
  const auto thicker = [&](double by_part) {
    fe::Mesh other = solver.mesh();
    other.inner = other.outer - (1 + by_part) * (other.outer - other.inner);
    return fe::Assembly::make(other);
  };
  for (std::size_t j = 0; j <= count; ++j) {
    const double h = j < count ? 1e-4 * is.parameters[j] : 1e-4;
    for (std::size_t k = 0; k < weights.size(); ++k) {
      const auto at = [&](double steps) {
        if (j == count) return contracted(material, *thicker(steps * h), weights[k]);
        std::vector<double> moved = is.parameters;
        moved[j] += steps * h;
        return contracted(fe::Material(*model, moved), *assembly, weights[k]);
      };
      const double expected = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * h);
      ASSERT_NE(expected, 0);
      const auto right = weights[k].right, dilation = weights[k].dilation;
      const double* const force = &changes.force[j * right.size()];
      double found = -std::inner_product(right.begin(), right.end(), force, 0.0);
      if (j == count) found += std::inner_product(dilation.begin(), dilation.end(), changes.dilation.begin(), 0.0);
      EXPECT_NEAR(found, expected, 1e-8 * std::abs(expected)) << j << ", " << k;
    }
  }
}

/// A model whose derivatives by its first parameter are no numbers.
class Spoiled final : public TensorsOnly {
 public:
  using TensorsOnly::TensorsOnly;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = TensorsOnly::evaluate(points, response);
    if (!response.stress_dp.empty()) std::fill_n(response.stress_dp.begin(), 6 * points.count, std::nan(""));
    return status;
  }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return {}; }
};

/// It may be held: then nobody asks for them.
TEST_P(FiniteElementAssembly, WhatIsNoNumberStaysWithItsParameter) {
  const fe::State state = disturbed(solver, 0.1, 20, 4);
  const TensorsOnly sound(make_model(is.model));
  const Spoiled spoiled(make_model(is.model));
  const auto changes_of = [&](const Model& of) {
    fe::State residual;
    fe::Changes changes;
    EXPECT_TRUE(assembly->multiply(fe::Material(of, is.parameters), state, pressure, {}, {}, residual, &changes).ok());
    return changes.force;
  };
  const std::vector<double> expected = changes_of(sound), found = changes_of(spoiled);
  ASSERT_EQ(found.size(), expected.size());
  const std::size_t each = state.x.size();
  EXPECT_TRUE(std::any_of(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(each),
                          [](double value) { return std::isnan(value); }));
  for (std::size_t i = each; i < found.size(); ++i) EXPECT_EQ(found[i], expected[i]) << i;
}

/// K y − G h and Gᵀ y are differences of ∂Π/∂x and c, and what comes with them is ∂Π/∂x and c.
TEST_P(FiniteElementAssembly, MultipliesByTheDerivativesOfTheEquations) {
  assembly->support = {7, std::vector<double>(solver.mesh().planes(), 0.99 * solver.mesh().outer)};
  const fe::State state = disturbed(solver, 0.1, 20, 9);
  std::vector<fe::State> fields{disturbed(solver, 1, 3, 10), disturbed(solver, 1, 3, 11)}, products(2);
  for (fe::State& field : fields)
    for (std::size_t i = 0; i < field.x.size(); ++i) field.x[i] -= solver.rest().x[i];
  fe::State residual;
  ASSERT_TRUE(assembly->multiply(material, state, pressure, fields, products, residual, nullptr).ok());
  const fe::System here = assembled(state, pressure, *assembly);
  for (std::size_t i = 0; i < state.x.size(); ++i) EXPECT_NEAR(residual.x[i], here.force[i], 1e-10) << i;
  for (std::size_t i = 0; i < state.q.size(); ++i) EXPECT_NEAR(residual.q[i], here.dilation[i], 1e-12) << i;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto at = [&](double steps) {
      fe::State moved = state;
      for (std::size_t i = 0; i < state.x.size(); ++i) moved.x[i] += steps * 1e-6 * fields[k].x[i];
      for (std::size_t i = 0; i < state.q.size(); ++i) moved.q[i] += steps * 1e-6 * fields[k].q[i];
      return assembled(moved, pressure, *assembly);
    };
    const fe::System up = at(1), down = at(-1), up2 = at(2), down2 = at(-2);
    const auto compare = [](const std::vector<double>& found, const auto& expected) {
      double scale = 0;
      for (const double entry : found) scale = std::max(scale, std::abs(entry));
      EXPECT_GT(scale, 0);
      for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected(i), 1e-8 * scale) << i;
    };
    const auto difference = [&](auto member) {
      return [=, &up, &down, &up2, &down2](std::size_t i) {
        return (8 * ((up.*member)[i] - (down.*member)[i]) - ((up2.*member)[i] - (down2.*member)[i])) / 12e-6;
      };
    };
    compare(products[k].x, difference(&fe::System::force));
    compare(products[k].q, difference(&fe::System::dilation));
  }
  assembly->support = {};
}

TEST_P(FiniteElementAssembly, ATubeMovedAlongItsAxisFeelsNoForce) {
  const auto shifted = [](fe::State state) {
    for (std::size_t i = 1; i < state.x.size(); i += 2) state.x[i] += 4.2;
    return state;
  };
  fe::System system = assembled(shifted(solver.rest()), 0, *assembly);
  // At rest a constant pressure balances 2 ∂W/∂C.
  std::vector<double> first(4);
  ASSERT_TRUE(material.evaluate(1, std::vector<double>{1, 1, 1, 0}, first, {}, {}).ok());
  fe::State rest = shifted(solver.rest());
  for (std::size_t i = 0; i < rest.q.size(); ++i) rest.q[i] = i % (is.order == 1 ? 1 : 3) == 0 ? 2 * first[2] : 0;
  system = assembled(rest, 0, *assembly);
  for (const double f : system.force) EXPECT_NEAR(f, 0, 1e-11 * first[2]);
  const fe::State state = disturbed(solver, 0.1, 20, 5);
  const fe::System here = assembled(state, pressure, *assembly), there = assembled(shifted(state), pressure, *assembly);
  for (std::size_t i = 0; i < state.x.size(); ++i) EXPECT_NEAR(here.force[i], there.force[i], 1e-8) << i;
}

/// In a tube of a radius ten million times its wall a section may be turned in its plane: the hoop stretch changes by
/// 1e-7. Forces turn with it, the matrix between turned vectors too, and the energy stays.
TEST_P(FiniteElementAssembly, ATurnedSectionCarriesTurnedForces) {
  constexpr double inner = 1e7, angle = 0.7;
  const fe::Mesh wide(is.order, 3, 3, inner, inner + 1, 1, 1, fe::Ends::sliding);
  const auto by = fe::Assembly::make(wide);
  const fe::Solver at(wide);
  const fe::State state = disturbed(at, 0.05, 20, 6);
  const auto turn = [&](std::vector<double> x, double centre) {
    for (std::size_t i = 0; i < x.size(); i += 2) {
      const double r = x[i] - centre, z = x[i + 1];
      x[i] = centre + std::cos(angle) * r - std::sin(angle) * z;
      x[i + 1] = std::sin(angle) * r + std::cos(angle) * z;
    }
    return x;
  };
  fe::State turned = state;
  turned.x = turn(state.x, inner);
  const fe::System before = assembled(state, 0, *by), after = assembled(turned, 0, *by);
  double scale = 0, lumen = 0, stored = 0, stored_after = 0;
  const auto compare = [&](const std::vector<double>& expected, const std::vector<double>& found) {
    scale = 0;
    for (const double entry : expected) scale = std::max(scale, std::abs(entry));
    for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i], found[i], 2e-6 * scale) << i;
  };
  compare(turn(before.force, 0), after.force);
  fe::State direction = disturbed(at, 1, 0, 7);
  for (std::size_t i = 0; i < direction.x.size(); ++i) direction.x[i] -= at.rest().x[i];
  std::vector<double> product(direction.x.size()), turned_product(direction.x.size());
  before.matrix.multiply(direction.x, product);
  after.matrix.multiply(turn(direction.x, 0), turned_product);
  compare(turn(product, 0), turned_product);
  ASSERT_TRUE(by->energies(material, state, lumen, stored).ok());
  ASSERT_TRUE(by->energies(material, turned, lumen, stored_after).ok());
  EXPECT_NEAR(stored, stored_after, 2e-6 * stored);
}

TEST_P(FiniteElementAssembly, AnOverflowIsAStatus) {
  const fe::State state = disturbed(solver, 0.1, 20, 8);
  fe::State far = state;
  far.x[10] = 1e200;
  fe::System system;
  system.gamma = gamma;
  const Status status = assembly->assemble(material, far, pressure, true, system);
  EXPECT_EQ(status.reason(), "the stress overflows, or an element is turned inside out");
}

INSTANTIATE_TEST_SUITE_P(Both, FiniteElementAssembly,
                         ::testing::Values(Case{"FourNodes", 1, "gho", set_s},
                                           Case{"FourNodesWithI2", 1, "mooney_rivlin", {20, 15}},
                                           Case{"NineNodes", 2, "gho", set_s},
                                           Case{"NineNodesWithI2", 2, "mooney_rivlin", {20, 15}}),
                         [](const auto& at) { return std::string(at.param.name); });

}  // namespace
}  // namespace tunica::testing::assembly_test
