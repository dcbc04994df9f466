// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/model.hpp"
#include "tunica/options.hpp"
#include "tunica/test.hpp"

namespace tunica {

/// Where a mechanism acts; also the canonical order of composition, whatever the file says.
enum class Stage { invariants, energy, stress, history, test, data };

/// A mechanism: something the base simulation leaves out, with a null at which it vanishes exactly. It is no fourth
/// interface: a descriptor, and a function that wraps a Model or a Test in a decorator with the mechanism's
/// parameters behind the wrapped object's own. At the null the decorator delegates to the bare object, bit for bit,
/// and its limit there agrees with it to 1e-12; derivatives at the null are those of the formula.
struct MechanismFactory {
  /// Where amplitudes lie about the null, and with it which test against the null is the right one.
  enum class Side { positive, both, even };  ///< amplitude ≥ null; either; first derivative zero at the null

  std::string id;                        ///< "fibre_dispersion"
  std::string cause;                     ///< one sentence: what physically happens
  Stage stage;                           ///< where it acts, and which of the two wrappers is set
  std::vector<std::string> applies_to;   ///< test types; empty = every one (test and data stages)
  std::vector<Parameter> parameters;     ///< the amplitude first; nuisance parameters after it
  double null;                           ///< of the amplitude
  Side side;                             ///< of the amplitude
  double plausible_min,                  ///< least amplitude that physics allows
      plausible_max;                     ///< largest
  std::vector<std::string> look_alikes;  ///< ids of mechanisms hard to tell from it; named in its explanation
  std::string isolated_by;               ///< the kind of test that separates it
  std::string reference;                 ///< source of formula and range
  std::vector<Option> options;           ///< of its object in the experiment file

  /// Instead of wrap_test: the test's own parameter of this name, a native imperfection that is held at its null
  /// unless this mechanism is there. Options that the test declares as well override those of the test.
  std::string native = {};
  /// Diagnosis tries one amplitude in all tests that it applies to, besides one a test.
  bool shared = false;
  /// Where diagnosis looks for the effect: values of nuisance parameters and of number options, by name. Empty: every
  /// nuisance at its initial value, those in s from the shortest step to the duration of the data.
  using Setting = std::vector<std::pair<std::string, double>>;
  std::vector<Setting> scan = {};  ///< one search a setting

  /// Stages invariants … history. Throws InputError where it cannot apply, for example for want of fibre parts.
  std::function<std::unique_ptr<Model>(std::unique_ptr<Model>, const Options&)> wrap_model = {};
  /// Stages test and data.
  std::function<std::unique_ptr<Test>(std::unique_ptr<Test>, const Options&)> wrap_test = {};
};

}  // namespace tunica
