// SPDX-License-Identifier: Apache-2.0
#include "data/row_choice.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/cycles.hpp"
#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

// 12 and 12.0 are the same specimen number; "> 0" compares numbers; everything else is compared as text.
bool same_value(const std::string& cell, const std::string& wanted) {
  if (cell == wanted) return true;
  const auto number = [](std::string_view text) -> std::optional<double> {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
  };
  const auto of_cell = number(cell);
  if (!of_cell) return false;
  for (const std::string_view sign : {">=", "<=", ">", "<"}) {
    if (!wanted.starts_with(sign)) continue;
    const auto bound = number(std::string_view(wanted).substr(sign.size()));
    if (!bound) return false;
    return sign == ">="   ? *of_cell >= *bound
           : sign == "<=" ? *of_cell <= *bound
           : sign == ">"  ? *of_cell > *bound
                          : *of_cell < *bound;
  }
  return of_cell == number(wanted);
}

/// ">= 0", not a value.
bool is_bound(const std::string& wanted) { return wanted.starts_with('>') || wanted.starts_with('<'); }

/// A branch and the number of its cycle; a column of cycles parts branches too.
std::vector<Branch> numbered_branches(const RawPath& path) {
  std::vector<Branch> branches = branches_of(path.path.values, path.rest);
  if (path.of_column.empty()) return branches;
  std::vector<Branch> parted;
  for (const Branch& branch : branches)
    for (std::size_t row = branch.first; row < branch.last; ++row) {
      const bool same = row > branch.first && parted.back().cycle == path.of_column[row];
      if (same)
        parted.back().last = row + 1;
      else
        parted.push_back({row, row + 1, branch.loading, path.of_column[row]});
    }
  return parted;
}

bool is_chosen(const Branch& branch, const DataRequest& request, std::size_t last_cycle) {
  if (request.branch != BranchChoice::both && branch.loading != (request.branch == BranchChoice::loading)) return false;
  if (!request.cycle) return true;
  if (request.cycle->last) return branch.cycle == last_cycle;
  const auto& numbers = request.cycle->numbers;
  return numbers.empty() || std::find(numbers.begin(), numbers.end(), branch.cycle) != numbers.end();
}

/// The last cycle that has the branch which is asked for: a test may end with a loading that nothing follows.
std::size_t last_cycle_of(const std::vector<Branch>& branches, BranchChoice wanted) {
  for (auto branch = branches.rbegin(); branch != branches.rend(); ++branch)
    if (wanted == BranchChoice::both || branch->loading == (wanted == BranchChoice::loading)) return branch->cycle;
  return 0;
}

void refuse_unknown_cycles(const RawPath& path, const DataRequest& request, const std::vector<Branch>& branches) {
  if (!request.cycle) return;
  std::set<std::size_t> known;
  for (const Branch& branch : branches)
    if (branch.cycle > 0) known.insert(branch.cycle);
  for (const std::size_t number : request.cycle->numbers)
    if (!known.contains(number))
      throw InputError(
          fmt::format("{}: there is no cycle {}. {}", path.path.place, number,
                      known.empty() ? "The load only goes back; leave \"cycle\" out."
                                    : fmt::format("Cycles found {}: {}.",
                                                  path.of_column.empty() ? "from the turning points" : "in the column",
                                                  fmt::join(known, ", "))));
}

/// Cuts a loading off before the load reaches the preload, and an unloading after it falls below.
void trim(Branch& branch, const std::vector<double>& load, double preload) {
  const auto bears = [&](std::size_t row) { return preload < 0 ? load[row] <= preload : load[row] >= preload; };
  if (branch.loading)
    while (branch.first < branch.last && !bears(branch.first)) ++branch.first;
  else
    while (branch.first < branch.last && !bears(branch.last - 1)) --branch.last;
}

/// Between the row that first bears the preload and the one before.
PathPoint point_at(const std::vector<double>& load, const Branch& whole, std::size_t row, double preload) {
  if (row == whole.first || load[row] == load[row - 1] || std::isnan(load[row - 1])) return {row};
  return {row, (load[row] - preload) / (load[row] - load[row - 1])};
}

}  // namespace

std::vector<const Csv::Row*> rows_where(const Csv& csv, const DataRequest& request) {
  std::vector<const Csv::Row*> rows;
  for (const Csv::Row& row : csv.rows) rows.push_back(&row);
  std::set<std::string> done;
  for (const auto& condition : request.where) {
    if (!done.insert(condition.first).second) continue;
    const std::size_t column = csv.column(condition.first);
    std::vector<std::string> wanted, present;
    for (const auto& [name, value] : request.where)
      if (name == condition.first) wanted.push_back(value);
    for (const Csv::Row* row : rows)
      if (present.size() < 20 && std::find(present.begin(), present.end(), row->cells[column]) == present.end())
        present.push_back(excerpt(row->cells[column]));
    const auto has = [&](const Csv::Row* row, const std::string& value) {
      return same_value(row->cells[column], value);
    };
    for (const std::string& value : wanted)
      if (std::none_of(rows.begin(), rows.end(), [&](const Csv::Row* row) { return has(row, value); }))
        throw InputError(fmt::format("{}: no row left has the value '{}' that \"where\" asks for. {}",
                                     csv.place(csv.header_line, column), excerpt(value), suggestion(value, present)));
    // All bounds hold together, and of values one.
    const bool any_value = !std::all_of(wanted.begin(), wanted.end(), is_bound);
    std::erase_if(rows, [&](const Csv::Row* row) {
      const auto fits = [&](const std::string& value) { return has(row, value); };
      const auto beyond = [&](const std::string& value) { return is_bound(value) && !fits(value); };
      const auto one_of = [&](const std::string& value) { return !is_bound(value) && fits(value); };
      return std::any_of(wanted.begin(), wanted.end(), beyond) ||
             (any_value && std::none_of(wanted.begin(), wanted.end(), one_of));
    });
    if (rows.empty())
      throw InputError(fmt::format("{}: no row left is within all bounds that \"where\" asks for. Widen one of them.",
                                   csv.place(csv.header_line, column)));
  }
  return rows;
}

std::vector<std::size_t> rows_in_range(const Csv& csv, const RowRange& range, std::size_t count,
                                       std::vector<std::string>& warnings) {
  const auto [first, last] = range.among(count);
  std::vector<std::size_t> selected;
  for (std::size_t row = first; row < last; row += std::max<std::size_t>(range.step, 1)) {
    selected.push_back(row);
    if (range.step > count) break;  // also keeps the sum from overflowing
  }
  if (selected.empty())
    throw InputError(fmt::format(
        "{}, line {}: \"rows\" begins at {} and ends before {}, but there are rows 0 to {}{}. Correct \"rows\".",
        csv.file.string(), csv.header_line, range.first, range.last ? fmt::format("{}", *range.last) : "the end",
        count - 1, count < csv.rows.size() ? " after \"where\"" : ""));
  if (range.last && *range.last > 0 && static_cast<std::size_t>(*range.last) > count)
    warnings.push_back(fmt::format("{}: \"rows\" ends at {}, but there are only {} rows; all up to the end are used.",
                                   csv.file.string(), *range.last, count));
  return selected;
}

ChosenRows choose_rows(const RawPath& path, const DataRequest& request) {
  const std::vector<Branch> branches = numbered_branches(path);
  refuse_unknown_cycles(path, request, branches);
  const std::size_t last = last_cycle_of(branches, request.branch);
  ChosenRows chosen;
  bool any_branch = false;
  for (const Branch& whole : branches) {
    if (!is_chosen(whole, request, last)) continue;
    any_branch = true;
    Branch used = whole;
    if (request.preload) trim(used, path.load->values, request.preload->value);
    if (request.preload && used.loading && used.first < used.last && !chosen.at_preload)
      chosen.at_preload = point_at(path.load->values, whole, used.first, request.preload->value);
    for (std::size_t row = used.first; row < used.last; ++row) chosen.rows.push_back(row);
  }
  if (!any_branch)
    throw InputError(fmt::format("{}: these cycles have no {} branch. Leave \"branch\" out, or choose other cycles.",
                                 path.path.place, request.branch == BranchChoice::loading ? "loading" : "unloading"));
  const std::string preload =
      request.preload ? fmt::format("{:g} {}", request.preload->value, request.preload->is_force ? "mN" : "kPa") : "";
  if (chosen.rows.empty()) {
    std::vector<double> load = path.load->values;
    std::erase_if(load, [](double value) { return std::isnan(value); });
    const auto [low, high] = std::minmax_element(load.begin(), load.end());
    throw InputError(
        fmt::format("{}: the preload of {} is not reached; the values lie between {:g} and {:g}. Correct "
                    "\"preload\", or leave it out.",
                    path.load->place, preload, *low, *high));
  }
  if (request.specimen.gauge_at_preload && !chosen.at_preload)
    throw InputError(
        fmt::format("{}: no loading reaches the preload of {}, so the gauge length cannot be taken there. "
                    "Give \"gauge_length\" as a length.",
                    path.load->place, preload));
  return chosen;
}

std::optional<std::size_t> first_number(std::string_view cell) {
  const std::size_t at = cell.find_first_of("0123456789");
  if (at == std::string_view::npos) return std::nullopt;
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(cell.data() + at, cell.data() + cell.size(), number);
  return error == std::errc() ? std::optional(number) : std::nullopt;
}

}  // namespace tunica::data
