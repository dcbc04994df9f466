// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "diagnosis/diagnosis.hpp"
#include "discovery/discovery.hpp"

namespace tunica::discovery {

/// The step that follows a diagnosis whose verdict is unknown: which terms of the energy would explain what no
/// mechanism of the catalogue does. None where the verdict is another, where a test is too costly to search with and
/// has no stand-in, or where it is open which model would get the terms.
std::optional<Discovery> after(const diagnosis::Diagnosis& diagnosis, const experiment::Experiment& experiment,
                               const plugins::Catalogue& catalogue, const diagnosis::Progress& progress = {});

/// The diagnosis with the verdict `discovered`, where the discovery has it.
diagnosis::Diagnosis with_verdict_of(const Discovery& discovery, diagnosis::Diagnosis diagnosis);

}  // namespace tunica::discovery
