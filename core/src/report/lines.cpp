// SPDX-License-Identifier: Apache-2.0
#include "report/lines.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "report/thinning.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t fewest_points = 40;  ///< of a line, however many lines there are
constexpr std::size_t most_tags = 14;

void append(std::vector<double>& to, const std::vector<double>& from, std::size_t place) {
  if (!from.empty()) to.push_back(from[place]);
}

}  // namespace

std::vector<Series> by_line(const Series& whole, const std::vector<data::Line>& lines, std::size_t most,
                            std::size_t& left_out) {
  std::vector<Series> parts;
  const std::size_t each = std::max(fewest_points, most / std::max<std::size_t>(1, lines.size()));
  for (const data::Line& line : lines) {
    Series part{whole.name, whole.mark, whole.style, {}, {}, {}, {}, whole.hidden, whole.faint, line.curve};
    if (!line.path && part.mark == "both") part.mark = "points";
    std::vector<double> y;
    for (const std::size_t row : line.rows) y.push_back(whole.y[row]);
    const auto kept = shape_keeping(y, each);
    left_out +=
        static_cast<std::size_t>(std::count_if(y.begin(), y.end(), [](double v) { return v - v == 0; })) - kept.size();
    for (const std::size_t k : kept) {
      part.x.push_back(whole.x[line.rows[k]]);
      part.y.push_back(y[k]);
      append(part.low, whole.low, line.rows[k]);
      append(part.high, whole.high, line.rows[k]);
    }
    if (!part.x.empty()) parts.push_back(std::move(part));
  }
  return parts;
}

std::string tag(std::vector<Series>& parts) {
  std::vector<Series*> first;
  for (Series& part : parts)
    if (!part.label.empty() &&
        std::none_of(first.begin(), first.end(), [&](const Series* one) { return one->label == part.label; }))
      first.push_back(&part);
  if (first.size() < 2 || first.size() > most_tags) return "";
  for (Series* part : first) part->tag = part->label.substr(part->label.rfind("= ") + 2);
  return fmt::format("Figures at the curves: {}. ", first.front()->label.substr(0, first.front()->label.rfind(" = ")));
}

}  // namespace tunica::report
