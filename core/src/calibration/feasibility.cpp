// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "calibration/assembly_parts.hpp"

namespace tunica::calibration {

Status Assembly::Parts::feasibility(std::span<const double> at, Workspace& workspace) const {
  for (std::size_t m = 0; m < models.size(); ++m)
    for (const Link& link : models[m].parameters.links) workspace.model_parameters[m][link.position] = at[link.index];
  double violation = 0, worst = 0;
  const ModelConstraint* broken = nullptr;
  std::size_t where = 0;
  for (const ModelConstraint& of_model : constraints) {
    const Constraint& constraint = *of_model.constraint;
    const std::span<double> values(workspace.constraints.data(), constraint.count());
    if (Status status = constraint.evaluate(workspace.model_parameters[of_model.model], values, {}); !status.ok())
      return status;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] <= Problem::constraint_tolerance) continue;
      violation += values[i];
      if (values[i] > worst) worst = values[i], broken = &of_model, where = i;
    }
  }
  return broken ? Status::infeasible(words(*broken, where, worst), violation) : Status();
}

Status Assembly::feasibility(std::span<const double> free, Workspace& workspace) const {
  return parts_->constraints.empty() ? Status() : parts_->feasibility(free, workspace);
}

std::size_t Assembly::constraint_count() const { return parts_->constraint_count; }

Status Assembly::constraints(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const {
  const std::size_t n = parts_->free.size();
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  std::vector<double> by_parameter;
  std::size_t first = 0;
  for (const auto& [model, constraint] : parts_->constraints) {
    const std::vector<double> parameters = model_parameters(model, free);
    const std::size_t count = constraint->count();
    by_parameter.resize(jacobian.empty() ? 0 : parameters.size() * count);
    if (Status status = constraint->evaluate(parameters, values.subspan(first, count), by_parameter); !status.ok())
      return status;
    if (!jacobian.empty())
      for (const Link& link : parts_->models[model].parameters.links)
        for (std::size_t i = 0; i < count; ++i)
          jacobian[(first + i) * n + link.index] += by_parameter[link.position * count + i];
    first += count;
  }
  return {};
}

std::string Assembly::constraint_words(std::size_t i, double value) const {
  for (const ModelConstraint& constraint : parts_->constraints) {
    if (i < constraint.constraint->count()) return parts_->words(constraint, i, value);
    i -= constraint.constraint->count();
  }
  return "";
}

std::string Assembly::Parts::words(const ModelConstraint& constraint, std::size_t i, double value) const {
  const std::string of_model = models.size() > 1 ? fmt::format("model '{}': ", models[constraint.model].name) : "";
  return of_model + constraint.constraint->words(i, value);
}

}  // namespace tunica::calibration
