// SPDX-License-Identifier: Apache-2.0
// Data of one test in several tables.
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

/// One table a file: "frame_*.csv" with a number where the star stands, which is the prescribed quantity that every row
/// needs and no column gives.
std::vector<data::DataRequest> read_numbered(const Node& block, const std::vector<Observable>& observables,
                                             std::string_view owner, const std::filesystem::path& folder) {
  const Node node = block.require("numbered_files", owner);
  const std::string& pattern = node.text("the names of numbered files, \"frame_*.csv\"");
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos || pattern.find('*', star + 1) != std::string::npos ||
      pattern.find('/', star) != std::string::npos)
    node.fail(fmt::format("'{}' has not one star in the name of its files", excerpt(pattern)),
              "Write one where the number stands, as in \"dic/frame_*.csv\".");
  const std::filesystem::path whole = folder / pattern, where = whole.parent_path();
  const std::string name = whole.filename().string(), begin = name.substr(0, name.find('*')),
                    end = name.substr(name.find('*') + 1);
  std::map<double, std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::directory_iterator at(where.empty() ? "." : where, error), stop; !error && at != stop;
       at.increment(error)) {
    const std::string file = at->path().filename().string();
    if (file.size() <= begin.size() + end.size() || !file.starts_with(begin) || !file.ends_with(end)) continue;
    const std::string digits = file.substr(begin.size(), file.size() - begin.size() - end.size());
    double number = 0;
    const auto [last, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (problem != std::errc() || last != digits.data() + digits.size()) continue;
    if (const auto [other, is_new] = found.emplace(number, at->path()); !is_new)
      node.fail(fmt::format("'{}' and '{}' have the same number", other->second.filename().string(), file),
                "Rename or remove one.");
  }
  if (found.empty())
    node.fail(fmt::format("no file '{}' with a number for the star is in '{}'", excerpt(name),
                          std::filesystem::absolute(where, error).string()),
              "Correct the name; relative names start at the folder of the experiment file.");
  std::vector<data::DataRequest> tables;
  for (const auto& [number, file] : found)
    tables.push_back(read_table(block, observables, owner, folder, {{number, file}}));
  return tables;
}

/// Several tables, whose rows follow one another.
data::DataRequest read_tables(const Node& list, const std::vector<Observable>& observables, std::string_view owner,
                              const std::filesystem::path& folder) {
  data::DataRequest all;
  bool measure_known = false;
  const auto add = [&](const Node& block, data::DataRequest table) {
    if (table.files.size() > 1)
      block.child_or_self("files").fail("replicates are given in one of several tables",
                                        "Give each table one \"file\", or make each replicate a test of its own.");
    table.part = true;
    const auto gives = [&](const auto& column) { return data::quantity_named(column.first, observables)->observable; };
    const bool stress = std::ranges::any_of(
        table.columns, [&](const auto& column) { return gives(column)->kind == Observable::Kind::stress; });
    if (!stress) table.stress_measure = all.stress_measure;
    if (stress && !measure_known) all.stress_measure = table.stress_measure;
    measure_known = measure_known || stress;
    if (table.stress_measure != all.stress_measure)
      block.child_or_self("stress_measure")
          .fail(fmt::format("the tables of {} state two stress measures", owner), "Give the same one in all of them.");
    all.files.push_back(table.files.front());
    for (const auto& column : table.columns)
      if (std::ranges::none_of(all.columns, [&](const auto& one) { return gives(one) == gives(column); }))
        all.columns.push_back(column);
    for (const auto& [name, noise] : table.noise) {
      const auto same = std::ranges::find(all.noise, name, [](const auto& one) { return one.first; });
      if (same == all.noise.end())
        all.noise.emplace_back(name, noise);
      else if (same->second.absolute != noise.absolute || same->second.relative != noise.relative ||
               same->second.correlation != noise.correlation)
        block.child_or_self("noise").fail(fmt::format("two tables of {} state another noise of '{}'", owner, name),
                                          "Give the same in both.");
    }
    all.tables.push_back(std::move(table));
  };
  for (const Node& block : list.is_array() ? list.elements("") : std::vector{list}) {
    if (block.is_object() && block.find("numbered_files"))
      for (data::DataRequest& table : read_numbered(block, observables, owner, folder)) add(block, std::move(table));
    else
      add(block, read_table(block, observables, owner, folder, {}));
  }
  if (all.tables.empty())
    list.fail(fmt::format("the list of tables of {} is empty", owner), "Give at least one, {\"file\": …}.");
  const bool ordered = std::ranges::all_of(
      all.tables, [](const data::DataRequest& table) { return table.order == data::Order::loading; });
  if (ordered) all.order = data::Order::loading;
  return all;
}

}  // namespace

data::DataRequest read_data(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                            const std::filesystem::path& folder) {
  const bool several = block.is_array() || (block.is_object() && block.find("numbered_files"));
  return several ? read_tables(block, observables, owner, folder) : read_table(block, observables, owner, folder, {});
}

/// Several tables as they were read, with what was since taken out of the whole or changed in it.
Json write_data(const data::DataRequest& data, const std::vector<Observable>& observables) {
  if (data.tables.empty()) return write_table(data, observables);
  Json list = Json::array();
  const auto gives = [&](const auto& columns, const std::string& observable) {
    return std::ranges::any_of(columns, [&](const auto& column) {
      return data::quantity_named(column.first, observables)->observable->name == observable;
    });
  };
  for (data::DataRequest table : data.tables) {
    std::erase_if(table.columns, [&](const auto& column) {
      return !gives(data.columns, data::quantity_named(column.first, observables)->observable->name);
    });
    table.noise.clear();
    for (const auto& [name, noise] : data.noise)
      if (gives(table.columns, name)) table.noise.emplace_back(name, noise);
    list.push_back(write_table(table, observables));
  }
  return list;
}

}  // namespace tunica::experiment
