// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "execution/results.hpp"
#include "search/neighbours.hpp"

namespace tunica::comparison {

/// What speaks for the best point of a run being the optimum, and what against it.
struct Certificate {
  /// What a process that knows only input.json and result.json found.
  struct Fresh {
    search::Neighbourhood around;
    double difference = 0;   ///< its objective minus the recorded one
    bool identical = false;  ///< bit for bit
  };
  /// Over the realisations that agree with the best one.
  struct Spread {
    std::string name, unit;
    double min = 0, max = 0, share = 0;  ///< max − min as a share of the bounds, in the coordinate of the search
  };
  std::optional<Fresh> fresh;
  std::string missing;  ///< why there is no `fresh`
  std::uint64_t realisations = 0, agreeing = 0;
  std::vector<Spread> spread;
  std::vector<std::string> at_bounds;
  bool ended_at_target = false;  ///< the search was not to go on to the optimum
  std::string verdict;           ///< one sentence
};

/// Fills in how many realisations end within 1e-3 (relative) of the best objective or, where the best one reached the
/// target of the run and so stopped, at or below it too; and how far their parameters are apart. `best`: its objective,
/// of a feasible point.
void add_agreement(const assembly::Assembly& assembly, const execution::RunResult& result, double best,
                   std::optional<double> target, Certificate& certificate);

/// The point is not what the run says it is: it fails or has another objective in a fresh process, or a small step
/// lowers the objective by more than success allows. For the warnings.
bool alarming(const Certificate& certificate);

/// The sentence of the report.
std::string verdict(const Certificate& certificate);

}  // namespace tunica::comparison
