// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "../external/observables.hpp"
#include "connection.hpp"
#include "tunica/plugin.hpp"

namespace tunica::um_bridge {

using Json = nlohmann::json;

namespace {

using Vectors = Connection::Vectors;

/// A parameter of the model at a place of the server's inputs.
struct Input {
  std::string name, unit;  ///< unit: empty = the base unit
  std::size_t vector = 0, place = 0;
};
/// A channel among the server's outputs: n numbers from `first` of output `vector`.
struct Output {
  std::size_t vector = 0, first = 0;
  double factor = 1;  ///< to the base unit
};

/// A model server of the protocol UM-Bridge that simulates an experiment.
class Served final : public Test {
 public:
  explicit Served(const TestSetup& setup)
      : connection_(setup.options.text("url"), setup.options.text("model"), Json::parse(setup.options.text("config")),
                    setup.options.number("time_limit"), setup.interrupted),
        unit_factor_(setup.unit_factor) {
    for (const auto& column : setup.rows.abscissae) columns_.emplace_back(column.values.begin(), column.values.end());
    for (std::size_t k = 0; k < columns_.size(); ++k)
      rows_.abscissae.push_back({setup.rows.abscissae[k].observable, columns_[k]});
    time_.assign(setup.rows.time.begin(), setup.rows.time.end());
    rows_.count = setup.rows.count;
    rows_.channels = setup.rows.channels;
    rows_.time = time_;
    description_.costly = true;
    description_.volume = TestDescription::Volume::either;  // J is the other program's
    const Json inputs = Json::parse(setup.options.text("inputs")), outputs = Json::parse(setup.options.text("outputs"));
    offline_ = setup.options.flag("offline");
    if (offline_)
      take_for_granted(inputs, outputs);
    else
      ask(setup);
    read_inputs(inputs);
    read_outputs(outputs, setup);
    if (!exact_)
      description_.differencing = {
          setup.options.number("difference_step"), setup.options.text("derivatives") == "central",
          setup.options.text("derivatives") != "forward" && setup.options.text("derivatives") != "central"};
  }

 private:
  void ask(const TestSetup& setup) {
    try {
      connection_.greet();
      input_sizes_ = connection_.input_sizes();
      output_sizes_ = connection_.output_sizes();
      exact_ = setup.options.text("derivatives") == "server" && connection_.supports("ApplyJacobian");
    } catch (const std::exception& problem) {
      throw InputError(problem.what());
    }
  }

  /// Sizes as the file has them, where no server is asked.
  void take_for_granted(const Json& inputs, const Json& outputs) {
    for (const Json& list : inputs) input_sizes_.push_back(list.size());
    for (const Json& entry : outputs) {
      if (!entry.is_object()) continue;
      const auto place = [&](const char* key) {
        const auto found = entry.find(key);
        return found != entry.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
      };
      constexpr std::size_t most = 10'000'000;  // numbers, as an answer may have
      const std::size_t vector = place("output"), first = place("first");
      if (vector >= most || first >= most) continue;
      output_sizes_.resize(std::max(output_sizes_.size(), vector + 1));
      output_sizes_[vector] = std::max(output_sizes_[vector], first + rows_.count);
    }
  }

 public:
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  [[nodiscard]] std::vector<Effort> efforts() const override {
    return {{"server_evaluations", evaluations_}, {"jacobian_actions", actions_}};
  }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (!output.abscissa_derivative.empty() || !input.abscissae.empty())
      return Status::failed("um_bridge: the server knows no other abscissae than its own");
    if (offline_) return Status::failed("um_bridge: \"offline\" is true, and the server is not asked");
    try {
      const Vectors at = filled_in(input);
      if (!output.values.empty()) {
        ++evaluations_;
        const Vectors values = connection_.evaluate(at);
        for (std::size_t k = 0; k < outputs_.size(); ++k) {
          if (outputs_[k].vector >= values.size())
            throw std::runtime_error(
                fmt::format("the server sent {} outputs where {} were announced", values.size(), output_sizes_.size()));
          copy(values[outputs_[k].vector], k, output.values);
        }
      }
      if (!output.jacobian.empty()) differentiate(input, at, output.jacobian);
    } catch (const std::exception& problem) {
      return Status::failed(fmt::format("um_bridge: {}", problem.what()));
    }
    return {};
  }

 private:
  void read_inputs(const Json& lists) {
    const std::string form =
        R"("inputs" is a list of lists of parameters, one list an input of the server: [["mu kPa"]])";
    std::vector<std::string> reads;
    if (!lists.is_array()) throw InputError(form);
    if (lists.size() != input_sizes_.size())
      throw InputError(
          fmt::format("\"inputs\" has {} lists, and the server has {} inputs", lists.size(), input_sizes_.size()));
    for (std::size_t v = 0; v < lists.size(); ++v) {
      if (!lists[v].is_array()) throw InputError(form);
      if (lists[v].size() != input_sizes_[v])
        throw InputError(fmt::format("input {} of the server has {} numbers, and \"inputs\" gives {} for it", v,
                                     input_sizes_[v], lists[v].size()));
      for (std::size_t place = 0; place < lists[v].size(); ++place) {
        if (!lists[v][place].is_string()) throw InputError(form);
        const auto text = lists[v][place].get<std::string>();
        const std::size_t blank = text.find(' ');
        inputs_.push_back({text.substr(0, blank), blank == std::string::npos ? "" : text.substr(blank + 1), v, place});
        reads.push_back(inputs_.back().name);
      }
    }
    description_.reads = std::move(reads);
  }

  void read_outputs(const Json& mapped, const TestSetup& setup) {
    const std::string form =
        R"("outputs" maps channels to the server's outputs: {"force": {"output": 0, "unit": "N"}})";
    if (!mapped.is_object()) throw InputError(form);
    for (const std::string& channel : rows_.channels) {
      const auto entry = mapped.find(channel);
      if (entry == mapped.end())
        throw InputError(fmt::format("\"outputs\" does not say which output of the server is '{}'; {}", channel, form));
      outputs_.push_back(output_of(*entry, channel, setup));
    }
    for (const auto& [channel, entry] : mapped.items())
      if (std::ranges::find(rows_.channels, channel) == rows_.channels.end())
        throw InputError(
            fmt::format("\"outputs\" names '{}', and \"columns\" maps no measured column to it; take it "
                        "out, or map one of {}",
                        channel, fmt::join(rows_.channels, ", ")));
  }

  [[nodiscard]] Output output_of(const Json& entry, const std::string& channel, const TestSetup& setup) const {
    const auto refuse = [&](const std::string& key, const std::string& found, const char* expected) {
      throw InputError(
          fmt::format("\"outputs\" (/outputs/{}{}): found {}, expected {}", channel, key, found, expected));
    };
    if (!entry.is_object()) refuse("", shown(entry), R"(an object: {"output": 0, "first": 0, "unit": "N"})");
    Output place;
    std::string unit;
    for (const auto& [key, value] : entry.items()) {
      if (key == "output" || key == "first") {
        if (!value.is_number_unsigned()) refuse("/" + key, shown(value), "a whole number from 0");
        (key == "output" ? place.vector : place.first) = value.get<std::size_t>();
      } else if (key == "factor") {
        if (!value.is_number() || !std::isfinite(value.get<double>()) || value.get<double>() == 0)
          refuse("/" + key, shown(value), "a number other than 0");
        place.factor = value.get<double>();
      } else if (key == "unit") {
        if (!value.is_string()) refuse("/" + key, shown(value), "a unit in quotes");
        unit = value.get<std::string>();
      } else {
        refuse("", "the key '" + key + "'", "\"output\", \"first\", \"unit\" and \"factor\" only");
      }
    }
    const auto& declared = *std::ranges::find(observables_, channel, &Observable::name);
    if (!unit.empty() && setup.unit_factor) place.factor *= setup.unit_factor(unit, declared.unit);
    // Compared without a sum, which could overflow.
    const bool fits = place.vector < output_sizes_.size() && rows_.count <= output_sizes_[place.vector] &&
                      place.first <= output_sizes_[place.vector] - rows_.count;
    if (!fits)
      throw InputError(fmt::format(
          "\"outputs\": '{}' has {} rows from number {} of output {}, and the server's outputs have {} numbers",
          channel, rows_.count, place.first, place.vector, fmt::join(output_sizes_, ", ")));
    return place;
  }

  static std::string shown(const Json& value) {
    const std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    return text.size() <= 60 ? text : text.substr(0, 60) + " …";
  }

  [[nodiscard]] std::size_t parameter(const TestInput& input, const std::string& name) const {
    const auto& parameters = input.model.describe().parameters;
    return static_cast<std::size_t>(std::ranges::find(parameters, name, &Parameter::name) - parameters.begin());
  }
  [[nodiscard]] double factor(const TestInput& input, const Input& place) const {
    const std::string& base = input.model.describe().parameters[parameter(input, place.name)].unit;
    return place.unit.empty() || place.unit == base ? 1 : unit_factor_(base, place.unit);
  }

  [[nodiscard]] Vectors filled_in(const TestInput& input) const {
    Vectors at;
    for (const std::size_t size : input_sizes_) at.emplace_back(size);
    for (const Input& place : inputs_)
      at[place.vector][place.place] = factor(input, place) * input.model_parameters[parameter(input, place.name)];
    return at;
  }

  void copy(const std::vector<double>& numbers, std::size_t channel, std::span<double> into) const {
    const Output& place = outputs_[channel];
    if (numbers.size() < rows_.count || numbers.size() - rows_.count < place.first)
      throw std::runtime_error(fmt::format("the server sent {} numbers of output {} where {} were announced",
                                           numbers.size(), place.vector, output_sizes_[place.vector]));
    for (std::size_t i = 0; i < rows_.count; ++i)
      into[channel * rows_.count + i] = place.factor * numbers[place.first + i];
  }

  /// One action of the server's Jacobian a parameter and output: on the unit vector of the parameter.
  void differentiate(const TestInput& input, const Vectors& at, std::span<double> jacobian) const {
    const std::size_t size = rows_.channels.size() * rows_.count;
    std::ranges::fill(jacobian, 0.0);
    std::vector<double> part(size);
    for (const Input& place : inputs_) {
      std::vector<double> direction(input_sizes_[place.vector]);
      direction[place.place] = 1;
      std::vector<std::vector<double>> answers(output_sizes_.size());
      for (std::size_t k = 0; k < outputs_.size(); ++k) {
        auto& answer = answers[outputs_[k].vector];
        if (answer.empty()) {
          ++actions_;
          answer = connection_.apply_jacobian(outputs_[k].vector, place.vector, at, direction);
        }
        copy(answer, k, part);
      }
      const std::span<double> column = jacobian.subspan(parameter(input, place.name) * size, size);
      for (std::size_t i = 0; i < size; ++i) column[i] += factor(input, place) * part[i];
    }
  }

  Connection connection_;
  std::function<double(std::string_view, std::string_view)> unit_factor_;
  const std::vector<Observable> observables_ = external::observables();
  std::vector<std::size_t> input_sizes_, output_sizes_;
  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
  bool exact_ = false, offline_ = false;
  std::vector<std::vector<double>> columns_;
  std::vector<double> time_;
  TestRows rows_;
  TestDescription description_;
  mutable std::atomic<std::uint64_t> evaluations_ = 0, actions_ = 0;
};

/// At most a year, which every clock can count.
Option time_limit() {
  Option option =
      Option::quantity("time_limit", "s", 0.001, "Longest wait for the server; then the evaluation fails.", 600.0);
  option.max = 3e7;
  return option;
}

std::vector<Option> options() {
  return {
      Option::text("url", "http://127.0.0.1:4242", "Address of the server."),
      Option::text("model", "forward", "Name of the model on the server."),
      Option::json("config", "{}", "Object that is sent along with every request."),
      Option::json("inputs", {},
                   "List of lists of parameters by name, with a unit if it is not the base unit: [[\"mu MPa\"]]."),
      Option::json("outputs", {}, "Object: channel to {\"output\": 0, \"first\": 0, \"unit\": \"N\", \"factor\": 1}."),
      time_limit(),
      Option::choice("derivatives", {"server", "broyden", "forward", "central"}, "server",
                     "Actions of the server's Jacobian, where it has them; else differences as 'broyden'."),
      Option::number("difference_step", 1e-4, {1e-8, 0.1}, "Relative step of the differences."),
      {"offline", Option::Kind::flag, false,
       "Ask no server, and take its sizes from inputs and outputs: nothing can be evaluated, and the rest be checked."},
  };
}

TestFactory factory() {
  return {"um_bridge",
          "A model server that is asked by HTTP, in the protocol UM-Bridge.",
          "Seelinger et al., J. Open Source Softw. 8(83):4748 (2023)",
          options(),
          external::observables(),
          [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Served>(setup); }};
}

}  // namespace
}  // namespace tunica::um_bridge

TUNICA_PLUGIN("um_bridge", TUNICA_PLUGIN_VERSION) { registry.add(tunica::um_bridge::factory()); }
