// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "execution/folder.hpp"
#include "execution/laboratory.hpp"
#include "execution/runner.hpp"

/// Runs, resumed runs, and what must be equal in them.
namespace tunica::trial {

inline execution::Execution run(const Laboratory& laboratory, const std::filesystem::path& folder, unsigned threads = 1,
                                bool resume = false, std::function<void(const std::string&)> noticed = {}) {
  const auto plan = laboratory.plan();
  execution::RunSettings settings;
  settings.directory = folder;
  settings.threads = threads;
  settings.resume = resume;
  settings.noticed = std::move(noticed);
  return execution::execute(plan, settings);
}

/// evaluations.csv without its last columns, the time and the checksum.
inline std::string rows(const std::filesystem::path& folder) {
  std::string text;
  std::istringstream stream(text_of(folder / "evaluations.csv"));
  for (std::string line; std::getline(stream, line);)
    text += line.substr(0, line.rfind(',', line.rfind(',') - 1)) + '\n';
  return text;
}

inline void expect_equal(const execution::Execution& a, const execution::Execution& b) {
  ASSERT_EQ(a.runs.size(), b.runs.size());
  for (std::size_t run = 0; run < a.runs.size(); ++run)
    for (std::size_t k = 0; k < a.runs[run].realisations.size(); ++k) {
      const auto &left = a.runs[run].realisations[k], &right = b.runs[run].realisations[k];
      EXPECT_EQ(left.best.parameters, right.best.parameters);
      EXPECT_EQ(left.best.objective, right.best.objective);
      EXPECT_EQ(left.best.index, right.best.index);
      const auto numbers = [](const auto& trace) {
        std::vector<std::pair<std::uint64_t, double>> pairs;
        for (const auto& [evaluations, objective] : trace) pairs.emplace_back(evaluations, objective);
        return pairs;
      };
      EXPECT_EQ(numbers(left.trace), numbers(right.trace));
      EXPECT_EQ(left.tally.evaluations, right.tally.evaluations);
      EXPECT_EQ(left.stopped_by, right.stopped_by);
      EXPECT_EQ(left.stop_sentence, right.stop_sentence);
      EXPECT_EQ(left.reason, right.reason);
    }
}

struct Many : Laboratory {
  Many() {
    add_run("walk", 500, 5);
    add_run("compass", 300);
  }
};

}  // namespace tunica::trial
