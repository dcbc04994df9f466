// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "assembly/memory.hpp"
#include "diagnosis/file/changes.hpp"
#include "diagnosis/file/correction.hpp"
#include "plugins/guarded.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double quarter_turn = 90, degrees_per_radian = 180 / std::numbers::pi;

/// An angle of a model that the file holds.
experiment::ParameterSetting* held_angle(experiment::Experiment& experiment, const std::string& model,
                                         const std::string& parameter) {
  for (experiment::ModelEntry& entry : experiment.models)
    if (entry.name == model)
      for (auto& [name, setting] : entry.parameters)
        if (name == parameter && setting.fixed) return &setting;
  return nullptr;
}

}  // namespace

void add_angles(const Record& record, const experiment::RunEntry& run, const plugins::Catalogue& catalogue,
                Corrections& all) {
  const std::vector<std::string> used = record.experiment().models_of(run);
  for (const experiment::ModelEntry& model : record.experiment().models) {
    if (std::find(used.begin(), used.end(), model.name) == used.end()) continue;
    const auto type = catalogue.models().find(model.type);
    if (type == catalogue.models().end()) continue;
    const auto made = plugins::create(type->second, model.options);
    for (const Parameter& parameter : made->describe().parameters) {
      const auto held = model.parameters.find(parameter.name);
      if (parameter.unit != "deg" || held == model.parameters.end() || !held->second.fixed) continue;
      const double angle = *held->second.fixed;
      const auto add = [&](double value, const std::string& why) {
        if (!(value >= parameter.min && value <= parameter.max) || std::abs(value - angle) < 1) return;
        all.push_back({FileKind::angle, run.tests, true,
                       fmt::format("the angle {} = {:.4g} deg of '{}' {}", parameter.name, angle, model.name, why),
                       fmt::format("\"{}\": {{\"fixed\": {:.6g}}} in '{}'", parameter.name, value, model.name),
                       [model = model.name, name = parameter.name, value](Record& read) {
                         auto* const setting = held_angle(read.experiment(), model, name);
                         if (setting != nullptr) setting->fixed = value;
                         return setting != nullptr;
                       }});
        all.back().changes = {{pointer({"models", model.name, "parameters", parameter.name}),
                               fmt::format("{{\"fixed\": {:.6g}}}", value)}};
      };
      add(quarter_turn - angle, "is counted from the other axis");
      add(angle * degrees_per_radian, "is in radians");
      add(quarter_turn - angle * degrees_per_radian, "is in radians and counted from the other axis");
      add(angle / degrees_per_radian, "was taken for radians and converted once more");
    }
  }
}

void add_clocks(const Inquiry& inquiry, const Record& record, const experiment::RunEntry& run, Corrections& all) {
  std::vector<std::string> timed;
  for (const std::string& test : run.tests)
    if (record.data(test).time.size() > 1 &&
        assembly::has_memory(record.experiment(), record.test(test), run, inquiry.catalogue))
      timed.push_back(test);
  // One factor on all clocks is taken up by the relaxation times.
  if (timed.size() < 2) return;
  constexpr std::array clock_factors{10.0, 60.0, 1000.0};
  for (const std::string& test : timed)
    for (const double up : clock_factors)
      for (const double factor : {up, 1 / up})
        all.push_back({FileKind::clock,
                       {test},
                       false,
                       fmt::format("the times of '{}' are {:.4g} times what the file says", test, factor),
                       fmt::format("the unit of the times of '{}' in their header or with \"units\"", test),
                       [test, factor](Record& read) { return read.scale_time(test, factor); },
                       0,
                       "times of " + test,
                       std::log(factor)});
}

}  // namespace tunica::diagnosis
