// SPDX-License-Identifier: Apache-2.0
// A table of measured data.
#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "experiment/blocks.hpp"
#include "experiment/limits.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;
using data::DataRequest;
using TableKey = Key<DataRequest>;

template <class Is>
bool maps(const DataRequest& data, const std::vector<Observable>& observables, Is is) {
  return std::any_of(data.columns.begin(), data.columns.end(), [&](const auto& column) {
    const auto quantity = data::quantity_named(column.first, observables);
    return quantity && is(*quantity->observable);
  });
}
bool is_stress(const Observable& one) { return one.kind == Observable::Kind::stress; }
bool is_channel(const Observable& one) { return one.role == Role::channel; }

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

std::string written_file(const std::filesystem::path& file) {
  return std::filesystem::absolute(file).lexically_normal().string();
}

TableKey file_key(const std::filesystem::path& folder) {
  return {
      "file", [] { return text_schema("The data file, relative to the experiment file."); },
      [=](const Node& node, DataRequest& data) { data.files.push_back(read_file_name(node, folder)); },
      [](const DataRequest& data) { return data.files.size() == 1 ? Json(written_file(data.files.front())) : Json(); }};
}

TableKey files_key(const std::filesystem::path& folder) {
  const auto schema = [] {
    Json files = list_schema("Replicates: same abscissae, else interpolated.", Json{{"type", "string"}});
    files["minItems"] = 1;
    return files;
  };
  return {"files", schema,
          [=](const Node& list, DataRequest& data) {
            for (const Node& node : list.elements("a list of data files")) {
              data.files.push_back(read_file_name(node, folder));
              if (std::find(data.files.begin(), data.files.end() - 1, data.files.back()) != data.files.end() - 1)
                node.fail("this file appears twice in the list", "A replicate is another measurement; remove one.");
            }
            if (data.files.empty()) list.fail("the list of files is empty");
          },
          [](const DataRequest& data) {
            if (data.files.size() == 1) return Json();
            Json files = Json::array();
            for (const auto& file : data.files) files.push_back(written_file(file));
            return files;
          }};
}

/// Read where one entry becomes several tables.
TableKey numbered_files_key() {
  return {"numbered_files",
          [] {
            return text_schema(
                "One table a file, \"frame_*.csv\": the number for the star is the prescribed quantity that no column "
                "gives.");
          },
          [](const Node&, DataRequest&) {}};
}

/// Written only where there is a stress: without one the reader refuses it.
TableKey stress_measure_key(const std::vector<Observable>& observables) {
  TableKey key = member_key(
      "stress_measure",
      [] { return choice_schema("Which stress the data give (default cauchy).", data::stress_measures()); },
      &DataRequest::stress_measure,
      [](const Node& node) { return node.one_of(data::stress_measures(), "stress measure"); });
  key.write = [&observables](const DataRequest& data) {
    const bool idle = data.part || maps(data, observables, is_channel);
    return idle && !maps(data, observables, is_stress) ? Json() : Json(data.stress_measure);
  };
  return key;
}

TableKey rows_key() {
  return {"rows", [] { return reference("row_range", "The rows to use, of those that match `where`."); },
          [](const Node& node, DataRequest& data) { data.rows = read_row_range(node); },
          [](const DataRequest& data) { return Json(write_row_range(data.rows)); }};
}

void read_where(const Node& node, DataRequest& data) {
  const auto value_of = [](const Node& value) {
    if (!value.is_text() && !value.is_number()) value.fail_expected("the text or number to look for in the column");
    return value.is_text() ? value.text("") : value.dumped();
  };
  for (const auto& [column, value] : node.members("an object of column names and values")) {
    if (!value.is_array()) {
      data.where.emplace_back(column, value_of(value));
      continue;
    }
    if (value.size() == 0) value.fail("the list of values is empty", "Name one, or leave the column out.");
    for (const Node& one : value.elements("")) data.where.emplace_back(column, value_of(one));
  }
}

TableKey where_key() {
  const auto schema = [] {
    const Json value = {{"type", {"string", "number"}}};
    Json condition = Json::object(), where = Json::object();
    condition["anyOf"] = Json::array({value, list_schema("Any of several.", value)});
    where["description"] = "Column → value, or a list of values: only rows that match every column.";
    where["type"] = "object";
    where["additionalProperties"] = std::move(condition);
    return where;
  };
  const auto write = [](const DataRequest& data) {  // one value alone, several in a list
    Json json;
    for (const auto& [column, value] : data.where) {
      Json& one = json[column];
      if (one.is_null())
        one = value;
      else if (one.is_array())
        one.push_back(value);
      else
        one = Json::array({one, value});
    }
    return json;
  };
  return {"where", schema, read_where, write};
}

/// Time from the path of the first abscissa.
Block<DataRequest> time_from_block(const std::vector<Observable>& observables) {
  const auto read = [&observables](const Node& node, DataRequest& data) {
    const Observable* path = nullptr;
    for (const auto& [name, column] : data.columns) {
      const Observable& observable = *data::quantity_named(name, observables)->observable;
      if (observable.role == Role::abscissa && path == nullptr) path = &observable;
      if (observable.role == Role::time)
        node.fail(
            fmt::format("\"time_from\" is given, and the column '{}' is mapped to '{}' too", excerpt(column), name),
            "Leave out one of the two.");
    }
    if (path == nullptr)
      node.fail("\"time_from\" needs an abscissa, and none is mapped",
                "Map one in \"columns\", or give a time column.");
    const double rate = node.quantity(path->unit + "/s", fmt::format("the rate of '{}'", path->name));
    if (!(rate > 0))
      node.fail(fmt::format("the rate is {}", rate),
                "It must be greater than zero: how fast the abscissa changes, in either direction.");
    data.time_rate = rate;
  };
  return {
      "\"time_from\"",
      "Time from the path of the abscissa, where none was recorded.",
      {required<DataRequest>(
          {"rate", [] { return quantity_schema("Change of the first abscissa per second, for example \"0.01/s\"."); },
           read, [](const DataRequest& data) { return written(data.time_rate); }})}};
}

Block<DataRequest> table_block(const std::vector<Observable>& observables, const std::string& owner,
                               const std::filesystem::path& folder) {
  TableKey order = code_key("order",
                            "Whether rows stand in the order in which they were measured (default unknown; time says "
                            "it too).",
                            &DataRequest::order, data::order_names, "order of rows");
  std::vector<TableKey> keys = {file_key(folder),
                                files_key(folder),
                                numbered_files_key(),
                                constant_key(observables, owner),
                                columns_key(observables, owner),
                                defined(stress_measure_key(observables)),
                                defined(rows_key()),
                                defined(where_key()),
                                defined(silent_at(std::move(order), "unknown")),
                                defined(block_key("time_from", time_from_block(observables))),
                                noise_key(observables)};
  for (TableKey& key : rig_keys(observables)) keys.push_back(std::move(key));
  return {fmt::format("the data of {}", owner), "The measured data.", std::move(keys)};
}

/// Keys that have no effect because of another key or of the mapped columns.
void refuse_idle_keys(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                      const data::DataRequest& data) {
  const auto has = [&](auto is) { return maps(data, observables, is); };
  const bool timed = data.time_rate || has([](const Observable& one) { return one.role == Role::time; });
  if (const auto node = block.find("order"); node && data.order == data::Order::unknown && (data.cycle || timed))
    node->fail(fmt::format("\"order\" is \"unknown\", and {} gives the order of the rows in {}",
                           data.cycle ? "\"cycle\"" : "the time", owner),
               "Leave one of the two out.");
  const bool measured = has(is_channel);
  if (const auto node = block.find("stress_measure"); node && measured && !has(is_stress))
    node->fail(fmt::format("\"stress_measure\" changes nothing in {}: no stress is mapped", owner),
               "Map one in \"columns\", or leave the measure out.");
}

}  // namespace

data::DataRequest read_table(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                             const std::filesystem::path& folder, const std::optional<Numbered>& numbered) {
  DataRequest data;
  const Block<DataRequest> table = table_block(observables, std::string(owner), folder);
  table.allow_only(block);
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
  if (numbered) {
    data.files.push_back(numbered->second.lexically_normal());
    read_number(block, observables, owner, numbered->first, data);
  }
  table.read(block, data);
  const auto by_position = [](const auto& entry) { return data::column_position(entry.second).has_value(); };
  data.layout.by_position = std::all_of(data.columns.begin(), data.columns.end(), by_position);
  check_sizes(block, owner, observables, data);
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

std::string write_row_range(const data::RowRange& range) {
  return fmt::format("{}:{}:{}", range.first, range.last ? fmt::format("{}", *range.last) : "", range.step);
}

void define_data(Json& definitions) {
  static const std::vector<Observable> none;
  definitions["row_range"] = {
      {"description", "first:last:step, counted from 0, negative numbers from the end, last not included."},
      {"type", "string"},
      {"pattern", "^-?[0-9]*:-?[0-9]*(:[0-9]*)?$"}};
  definitions["noise"] = noise_schema();
  table_block(none, "", {}).define(definitions);
}

Json table_schema(const std::vector<Observable>& observables) {
  Json schema = table_block(observables, "", {}).schema();
  Json& properties = schema["properties"];
  if (properties["constant"]["properties"].empty()) properties.erase("constant");
  // A quantity that every row needs has a column, unless it is the number of a file or a constant.
  Json needed = Json::object();
  for (const char* key : {"required", "allOf"})
    if (Json& columns = properties["columns"]; columns.contains(key)) {
      needed[key] = columns[key];
      columns.erase(key);
    }
  const auto has = [](const char* key) {
    Json one = Json::object();
    one["required"] = {key};
    return one;
  };
  if (!needed.empty()) {
    Json columns = Json::object();
    columns["properties"]["columns"] = std::move(needed);
    schema["anyOf"] = Json::array({std::move(columns), has("numbered_files"), has("constant")});
  }
  schema["oneOf"] = Json::array({has("file"), has("files"), has("numbered_files")});
  return schema;
}

Json write_table(const data::DataRequest& data, const std::vector<Observable>& observables) {
  return table_block(observables, "", {}).write(data);
}

}  // namespace tunica::experiment
