// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace tunica::assembly {

struct SecantMemory;

/// Scratch of one thread.
class Workspace {
 public:
  std::vector<std::vector<double>> model_parameters;  ///< by model
  std::vector<std::vector<double>> materials, own;    ///< by test: parameters of its models, and of its own
  std::vector<double> predictions;                    ///< all
  std::vector<double> jacobian;                       ///< of one test by slots, large enough for each
  std::vector<double> ahead, behind, shifted;         ///< for differences
  std::vector<double> residuals;                      ///< of a search that corrects them
  std::vector<double> constraints;                    ///< values
  std::vector<std::vector<double>> measured;          ///< by fitted channel, in place of the data; empty = the data
  SecantMemory* secant = nullptr;                     ///< of the search that evaluates; none = differences each time
};

}  // namespace tunica::assembly
