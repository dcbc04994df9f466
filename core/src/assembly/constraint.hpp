// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assembly/models.hpp"
#include "experiment/experiment.hpp"
#include "tunica/model.hpp"
#include "tunica/status.hpp"

namespace tunica::assembly {

/// Conditions c(p) ≤ 0 on a model's parameters. Const and thread-safe; refers to the model.
class Constraint {
 public:
  virtual ~Constraint() = default;
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Values and, unless empty, derivatives by the model's parameters, parameter j of value i at [j·count + i].
  virtual Status evaluate(std::span<const double> parameters, std::span<double> values,
                          std::span<double> derivatives) const = 0;
  /// The violated condition in words, for a positive value i.
  [[nodiscard]] virtual std::string words(std::size_t i, double value) const = 0;
};

/// A constraint on one of the run's models.
struct ModelConstraint {
  std::size_t model;
  std::unique_ptr<Constraint> constraint;
};

/// transverse_stability   one value a stretch of every strip, `range` and `points` (docs/experiment-file.md);
/// admissible_parameters  one value an inequality that a model declares.
///
/// Each constraint applies to every model: at the strips made of it, over a range, to the inequalities that it
/// declares. Throws InputError, with the place in the file, for a constraint without any condition: no strip and no
/// range, or no declared inequality.
std::vector<ModelConstraint> make_constraints(const std::vector<experiment::ConstraintEntry>& entries,
                                              const std::vector<const Model*>& models,
                                              const std::vector<Strip>& strips);

/// The largest stretch at which the constraints of a run require stability beyond its strips; 1 = none.
double stated_range(const std::vector<experiment::ConstraintEntry>& entries);

}  // namespace tunica::assembly
