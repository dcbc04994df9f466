// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <string>

#include "execution/files.hpp"
#include "execution/first_failure.hpp"
#include "posterior/memory.hpp"

namespace tunica::comparison {

/// posterior_steps_<run>.csv: the steps of the chains of a run as they are made, from which a killed run goes on.
///
///   # <question>
///   chain,step,log_density,acceptance,size,random,simulations,failed,z_1,…,z_n,checksum
///
/// Numbers are the shortest text that reads back as the same double, and checksum is that of the line before it. A line
/// that does not fit ends the journal there: it and what follows are cut off, and drawn again. Lines of several chains
/// stand in the order in which they were written, those of one chain in that of their steps. A step that comes once
/// more takes the place of the one before and of all after that.
///
/// Text is written every 0.2 s, and at finish(). A failed write is thrown there: an exception would cancel the other
/// chains without a word.
class DrawJournal final : public posterior::Memory {
 public:
  explicit DrawJournal(std::filesystem::path file) : file_(std::move(file)) {}

  std::vector<std::vector<posterior::Step>> recall(const std::string& question, std::size_t chains,
                                                   std::size_t parameters) override;
  void keep(std::size_t chain, std::size_t index, const posterior::Step& step) override;
  /// Returns once everything is on the disk. Throws execution::WriteFailure.
  void finish();

 private:
  std::filesystem::path file_;
  std::mutex mutex_;  ///< of what follows
  execution::AppendFile appended_;
  std::string text_;
  std::chrono::steady_clock::time_point written_ = {};
  execution::FirstFailure failure_;
};

}  // namespace tunica::comparison
