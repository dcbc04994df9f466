// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiment/enum_names.hpp"
#include "experiment/reader.hpp"
#include "experiment/suggest.hpp"
#include "tunica/error.hpp"

namespace tunica::experiment {
namespace {

std::string quantity(double value, std::string_view unit) {
  return unit.empty() || unit == "1" ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

/// The numbers of one parameter against each other; absent ones are not compared. `node` is where the parameter
/// stands, `of_file` says which of the bounds the file gives.
void check_setting(const Node& node, const ParameterSetting& setting, const ParameterSetting& of_file,
                   std::string_view what, std::string_view unit) {
  if (setting.fixed) return;
  const auto source = [](const std::optional<double>& given) { return given ? "" : " (the default)"; };
  if (setting.min && setting.max && !(*setting.min < *setting.max))
    node.fail(fmt::format("the bounds of {} are {}: min is {}{}, max is {}{}", what,
                          *setting.min == *setting.max ? "equal" : "reversed", quantity(*setting.min, unit),
                          source(of_file.min), quantity(*setting.max, unit), source(of_file.max)),
              *setting.min == *setting.max ? "To hold a parameter at a value, use \"fixed\"."
              : of_file.min && of_file.max ? "Swap them: min must be less than max."
                                           : "Give both: min must be less than max.");
  if (setting.scale == Scale::log && setting.min && !(*setting.min > 0))
    node.fail(fmt::format("{} has \"scale\": \"log\" and the lower bound {}{}, which has no logarithm", what,
                          quantity(*setting.min, unit), source(of_file.min)),
              "Give a \"min\" greater than zero, or \"scale\": \"linear\".");
  const bool below = setting.initial && setting.min && *setting.initial < *setting.min;
  const bool above = setting.initial && setting.max && *setting.initial > *setting.max;
  if (below || above)
    node.child_or_self("initial").fail(
        fmt::format("the initial value of {}, {}, is outside its bounds: {}{} to {}{}", what,
                    quantity(*setting.initial, unit), quantity(setting.min.value_or(0), unit), source(of_file.min),
                    quantity(setting.max.value_or(0), unit), source(of_file.max)),
        "Move it inside, or widen the bounds.");
}

/// The file's setting with the declaration where the file is silent. A default start outside bounds that the file has
/// narrowed moves to the nearest bound.
ParameterSetting completed(ParameterSetting setting, const Parameter& declared) {
  if (setting.fixed) return setting;
  setting.own_initial = setting.initial.has_value();
  setting.min = setting.min.value_or(declared.min);
  setting.max = setting.max.value_or(declared.max);
  setting.scale = setting.scale.value_or(declared.scale);
  if (!setting.initial && *setting.min < *setting.max)
    setting.initial = std::clamp(declared.initial, *setting.min, *setting.max);
  return setting;
}

}  // namespace

ParameterSettings read_parameters(const Node& entry, const std::vector<Parameter>& declared, std::string_view owner,
                                  std::vector<SharedParameter>& shared) {
  const auto block = entry.find("parameters");
  std::vector<std::string> known;
  for (const Parameter& parameter : declared) known.push_back(parameter.name);
  if (block)
    for (const auto& [name, node] : block->members("an object with one entry per parameter"))
      if (std::find(known.begin(), known.end(), name) == known.end())
        node.fail(
            fmt::format("unknown parameter '{}' of {}", excerpt(name), owner),
            (name.find('.') == std::string::npos ? ""
                                                 : "Parameters of a mechanism stand in the mechanism's own entry. ") +
                suggestion(name, known));
  ParameterSettings settings;
  for (const Parameter& parameter : declared) {
    const auto node = block ? block->find(parameter.name) : std::nullopt;
    const std::string what = fmt::format("'{}' of {}", parameter.name, owner);
    ParameterSetting of_file;
    of_file.pointer = child_pointer(child_pointer(entry.pointer(), "parameters"), parameter.name);
    if (node) of_file = read_setting(*node, parameter.name, parameter.unit);
    const ParameterSetting setting = completed(of_file, parameter);
    if (node) check_setting(*node, setting, of_file, what, parameter.unit);
    if (node && setting.share) shared.push_back({*setting.share, parameter.unit, setting, *node});
    settings.emplace(parameter.name, setting);
  }
  return settings;
}

ParameterSettings read_mentioned_parameters(const Node& entry, const std::vector<Parameter>& declared,
                                            std::string_view owner, std::vector<SharedParameter>& shared) {
  ParameterSettings settings = read_parameters(entry, declared, owner, shared);
  const auto block = entry.find("parameters");
  std::erase_if(settings, [&](const auto& setting) { return !block || !block->find(setting.first); });
  return settings;
}

/// Tied parameters are one unknown, so their settings must agree.
void check_shared(const std::vector<SharedParameter>& shared) {
  std::map<std::string, std::vector<const SharedParameter*>, std::less<>> groups;
  for (const SharedParameter& member : shared) groups[member.group].push_back(&member);
  for (const auto& entry : groups) {
    const std::string& group = entry.first;
    const std::vector<const SharedParameter*>& members = entry.second;
    const SharedParameter& first = *members.front();
    if (members.size() == 1) {
      std::vector<std::string> others;
      for (const auto& other : groups)
        if (other.first != group) others.push_back(other.first);
      const std::string near = nearest(group, others);
      first.node.child_or_self("share").fail(
          fmt::format("the share group '{}' has only this one member", group),
          near.empty() ? "Give the other parameters to be tied the same group, or remove \"share\"."
                       : fmt::format("Did you mean '{}'?", near));
    }
    for (const SharedParameter* member : members) {
      const auto conflict = [&](std::string_view what, std::string_view here, std::string_view there) {
        member->node.fail(fmt::format("parameters of the share group '{}' have different {}: {} here, {} at {}", group,
                                      what, here, there, first.node.pointer()),
                          "They are one unknown: make them agree.");
      };
      const auto compare = [&](std::string_view what, const std::optional<double>& here,
                               const std::optional<double>& there) {
        if (here && there && *here != *there) conflict(what, fmt::format("{}", *here), fmt::format("{}", *there));
      };
      if (!member->unit.empty() && !first.unit.empty() && member->unit != first.unit)
        conflict("units", member->unit, first.unit);
      compare("lower bounds", member->setting.min, first.setting.min);
      compare("upper bounds", member->setting.max, first.setting.max);
      compare("initial values", member->setting.initial, first.setting.initial);
      if (member->setting.scale && first.setting.scale && *member->setting.scale != *first.setting.scale)
        conflict("scales", text::code_of(scale_names, *member->setting.scale),
                 text::code_of(scale_names, *first.setting.scale));
      if (member->setting.prior && first.setting.prior &&
          (member->setting.prior->mean != first.setting.prior->mean ||
           member->setting.prior->sd != first.setting.prior->sd))
        conflict("priors", fmt::format("{} ± {}", member->setting.prior->mean, member->setting.prior->sd),
                 fmt::format("{} ± {}", first.setting.prior->mean, first.setting.prior->sd));
    }
  }
}

}  // namespace tunica::experiment
