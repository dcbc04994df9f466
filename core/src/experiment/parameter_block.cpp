// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "experiment/blocks.hpp"

namespace tunica::experiment {
namespace {

const auto any_value = [](const Node&, double) {};

Block<Prior> prior_block(const std::string& what, const std::string& unit) {
  const auto above_zero = [what](const Node& node, double sd) {
    if (!(sd > 0))
      node.fail(fmt::format("the prior standard deviation of {} is {}", what, sd),
                "It must be greater than zero; to hold a parameter, use \"fixed\".");
  };
  return {"the prior of " + what,
          "A normal prior.",
          {required(quantity_key("mean", "Mean.", &Prior::mean, unit, "the prior mean", any_value)),
           required(quantity_key("sd", "Standard deviation.", &Prior::sd, unit, "the prior standard deviation",
                                 above_zero))}};
}

Block<ParameterSetting> parameter_block(const std::string& what, const std::string& unit) {
  const auto value = [&](const std::string& key, const char* doc, auto member) {
    return quantity_key(key, doc, member, unit, fmt::format("'{}' of {}", key, what), any_value);
  };
  const auto share_schema = [] {
    Json schema = text_schema("Parameters with the same group are one unknown.");
    schema["pattern"] = name_pattern;
    return schema;
  };
  const auto read_share = [](const Node& node) {
    node.check_name(node.text("the name of a share group"), "share group");
    return node.text("");
  };
  const Block<Prior> prior = prior_block(what, unit);
  return {what,
          "Searched.",
          {value("min", "Lower bound.", &ParameterSetting::min),
           value("max", "Upper bound.", &ParameterSetting::max),
           value("initial", "Start of the search.", &ParameterSetting::initial),
           value("fixed", "The value held.", &ParameterSetting::fixed),
           code_key("scale", "How the search divides the range; log needs a lower bound above zero.",
                    &ParameterSetting::scale, scale_names, "scale"),
           member_key("share", share_schema, &ParameterSetting::share, read_share),
           {"prior", [=] { return prior.schema(); },
            [=](const Node& node, ParameterSetting& setting) { prior.read(node, setting.prior.emplace()); },
            [=](const ParameterSetting& setting) { return setting.prior ? prior.write(*setting.prior) : Json(); }}}};
}

}  // namespace

Json parameter_schema() {
  Json keys = parameter_block("", "").properties();
  Json held = Json::object();
  held["fixed"] = keys.at("fixed");
  keys.erase("fixed");
  Json schema = {
      {"description", "A parameter: searched between bounds, or held at `fixed`, which excludes the other keys."}};
  schema["anyOf"] =
      Json::array({object_schema("Searched.", std::move(keys)), object_schema("Held.", std::move(held), {"fixed"})});
  return schema;
}

Json write_parameters(const ParameterSettings& settings) {
  Json json = Json::object();
  const Block<ParameterSetting> block = parameter_block("", "");
  for (const auto& [name, setting] : settings) json[name] = block.write(setting);
  return json;
}

ParameterSetting read_setting(const Node& node, const std::string& name, std::string_view unit) {
  const std::string what = fmt::format("parameter '{}'", name);
  ParameterSetting setting;
  setting.pointer = node.pointer();
  parameter_block(what, std::string(unit)).read(node, setting);
  if (setting.fixed && node.size() > 1) {
    std::string others;
    for (const auto& [key, child] : node.members("an object"))
      if (key != "fixed") others += (others.empty() ? "'" : ", '") + key + "'";
    node.fail(fmt::format("{} is fixed but has {} as well", what, others),
              "A fixed parameter is held at its value, so the other keys mean nothing: remove them, or \"fixed\".");
  }
  return setting;
}

}  // namespace tunica::experiment
