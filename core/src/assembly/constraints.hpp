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

/// All constraints c(p) ≤ 0 of a run, one behind the other. Const and thread-safe; refers to the models.
class Constraints {
 public:
  Constraints(const Models& models, std::vector<ModelConstraint> constraints);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Values (count) and, unless empty, their Jacobian by the free parameters, row-major.
  Status evaluate(std::span<const double> free, std::span<double> values, std::span<double> jacobian) const;
  /// Infeasible, with its violation, where a constraint exceeds Problem::constraint_tolerance; the reason names the
  /// one that is broken most. Allocates nothing as long as none is.
  Status feasibility(std::span<const double> free, Workspace& workspace) const;
  /// What is broken when constraint i is positive, in words.
  [[nodiscard]] std::string words(std::size_t i, double value) const;

 private:
  /// With the model's name where there are several.
  [[nodiscard]] std::string words(const ModelConstraint& constraint, std::size_t i, double value) const;

  const Models& models_;
  std::vector<ModelConstraint> constraints_;
  std::size_t count_ = 0;
};

}  // namespace tunica::assembly
