// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "plugins/calls.hpp"
#include "tunica/status.hpp"

namespace tunica::search {

/// The neighbourhood of a supposed optimum.
struct Neighbourhood {
  /// The lowest feasible objective among the neighbours, and its place.
  struct Lowest {
    double objective = 0, step = 0;  ///< signed, in the unit box; 0: a local search ended there
    std::string along;               ///< a parameter, or "direction 2 of the residuals' curvature"
    std::vector<double> parameters;
  };
  Status status;         ///< of the point itself
  double objective = 0;  ///< of the point itself, evaluated here
  std::size_t evaluated = 0, infeasible = 0, failed = 0;
  std::size_t simulated = 0;     ///< of the evaluated ones, in full: cheap tests settle the others, see early_end.hpp
  std::size_t left_out = 0;      ///< not evaluated, for time was over
  std::optional<Lowest> lowest;  ///< none when no neighbour could be evaluated and is feasible
  bool better = false;           ///< the lowest is below the point by more than rounding
  std::size_t constraints = 0, active_constraints = 0;  ///< values c(p), and those above −active_margin
};

constexpr double neighbour_steps[] = {1e-3, 1e-5};  ///< of the unit box
constexpr double active_margin = 1e-3;

/// Objectives that differ by less count as equal: |a − b| ≤ 1e-9 |b| + 1e-12. The absolute part is for perfect fits of
/// synthetic data, whose objectives are only rounding errors.
bool same_objective(double a, double b);

/// Evaluates the point, and its neighbours at ± the steps above along every parameter and along the eigenvectors of JᵀJ
/// in the unit box, J the Jacobian of the residuals as the objective weighs them. These span the long and the short
/// axes of the valley around the point. They reveal an optimiser that stopped half-way down a curved valley. Neighbours
/// outside the bounds are moved onto them; neighbours that violate a constraint do not count. The point itself is
/// always evaluated; after the deadline neighbours are left out.
Neighbourhood probe_neighbourhood(const assembly::Assembly& assembly, std::span<const double> free,
                                  plugins::Clock::time_point deadline = plugins::Clock::time_point::max());

}  // namespace tunica::search
