// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "diagnosis/diagnosis.hpp"

namespace tunica::diagnosis {

/// What a refit leaves, as a test among all that was not added: smooth shapes and the other mechanisms. Of `outliers`
/// that sit in a row, the other rows are tested still.
struct Rest {
  Rest(const Diagnosis& diagnosis, const Refitted& refitted, const Shapes& shapes, const Eigen::MatrixXf& draws);

  std::vector<Candidate> others;
  std::vector<Direction> directions;
  std::unique_ptr<Detection> detection;
};

/// P-value of what a refit leaves.
double p_of_rest(const Diagnosis& diagnosis, const Refitted& refitted, const Shapes& shapes,
                 const Eigen::MatrixXf& draws);

}  // namespace tunica::diagnosis
