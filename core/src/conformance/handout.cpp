// SPDX-License-Identifier: Apache-2.0
#include "conformance/handout.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace tunica::conformance {
namespace {

/// Guard numbers on each side that no call may change.
constexpr std::size_t guard_size = 32;
/// NaNs with the quiet bit clear. Arithmetic with one sets it and keeps the payload.
constexpr std::uint64_t quiet = 0x0008'0000'0000'0000, guard = 0x7ff4'7e57'0000'0001, unwritten = 0x7ff4'7e57'0000'0002;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
bool touched(double value) { return bits(value) != guard; }

std::string numbers(std::size_t count) {
  if (count == 1) return "1 number";
  return fmt::format("{}{} numbers", count, count == guard_size ? " or more" : "");
}

}  // namespace

std::span<const double> Handout::input(std::string name, std::span<const double> values) {
  return add(std::move(name), Use::input, values, values.size());
}
std::span<double> Handout::output(std::string name, std::size_t count) {
  return add(std::move(name), Use::output, {}, count);
}
std::span<double> Handout::in_place(std::string name, std::span<const double> values) {
  return add(std::move(name), Use::in_place, values, values.size());
}

std::span<double> Handout::add(std::string name, Use use, std::span<const double> values, std::size_t count) {
  if (count == 0) return {};
  Block& block = blocks_.emplace_back(Block{std::move(name), use, {}, {}});
  block.memory.assign(count + 2 * guard_size, std::bit_cast<double>(guard));
  const std::span<double> inside = std::span(block.memory).subspan(guard_size, count);
  if (use == Use::output)
    std::fill(inside.begin(), inside.end(), std::bit_cast<double>(unwritten));
  else
    std::copy(values.begin(), values.end(), inside.begin());
  if (use == Use::input) block.given.assign(values.begin(), values.end());
  return inside;
}

std::string Handout::flaw(const Block& block, bool ok) const {
  const auto begin = block.memory.begin() + guard_size, end = block.memory.end() - guard_size;
  const std::size_t count = static_cast<std::size_t>(end - begin);
  const char* kind = block.use == Use::input ? "input" : "output";
  const auto before = static_cast<std::size_t>(std::count_if(block.memory.begin(), begin, touched)),
             behind = static_cast<std::size_t>(std::count_if(end, block.memory.end(), touched));
  for (const auto& [written, where] : {std::pair(behind, "past the end"), std::pair(before, "before the beginning")})
    if (written > 0)
      return fmt::format("{} writes {} {} of the {} '{}', which has {}: keep to the size of the span", who_,
                         numbers(written), where, kind, block.name, count);
  if (block.use == Use::input) {
    const auto changed = static_cast<std::size_t>(std::inner_product(
        begin, end, block.given.begin(), 0, std::plus<>(), [](double a, double b) { return bits(a) != bits(b); }));
    if (changed > 0)
      return fmt::format("{} writes to its input '{}': {} of {} numbers changed", who_, block.name, changed, count);
  }
  if (block.use != Use::output || !ok) return {};
  const auto left =
      static_cast<std::size_t>(std::count_if(begin, end, [](double value) { return bits(value) == unwritten; }));
  if (left == count)
    return fmt::format(
        "{} never writes its output '{}', and returns ok: {} of {} numbers are as they were before the "
        "call",
        who_, block.name, left, count);
  const auto first = [&](std::uint64_t mark) {
    return std::find_if(begin, end, [mark](double value) { return bits(value) == mark; }) - begin;
  };
  if (left > 0)
    return fmt::format(
        "{} leaves {} of {} numbers of its output '{}' unwritten, and returns ok; the first is number {}", who_, left,
        count, block.name, first(unwritten) + 1);
  constexpr std::uint64_t added = unwritten | quiet;
  const auto sums = static_cast<std::size_t>(
      std::count_if(begin, end, [](double value) { return (bits(value) & ~(1ULL << 63)) == added; }));
  if (sums > 0)
    return fmt::format(
        "{} computes {} of {} numbers of its output '{}' from what was there before the call; outputs "
        "are to be assigned, not added to",
        who_, sums, count, block.name);
  return {};
}

void Handout::verify(bool ok) const {
  for (const Block& block : blocks_)
    if (const std::string found = flaw(block, ok); !found.empty()) throw MemoryFault(found);
}

}  // namespace tunica::conformance
