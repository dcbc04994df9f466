// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/request.hpp"

namespace tunica::discovery {

/// The request: the "discovery" block of the experiment file and the command line.
struct Request {
  std::string model;                    ///< name of an entry of "models": the base
  bool from_nothing = false;            ///< the terms make up the whole energy
  std::vector<std::string> invariants;  ///< those to consider; empty = what suits the model
  std::vector<std::string> laws;        ///< those to consider; empty = all
  std::size_t most_terms = 0;           ///< 0 = three beside a base, four from nothing
  std::size_t most_parameters = 0;      ///< that the terms may have together; 0 = as many as it takes
  double alpha = 0.05;                  ///< false alarms that are accepted
  /// The tolerated misfit, as in a diagnosis.
  std::vector<std::pair<std::string, std::string>> tolerance = {};
  bool quick = false;  ///< linear bootstrap of the alarm only
  std::uint64_t seed = 1;

  [[nodiscard]] std::size_t term_limit() const {
    if (most_terms > 0) return most_terms;
    return from_nothing ? 4 : 3;
  }
};

/// Fills in what the file leaves open: the model of the first run.
Request request_of(const experiment::Experiment& experiment);

/// The request of the analysis that a discovery begins with.
diagnosis::Request analysis_request(const Request& request);

}  // namespace tunica::discovery
