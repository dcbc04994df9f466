// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/hypotheses/hypotheses.hpp"

namespace tunica::diagnosis {

/// A model that was fitted to the data, as one of several that explain them.
struct FittedRival {
  const assembly::Assembly& assembly;
  std::vector<Variable> variables;
  const Fit& fit;
};

/// A test that tells rivals apart.
struct Separation {
  std::string design;
  double sigmas = 0;  ///< the smallest distance between two of the rivals there, in σ
  std::size_t repeats = 1;
};

/// Over the library of designs, the one whose smallest distance between the rivals is largest (T-optimality); none
/// where so many repeats of none tell them apart.
std::optional<Separation> separating_design(const Inquiry& inquiry, const Evidence& evidence,
                                            const std::vector<FittedRival>& rivals);

}  // namespace tunica::diagnosis
