// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/quantities.hpp"
#include "experiment/enum_names.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;

std::vector<std::string> observable_names(const std::vector<Observable>& observables) {
  std::vector<std::string> names;
  for (const Observable& observable : observables) names.push_back(observable.name);
  return names;
}

/// Names that "columns" may have: the observables, and what they follow from.
std::vector<std::string> column_names(const std::vector<Observable>& observables) {
  std::vector<std::string> names = observable_names(observables);
  for (const data::RawName& raw : data::raw_names(observables)) names.push_back(raw.name);
  return names;
}

const Observable& observable_of(const std::vector<Observable>& observables, std::string_view name) {
  return *data::quantity_named(name, observables)->observable;
}

std::filesystem::path read_file_name(const Node& node, const std::filesystem::path& folder) {
  const std::string& name = node.text("the name of a data file");
  std::filesystem::path file = (folder / name).lexically_normal();
  std::error_code error;
  if (!name.empty() && std::filesystem::is_regular_file(file, error)) return file;
  if (!name.empty() && std::filesystem::exists(file, error))
    node.fail(fmt::format("the data file '{}' is {}", excerpt(name),
                          std::filesystem::is_directory(file, error) ? "a folder" : "no regular file"),
              "Name a file that holds a table as text.");
  std::vector<std::string> present;
  std::filesystem::directory_iterator entries(file.parent_path().empty() ? "." : file.parent_path(), error), end;
  for (; !error && entries != end && present.size() < 1000; entries.increment(error))
    present.push_back(entries->path().filename().string());
  std::sort(present.begin(), present.end());
  const std::string near = nearest(file.filename().string(), present);
  node.fail(fmt::format("the data file '{}' does not exist", excerpt(name)),
            fmt::format("{}Looked for {}; relative names start at the folder of the experiment file.",
                        near.empty() ? "" : fmt::format("Did you mean '{}'? ", near),
                        std::filesystem::absolute(file, error).string()));
}

/// Which names can be left out because one of them is there: "'stretch' ('displacement', 'length' or 'strain')".
std::string sources_of(const Observable& observable, const std::vector<Observable>& observables) {
  std::vector<std::string> sources;
  for (const data::RawName& raw : data::raw_names(observables))
    if (raw.quantity.observable->name == observable.name) sources.push_back("'" + raw.name + "'");
  return sources.empty() ? "" : fmt::format(" It may also follow from {}.", fmt::join(sources, ", "));
}

void read_columns(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                  data::DataRequest& data) {
  const Node node = block.require("columns", fmt::format("the data of {}", owner));
  std::map<std::string, std::string> mapped;  // observable → the name that gives it
  for (const auto& [name, column] : node.members("an object that maps observables to column names")) {
    const auto quantity = data::quantity_named(name, observables);
    if (!quantity)
      column.fail(fmt::format("unknown observable '{}' of {}", excerpt(name), owner),
                  suggestion(name, column_names(observables)));
    const auto [first, is_new] = mapped.emplace(quantity->observable->name, name);
    if (!is_new)
      column.fail(
          fmt::format("'{}' and '{}' both give the {} of {}", first->second, name, quantity->observable->name, owner),
          "Leave out one.");
    data.columns.emplace_back(name, read_column_name(column));
  }
  for (const auto& [name, value] : data.constants)
    if (!mapped.emplace(name, name).second)
      node.fail(fmt::format("'{}' has a column and a constant in the data of {}", name, owner), "Leave out one.");
  for (const Observable& observable : observables)
    if (observable.required && !mapped.contains(observable.name))
      node.fail(fmt::format("no column is mapped to '{}', which {} needs", observable.name, owner),
                fmt::format("Add it. {}{}", observable.doc, sources_of(observable, observables)));
}

data::Noise read_noise_of(const Node& node, const Observable& channel) {
  node.allow_only({"absolute", "relative", "correlation"}, fmt::format("the noise of '{}'", channel.name));
  data::Noise noise;
  if (const auto absolute = node.find("absolute"))
    noise.absolute = absolute->quantity(channel.unit, fmt::format("the noise of '{}'", channel.name));
  if (const auto relative = node.find("relative")) noise.relative = relative->quantity("1", "a relative noise");
  if (const auto correlation = node.find("correlation")) noise.correlation = correlation->number("a correlation");
  if (noise.absolute < 0)
    node.child_or_self("absolute")
        .fail(fmt::format("the absolute noise is {}", noise.absolute), "A standard deviation is not negative.");
  if (noise.relative < 0)
    node.child_or_self("relative")
        .fail(fmt::format("the relative noise is {}", noise.relative), "A standard deviation is not negative.");
  if (!(noise.absolute > 0 || noise.relative > 0))
    node.fail(fmt::format("the noise of '{}' is zero", channel.name),
              "Give \"absolute\" or \"relative\" greater than zero, or leave \"noise\" out to have it estimated.");
  if (!(noise.correlation > -1 && noise.correlation < 1))
    node.child_or_self("correlation")
        .fail(fmt::format("the correlation {} is not between -1 and 1", noise.correlation),
              "Correct it, or leave it out where rows err independently.");
  return noise;
}

// Either one noise for every channel, or an object of channels.
void read_noise(const Node& node, const std::vector<Observable>& observables, data::DataRequest& data) {
  std::vector<std::string> mapped;
  for (const auto& [name, column] : data.columns)
    if (const Observable& channel = observable_of(observables, name); channel.role == Role::channel)
      mapped.push_back(channel.name);
  if (mapped.empty())
    node.fail("\"noise\" changes nothing: no measured quantity is mapped",
              "Map one in \"columns\", or leave the noise out.");
  const auto members =
      node.members("a noise, {\"absolute\": …, \"relative\": …, \"correlation\": …}, or one per channel,");
  const bool per_channel = !members.empty() && std::all_of(members.begin(), members.end(), [](const auto& member) {
    return member.second.is_object();
  });
  if (!per_channel) {
    for (const std::string& name : mapped)
      data.noise.emplace_back(name, read_noise_of(node, observable_of(observables, name)));
    return;
  }
  for (const auto& [name, child] : members) {
    if (std::find(mapped.begin(), mapped.end(), name) == mapped.end())
      child.fail(fmt::format("noise is given for '{}', which is not a mapped channel", excerpt(name)),
                 suggestion(name, mapped));
    data.noise.emplace_back(name, read_noise_of(child, observable_of(observables, name)));
  }
}

void read_time_from(const Node& node, const std::vector<Observable>& observables, data::DataRequest& data) {
  node.allow_only({"rate"}, "\"time_from\"");
  const Observable* path = nullptr;
  for (const auto& [name, column] : data.columns) {
    const Observable& observable = observable_of(observables, name);
    if (observable.role == Role::abscissa && path == nullptr) path = &observable;
    if (observable.role == Role::time)
      node.fail(fmt::format("\"time_from\" is given, and the column '{}' is mapped to '{}' too", excerpt(column), name),
                "Leave out one of the two.");
  }
  if (path == nullptr)
    node.fail("\"time_from\" needs an abscissa, and none is mapped", "Map one in \"columns\", or give a time column.");
  const Node rate = node.require("rate", "\"time_from\"");
  const double value = rate.quantity(path->unit + "/s", fmt::format("the rate of '{}'", path->name));
  if (!(value > 0))
    rate.fail(fmt::format("the rate is {}", value),
              "It must be greater than zero: how fast the abscissa changes, in either direction.");
  data.time_rate = value;
}

/// Keys that another key, or what is mapped, leaves without effect.
void refuse_idle_keys(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                      const data::DataRequest& data) {
  const auto maps = [&](auto is) {
    return std::any_of(data.columns.begin(), data.columns.end(),
                       [&](const auto& column) { return is(observable_of(observables, column.first)); });
  };
  const bool timed = data.time_rate || maps([](const Observable& one) { return one.role == Role::time; });
  if (const auto node = block.find("order"); node && data.order == data::Order::unknown && (data.cycle || timed))
    node->fail(fmt::format("\"order\" is \"unknown\", and {} gives the order of the rows in {}",
                           data.cycle ? "\"cycle\"" : "the time", owner),
               "Leave one of the two out.");
  const bool measured = maps([](const Observable& one) { return one.role == Role::channel; });
  if (const auto node = block.find("stress_measure");
      node && measured && !maps([](const Observable& one) { return one.kind == Observable::Kind::stress; }))
    node->fail(fmt::format("\"stress_measure\" changes nothing in {}: no stress is mapped", owner),
               "Map one in \"columns\", or leave the measure out.");
}

/// Prescribed quantities that are the same in all rows of a table.
void read_constants(const Node& node, const std::vector<Observable>& observables, std::string_view owner,
                    data::DataRequest& data) {
  std::vector<std::string> prescribed;
  for (const Observable& observable : observables)
    if (observable.role == Role::abscissa) prescribed.push_back(observable.name);
  for (const auto& [name, value] : node.members("an object of prescribed quantities and their values")) {
    const auto found = std::ranges::find(observables, name, &Observable::name);
    if (found == observables.end() || found->role != Role::abscissa)
      value.fail(fmt::format("'{}' is no prescribed quantity of {}", excerpt(name), owner),
                 suggestion(name, prescribed));
    data.constants.emplace_back(name, value.quantity(found->unit, fmt::format("the value of '{}'", name)));
  }
}

/// The number of a file is the first prescribed quantity that every row needs and nothing else gives.
void read_number(const Node& block, const std::vector<Observable>& observables, std::string_view owner, double number,
                 data::DataRequest& data) {
  std::set<std::string> given;
  for (const auto& [name, value] : data.constants) given.insert(name);
  if (const auto columns = block.find("columns"); columns && columns->is_object())
    for (const auto& [name, column] : columns->members(""))
      if (const auto quantity = data::quantity_named(name, observables)) given.insert(quantity->observable->name);
  for (const Observable& observable : observables)
    if (observable.role == Role::abscissa && observable.required && !given.contains(observable.name)) {
      data.constants.emplace_back(observable.name, number);
      return;
    }
  block.fail(fmt::format("the number of a file means nothing in {}: every quantity that a row needs is given", owner),
             "Take its column out, or name the files in \"data\": [{\"file\": …}, …].");
}

}  // namespace

data::DataRequest read_table(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                             const std::filesystem::path& folder, const std::optional<Numbered>& numbered) {
  std::vector<std::string> keys = {"file",  "files",     "columns", "stress_measure", "rows",          "where",
                                   "order", "time_from", "noise",   "constant",       "numbered_files"};
  keys.insert(keys.end(), rig_keys().begin(), rig_keys().end());
  block.allow_only(keys, fmt::format("the data of {}", owner));
  data::DataRequest data;
  const auto file = block.find("file"), files = block.find("files");
  if (file && files)
    block.fail(fmt::format("the data of {} have \"file\" and \"files\"", owner),
               "Leave out one: \"files\" is the list of replicates.");
  if (numbered && (file || files))
    block.fail(fmt::format("the data of {} have \"numbered_files\" and \"{}\"", owner, file ? "file" : "files"),
               "Leave out one.");
  if (!file && !files && !numbered)
    block.fail(fmt::format("the key 'file' is missing in the data of {}", owner),
               "Give \"file\", or \"files\" for replicates.");
  if (file) data.files.push_back(read_file_name(*file, folder));
  if (files)
    for (const Node& node : files->elements("a list of data files")) {
      data.files.push_back(read_file_name(node, folder));
      if (std::find(data.files.begin(), data.files.end() - 1, data.files.back()) != data.files.end() - 1)
        node.fail("this file appears twice in the list", "A replicate is another measurement; remove one.");
    }
  if (numbered) data.files.push_back(numbered->second.lexically_normal());
  if (data.files.empty()) files->fail("the list of files is empty");
  if (const auto node = block.find("constant")) read_constants(*node, observables, owner, data);
  if (numbered) read_number(block, observables, owner, numbered->first, data);
  read_columns(block, observables, owner, data);
  if (const auto node = block.find("stress_measure"))
    data.stress_measure = node->one_of(data::stress_measures(), "stress measure");
  if (const auto node = block.find("rows")) data.rows = read_row_range(*node);
  if (const auto node = block.find("where")) read_where(*node, data);
  if (const auto node = block.find("order")) {
    const std::string name = node->one_of(names_in(data::order_names), "order of rows");
    data.order = text::value_of(data::order_names, name).value();
  }
  if (const auto node = block.find("time_from")) read_time_from(*node, observables, data);
  if (const auto node = block.find("noise")) read_noise(*node, observables, data);
  read_rig_keys(block, observables, owner, data);
  refuse_idle_keys(block, observables, owner, data);
  return data;
}

data::RowRange read_row_range(const Node& node) {
  const std::string& text = node.text("a row range such as \"0:240:6\"");
  const auto refuse = [&](std::string_view reason) {
    node.fail(
        fmt::format("'{}' is not a row range: {}", excerpt(text), reason),
        "Expected \"first:last\" or \"first:last:step\" as in \"0:240:6\": rows count from 0, negative numbers from "
        "the end, last is not included, and each number may be left out.");
  };
  std::vector<std::optional<std::ptrdiff_t>> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    std::ptrdiff_t number = 0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (begin != end && (error != std::errc() || stop != text.data() + end))
      refuse(fmt::format("'{}' is not a row number", excerpt(text.substr(begin, end - begin))));
    parts.push_back(begin == end ? std::nullopt : std::optional(number));
    begin = end + 1;
  }
  if (parts.size() < 2 || parts.size() > 3)
    refuse(fmt::format("it has {} part{}", parts.size(), parts.size() == 1 ? "" : "s"));
  const std::ptrdiff_t step = parts.size() == 3 ? parts[2].value_or(1) : 1;
  if (step == 0) refuse("the step is 0");
  if (step < 0) refuse("the step is negative");
  const data::RowRange range{parts[0].value_or(0), parts[1], static_cast<std::size_t>(step)};
  const bool one_end = range.last && (*range.last < 0) == (range.first < 0);
  if (one_end && *range.last <= range.first) refuse("it ends before it begins");
  return range;
}

}  // namespace tunica::experiment
