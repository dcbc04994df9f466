// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

#include "cohort/collection.hpp"
#include "cohort/specification.hpp"
#include "cohort/specimens.hpp"
#include "cohort/study.hpp"
#include "cohort/template.hpp"

/// What `tunica cohort` does around the fits of its specimens, as functions.
namespace tunica::cohort {

/// A cohort as it was read.
struct Opened {
  Specification cohort;
  SpecimenTable table;
  Template pattern;

  /// Reads the cohort file and its table; `diagnose` is its key "diagnosis". Throws InputError.
  Opened(const std::filesystem::path& file, bool diagnose);
};

/// Above this number of specimens, individual reports are made only on request: a page is half a megabyte.
constexpr std::size_t most_reports = 50;

/// Studies all specimens together and writes result.json, tables and report.html into `results`, over those of an
/// earlier study. `found` misses no specimen. Deterministic, for any number of threads.
Study make_results(const Opened& opened, const Collection& found, const plugins::Catalogue& catalogue,
                   const std::filesystem::path& results,
                   const std::function<void(const std::string& stage, double share)>& told = {});

}  // namespace tunica::cohort
