// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "calibration/answering_curve.hpp"
#include "calibration/calibrate.hpp"
#include "execution/folder.hpp"
#include "execution/laboratory.hpp"

/// Whole calibrations of the fakes, from the plan to the report.
namespace tunica::trial {

struct Calibrating : Laboratory {
  Calibrating() {
    fakes::add_answering_curve(bench.shelf);
    bench.experiment.file = "experiment.json";
    options.directory = folder.path() / "out";
  }

  calibration::Outcome calibrate() const { return calibration::calibrate(bench.experiment, bench.shelf, options); }
  std::filesystem::path out(const std::string& file) const { return folder.path() / "out" / file; }
  bool has(const std::string& file) const { return std::filesystem::exists(out(file)); }

  /// Counts the predictions from now on.
  void count_calls() const {
    calls = 0;
    fakes::set_behaviour([this](double, std::span<double>, Status&) { ++calls; });
  }

  Folder folder;
  calibration::Options options;
  mutable std::atomic<int> calls = 0;
};

/// The results of the searches of two outcomes, run by run.
inline std::vector<std::vector<double>> found_by(const calibration::Outcome& outcome) {
  std::vector<std::vector<double>> found;
  for (const auto& run : outcome.summary.runs) {
    auto& one = found.emplace_back();
    one = {run.objective, static_cast<double>(run.evaluations), static_cast<double>(run.best_id)};
    for (const auto& parameter : run.parameters) one.push_back(parameter.value);
  }
  return found;
}

}  // namespace tunica::trial
