// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "calibration/assembly_parts.hpp"

namespace tunica::calibration {

Status Assembly::Parts::feasibility(std::span<const double> at, Workspace& workspace) const {
  for (const Link& link : model_parameters.links) workspace.model_parameters[link.position] = at[link.index];
  double violation = 0, worst = 0;
  const Constraint* broken = nullptr;
  std::size_t where = 0;
  for (const auto& constraint : constraints) {
    const std::span<double> values(workspace.constraints.data(), constraint->count());
    if (Status status = constraint->evaluate(workspace.model_parameters, values, {}); !status.ok()) return status;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i] <= Problem::constraint_tolerance) continue;
      violation += values[i];
      if (values[i] > worst) worst = values[i], broken = constraint.get(), where = i;
    }
  }
  return broken ? Status::infeasible(broken->words(where, worst), violation) : Status();
}

Status Assembly::feasibility(std::span<const double> free, Workspace& workspace) const {
  return parts_->constraints.empty() ? Status() : parts_->feasibility(free, workspace);
}

std::size_t Assembly::constraint_count() const { return parts_->constraint_count; }

Status Assembly::constraints(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const {
  const std::vector<double> parameters = model_parameters(free);
  const std::size_t n = parts_->free.size();
  std::fill(jacobian.begin(), jacobian.end(), 0.0);
  std::vector<double> by_parameter;
  std::size_t first = 0;
  for (const auto& constraint : parts_->constraints) {
    const std::size_t count = constraint->count();
    by_parameter.resize(jacobian.empty() ? 0 : parameters.size() * count);
    if (Status status = constraint->evaluate(parameters, values.subspan(first, count), by_parameter); !status.ok())
      return status;
    if (!jacobian.empty())
      for (const Link& link : parts_->model_parameters.links)
        for (std::size_t i = 0; i < count; ++i)
          jacobian[(first + i) * n + link.index] += by_parameter[link.position * count + i];
    first += count;
  }
  return {};
}

std::string Assembly::constraint_words(std::size_t i, double value) const {
  for (const auto& constraint : parts_->constraints) {
    if (i < constraint->count()) return constraint->words(i, value);
    i -= constraint->count();
  }
  return "";
}

}  // namespace tunica::calibration
