// SPDX-License-Identifier: Apache-2.0
#include "plugins/guarded_model.hpp"

#include <bit>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/guarded.hpp"

namespace tunica::plugins {

namespace {

/// A NaN that no arithmetic makes: where it is found after a call, nobody has written.
constexpr double unwritten = std::bit_cast<double>(std::uint64_t{0x7ff8'dead'0000'0000});

bool is_unwritten(double value) {
  return std::bit_cast<std::uint64_t>(value) == std::bit_cast<std::uint64_t>(unwritten);
}

struct Named {
  const char* name;
  std::span<double> values;
};

/// Marks the first and the last point of every component, of which there are size/n. A model that leaves a component
/// out leaves all of its points: to mark those too would cost as much as the model. `tunica plugin check` does.
template <std::size_t N>
void mark(const Named (&outputs)[N], std::size_t n) {
  if (n == 0) return;
  for (const Named& output : outputs)
    for (std::size_t first = 0; first < output.values.size(); first += n)
      output.values[first] = output.values[first + n - 1] = unwritten;
}

template <std::size_t N>
Status verdict(Status status, const Named (&outputs)[N], const std::string& plugin, std::size_t n) {
  if (!status.ok() || n == 0) return status;
  for (const Named& output : outputs)
    for (std::size_t first = 0; first < output.values.size(); first += n)
      if (is_unwritten(output.values[first]) || is_unwritten(output.values[first + n - 1]))
        return Status::failed(
            fmt::format("plugin '{}' returned ok without writing the {}; expected every number of it. "
                        "`tunica plugin check` shows what else is amiss",
                        plugin, output.name));
  return status;
}

/// Makes the call; exceptions become a status.
template <class Body>
Status contained(const std::string& plugin, const Body& body) {
  try {
    return body();
  } catch (const HostFault&) {
    throw;
  } catch (const std::exception& problem) {
    return Status::failed(fmt::format("plugin '{}' threw: {}", plugin, problem.what()));
  } catch (...) {
    return Status::failed(fmt::format("plugin '{}' threw something that is no std::exception", plugin));
  }
}

template <class Points, class Response>
struct Input {
  const Points& points;
  const Response& response;
};
using TensorInput = Input<MaterialPoints, MaterialResponse>;
using AxisInput = Input<AxisPoints, AxisResponse>;

/// By the parameters and by what is wanted, not by the points: those may lie in scratch memory of the thread, which is
/// gone when a plugin has called exit(). So a point that ends the process fails the whole evaluation at once.
std::uint64_t tensor_key(const Call& call) {
  const auto& [points, response] = *static_cast<const TensorInput*>(call.input);
  CallKey key(call.plugin, call.what);
  key.add(points.parameters);
  for (const auto& wanted : {response.energy, response.stress, response.tangent, response.stress_dp, response.state})
    key.add(wanted.empty());
  return key.value();
}

std::uint64_t axis_key(const Call& call) {
  const auto& [points, response] = *static_cast<const AxisInput*>(call.input);
  CallKey key(call.plugin, call.what);
  key.add(points.parameters);
  for (const auto& wanted :
       {response.energy, response.gradient, response.hessian, response.gradient_dp, response.energy_dp})
    key.add(wanted.empty());
  return key.value();
}

/// By the parameters and by what is wanted, as above.
std::uint64_t strip_key(const Call& call) {
  const auto& strip = *static_cast<const StripPath*>(call.input);
  CallKey key(call.plugin, call.what);
  key.add(strip.parameters);
  for (const auto& wanted : {strip.stress, strip.lateral, strip.stress_dp, strip.stress_by_l}) key.add(wanted.empty());
  return key.value();
}

}  // namespace

GuardedModel::GuardedModel(std::unique_ptr<Model> model, std::string plugin)
    : model_(std::move(model)), plugin_(std::move(plugin)), stricken_(is_stricken(plugin_)) {
  description_ = guarded(plugin_, "describe", [this] { return &model_->describe(); });
}

Status GuardedModel::evaluate(const MaterialPoints& points, const MaterialResponse& response) const {
  const TensorInput input{points, response};
  const Call call{plugin_.c_str(), "evaluate", tensor_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, tensor_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  const Named outputs[] = {{"energy", response.energy},
                           {"stress", response.stress},
                           {"tangent", response.tangent},
                           {"derivatives by parameters", response.stress_dp},
                           {"state", response.state}};
  mark(outputs, points.count);
  const CallScope scope(call);
  return verdict(contained(plugin_, [&] { return model_->evaluate(points, response); }), outputs, plugin_,
                 points.count);
}

Status GuardedModel::evaluate_axes(const AxisPoints& points, const AxisResponse& response) const {
  const AxisInput input{points, response};
  const Call call{plugin_.c_str(), "evaluate_axes", axis_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, axis_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  const Named outputs[] = {{"energy", response.energy},
                           {"gradient", response.gradient},
                           {"Hessian", response.hessian},
                           {"derivatives by parameters", response.gradient_dp},
                           {"derivatives of the energy", response.energy_dp}};
  mark(outputs, points.count);
  const CallScope scope(call);
  return verdict(contained(plugin_, [&] { return model_->evaluate_axes(points, response); }), outputs, plugin_,
                 points.count);
}

bool GuardedModel::solve_strip(const StripPath& strip, Status& status) const {
  const Call call{plugin_.c_str(), "solve_strip", strip_key, &strip};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, strip_key(call)); !reason.empty()) {
      status = Status::failed(std::move(reason));
      return true;
    }
  const Named outputs[] = {{"stress of the strip", strip.stress},
                           {"lateral stretch", strip.lateral},
                           {"derivatives by parameters", strip.stress_dp},
                           {"lateral derivatives by parameters", strip.lateral_dp},
                           {"derivatives by the stretch", strip.stress_by_l},
                           {"lateral derivatives by the stretch", strip.lateral_by_l}};
  mark(outputs, strip.stretch.size());
  bool offered = false;
  const CallScope scope(call);
  status = contained(plugin_, [&] {
    Status outcome;
    offered = model_->solve_strip(strip, outcome);
    return outcome;
  });
  offered |= !status.ok();
  if (offered) status = verdict(std::move(status), outputs, plugin_, strip.stretch.size());
  return offered;
}

const Model& GuardedModel::elastic() const {
  const Model& inner = model_->elastic();
  return &inner == model_.get() ? *this : inner;
}

bool GuardedModel::remembers(std::span<const double> parameters) const {
  return guarded(plugin_, "remembers", [&] { return model_->remembers(parameters); });
}

}  // namespace tunica::plugins
