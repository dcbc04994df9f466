// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "population/mixed_model.hpp"

namespace tunica::testing {

/// A specimen that is measured with so little noise that its coordinates are known.
inline population::Individual known(const Eigen::VectorXd& xi, const Eigen::VectorXd& design, std::size_t animal,
                                    double information = 1e10) {
  const Eigen::Index p = xi.size();
  return {{information * Eigen::MatrixXd::Identity(p, p), xi, 0}, design, animal};
}

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  Eigen::Index k = 0;
  for (const double value : values) result[k++] = value;
  return result;
}

}  // namespace tunica::testing
