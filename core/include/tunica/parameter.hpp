// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tunica {

/// How the host maps the bounds of a parameter to [0, 1]: by the value or by its logarithm.
enum class Scale { linear, log };

/// One parameter as its owner (model, test or mechanism) declares it. Everything the outside sees of it – schema,
/// `describe`, validation, bounds, units in reports – comes from this declaration. Values are in the base unit.
struct Parameter {
  std::string name;       ///< symbol of the literature, for example "mu"; no dots
  std::string unit;       ///< base unit in UDUNITS spelling: "kPa", "mm", "mN", "s", "deg", "1"
  double initial;         ///< default start, min <= initial <= max
  double min,             ///< default lower bound, finite
      max;                ///< default upper bound, finite
  Scale scale;            ///< log needs min > 0
  std::string doc;        ///< one sentence
  std::string reference;  ///< where the parameter is defined or the range comes from; may be empty
};

/// A function of the parameters that data may fix although they leave its arguments free, for example "2A + B".
/// The host finds such valleys numerically and uses these names to say in words what the data do fix.
struct Combination {
  std::string name;                                      ///< as printed, for example "2A + B"
  std::string unit;                                      ///< base unit of the value
  std::vector<std::size_t> arguments;                    ///< indices of the parameters it depends on
  std::function<double(std::span<const double>)> value;  ///< of the owner's full parameter vector
  std::string remedy;                                    ///< what fixes the rest, for example "an off-axis strip"
};

}  // namespace tunica
