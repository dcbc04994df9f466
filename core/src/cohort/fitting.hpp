// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cohort/record.hpp"
#include "cohort/template.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::cohort {

/// The experiment of one specimen: the template with its values, a seed of its own that follows from the cohort's seed
/// and the id alone, and the hash of all that decides its result. Throws InputError.
struct Bound {
  experiment::Experiment experiment;
  std::string inputs;
};
Bound bind(const Specification& cohort, const Template& pattern, const Specimen& specimen,
           const plugins::Catalogue& catalogue);

struct FitSettings {
  std::filesystem::path results;  ///< of the cohort; a specimen has the folder specimens/<folder> in it
  bool reports = true;            ///< a report.html for each specimen
  std::function<bool()> interrupted = {};
  std::vector<std::string> refusals = {};  ///< of plugins, for the warnings
  /// Told, by any thread, of a stored file that is damaged and is therefore made again.
  std::function<void(const std::string& sentence)> noticed = {};
};

std::filesystem::path folder_of(const std::filesystem::path& results, const Specimen& specimen);

/// The record of a row of the table that has a problem; it is never written.
Record unreadable(const Specimen& specimen);

/// The record in the folder of a specimen, if there is one that can be read.
std::optional<Record> stored_record(const std::filesystem::path& results, const Specimen& specimen);

/// Fits one specimen with every run of the experiment and writes its folder: result.json, fit_<test>.csv, report.html
/// and, last, record.json. A record of the same inputs is taken as it is. Whatever goes wrong with the specimen is in
/// the record; only a folder that cannot be written throws (execution::WriteFailure). None: interrupted, and nothing is
/// left that would pass for a result.
std::optional<Record> fit(const Specification& cohort, const Template& pattern, const Specimen& specimen,
                          const plugins::Catalogue& catalogue, const FitSettings& settings);

}  // namespace tunica::cohort
