// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tunica {

/// How the host maps the bounds of a parameter to the unit interval [0, 1] that optimizers search.
enum class Scale {
  linear,  ///< by the value; for angles, exponents, whatever may be zero or negative
  log      ///< by the logarithm; for moduli and times that are known within a factor
};

/// One parameter, as its owner declares it: a model, a test or a mechanism.
///
/// Schema, `tunica describe`, validation, bounds, the search and the units of reports all come from this declaration.
/// Experiment files may narrow or move the bounds and the initial value; a plugin therefore gets values between the
/// bounds of the file, not of this table. All values are in the base unit.
///
///     {"mu", "kPa", 10, 0.1, 200, Scale::log, "Shear modulus of the matrix.", "Holzapfel, Gasser, Ogden 2000"}
struct Parameter {
  /// The symbol of the literature, for example "mu". No dots: the host joins names with dots.
  std::string name;
  /// Base unit in UDUNITS spelling: "kPa", "mm", "mN", "s", "deg", "1" for none.
  std::string unit;
  /// Where a search starts by default; min ≤ initial ≤ max.
  double initial;
  double min,  ///< default lower bound, finite
      max;     ///< default upper bound, finite
  /// How the bounds are mapped. Scale::log needs min > 0.
  Scale scale;
  /// One sentence, with a capital letter and a full stop.
  std::string doc;
  /// Source of the definition or of the range; may be empty.
  std::string reference;
};

/// A function of the parameters that data may fix although they leave its arguments free, for example "2A + B".
///
/// The host finds such valleys numerically. If a declared combination explains one, reports name what the data do fix,
/// and print `remedy` for the rest. `value` must be smooth, and is called from any thread.
struct Combination {
  /// The formula as reports print it, for example "2A + B".
  std::string name;
  /// Base unit of the value.
  std::string unit;
  /// Indices of the parameters that the value depends on.
  std::vector<std::size_t> arguments;
  /// The value, from the owner's full parameter vector.
  std::function<double(std::span<const double>)> value;
  /// The experiment that fixes the rest, for example "an off-axis strip"; may be empty.
  std::string remedy;
};

}  // namespace tunica
