// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::diagnosis {

/// Costly tests that have a cheaper method of the same simulation: a search over thousands of sets takes that, and what
/// it finds is fitted with the tests themselves.
class StandIns {
 public:
  /// Of the tests of a run. Throws InputError where a plugin's stand-in cannot be made.
  StandIns(const experiment::Experiment& experiment, const experiment::RunEntry& run,
           const plugins::Catalogue& catalogue);
  StandIns() = default;

  [[nodiscard]] bool empty() const { return tests_.empty(); }
  [[nodiscard]] std::vector<std::string> names() const;  ///< of the tests
  /// Whether no test of the run is costly with them.
  [[nodiscard]] bool suffice(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                             const plugins::Catalogue& catalogue) const;
  /// With the cheaper methods, and with the own ones again. Everything else stays, the stated noise too.
  [[nodiscard]] experiment::Experiment cheaper(experiment::Experiment experiment) const;
  [[nodiscard]] experiment::Experiment restored(experiment::Experiment experiment) const;

 private:
  struct Test {
    std::string name;
    Options own, cheaper;
  };
  std::vector<Test> tests_;
};

}  // namespace tunica::diagnosis
