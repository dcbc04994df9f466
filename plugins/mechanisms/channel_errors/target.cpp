// SPDX-License-Identifier: Apache-2.0
#include "target.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tunica/error.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::channel_errors {

std::vector<std::size_t> channels_named(const std::string& id, const std::vector<std::string>& wanted,
                                        const TestRows& rows) {
  std::vector<std::size_t> found;
  for (std::size_t k = 0; k < rows.channels.size(); ++k)
    if (std::find(wanted.begin(), wanted.end(), rows.channels[k]) != wanted.end()) found.push_back(k);
  if (!found.empty()) return found;
  const std::string names = fmt::format("'{}'", fmt::join(wanted, "', '"));
  throw InputError(fmt::format(
      "{}: the test's data have no channel {}, which is what the mechanism shifts; map a column to {}, or take the "
      "mechanism out",
      id, names, wanted.size() == 1 ? names : "one of them"));
}

std::size_t channel_chosen(const std::string& id, const Options& options, const TestRows& rows) {
  const std::string& wanted = options.text("channel");
  if (wanted.empty() && rows.channels.size() == 1) return 0;
  if (const std::optional<std::size_t> found = channel_index(rows, wanted)) return *found;
  const std::string fitted = fmt::format("{}", fmt::join(rows.channels, ", "));
  if (wanted.empty())
    throw InputError(fmt::format("{}: the test has several channels; say which one with \"channel\": {}", id, fitted));
  throw InputError(fmt::format("{}: \"channel\" is '{}', which the test's data do not have; expected one of: {}", id,
                               wanted, fitted));
}

std::vector<double> rows_chosen(const std::string& id, const Options& options, std::size_t count) {
  const std::string& text = options.text("rows");
  if (text == "all") return std::vector<double>(count, 1.0);
  std::vector<std::optional<std::size_t>> parts;
  bool numbers = true;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    std::size_t number = 0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    numbers &= begin == end || (error == std::errc() && stop == text.data() + end);
    parts.push_back(begin == end ? std::nullopt : std::optional(number));
    begin = end + 1;
  }
  const std::size_t step = parts.size() == 3 ? parts[2].value_or(1) : 1;
  if (!numbers || parts.size() < 2 || parts.size() > 3 || step == 0)
    throw InputError(fmt::format(
        "{}: \"rows\" is '{}'; expected \"all\", \"first:last\" or \"first:last:step\" as in \"0:240:6\": rows count "
        "from 0, last is not included, and each number may be left out",
        id, text));
  std::vector<double> share(count, 0.0);
  const std::size_t first = parts[0].value_or(0), last = std::min(parts[1].value_or(count), count);
  for (std::size_t row = first; row < last; row += std::min(step, count)) share[row] = 1;
  if (first >= last)
    throw InputError(
        fmt::format("{}: \"rows\" is '{}', which is none of the test's rows 0 to {}; correct it", id, text, count - 1));
  return share;
}

std::vector<double> elapsed(const std::string& id, const TestRows& rows) {
  std::vector<double> share(rows.time.begin(), rows.time.end());
  if (share.empty())
    for (std::size_t i = 0; i < rows.count; ++i) share.push_back(static_cast<double>(i));
  const double begin = share.empty() ? 0 : share.front(), duration = share.empty() ? 0 : share.back() - begin;
  if (!(duration > 0))
    throw InputError(
        fmt::format("{}: the test's {} lasts no time, and nothing can drift; expected {}; take the "
                    "mechanism out",
                    id, rows.time.empty() ? "only row" : "recording",
                    rows.time.empty() ? "two rows or more" : "a time that goes on"));
  for (double& at : share) at = (at - begin) / duration;
  return share;
}

Parameter in_unit_of(const std::string& channel, Parameter general) {
  struct UnitRule {
    const char *ending, *unit;
    double largest;
  };
  static constexpr UnitRule rules[] = {
      {"stress", "kPa", 100}, {"axial_force", "mN", 1000}, {"diameter", "mm", 5}, {"stretch", "1", 0.5}};
  for (const auto& [ending, unit, largest] : rules) {
    if (!channel.ends_with(ending)) continue;
    general.unit = unit;
    general.min = -largest;
    general.max = largest;
  }
  return general;
}

Option channel_option() {
  return Option::text("channel", "", "The channel that is read wrongly; may be left out where the test has one.");
}

Option rows_option() {
  return Option::text("rows", "all",
                      "The rows that are read wrongly, first:last:step from 0 of those that the test uses, last not "
                      "included; or all, the whole curve.");
}

}  // namespace tunica::channel_errors
