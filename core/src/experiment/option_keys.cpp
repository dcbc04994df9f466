// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "plugins/default_options.hpp"

namespace tunica::experiment {
namespace {

using Kind = Option::Kind;

void check_range(const Node& node, const Option& option, double value) {
  if (option.min && value < *option.min)
    node.fail(fmt::format("the option '{}' is {}, less than its least value {}", option.name, value, *option.min),
              fmt::format("Give at least that. {}", option.doc));
  if (option.max && value > *option.max)
    node.fail(fmt::format("the option '{}' is {}, more than its largest value {}", option.name, value, *option.max),
              fmt::format("Give at most that. {}", option.doc));
}

}  // namespace

Option::Value read_option(const Node& node, const Option& option) {
  const std::string what = fmt::format("the option '{}'", option.name);
  switch (option.kind) {
    case Kind::flag:
      return node.flag(what + ", true or false,");
    case Kind::integer: {
      const std::int64_t value = node.integer(what + ", a whole number,");
      check_range(node, option, static_cast<double>(value));
      return value;
    }
    case Kind::number:
    case Kind::quantity: {
      const double value =
          option.kind == Kind::number ? node.number(what + ", a number,") : node.quantity(option.unit, what);
      check_range(node, option, value);
      return value;
    }
    case Kind::choice:
      return node.one_of(option.choices, fmt::format("choice for the option '{}':", option.name));
    case Kind::text:
      return node.text(what + ", a text,");
    case Kind::json:
      break;
  }
  return node.dumped();
}

Json write_option(const Option& option, const Options& options) {
  const Option::Value& value = options.values().find(option.name)->second;
  if (option.kind == Option::Kind::json) return Json::parse(std::get<std::string>(value));
  return std::visit([](const auto& one) { return Json(one); }, value);
}

Options default_options(const Node& entry, const std::vector<Option>& declared, std::string_view owner) {
  for (const Option& option : declared)
    if (!option.fallback && !entry.find(option.name))
      entry.fail(fmt::format("the option '{}' is missing in {}", option.name, owner),
                 fmt::format("Add it. {}", option.doc));
  return plugins::default_options(declared);
}

}  // namespace tunica::experiment
