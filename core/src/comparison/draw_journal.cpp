// SPDX-License-Identifier: Apache-2.0
#include "comparison/draw_journal.hpp"

#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "execution/checksum.hpp"
#include "execution/evaluation_table.hpp"
#include "text/lists.hpp"

namespace tunica::comparison {

namespace {

using posterior::Step;
using Steps = std::vector<std::vector<Step>>;

std::string header(const std::string& question, std::size_t parameters) {
  std::string text = "# " + question + "\nchain,step,log_density,acceptance,size,random,simulations,failed";
  for (std::size_t j = 1; j <= parameters; ++j) text += fmt::format(",z_{}", j);
  return text + ",checksum\n";
}

/// Takes the next cell of a line; false where it is no number of this type.
template <class Number>
bool next(std::string_view& line, Number& value) {
  const auto cell = line.substr(0, line.find(','));
  const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || stop != cell.data() + cell.size()) return false;
  line.remove_prefix(std::min(line.size(), cell.size() + 1));
  return true;
}

/// Adds the step of a line; false where it is not what was written, or does not follow.
bool take(std::string_view line, std::size_t parameters, Steps& steps) {
  if (!execution::EvaluationTable::intact(line)) return false;
  std::size_t chain = 0, index = 0;
  Step step;
  step.z.resize(parameters);
  bool read = next(line, chain) && next(line, index) && next(line, step.log_density) && next(line, step.acceptance) &&
              next(line, step.size) && next(line, step.random) && next(line, step.evaluations) &&
              next(line, step.failures);
  for (double& z : step.z) read = read && next(line, z);
  if (!read || chain < 1 || chain > steps.size() || index < 1 || index > steps[chain - 1].size() + 1) return false;
  auto& own = steps[chain - 1];
  own.resize(index - 1);
  own.push_back(std::move(step));
  return true;
}

}  // namespace

Steps DrawJournal::recall(const std::string& question, std::size_t chains, std::size_t parameters) {
  Steps steps(chains);
  const std::string begin = header(program_ + "; " + question, parameters);
  appended_ = execution::AppendFile(file_);
  const std::string text = execution::read_text(file_);
  std::size_t whole = text.starts_with(begin) ? begin.size() : 0;
  if (whole == 0) {
    appended_.cut(0);
    appended_.append(begin);
    return steps;
  }
  for (std::size_t end = 0; (end = text.find('\n', whole)) != std::string::npos; whole = end + 1)
    if (!take(std::string_view(text).substr(whole, end - whole), parameters, steps)) break;
  if (whole < text.size()) appended_.cut(whole);
  for (const auto& own : steps) kept_ += own.size();
  return steps;
}

void DrawJournal::keep(std::size_t chain, std::size_t index, const Step& step) {
  constexpr std::chrono::milliseconds patience(200);
  std::string line = fmt::format("{},{},{},{},{},{},{},{}", chain + 1, index + 1, step.log_density, step.acceptance,
                                 step.size, step.random, step.evaluations, step.failures);
  for (const double z : step.z) line += fmt::format(",{}", z);
  line += ',' + execution::checksum(line) + '\n';
  const std::lock_guard lock(mutex_);
  if (failure_.any()) return;
  text_ += line;
  ++waiting_;
  const auto now = std::chrono::steady_clock::now();
  if (now - written_ < patience) return;
  written_ = now;
  failure_.guard([&] { write(); });
}

/// What a write that fails leaves of a line, recall() cuts off.
void DrawJournal::write() {
  try {
    appended_.append(text_);
  } catch (const execution::WriteFailure& problem) {
    throw execution::WriteFailure(
        fmt::format("{}. {} of the chains are kept there", problem.what(), text::counted(kept_, "step", "steps")));
  }
  kept_ += waiting_;
  waiting_ = 0;
  text_.clear();
}

void DrawJournal::finish() {
  failure_.rethrow();
  if (!appended_.is_open()) return;
  write();
  appended_.sync();
}

}  // namespace tunica::comparison
