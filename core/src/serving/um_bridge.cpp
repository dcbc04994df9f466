// SPDX-License-Identifier: Apache-2.0
#include "serving/um_bridge.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::serving {
namespace {

using Json = nlohmann::json;
using Function = ServedRun::Function;
using Vectors = std::vector<std::vector<double>>;

constexpr Function functions[] = {Function::objective, Function::residuals, Function::predictions};

/// An answer that is an error, with its type in the protocol.
struct Refusal : std::runtime_error {
  Refusal(std::string type_, const std::string& message) : std::runtime_error(message), type(std::move(type_)) {}
  std::string type;
};

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const Function function : functions) found.emplace_back(name_of(function));
  return found;
}

/// Lists by their kind: they may be nested so deeply that writing them would exhaust the stack.
std::string shown(const Json& value) {
  return value.is_structured() ? fmt::format("an {}", value.type_name()) : data::excerpt(value.dump());
}

const Json& member(const Json& request, const char* key) {
  const auto found = request.find(key);
  if (found == request.end()) throw Refusal("InvalidInput", fmt::format("the request has no \"{}\"", key));
  return *found;
}

Function function_of(const Json& request) {
  const Json& name = member(request, "name");
  for (const Function function : functions)
    if (name == name_of(function)) return function;
  throw Refusal("ModelNotFound",
                fmt::format("there is no model {}. {}", shown(name),
                            data::suggestion(name.is_string() ? name.get<std::string>() : "", names())));
}

std::vector<double> numbers(const Json& list, std::size_t count, const std::string& what) {
  const bool all = list.is_array() && std::ranges::all_of(list, [](const Json& value) { return value.is_number(); });
  if (!all || list.size() != count)
    throw Refusal("InvalidInput", fmt::format("{} is a list of {} numbers; found {}", what, count,
                                              all ? fmt::format("{} numbers", list.size()) : shown(list)));
  return list.get<std::vector<double>>();
}

std::vector<double> parameters(const Json& request, const ServedRun& run) {
  const Json& input = member(request, "input");
  if (!input.is_array() || input.size() != 1)
    throw Refusal("InvalidInput", "\"input\" is a list of one list: the free parameters, in base units");
  return numbers(input[0], run.input_size(), "\"input\"");
}

std::size_t index(const Json& request, const char* key, std::size_t count) {
  const Json& value = member(request, key);
  if (!value.is_number_integer() || value.get<std::int64_t>() < 0 || value.get<std::size_t>() >= count)
    throw Refusal("InvalidInput", fmt::format("\"{}\" is a whole number below {}; found {}", key, count, shown(value)));
  return value.get<std::size_t>();
}

template <class Values>
void check_finite(const Values& values, std::string_view what) {
  if (std::ranges::any_of(values, [](double value) { return !std::isfinite(value); }))
    throw Refusal("InvalidOutput", fmt::format("a number of {} is not finite, and JSON has none of those", what));
}

Json evaluated(const ServedRun& run, const Json& request) {
  const Function function = function_of(request);
  const Vectors outputs = run.values(function, parameters(request, run));
  for (const auto& output : outputs) check_finite(output, name_of(function));
  return {{"output", outputs}};
}

/// Rows of the Jacobian against a vector: from the left (Gradient, "sens"), or from the right (ApplyJacobian, "vec").
Json applied(const ServedRun& run, const Json& request, bool left) {
  const Function function = function_of(request);
  const auto sizes = run.output_sizes(function);
  const std::size_t output = index(request, "outWrt", sizes.size()), n = run.input_size(), m = sizes[output];
  (void)index(request, "inWrt", 1);
  const char* const key = left ? "sens" : "vec";
  const auto vector = numbers(member(request, key), left ? m : n, fmt::format("\"{}\"", key));
  const auto rows = run.jacobian(function, output, parameters(request, run));
  std::vector<double> product(left ? n : m);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (left)
        product[j] += vector[i] * rows[i * n + j];
      else
        product[i] += rows[i * n + j] * vector[j];
    }
  check_finite(product, "the derivative");
  return {{"output", product}};
}

Json described(const ServedRun& run) {
  Json list = Json::array();
  for (const auto& parameter : run.layout().parameters)
    list.push_back({{"name", parameter.name},
                    {"unit", parameter.unit},
                    {"min", parameter.min},
                    {"max", parameter.max},
                    {"initial", parameter.initial}});
  return {{"support", {{"Evaluate", true}, {"Gradient", true}, {"ApplyJacobian", true}, {"ApplyHessian", false}}},
          {"parameters", list}};
}

Json response(const ServedRun& run, std::string_view path, const std::string& body) {
  if (path == "/Info") return {{"protocolVersion", 1.0}, {"models", names()}};
  constexpr int deepest = 64;  // levels; a request has three
  bool too_deep = false;
  const Json request = Json::parse(
      body,
      [&too_deep](int depth, Json::parse_event_t, Json&) {
        too_deep = too_deep || depth > deepest;
        return !too_deep;
      },
      false);
  if (too_deep) throw Refusal("InvalidInput", fmt::format("the request is nested more than {} levels deep", deepest));
  if (!request.is_object()) throw Refusal("InvalidInput", "the request is no JSON object");
  if (path == "/Evaluate") return evaluated(run, request);
  if (path == "/Gradient") return applied(run, request, true);
  if (path == "/ApplyJacobian") return applied(run, request, false);
  const Function function = function_of(request);
  if (path == "/InputSizes") return {{"inputSizes", {run.input_size()}}};
  if (path == "/OutputSizes") return {{"outputSizes", run.output_sizes(function)}};
  if (path == "/ModelInfo") return described(run);
  throw Refusal("UnsupportedFeature",
                fmt::format("{} is not supported; there are Evaluate, Gradient and ApplyJacobian", path));
}

Answer error(int status, const std::string& type, const std::string& message) {
  return {status,
          Json{{"error", {{"type", type}, {"message", message}}}}.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

}  // namespace

Answer answer(const ServedRun& run, std::string_view path, const std::string& body) {
  try {
    return {200, response(run, path, body).dump(-1, ' ', false, Json::error_handler_t::replace)};
  } catch (const Refusal& problem) {
    return error(400, problem.type, problem.what());
  } catch (const InputError& problem) {
    return error(400, "InvalidInput", problem.what());
  } catch (const ModelFailure& problem) {
    return error(500, "ModelError", problem.what());
  } catch (const std::exception& problem) {
    return error(500, "InternalError", problem.what());
  }
}

const std::vector<std::string>& posted_paths() {
  static const std::vector<std::string> paths = {"/InputSizes", "/OutputSizes",   "/ModelInfo",   "/Evaluate",
                                                 "/Gradient",   "/ApplyJacobian", "/ApplyHessian"};
  return paths;
}

}  // namespace tunica::serving
