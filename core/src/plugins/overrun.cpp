// SPDX-License-Identifier: Apache-2.0
#include "plugins/overrun.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

namespace tunica::plugins {

namespace {

constexpr std::uint64_t fence = 0x7ff8'feed'0000'0000;  // a NaN that no arithmetic makes

/// Kept from call to call; a call inside a call finds it taken, and gets memory of its own.
std::vector<double>& memory_of_this_thread() {
  static thread_local std::vector<double> memory;
  return memory;
}

bool is_whole(const double* begin) {
  return std::all_of(begin, begin + FencedOutputs::margin,
                     [](double value) { return std::bit_cast<std::uint64_t>(value) == fence; });
}

}  // namespace

FencedOutputs::FencedOutputs(std::span<NamedOutput> outputs) : memory_(std::move(memory_of_this_thread())) {
  std::size_t size = 0;
  for (const NamedOutput& output : outputs) size += output.values.empty() ? 0 : output.values.size() + 2 * margin;
  memory_.assign(size, std::bit_cast<double>(fence));
  double* place = memory_.data() + margin;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    theirs_[i] = outputs[i].values;
    if (theirs_[i].empty()) continue;
    std::copy(theirs_[i].begin(), theirs_[i].end(), place);
    outputs[i].values = {place, theirs_[i].size()};
    place += theirs_[i].size() + 2 * margin;
  }
}

const char* FencedOutputs::release(std::span<NamedOutput> outputs) {
  const char* broken = nullptr;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (theirs_[i].empty()) continue;
    const std::span<double> fenced = outputs[i].values;
    if (broken == nullptr && !(is_whole(fenced.data() - margin) && is_whole(fenced.data() + fenced.size())))
      broken = outputs[i].name;
    std::copy(fenced.begin(), fenced.end(), theirs_[i].begin());
    outputs[i].values = theirs_[i];
  }
  memory_of_this_thread() = std::move(memory_);
  return broken;
}

std::string overrun_reason(const std::string& plugin, const char* output) {
  return fmt::format(
      "plugin '{}' wrote beyond the ends of its {} and is not evaluated again; expected nothing outside of "
      "the span. `tunica plugin check` shows where",
      plugin, output);
}

}  // namespace tunica::plugins
