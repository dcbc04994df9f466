// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/least_squares.hpp"
#include "diagnosis/settings.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

class Projection;

/// Where a mechanism acts.
struct Target {
  std::vector<std::string> tests;       ///< empty: the model; several: one amplitude in all of them
  std::string channel = {};             ///< of a mechanism that takes one
  std::optional<std::size_t> row = {};  ///< of a mechanism that takes rows; none = the whole curve
  std::string model = {};               ///< where a run has several, and no tests are named

  bool operator==(const Target&) const = default;
  /// "in the material", "in the material of 'media'", "in the test 'strip'", "alike in the tests 'a', 'b'", "in the
  /// channel 'stress' of the test 'strip', row 12"
  [[nodiscard]] std::string words() const;
};

/// A mechanism at work: what is added to the experiment.
struct Addition {
  std::string id;
  Target target;
  MechanismFactory::Setting setting;  ///< nuisance parameters and number options where the search begins
};

/// The experiment with additions, bound to its data. Parameters are those of the base model and tests first found by
/// name, with those of the mechanisms; `null` is the bare experiment.
class Extended {
 public:
  /// Throws InputError where a mechanism cannot act there.
  Extended(const experiment::Experiment& experiment, const experiment::RunEntry& run, std::vector<Addition> additions,
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
  /// The base's, then of every part amplitude and nuisance.
  [[nodiscard]] std::vector<Variable> variables() const;

 private:
  experiment::Experiment experiment_;
  std::vector<Addition> additions_;
  std::unique_ptr<assembly::Assembly> assembly_;
  std::vector<std::size_t> base_;
  std::vector<Part> parts_;
};

/// One amplitude that may differ from its null, and what the data would show of it.
struct Hypothesis {
  const MechanismFactory* mechanism = nullptr;
  Addition addition;
  Eigen::VectorXd signature;  ///< ∂ whitened prediction/∂ amplitude at the null (even: by its square)
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1;  ///< −1: a positive score means an amplitude below the null
  /// The signature of amplitudes half as large as plausible ones, per unit of amplitude, where it is another than at
  /// the null.
  bool at_large = false;
};

/// A mechanism that takes part, or why it does not.
struct Candidate {
  std::string id;
  const MechanismFactory* mechanism = nullptr;
  std::vector<Hypothesis> hypotheses;  ///< over targets and settings; empty: it leaves no trace in these data
  std::string absent;                  ///< why, in words
};

/// Every mechanism that was asked for with all its targets and settings, and its signatures at the base fit, where a
/// refit absorbs what `projection` says. Mechanisms side by side; the outcome does not depend on threads.
std::vector<Candidate> candidates(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                  const Settings& settings, const assembly::Assembly& base,
                                  std::span<const double> fitted, const Projection& projection,
                                  const plugins::Catalogue& catalogue);

}  // namespace tunica::diagnosis
