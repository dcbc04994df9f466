// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cards/material.hpp"

/// From a result folder to the contents of a material card.
namespace tunica::exporting {

/// The selection of a result and of its parameters.
struct ExportRequest {
  std::filesystem::path result;  ///< a folder that `tunica run` has written, or the result.json in it
  std::string run = {};          ///< a run of it; empty = the best-ranked one with a result
  std::string model = {};        ///< a model of the experiment: needed where a run has several (layers)
};

/// A model with the parameters that a run found.
struct FittedMaterial {
  cards::Material material;
  std::string name;  ///< of the model in the experiment
  std::string run;
  /// For the card: provenance, a misfit that counts, parameters with their intervals, fitted range, stability,
  /// warnings. One paragraph each, without a date.
  std::vector<std::string> remarks;
};

/// Throws InputError where there is no such result, run or model, where no plugin provides it, and where no card has it
/// or the mechanisms that change it.
FittedMaterial fitted_material(const ExportRequest& request, const plugins::Catalogue& catalogue);

}  // namespace tunica::exporting
