// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "conformance/partners.hpp"
#include "conformance/test_properties.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/test.hpp"

namespace tunica::conformance {

/// What a test was made from, owned: rows made up from what the type declares, or those of an experiment.
struct OwnedSetup {
  Options options;
  std::string stress_measure = "cauchy";
  std::vector<std::pair<std::string, std::vector<double>>> abscissae;
  std::vector<double> time;
  std::vector<std::string> channels;
  std::vector<std::pair<std::string, std::string>> choices = {};  ///< the options that are one of several words

  [[nodiscard]] std::size_t count() const {
    if (!abscissae.empty()) return abscissae.front().second.size();
    return time.empty() ? 1 : time.size();
  }
  /// A view; valid while this object lives and is not changed.
  [[nodiscard]] TestSetup setup() const;
  /// "stretch from 1.01 to 1.2, channels stress; direction = axial": what was made up, in words.
  [[nodiscard]] std::string words() const;
};

/// A test on the test_case, at parameters of its own at which it is simulated.
struct TestCase {
  std::string name;  ///< of the test in the experiment; empty = made up
  std::shared_ptr<Test> test;
  std::optional<OwnedSetup> from;
  std::vector<double> own;  ///< its parameters: nulls of imperfections, initial values of the others
  Material material;
  std::vector<std::shared_ptr<const Model>> layers = {};  ///< of a wall with several; their parameters in `material`
};

/// The test's own parameters where imperfections are absent.
std::vector<double> own_values(const TestDescription& description);

/// No rows, options and choices were found with which a test is made and predicts; says what the type answered last.
class NothingSuits : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A test of the type with rows made up from its observables, such that the test is made and predicts. Seeded search
/// among what a person might map and give: which observables, options at their defaults and near 1. Throws
/// NothingSuits where none of that does.
TestCase synthetic_case(const plugins::Catalogue::Entry<TestFactory>& entry, std::uint64_t seed);

/// The other choices of a test's options, as far as they go together.
struct ChoiceCases {
  std::vector<TestCase> cases;
  std::vector<std::string> missed;  ///< "direction = radial (why)": choices that no case has
};
/// Every combination of choices but that of `base`; if there are many, or the test is costly, each word once.
ChoiceCases choice_cases(const plugins::Catalogue::Entry<TestFactory>& entry, const TestCase& base, std::uint64_t seed);

/// The tests of these types as they stand in an experiment, each with the model of the first run that has it.
std::vector<TestCase> experiment_cases(const experiment::Experiment& experiment, const std::vector<std::string>& types,
                                       const plugins::Catalogue& catalogue);
/// The models of an experiment, at the initial values of their parameters.
std::vector<Material> models_of(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue);

}  // namespace tunica::conformance
