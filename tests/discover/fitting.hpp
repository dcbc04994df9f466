// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "discover/rubber.hpp"
#include "discovery/reach.hpp"
#include "discovery/set_fit.hpp"

namespace tunica::trial {

/// The index of a free parameter by the name that people read; throws std::logic_error where there is none.
std::size_t index_named(const assembly::Assembly& assembly, const std::string& name);

/// What is fitted beside Rubber as it is: 300 kPa with noise of 3 kPa, which the file states.
struct ToFit {
  Measured::Hide hide = {};                                   ///< what the data show and the model does not have
  std::function<void(nlohmann::json& experiment)> with = {};  ///< changes of the experiment
  bool from_nothing = false;
  double sd = 1e-9;  ///< of the noise that there is
  std::uint64_t seed = 11;
  std::size_t rows = 25;  ///< of each test, those at the largest stretches
};

struct MeasuredRubber : Rubber {
  explicit MeasuredRubber(const ToFit& what);
};

/// Rubber, its evidence, and a fitter for terms of its energy.
class FittedRubber {
 public:
  explicit FittedRubber(const ToFit& what = {});
  FittedRubber(const FittedRubber&) = delete;
  FittedRubber& operator=(const FittedRubber&) = delete;

  /// The kind of this name, with an amplitude that the data can hold; `change` has the last word.
  [[nodiscard]] discovery::KindPointer kind(const std::string& name,
                                            const std::function<void(discovery::Kind&)>& change = {}) const;
  [[nodiscard]] discovery::States states() const { return discovery::reached_states(subject, evidence.fit.free); }
  /// The set of these kinds at these free parameters, with residuals and Jacobian there.
  [[nodiscard]] discovery::SetFit at(const std::vector<discovery::KindPointer>& kinds,
                                     const std::vector<double>& free) const;
  /// √Σ(y/σ)²
  [[nodiscard]] double measured() const;

  const MeasuredRubber rubber;
  const diagnosis::Evidence evidence;
  const discovery::Subject subject;
  const discovery::Fitter fitter;
};

/// Where a free parameter stands.
std::size_t place_of(const discovery::SetFit& fit, const std::string& parameter);

/// Hides a term of these parameters.
Measured::Hide hidden(const std::string& invariant, const std::string& law,
                      const std::vector<std::pair<std::string, double>>& parameters, const std::string& family = "");

}  // namespace tunica::trial
