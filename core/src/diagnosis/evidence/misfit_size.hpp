// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "assembly/misfit_size.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tunica::diagnosis {

using assembly::ChannelSize;
using assembly::Size;

/// How much the fits of a diagnosis miss, in the rows of its evidence.
class MisfitSize {
 public:
  explicit MisfitSize(const Evidence& evidence);

  [[nodiscard]] double squares(const Fit& fit) const { return size_.squares(fit.residuals, free(fit)); }
  /// Of a fit with as many free parameters, of which only |r|² is known.
  [[nodiscard]] double squares(double chi2, const Fit& like) const { return size_.squares(chi2, free(like)); }
  [[nodiscard]] Size of(const Fit& fit) const { return size_.of(fit.residuals, free(fit)); }
  [[nodiscard]] std::vector<ChannelSize> channels(const Fit& fit) const {
    return size_.channels(fit.residuals, free(fit));
  }
  /// range/σ of each row
  [[nodiscard]] Eigen::VectorXd ranges_over_sigma() const { return size_.ranges_over_sigma(); }

 private:
  static std::size_t free(const Fit& fit);

  assembly::MisfitSize size_;
};

}  // namespace tunica::diagnosis
