// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/enum_names.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"

namespace tunica::experiment {
namespace {

using Role = Observable::Role;

std::vector<std::string> observable_names(const std::vector<Observable>& observables, bool channels_only = false) {
  std::vector<std::string> names;
  for (const Observable& observable : observables)
    if (!channels_only || observable.role == Role::channel) names.push_back(observable.name);
  return names;
}

const Observable& observable_named(const std::vector<Observable>& observables, std::string_view name) {
  return *std::find_if(observables.begin(), observables.end(), [&](const Observable& o) { return o.name == name; });
}

std::filesystem::path read_file_name(const Node& node, const std::filesystem::path& folder) {
  const std::string& name = node.text("the name of a data file");
  std::filesystem::path file = (folder / name).lexically_normal();
  std::error_code error;
  if (!name.empty() && std::filesystem::is_regular_file(file, error)) return file;
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

void read_columns(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                  data::DataRequest& data) {
  const Node node = block.require("columns", fmt::format("the data of {}", owner));
  bool channel = false;
  for (const auto& [name, column] : node.members("an object that maps observables to column names")) {
    const auto known = observable_names(observables);
    if (std::find(known.begin(), known.end(), name) == known.end())
      column.fail(fmt::format("unknown observable '{}' of {}", excerpt(name), owner), suggestion(name, known));
    if (column.text("the name of a column").empty()) column.fail_expected("the name of a column");
    data.columns.emplace_back(name, column.text(""));
    channel = channel || observable_named(observables, name).role == Role::channel;
  }
  for (const Observable& observable : observables)
    if (observable.required && !node.find(observable.name))
      node.fail(fmt::format("no column is mapped to '{}', which {} needs", observable.name, owner),
                fmt::format("Add it. {}", observable.doc));
  if (!channel)
    node.fail(fmt::format("no measured quantity of {} is mapped, so there is nothing to fit", owner),
              suggestion("", observable_names(observables, true)));
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
    if (observable_named(observables, name).role == Role::channel) mapped.push_back(name);
  const auto members =
      node.members("a noise, {\"absolute\": …, \"relative\": …, \"correlation\": …}, or one per channel,");
  const bool per_channel = !members.empty() && std::all_of(members.begin(), members.end(), [](const auto& member) {
    return member.second.is_object();
  });
  if (!per_channel) {
    for (const std::string& name : mapped)
      data.noise.emplace_back(name, read_noise_of(node, observable_named(observables, name)));
    return;
  }
  for (const auto& [name, child] : members) {
    if (std::find(mapped.begin(), mapped.end(), name) == mapped.end())
      child.fail(fmt::format("noise is given for '{}', which is not a mapped channel", excerpt(name)),
                 suggestion(name, mapped));
    data.noise.emplace_back(name, read_noise_of(child, observable_named(observables, name)));
  }
}

void read_time_from(const Node& node, const std::vector<Observable>& observables, data::DataRequest& data) {
  node.allow_only({"rate"}, "\"time_from\"");
  const Observable* path = nullptr;
  for (const auto& [name, column] : data.columns) {
    const Observable& observable = observable_named(observables, name);
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

data::DataRequest read_data(const Node& block, const std::vector<Observable>& observables, std::string_view owner,
                            const std::filesystem::path& folder) {
  block.allow_only({"file", "files", "columns", "stress_measure", "rows", "where", "order", "time_from", "noise"},
                   fmt::format("the data of {}", owner));
  data::DataRequest data;
  const auto file = block.find("file"), files = block.find("files");
  if (file && files)
    block.fail(fmt::format("the data of {} have \"file\" and \"files\"", owner),
               "Leave out one: \"files\" is the list of replicates.");
  if (!file && !files)
    block.fail(fmt::format("the key 'file' is missing in the data of {}", owner),
               "Give \"file\", or \"files\" for replicates.");
  if (file) data.files.push_back(read_file_name(*file, folder));
  if (files)
    for (const Node& node : files->elements("a list of data files")) {
      data.files.push_back(read_file_name(node, folder));
      if (std::find(data.files.begin(), data.files.end() - 1, data.files.back()) != data.files.end() - 1)
        node.fail("this file appears twice in the list", "A replicate is another measurement; remove one.");
    }
  if (data.files.empty()) files->fail("the list of files is empty");
  read_columns(block, observables, owner, data);
  if (const auto node = block.find("stress_measure"))
    data.stress_measure = node->one_of(data::stress_measures(), "stress measure");
  if (const auto node = block.find("rows")) data.rows = read_row_range(*node);
  if (const auto node = block.find("where"))
    for (const auto& [column, value] : node->members("an object of column names and values")) {
      if (!value.is_text() && !value.is_number()) value.fail_expected("the text or number to look for in the column");
      data.where.emplace_back(column, value.is_text() ? value.text("") : value.dumped());
    }
  if (const auto node = block.find("order")) {
    const std::string name = node->one_of(names_in(data::order_names), "order of rows");
    data.order = text::value_of(data::order_names, name).value();
  }
  if (const auto node = block.find("time_from")) read_time_from(*node, observables, data);
  if (const auto node = block.find("noise")) read_noise(*node, observables, data);
  return data;
}

std::vector<double> read_weights(const Node& entry, std::size_t channels, std::string_view owner) {
  const auto node = entry.find("weight");
  if (!node) return std::vector<double>(channels, 1.0);
  const auto weight = [](const Node& at) {
    const double value = at.number("a weight");
    if (value < 0)
      at.fail(fmt::format("the weight is {}", value), "Weights are not negative; 0 leaves the channel out of the fit.");
    return value;
  };
  if (!node->is_array()) return std::vector<double>(channels, weight(*node));
  std::vector<double> weights;
  for (const Node& child : node->elements("")) weights.push_back(weight(child));
  if (weights.size() != channels)
    node->fail(fmt::format("found {} weights for the {} of {}", weights.size(),
                           channels == 1 ? "one mapped channel" : fmt::format("{} mapped channels", channels), owner),
               "Give one number for all, or one per channel in the order of \"columns\".");
  return weights;
}

HoldOut read_hold_out(const Node& node) {
  HoldOut hold_out;
  if (node.is_flag())
    hold_out.all = node.flag("");
  else if (node.is_text())
    hold_out.rows = read_row_range(node);
  else
    node.fail_expected("true, false or a row range such as \"200:240\"");
  return hold_out;
}

std::vector<LayerEntry> read_layers(const Node& entry, const std::string& type, const std::vector<std::string>& models,
                                    const plugins::Catalogue& catalogue) {
  const auto list = entry.find("layers");
  if (!list) return {};
  if (!catalogue.tests().find(type)->second.factory.layered) {
    std::vector<std::string> types;
    for (const auto& [name, test] : catalogue.tests())
      if (test.factory.layered) types.push_back(name);
    list->fail(
        fmt::format("a test of type '{}' has one model throughout and takes no layers", type),
        types.empty() ? "Remove \"layers\"." : fmt::format("Tests that take layers: {}.", fmt::join(types, ", ")));
  }
  std::vector<LayerEntry> layers;
  for (const Node& node : list->elements("a list of layers from inside, [ {\"model\": …, \"thickness\": …}, … ],")) {
    node.expect_object("a layer, {\"model\": …, \"thickness\": …},");
    node.allow_only({"model", "thickness"}, "a layer");
    LayerEntry layer{node.require("model", "a layer").one_of(models, "model"), 0};
    const Node thickness = node.require("thickness", "a layer");
    layer.thickness = thickness.quantity("mm", "the thickness of a layer");
    if (!(layer.thickness > 0))
      thickness.fail(fmt::format("the thickness of the layer is {} mm", layer.thickness),
                     "It must be greater than zero.");
    layers.push_back(std::move(layer));
  }
  if (layers.empty())
    list->fail("the list of layers is empty", "Leave \"layers\" out where the model of the run serves the test.");
  return layers;
}

}  // namespace

data::RowRange read_row_range(const Node& node) {
  const std::string& text = node.text("a row range such as \"0:240:6\"");
  const auto refuse = [&](std::string_view reason) {
    node.fail(fmt::format("'{}' is not a row range: {}", excerpt(text), reason),
              "Expected \"first:last\" or \"first:last:step\" as in \"0:240:6\": rows count from 0, last is not "
              "included, and each number may be left out.");
  };
  std::vector<std::optional<std::size_t>> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    std::size_t number = 0;
    const auto [stop, error] = std::from_chars(text.data() + begin, text.data() + end, number);
    if (begin != end && (error != std::errc() || stop != text.data() + end))
      refuse(fmt::format("'{}' is not a row number", excerpt(text.substr(begin, end - begin))));
    parts.push_back(begin == end ? std::nullopt : std::optional(number));
    begin = end + 1;
  }
  if (parts.size() < 2 || parts.size() > 3)
    refuse(fmt::format("it has {} part{}", parts.size(), parts.size() == 1 ? "" : "s"));
  data::RowRange range{parts[0].value_or(0), parts[1], parts.size() == 3 ? parts[2].value_or(1) : 1};
  if (range.step == 0) refuse("the step is 0");
  if (range.last && *range.last <= range.first) refuse("it ends before it begins");
  return range;
}

TestEntry read_test(const std::string& name, const Node& entry, const std::filesystem::path& folder,
                    const std::vector<std::string>& models, const plugins::Catalogue& catalogue,
                    std::vector<SharedParameter>& shared) {
  entry.expect_object("a test, {\"type\": …},");
  entry.check_name(name, "test");
  const std::string owner = fmt::format("test '{}'", name);
  const std::string type = entry.require("type", owner).one_of(names_of(catalogue.tests()), "test type");
  const TestFactory& factory = catalogue.tests().find(type)->second.factory;
  TestEntry test;
  test.name = name;
  test.type = type;
  test.layers = read_layers(entry, type, models, catalogue);
  std::vector<std::string> keys = {"type", "data", "weight", "hold_out", "parameters", "mechanisms"};
  if (factory.layered) keys.emplace_back("layers");
  test.options = read_options(entry, factory.options, keys, owner);
  test.folder = std::filesystem::absolute(folder.empty() ? "." : folder);
  if (test.options.has("folder")) {  // absolute from here on, so that a copy of the file elsewhere means the same
    test.folder = (test.folder / test.options.text("folder")).lexically_normal();
    test.options.set("folder", test.folder.string());
  }
  test.parameters = read_mentioned_parameters(entry, factory.parameters, owner, shared);
  test.mechanisms = read_test_mechanisms(entry, type, owner, catalogue, shared);
  test.data = read_data(entry.require("data", owner), factory.observables, owner, folder);
  const auto channels = std::count_if(test.data.columns.begin(), test.data.columns.end(), [&](const auto& column) {
    return observable_named(factory.observables, column.first).role == Role::channel;
  });
  test.weights = read_weights(entry, static_cast<std::size_t>(channels), owner);
  if (const auto node = entry.find("hold_out")) test.hold_out = read_hold_out(*node);
  return test;
}

}  // namespace tunica::experiment
