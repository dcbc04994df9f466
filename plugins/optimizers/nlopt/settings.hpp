// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tunica::nlopt_plugin {

enum class Algorithm { crs2_lm, isres, direct_l, mlsl, cobyla, bobyqa, slsqp };

/// What distinguishes the algorithms for their use here.
constexpr bool is_local(Algorithm algorithm) { return algorithm >= Algorithm::cobyla; }
constexpr bool uses_gradient(Algorithm algorithm) { return algorithm == Algorithm::slsqp; }
constexpr bool takes_constraints(Algorithm algorithm) {
  return algorithm == Algorithm::isres || algorithm == Algorithm::cobyla || algorithm == Algorithm::slsqp;
}

/// The options, checked and typed; plugin.cpp declares them with their defaults. Lengths are fractions of the box.
struct Settings {
  Algorithm algorithm;
  Algorithm local;         ///< of mlsl
  std::size_t starts;      ///< of local algorithms
  std::size_t restarts;    ///< of global algorithms that draw random numbers
  std::size_t population;  ///< 0: as NLopt chooses
  double initial_step;     ///< of cobyla and bobyqa
  std::size_t stall;       ///< evaluations without progress that end a global search; 0 = by dimension
  double tolerance;        ///< relative improvement that counts as progress; ends local searches
  double step_tolerance;   ///< ends local searches
};

}  // namespace tunica::nlopt_plugin
