// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "conformance/verdict.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

namespace tunica::conformance {

/// A property of one thing that a plugin provides, and what was found.
struct Finding {
  std::string kind;      ///< "model", "test", "optimizer", "mechanism"
  std::string name;      ///< "gho"
  std::string with;      ///< "on uniaxial (stretch from 1.01 to 1.2, channels stress)"; may be empty
  std::string property;  ///< "stress_is_the_gradient_of_the_energy"
  bool advisory = false;
  Verdict verdict = {};
  double seconds = 0;

  [[nodiscard]] bool failed() const { return !advisory && !verdict.counter_example.empty(); }
};

struct CheckSettings {
  std::uint64_t seed = 20230211;
  std::vector<std::string> only = {};  ///< properties or names of things; empty = all
  /// Tests are checked as they stand here, instead of with made-up rows.
  const experiment::Experiment* experiment = nullptr;
  double time_limit = 120;  ///< s, of one check
};

/// Names by which a plugin's things stand in the catalogue: those that were there when nothing else was loaded.
struct Contents {
  std::vector<std::string> models, tests, optimizers, mechanisms;

  [[nodiscard]] bool empty() const {
    return models.empty() && tests.empty() && optimizers.empty() && mechanisms.empty();
  }
};
Contents contents_of(const plugins::Catalogue& catalogue);

/// Every property of everything in `contents`, each in a process of its own; `show` is called as they come. Throws
/// InputError for a name in `only` that nothing answers to.
std::vector<Finding> check_plugin(const Contents& contents, const plugins::Catalogue& catalogue,
                                  const CheckSettings& settings, const std::function<void(const Finding&)>& show);

}  // namespace tunica::conformance
