// SPDX-License-Identifier: Apache-2.0
#include "plugins/guarded_model.hpp"

#include <cstdint>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/declared_bounds.hpp"
#include "plugins/destroyed.hpp"
#include "plugins/guarded.hpp"
#include "plugins/unwritten.hpp"
#include "plugins/usual_arithmetic.hpp"

namespace tunica::plugins {

namespace {

/// Marks the ends of every component, of which there are size/n.
void mark(std::span<const NamedOutput> outputs, std::size_t n) {
  if (n == 0) return;
  for (const NamedOutput& output : outputs) mark_ends(output.values, n);
}

Status verdict(Status status, std::span<const NamedOutput> outputs, const std::string& plugin, std::size_t n) {
  if (!status.ok() || n == 0) return status;
  for (const NamedOutput& output : outputs)
    if (has_marked_ends(output.values, n))
      return Status::failed(
          fmt::format("plugin '{}' returned ok without writing the {}; expected every number of it. "
                      "`tunica plugin check` shows what else is amiss",
                      plugin, output.name));
  return status;
}

/// Makes the call; exceptions become a status. Memory that lacked for a moment is asked for again: it says nothing of
/// the point.
template <class Body>
Status contained(const std::string& plugin, const Body& body, bool again = true) {
  try {
    return body();
  } catch (const HostFault&) {
    throw;
  } catch (const std::bad_alloc& problem) {
    if (again) return contained(plugin, body, false);
    return Status::failed(fmt::format("plugin '{}' threw: {}", plugin, problem.what()));
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
/// gone when a plugin has called exit(). A point that kills the process therefore fails the whole evaluation at once.
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

const Model*& last_failed_model() {
  thread_local const Model* model = nullptr;
  return model;
}

GuardedModel::GuardedModel(std::unique_ptr<Model> model, std::string plugin)
    : model_(std::move(model)), plugin_(std::move(plugin)), stricken_(is_stricken(plugin_)) {
  description_ = guarded(plugin_, "describe", [this] { return &model_->describe(); });
}

GuardedModel::~GuardedModel() { destroy(plugin_, model_); }

/// `outputs` are the spans of the response, in whatever memory; `body` evaluates into them. A call that is declined has
/// written nothing, and is no failure.
template <class Body>
Status GuardedModel::made(const Call& call, OverrunRecord::Function function, std::span<NamedOutput> outputs,
                          std::size_t points, const Body& body, const bool* declined) const {
  const auto attempt = [&] {
    mark(outputs, points);
    const CallScope scope(call);
    UsualArithmetic arithmetic;
    Status status = contained(plugin_, body);
    if (arithmetic.take_change())
      status = Status::failed(fmt::format("plugin '{}' {}", plugin_, changed_arithmetic));
    else if (declined == nullptr || !*declined)
      status = verdict(std::move(status), outputs, plugin_, points);
    if (!status.ok()) last_failed_model() = this;
    return status;
  };
  const std::size_t kind = OverrunRecord::kind(function, outputs, points);
  if (!overruns_.is_new(kind)) return attempt();
  if (const char* output = overruns_.overrun()) return Status::failed(overrun_reason(plugin_, output));
  FencedOutputs fenced(outputs);
  Status status = attempt();
  if (const char* output = fenced.release(outputs)) {
    overruns_.set_overrun(output);
    return Status::failed(overrun_reason(plugin_, output));
  }
  if (status.ok()) overruns_.set_good(kind);
  return status;
}

Status GuardedModel::evaluate(const MaterialPoints& points, const MaterialResponse& response) const {
  const TensorInput input{points, response};
  const Call call{plugin_.c_str(), "evaluate", tensor_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, tensor_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  NamedOutput outputs[] = {{"energy", response.energy},
                           {"stress", response.stress},
                           {"tangent", response.tangent},
                           {"derivatives by parameters", response.stress_dp},
                           {"state", response.state}};
  return made(call, OverrunRecord::Function::evaluate, outputs, points.count, [&] {
    return model_->evaluate(
        points, {outputs[0].values, outputs[1].values, outputs[2].values, outputs[3].values, outputs[4].values});
  });
}

Status GuardedModel::evaluate_axes(const AxisPoints& points, const AxisResponse& response) const {
  const AxisInput input{points, response};
  const Call call{plugin_.c_str(), "evaluate_axes", axis_key, &input};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, axis_key(call)); !reason.empty())
      return Status::failed(std::move(reason));
  NamedOutput outputs[] = {{"energy", response.energy},
                           {"gradient", response.gradient},
                           {"Hessian", response.hessian},
                           {"derivatives by parameters", response.gradient_dp},
                           {"derivatives of the energy", response.energy_dp}};
  return made(call, OverrunRecord::Function::evaluate_axes, outputs, points.count, [&] {
    return model_->evaluate_axes(
        points, {outputs[0].values, outputs[1].values, outputs[2].values, outputs[3].values, outputs[4].values});
  });
}

bool GuardedModel::solve_strip(const StripPath& strip, Status& status) const {
  const Call call{plugin_.c_str(), "solve_strip", strip_key, &strip};
  if (stricken_)
    if (std::string reason = refusal_of_evaluation(plugin_, strip_key(call)); !reason.empty()) {
      status = Status::failed(std::move(reason));
      return true;
    }
  NamedOutput outputs[] = {{"stress of the strip", strip.stress},
                           {"lateral stretch", strip.lateral},
                           {"derivatives by parameters", strip.stress_dp},
                           {"lateral derivatives by parameters", strip.lateral_dp},
                           {"derivatives by the stretch", strip.stress_by_l},
                           {"lateral derivatives by the stretch", strip.lateral_by_l}};
  bool declined = false;
  const auto solve = [&] {
    StripPath path = strip;
    path.stress = outputs[0].values;
    path.lateral = outputs[1].values;
    path.stress_dp = outputs[2].values;
    path.lateral_dp = outputs[3].values;
    path.stress_by_l = outputs[4].values;
    path.lateral_by_l = outputs[5].values;
    Status outcome;
    declined = !model_->solve_strip(path, outcome);
    return declined ? Status() : outcome;
  };
  status = made(call, OverrunRecord::Function::solve_strip, outputs, strip.stretch.size(), solve, &declined);
  return !declined || !status.ok();
}

const Model& GuardedModel::elastic() const {
  const UsualArithmetic arithmetic;
  const Model& inner = model_->elastic();
  return &inner == model_.get() ? *this : inner;
}

bool GuardedModel::keeps_volume(std::span<const double> parameters) const {
  if (!description_->compressible) return true;
  return guarded(plugin_, "keeps_volume", [&] { return model_->keeps_volume(parameters); });
}

const Model& GuardedModel::incompressible() const {
  const UsualArithmetic arithmetic;
  const Model& inner = model_->incompressible();
  return &inner == model_.get() ? *this : inner;
}

void GuardedModel::remember(const AxisStep& step) const {
  const UsualArithmetic arithmetic;
  model_->remember(step);
}

bool GuardedModel::add_branches(std::vector<Branch>& found) const {
  const auto* const maxwell = dynamic_cast<const MaxwellModel*>(model_.get());
  return maxwell != nullptr && guarded(plugin_, "add_branches", [&] { return maxwell->add_branches(found); });
}

bool GuardedModel::scale_path(const ScaledPath& path, const Factors& factors) const {
  const auto* const scaled = dynamic_cast<const EnergyScaledModel*>(model_.get());
  return scaled != nullptr && guarded(plugin_, "scale_path", [&] { return scaled->scale_path(path, factors); });
}

bool GuardedModel::remembers(std::span<const double> parameters) const {
  return guarded(plugin_, "remembers", [&] { return model_->remembers(parameters); });
}

}  // namespace tunica::plugins
