// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <stdexcept>

#include "path.hpp"
#include "support/tube.hpp"

namespace tunica::testing {

/// The wall of the lamb aorta (Canales et al. 2023) in few elements.
inline fe::Mesh small_mesh(std::size_t order, fe::Ends ends, double grading = 1.5) {
  return order == 1 ? fe::Mesh(1, 5, 7, 3.71, 5.77, 7, grading, ends) : fe::Mesh(2, 3, 4, 3.71, 5.77, 7, grading, ends);
}

/// A model bound to parameters, on a mesh, followed from rest.
struct Kernel {
  std::unique_ptr<Model> model;
  std::vector<double> parameters;
  fe::Material material{*model, parameters};
  fe::Solver solver;
  fe::Path path{solver, {}};

  Kernel(const fe::Mesh& mesh, std::unique_ptr<Model> model_, std::vector<double> parameters_)
      : model(std::move(model_)), parameters(std::move(parameters_)), solver(mesh) {
    expect(solver.begin(material));
    expect(path.begin());
  }
  Kernel(const Kernel&) = delete;
  Kernel& operator=(const Kernel&) = delete;

  static void expect(const Status& status) {
    if (!status.ok()) throw std::runtime_error(status.reason());
  }
  /// Observed at a load, to the last digit.
  fe::Observed at(const fe::Load& load) {
    expect(path.go(load, fe::Aim::factor));
    return path.observed();
  }
};

/// Rest, its positions and pressures disturbed.
inline fe::State disturbed(const fe::Solver& solver, double positions, double pressures, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  fe::State state = solver.rest();
  for (double& x : state.x) x += positions * unit(engine);
  for (double& q : state.q) q += pressures * unit(engine);
  return state;
}

}  // namespace tunica::testing
