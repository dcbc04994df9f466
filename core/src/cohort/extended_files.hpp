// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "cohort/specification.hpp"

/// The experiment and the cohort with what was found in them, as files in a results folder: data are named from the
/// root, and every key that nobody changes stays as it is, so that the bindings hold.
namespace tunica::cohort {

/// The experiment of the cohort as it stands.
nlohmann::ordered_json template_json(const Specification& cohort);

/// extended.json, of the changed experiment.
std::string experiment_text(const Specification& cohort, nlohmann::ordered_json experiment);

/// extended_cohort.json: the same specimens, with extended.json.
std::string cohort_text(const Specification& cohort);

}  // namespace tunica::cohort
