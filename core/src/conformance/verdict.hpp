// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

/// What a plugin promises, as properties that are checked from outside: `tunica plugin check`, and the tests of the
/// built-in plugins.
namespace tunica::conformance {

/// What a check of one property found.
struct Verdict {
  std::string compared;              ///< what was held against what
  double worst = 0;                  ///< largest error seen; relative unless `compared` says otherwise
  double tolerance = 0;              ///< 0 with a worst of 0 = a matter of yes and no
  std::string counter_example = {};  ///< in words; empty = the property held
  std::string skipped = {};          ///< why it was not checked; empty = it was
  std::string note = {};             ///< "3 states were drawn again"

  [[nodiscard]] bool held() const { return counter_example.empty() && skipped.empty(); }
};

inline Verdict not_checked(std::string compared, std::string why) {
  return {.compared = std::move(compared), .skipped = std::move(why)};
}
inline Verdict broken(std::string compared, std::string how) {
  return {.compared = std::move(compared), .counter_example = std::move(how)};
}

/// Keeps the largest error, and what happened there if it is above the tolerance. A number that is none is the largest
/// error of all.
class Meter {
 public:
  Meter(std::string compared, double tolerance) : verdict_{.compared = std::move(compared), .tolerance = tolerance} {}

  /// `words()` makes the counter-example.
  template <class Words>
  void see(double error, const Words& words) {
    if (std::isnan(error)) error = std::numeric_limits<double>::infinity();
    if (!(error > verdict_.worst)) return;
    verdict_.worst = error;
    if (error > verdict_.tolerance) verdict_.counter_example = words();
  }
  /// Coarser, where the means of comparison are.
  void allow(double tolerance) { verdict_.tolerance = tolerance; }
  void note(std::string text) { verdict_.note = std::move(text); }
  [[nodiscard]] double tolerance() const { return verdict_.tolerance; }
  [[nodiscard]] const Verdict& verdict() const { return verdict_; }

 private:
  Verdict verdict_;
};

/// A property of a Subject, under the name by which it is reported. One that is advisory tells what kind of thing the
/// subject is, and is no promise.
template <class Subject>
struct PropertyOf {
  const char* name;
  Verdict (*function)(const Subject&, std::uint64_t seed);
  bool advisory = false;

  [[nodiscard]] Verdict check(const Subject& subject, std::uint64_t seed = 0) const { return function(subject, seed); }
};

}  // namespace tunica::conformance
