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
///   # <program>; <question>
///   chain,step,log_density,acceptance,size,random,simulations,failed,z_1,…,z_n,checksum
///
/// Numbers are the shortest text that reads back as the same double, and checksum is that of the line before it. A line
/// that does not fit ends the journal there: it and what follows are cut off, and drawn again. Lines of several chains
/// stand in the order in which they were written, those of one chain in that of their steps. A step that comes once
/// more takes the place of the one before and of all after that.
///
/// The program is what makes the steps: its version, its plugins, the vectors of the machine. Another program
/// would continue a chain differently.
///
/// Text is written every 0.2 s, and at finish(). A failed write is thrown there: an exception would cancel the other
/// chains without a word. has_failed() is for the chains, which need not draw what cannot be kept.
class DrawJournal final : public posterior::Memory {
 public:
  DrawJournal(std::filesystem::path file, std::string program) : file_(std::move(file)), program_(std::move(program)) {}

  std::vector<std::vector<posterior::Step>> recall(const std::string& question, std::size_t chains,
                                                   std::size_t parameters) override;
  void keep(std::size_t chain, std::size_t index, const posterior::Step& step) override;
  /// Whether a write has failed: nothing is kept any more.
  [[nodiscard]] bool has_failed() const { return failure_.any(); }
  /// Returns once everything is on the disk. Throws execution::WriteFailure, which says how many steps are kept.
  void finish();

 private:
  void write();

  std::filesystem::path file_;
  std::string program_;
  std::mutex mutex_;  ///< of what follows
  execution::AppendFile appended_;
  std::string text_;
  std::size_t waiting_ = 0, kept_ = 0;  ///< steps in the text; those before it
  std::chrono::steady_clock::time_point written_ = {};
  execution::FirstFailure failure_;
};

}  // namespace tunica::comparison
