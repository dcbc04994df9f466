// SPDX-License-Identifier: Apache-2.0
#include "data/stacking.hpp"

#include <algorithm>
#include <limits>

#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using Named = std::pair<std::string, std::vector<double>>;

/// The column of that name, made of NaN for the rows before where it is new.
std::vector<double>& column(std::vector<Named>& columns, const std::string& name, std::size_t rows) {
  const auto found = std::ranges::find(columns, name, &Named::first);
  if (found != columns.end()) return found->second;
  return columns.emplace_back(name, std::vector<double>(rows, std::numeric_limits<double>::quiet_NaN())).second;
}

void append(std::vector<double>& to, const std::vector<double>& values) {
  to.insert(to.end(), values.begin(), values.end());
}

void append_channel(Dataset& all, const Channel& channel) {
  auto found = std::ranges::find(all.channels, channel.observable, &Channel::observable);
  if (found == all.channels.end()) {
    all.channels.push_back({channel.observable, channel.unit, {}, {}, channel.noise});
    found = all.channels.end() - 1;
    found->values.assign(all.count, std::numeric_limits<double>::quiet_NaN());
  }
  append(found->values, channel.values);
}

template <class T>
void add_new(std::vector<T>& to, const std::vector<T>& values) {
  for (const T& value : values)
    if (std::ranges::find(to, value) == to.end()) to.push_back(value);
}

}  // namespace

Dataset stacked(const std::vector<Dataset>& tables) {
  Dataset all;
  all.ordered = true;
  for (const Dataset& table : tables) {
    if (&table != tables.data() && table.time.empty() != all.time.empty())
      throw InputError("one table of the data has a time and another has none; map \"time\" in all of them or in none");
    for (const auto& [name, values] : table.abscissae) append(column(all.abscissae, name, all.count), values);
    for (const Channel& channel : table.channels) append_channel(all, channel);
    append(all.time, table.time);
    all.count += table.count;
    for (auto& [name, values] : all.abscissae) values.resize(all.count, std::numeric_limits<double>::quiet_NaN());
    for (Channel& channel : all.channels) channel.values.resize(all.count, std::numeric_limits<double>::quiet_NaN());
    all.lines.insert(all.lines.end(), table.lines.begin(), table.lines.end());
    all.ordered = all.ordered && table.ordered;
    add_new(all.elongations, table.elongations);
    add_new(all.warnings, table.warnings);
    for (const auto& source : table.source_columns)
      if (std::ranges::find(all.source_columns, source.first, [](const auto& one) { return one.first; }) ==
          all.source_columns.end())
        all.source_columns.push_back(source);
    all.sha256.insert(all.sha256.end(), table.sha256.begin(), table.sha256.end());
    all.understood.insert(all.understood.end(), table.understood.begin(), table.understood.end());
  }
  return all;
}

}  // namespace tunica::data
