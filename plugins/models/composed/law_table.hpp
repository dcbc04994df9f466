// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "tunica/energy_part.hpp"
#include "tunica/parameter.hpp"

namespace tunica::composed {

/// ψ and its derivatives at own parameters, as EnergyPart::respond().
using Respond = std::function<void(std::span<const double>, const ResponseBatch&)>;

/// A law that a term may follow, as the experiment file names it.
struct Law {
  std::string name;
  std::vector<Parameter> parameters;  ///< names as the term's prefix precedes them
  Respond respond;
  bool rests = true;    ///< ψ'(0) = 0, as fibres need it
  bool even = false;    ///< ψ grows on both sides of 0, as a coupling of families needs it
  bool linear = false;  ///< ψ'' = 0
  std::string formula;  ///< with x for the invariant and $k for the parameter k
};

/// Names of the laws, in the order of the documentation.
const std::vector<std::string>& law_names();

/// The law of this name, which is one of law_names(). A spline runs over these knots; in an isotropic invariant its
/// slope at rest is a parameter, of fibres it is 0.
Law law(const std::string& name, const std::vector<double>& knots, bool isotropic);

}  // namespace tunica::composed
