// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "diagnosis/naming/refits.hpp"
#include "tunica/test.hpp"

namespace tunica::diagnosis {

/// A test that a lab could make, on the material of the experiment.
struct Design {
  std::string description;
  std::unique_ptr<Test> test;
  std::vector<double> parameters;  ///< of the test: its nulls, or what the design sets
  std::vector<double> sd;          ///< of each predicted value
};

/// What the test plugins plan (TestFactory::plan). Noise is that of the data's channels of the same kind, else 1.5 % of
/// the largest value, which `scale` predicts at its parameters.
std::vector<Design> designs(const Inquiry& inquiry, const Evidence& evidence, const assembly::Assembly& scale,
                            std::span<const double> free);

/// What the material of a fit shows in a design; false where it cannot be simulated. The errors of the rig that the fit
/// may hold belong to the tests they were found in.
bool predict(const Design& design, const assembly::Assembly& rival, std::span<const double> free,
             std::vector<double>& values);

}  // namespace tunica::diagnosis
