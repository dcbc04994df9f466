// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "assembly/constraint.hpp"
#include "assembly/models.hpp"
#include "tunica/status.hpp"

namespace tunica::assembly {

class Workspace;

/// All constraints c(p) ≤ 0 of a run, in order. Const and thread-safe; refers to the models.
class Constraints {
 public:
  Constraints(const Models& models, std::vector<ModelConstraint> constraints);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Values (count) and, unless empty, their Jacobian by the free parameters, row-major.
  Status evaluate(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const;
  /// Infeasible, with its violation, if a constraint exceeds Problem::constraint_tolerance; the reason names the most
  /// violated one. Allocates nothing if no constraint is violated.
  Status feasibility(std::span<const double> free, Workspace& workspace) const;
  /// The violated condition in words, for a positive constraint i.
  [[nodiscard]] std::string words(std::size_t i, double value) const;

 private:
  /// With the model's name if there are several models.
  [[nodiscard]] std::string words(const ModelConstraint& constraint, std::size_t i, double value) const;

  const Models& models_;
  std::vector<ModelConstraint> constraints_;
  std::size_t count_ = 0;
};

}  // namespace tunica::assembly
