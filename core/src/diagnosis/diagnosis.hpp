// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/naming/explanation.hpp"
#include "diagnosis/prospects/prospects.hpp"

/// Where the simulation is wrong, why, and what the addition of the cause gains: docs/diagnosis.md.
namespace tunica::diagnosis {

struct Diagnosis {
  Request request;
  Analysis analysis;
  Explanation explanation;
  Prospects prospects;

  [[nodiscard]] std::vector<Warning> warnings() const;
};

/// Runs a whole diagnosis; docs/diagnosis.md says how. Deterministic given the seed of the request, for any number of
/// threads. Throws InputError if data or names do not match, and BaseFitFailure if the base model cannot be fitted.
Diagnosis diagnose(const experiment::Experiment& experiment, const Request& request,
                   const plugins::Catalogue& catalogue, const Progress& progress = {});

}  // namespace tunica::diagnosis
