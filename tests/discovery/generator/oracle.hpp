// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sealed_case.hpp"
#include "signatures.hpp"

namespace blind {

/// What the data allow to whoever knows the noise and the base parameters: the scores of the method – a smooth omnibus
/// and the largest projected score of the catalogue, calibrated jointly – at the truth, on the very data of the case.
struct OracleVerdict {
  double p_value = 1;
  bool detected = false;                   ///< at 5 %
  std::string first;                       ///< the likeliest effect
  std::map<std::string, double> likeness;  ///< of other effects to it on these data: largest correlations above 0.9
  /// Where two effects are hidden: the likeliest two, and the likeness of others to each.
  std::vector<std::string> pair = {};
  std::vector<std::map<std::string, double>> pair_likeness = {};
};
OracleVerdict ask_oracle(const SealedCase& made);

/// Of projected residuals r: the two effects with the largest marginal likelihood together, as columns of `shapes` (the
/// unit vectors of `all`); of their places the two that explain most.
std::pair<std::size_t, std::size_t> likeliest_pair(const std::vector<Signature>& all, const Eigen::MatrixXd& shapes,
                                                   const Eigen::VectorXd& r);

/// Of every other effect the largest correlation with one direction, where above 0.9.
std::map<std::string, double> likeness_to(const std::vector<Signature>& all, const Eigen::MatrixXd& shapes,
                                          std::size_t direction);

}  // namespace blind
