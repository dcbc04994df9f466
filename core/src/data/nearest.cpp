// SPDX-License-Identifier: Apache-2.0
#include "data/nearest.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::data {
namespace {

constexpr std::size_t longest = 80;       // names longer than this are no typing errors of ours
constexpr std::size_t most_listed = 100;  // names in a message

bool equal_but_for_case(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

// In half steps, so that a change of case can cost less than a change of letter.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = 2 * j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = 2 * i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : equal_but_for_case(a[i - 1], b[j - 1]) ? 1 : 2;
      row[j] = std::min({last[j] + 2, row[j - 1] + 2, last[j - 1] + change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 2);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view found, const std::vector<std::string>& known) {
  if (found.empty() || found.size() > longest) return {};
  std::string best;
  std::size_t best_distance = 5;  // two steps and a case
  for (const std::string& name : known) {
    if (name.size() > 2 * longest) continue;
    const std::size_t d = distance(found, name);
    if (d < best_distance && d <= std::max(found.size(), name.size())) {
      best = name;
      best_distance = d;
    }
  }
  if (!best.empty()) return best;
  // A shortened or lengthened name: "transverse" for "transverse_stretch".
  for (const std::string& name : known)
    if (found.size() >= 4 && name.size() >= 4 && (name.starts_with(found) || found.starts_with(name))) return name;
  return {};
}

std::string suggestion(std::string_view found, const std::vector<std::string>& known) {
  const std::string near = nearest(found, known);
  std::string text = near.empty() ? "" : fmt::format("Did you mean '{}'? ", text::escaped(near));
  if (known.empty()) return text + "None is known.";
  std::vector<std::string> listed;
  for (std::size_t k = 0; k < std::min(known.size(), most_listed); ++k) listed.push_back(excerpt(known[k], longest));
  if (known.size() > most_listed) listed.push_back(fmt::format("and {} more", known.size() - most_listed));
  return text + fmt::format("Known: {}.", fmt::join(listed, ", "));
}

}  // namespace tunica::data
