// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/hypotheses/hypothesis.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// The experiment with additions, bound to its data. Parameters are those of the base model and tests first found by
/// name, with those of the mechanisms; `null` is the bare experiment.
class Extension {
 public:
  /// Throws InputError where a mechanism cannot act there. Of several of one kind, in the base or among the additions,
  /// each gets a name of its own.
  Extension(const experiment::Experiment& experiment, const experiment::RunEntry& run, std::vector<Addition> additions,
            const plugins::Catalogue& catalogue);

  struct Part {
    Variable amplitude;
    std::vector<Variable> nuisance;
    std::vector<double> nuisance_start;
    double null;
  };
  [[nodiscard]] const assembly::Assembly& assembly() const { return *assembly_; }
  [[nodiscard]] const experiment::Experiment& experiment() const { return experiment_; }
  [[nodiscard]] const std::vector<Addition>& additions() const { return additions_; }
  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }       ///< one an addition
  [[nodiscard]] const std::vector<std::size_t>& base() const { return base_; }  ///< where the base's parameters are
  /// All parameters, with the base's at `base` and every mechanism at its null.
  [[nodiscard]] std::vector<double> at_null(std::span<const double> base) const;
  /// The parameters of the base, then amplitude and nuisance parameters of every part. Without nuisance parameters,
  /// these stay fixed.
  [[nodiscard]] std::vector<Variable> variables(bool with_nuisance = true) const;

 private:
  experiment::Experiment experiment_;
  std::vector<Addition> additions_;
  std::unique_ptr<assembly::Assembly> assembly_;
  std::vector<std::size_t> base_;
  std::vector<Part> parts_;
};

/// Name of the share under which the tests of an addition have one parameter.
std::string share_of(const Addition& addition, const Parameter& parameter);

/// The experiment of an extension in which tests with one amplitude share their parameters, as they were fitted.
experiment::Experiment with_shares(const Extension& extension, const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
