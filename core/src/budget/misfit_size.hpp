// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "diagnosis/evidence/evidence.hpp"

namespace tunica::budget {

/// How large a misfit is that noise does not explain, as a root mean square over rows.
struct Size {
  double rms = 0, upper = 0;  ///< share of the range of the measured values; estimate and upper 95 % bound
};

struct ChannelSize {
  std::string test, channel, unit;
  double range = 0;           ///< of the measured values, in the unit
  double rms = 0, upper = 0;  ///< in the unit
  std::size_t rows = 0;
};

/// Misfit beyond noise, of whitened residuals r of the rows of `evidence`: with x = |r|² and ν degrees of freedom,
///
///   m² = (x − ν)₊,  its upper bound the noncentrality λ of a χ²_ν(λ) that stays below x with 5 %.
///
/// In units, m is scaled by the σ that the rows have on average, weighed as the residuals weigh them.
class MisfitSize {
 public:
  explicit MisfitSize(const diagnosis::Evidence& evidence);

  [[nodiscard]] double squares(const diagnosis::Fit& fit) const;  ///< m² of all rows
  [[nodiscard]] Size of(const diagnosis::Fit& fit) const;
  [[nodiscard]] std::vector<ChannelSize> channels(const diagnosis::Fit& fit) const;
  /// range/σ of each row
  [[nodiscard]] Eigen::VectorXd ranges_over_sigma() const;

 private:
  struct Channel {
    std::string test, name, unit;
    double range;
    Eigen::Index first, count;
    Eigen::VectorXd sigma;  ///< of the rows, in the unit
  };
  std::vector<Channel> channels_;
  Eigen::Index rows_ = 0;
};

}  // namespace tunica::budget
