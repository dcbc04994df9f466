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

/// The prediction of a design with the material of a fit; false if it cannot be simulated. Errors of the rig in the fit
/// belong to their own tests, and are left out.
bool predict(const Design& design, const assembly::Assembly& rival, std::span<const double> free,
             std::vector<double>& values);

}  // namespace tunica::diagnosis
