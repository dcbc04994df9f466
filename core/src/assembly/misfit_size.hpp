// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "assembly/layout.hpp"
#include "assembly/noise.hpp"
#include "experiment/experiment.hpp"

namespace tunica::assembly {

/// The size of a misfit that noise does not explain, as a root mean square over rows.
struct Size {
  double rms = 0, upper = 0;  ///< share of the range of the measured values; estimate and upper 95 % bound
};

struct ChannelSize {
  std::string test, channel, unit;
  double range = 0;           ///< of the observable, in the unit
  double rms = 0, upper = 0;  ///< in the unit
  std::size_t rows = 0;
  double counted = 0;  ///< rows that it counts as beside other channels: those of a field as one a step

  [[nodiscard]] Size of_range() const { return {rms / range, upper / range}; }
};

/// By Layout::channels, the measured range of the observable in all tests of the same type. A nearly constant channel
/// is thus compared with the range of its observable in other tests. If nothing varies, the largest |value|.
std::vector<double> observable_ranges(const Layout& layout, const experiment::Experiment& experiment);

/// The fitted rows of a channel; of a field the steps that have points.
double counted_rows(const MeasuredChannel& view);

/// Misfit beyond noise, of residuals r in units of σ: with x = |r|² and ν degrees of freedom,
///
///   m² = (x − ν)₊,  its upper bound the noncentrality λ of a χ²_ν(λ) that stays below x with 5 %.
///
/// In units it is √(m²/x) of the root mean square of the errors e; of several channels the mean over rows, those of a
/// field as one a step: points shall not hide what a force misses by. Where neighbouring rows share noise, residuals
/// are r = (e_k/σ_k − φ e_{k−1}/σ_{k−1})/√(1 − φ²). Runs and diagnoses measure by it.
class MisfitSize {
 public:
  struct Channel {
    std::string test, name, unit;
    double range;
    NoiseModel noise;  ///< of its rows, which stand behind those of the channel before, in the unit
    double counted;    ///< rows that it counts as, see counted_rows()
  };
  explicit MisfitSize(std::vector<Channel> channels);

  /// `free`: parameters that were fitted; each fits one of all rows away. m² of all rows
  [[nodiscard]] double squares(const Eigen::VectorXd& residuals, std::size_t free) const {
    return squares(residuals.squaredNorm(), free);
  }
  /// The same if only |r|² is known.
  [[nodiscard]] double squares(double chi2, std::size_t free) const;
  [[nodiscard]] Size of(const Eigen::VectorXd& residuals, std::size_t free) const;
  [[nodiscard]] std::vector<ChannelSize> channels(const Eigen::VectorXd& residuals, std::size_t free) const;
  /// range/σ of each row
  [[nodiscard]] Eigen::VectorXd ranges_over_sigma() const;

 private:
  struct Rows {
    Eigen::Index first, count;
  };
  /// Of the rows of a channel, in units of their range.
  [[nodiscard]] double error_squares(std::size_t channel, const Eigen::VectorXd& residuals) const;

  std::vector<Channel> channels_;
  std::vector<Rows> places_;
  Eigen::Index rows_ = 0;
};

/// The tolerance stated for a channel ("2 %" or a quantity, by observable; "" = all), as a share of its range; none
/// without a statement.
std::optional<double> stated_tolerance(const std::vector<std::pair<std::string, std::string>>& stated,
                                       const ChannelSize& channel);

/// The shares of channels combined: mean squares over rows.
double over_rows(const std::vector<ChannelSize>& channels, const std::vector<double>& shares);

/// "most in pulled, stress: 0.12 kPa (7.1 % of the range, at most 7.5 %)"; empty without channels.
std::string where_most(const std::vector<ChannelSize>& channels);

}  // namespace tunica::assembly
