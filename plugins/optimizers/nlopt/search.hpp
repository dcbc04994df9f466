// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bridge.hpp"
#include "settings.hpp"

namespace tunica::nlopt_plugin {

/// How far one run of an algorithm came.
struct Search {
  enum class End {
    converged,   ///< a tolerance was met
    roundoff,    ///< rounding left no further progress
    stalled,     ///< no more progress
    infeasible,  ///< the constraints could not be met
    gave_up,     ///< NLopt failed, `message` says how
    stopped,     ///< should_stop()
    nothing      ///< nothing could be evaluated
  };
  Point best = {};
  End end = End::stopped;
  std::string failure = {};  ///< first reason of a failed evaluation
  std::string message = {};
  std::size_t evaluated = 0;

  [[nodiscard]] bool converged() const { return end <= End::stalled && best.violation == 0; }
  [[nodiscard]] std::string words() const;
};

/// A point of the unit box that depends on the seed alone.
std::vector<double> random_point(std::uint64_t seed, std::size_t n);

/// One run of a global algorithm over the box; `seed` is for NLopt's generator of this thread.
Search search_globally(Problem& problem, std::span<const double> start, std::uint64_t seed, const Settings& settings);

/// One run of a local algorithm from x. Where it takes no constraints, it minimises augmented Lagrangians.
Search search_locally(Problem& problem, std::span<const double> x, Algorithm algorithm, const Settings& settings);

}  // namespace tunica::nlopt_plugin
