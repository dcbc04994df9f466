// SPDX-License-Identifier: Apache-2.0
#include "comparison/parameter_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "data/units.hpp"
#include "execution/files.hpp"
#include "results/keys.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::comparison {

namespace key = results::key;

namespace {

using json = nlohmann::ordered_json;

/// {name: value} of a run of the model in a result.json, the best-ranked one unless `wanted` names it, which then is
/// its name.
json from_result(const json& document, const std::string& model, std::string& wanted, const std::string& file) {
  std::vector<std::string> known;
  for (const auto& entry : document.at(key::ranking))
    for (const auto& run : document.at(key::runs))
      if (run.at(key::run) == entry.at(key::run) && run.at(key::model) == model && !run.at(key::best).is_null()) {
        known.push_back(run.at(key::run));
        if (!wanted.empty() && known.back() != wanted) continue;
        wanted = known.back();
        json values = json::object();
        for (const auto& [name, parameter] : run.at(key::best).at(key::parameters).items())
          values[name] = parameter.at(key::value);
        return values;
      }
  if (!wanted.empty() && !known.empty())
    throw InputError(fmt::format("{}: no run '{}' of the model '{}' has a result in it. {}", file, wanted, model,
                                 data::suggestion(wanted, known)));
  throw InputError(fmt::format(
      "{}: no run of the model '{}' has a result in it; name one of its models with --model, or take another file",
      file, model));
}

double value_of(const json& value, const std::string& unit, const std::string& where) {
  try {
    if (value.is_number()) return value.get<double>();
    if (value.is_string()) return data::parse_quantity(value.get<std::string>(), unit);
  } catch (const InputError& problem) {
    throw InputError(fmt::format("{}: {}", where, problem.what()));
  }
  throw InputError(fmt::format("{}: found {}, expected a number or a quantity such as \"10.4 kPa\"", where,
                               value.is_structured() ? value.type_name() : data::excerpt(value.dump())));
}

}  // namespace

std::pair<std::vector<double>, std::string> read_parameters(const std::filesystem::path& path, const std::string& model,
                                                            const std::string& run,
                                                            const assembly::Assembly& assembly) {
  const std::string file = path.string();
  std::string origin = file, chosen = run;
  json values;
  try {
    values = detail::parse_json<json>(execution::read_text(path), true, true);
    if (values.is_object() && values.contains(key::runs) && values.contains(key::ranking)) {
      values = from_result(values, model, chosen, file);
      origin = fmt::format("run '{}' of {}", chosen, file);
    } else if (!run.empty()) {
      throw InputError(fmt::format("{}: is not a result.json, so it has no run '{}'; leave out --run", file, run));
    }
  } catch (const json::exception& problem) {
    throw InputError(fmt::format("{}: is neither a result.json nor an object {{name: value}}: {}", file,
                                 text::json_problem(problem.what())));
  }
  if (!values.is_object())
    throw InputError(fmt::format("{}: found {}, expected an object {{name: value}}", file, values.type_name()));

  const auto& parameters = assembly.layout().parameters;
  const auto& fixed = assembly.layout().fixed_parameters;
  std::vector<double> free;
  std::vector<std::string> known;
  for (const auto& parameter : parameters) {
    free.push_back(parameter.initial);
    known.push_back(parameter.name);
  }
  for (const auto& parameter : fixed) known.push_back(parameter.name);
  // A run of the model alone has names without it, where this one, with layers of other models, says whose they are.
  const bool several = assembly.models().in_one_state() > 1;
  for (const auto& [written, value] : values.items()) {
    const std::string full = fmt::format("{}.{}", model, written);
    const bool prefixed = several && std::find(known.begin(), known.end(), written) == known.end() &&
                          std::find(known.begin(), known.end(), full) != known.end();
    const std::string name = prefixed ? full : written;
    const std::string where = fmt::format("{}: {}", file, name);
    const auto named = [&name](const auto& parameter) { return parameter.name == name; };
    const auto found = std::find_if(parameters.begin(), parameters.end(), named);
    if (found != parameters.end()) {
      free[static_cast<std::size_t>(found - parameters.begin())] = value_of(value, found->unit, where);
      continue;
    }
    const auto held = std::find_if(fixed.begin(), fixed.end(), named);
    if (held == fixed.end())
      throw InputError(
          fmt::format("{}: the model '{}' has no such parameter. {}", where, model, data::suggestion(name, known)));
    const double wanted = value_of(value, held->unit, where);
    if (std::abs(wanted - held->value) > 1e-12 * std::abs(held->value))
      throw InputError(
          fmt::format("{}: found {}, but the experiment holds it fixed at {} {}; take it out of one of the two files",
                      where, wanted, held->value, held->unit));
  }
  return {std::move(free), std::move(origin)};
}

}  // namespace tunica::comparison
