// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "discovery/request.hpp"

namespace tunica::discovery {

/// What a user says beside the file; what is left open stays as the file has it.
struct Wishes {
  std::optional<std::uint64_t> seed;
  std::optional<double> alpha;
  std::optional<std::size_t> most_terms, most_parameters;
  std::vector<std::string> invariants, laws;
  std::string model;
  bool from_nothing = false, quick = false;
};

/// Throws InputError for a word that is not known, with the nearest one. `prefix`: how options are written, "--".
Request request_of(const experiment::Experiment& experiment, const Wishes& wishes, const std::string& prefix = "--");

}  // namespace tunica::discovery
