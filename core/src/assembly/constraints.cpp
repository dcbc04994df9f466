// SPDX-License-Identifier: Apache-2.0
#include "assembly/constraints.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/workspace.hpp"
#include "tunica/optimizer.hpp"

namespace tunica::assembly {

Constraints::Constraints(const Models& models, std::vector<ModelConstraint> constraints)
    : models_(models), constraints_(std::move(constraints)) {
  for (const ModelConstraint& constraint : constraints_) count_ += constraint.constraint->count();
}

Status Constraints::evaluate(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const {
  const std::size_t n = free.size();
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  std::vector<double> by_parameter;
  std::size_t first = 0;
  for (const auto& [model, constraint] : constraints_) {
    const std::vector<double> parameters = models_.parameters(model, free);
    const std::size_t count = constraint->count();
    by_parameter.resize(jacobian.empty() ? 0 : parameters.size() * count);
    if (Status status = constraint->evaluate(parameters, values.subspan(first, count), by_parameter); !status.ok())
      return status;
    if (!jacobian.empty())
      for (const Link& link : models_.vector(model).links)
        for (std::size_t i = 0; i < count; ++i)
          jacobian[(first + i) * n + link.index] += by_parameter[link.position * count + i];
    first += count;
  }
  return {};
}

Status Constraints::feasibility(std::span<const double> free, Workspace& workspace) const {
  if (constraints_.empty()) return {};
  for (std::size_t m = 0; m < models_.count(); ++m)
    for (const Link& link : models_.vector(m).links) workspace.model_parameters[m][link.position] = free[link.index];
  double violation = 0, worst = 0;
  const ModelConstraint* broken = nullptr;
  std::size_t where = 0;
  for (const ModelConstraint& of_model : constraints_) {
    const Constraint& constraint = *of_model.constraint;
    const std::span<double> values(workspace.constraints.data(), constraint.count());
    if (Status status = constraint.evaluate(workspace.model_parameters[of_model.model], values, {}); !status.ok())
      return status;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] <= Problem::constraint_tolerance) continue;
      violation += values[i];
      if (!(values[i] > worst)) continue;
      worst = values[i];
      broken = &of_model;
      where = i;
    }
  }
  return broken ? Status::infeasible(words(*broken, where, worst), violation) : Status();
}

std::string Constraints::words(std::size_t i, double value) const {
  for (const ModelConstraint& constraint : constraints_) {
    if (i < constraint.constraint->count()) return words(constraint, i, value);
    i -= constraint.constraint->count();
  }
  return "";
}

std::string Constraints::words(const ModelConstraint& constraint, std::size_t i, double value) const {
  const std::string of_model = models_.count() > 1 ? fmt::format("model '{}': ", models_.name(constraint.model)) : "";
  return of_model + constraint.constraint->words(i, value);
}

}  // namespace tunica::assembly
