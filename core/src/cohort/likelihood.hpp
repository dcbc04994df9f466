// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "assembly/whitening.hpp"
#include "cohort/fitting.hpp"

namespace tunica::cohort {

/// A reading as a number that is linear in the predictions of a specimen: Σ w_k ŷ_k.
struct LinearReading {
  std::vector<std::pair<std::size_t, double>> weights;
  std::string unit;
  std::string problem;  ///< why this specimen does not have it; empty = it does
};

/// One specimen as a function of ξ, the coordinates in which parameters vary between specimens: log p where the scale
/// of the search is logarithmic, else p. Beyond its bounds a parameter has the effect that it has there. σ is that of
/// the specimen's own best fit (assembly/whitening.hpp). Not thread-safe.
class SpecimenLikelihood {
 public:
  /// Throws InputError, plugins::PluginFailure.
  SpecimenLikelihood(Bound bound, std::size_t run, const Record::Run& best, const plugins::Catalogue& catalogue);

  [[nodiscard]] const assembly::Layout& layout() const { return assembly_->layout(); }
  /// Names of the channels that residuals belong to, "strip: stress".
  [[nodiscard]] const std::vector<std::string>& channels() const { return channels_; }
  /// Rows [first[c], first[c + 1]) of the residuals are those of channel c; what follows is priors.
  [[nodiscard]] const std::vector<std::size_t>& first() const { return whitening_.first; }
  [[nodiscard]] std::size_t rows() const { return whitening_.count(); }
  /// σ of a channel, quadratic mean over its rows; whether the file states it; Σ ln σ² of all rows.
  [[nodiscard]] double noise(std::size_t channel) const;
  [[nodiscard]] bool noise_is_stated(std::size_t channel) const;
  [[nodiscard]] double log_noise() const;
  /// From now on the σ of a channel is this many times as large.
  void scale_noise(std::size_t channel, double factor);
  [[nodiscard]] const Eigen::VectorXd& best() const { return best_; }

  /// Whitened residuals and, unless null, their Jacobian by ξ.
  Status residuals(const Eigen::VectorXd& xi, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian);
  /// All predictions and, unless null, their Jacobian by ξ.
  Status predict(const Eigen::VectorXd& xi, Eigen::VectorXd& predictions, Eigen::MatrixXd* jacobian);

  [[nodiscard]] LinearReading reading(const ReadingEntry& entry) const;

 private:
  /// Free parameters at ξ within their bounds, and dp/dξ there.
  void move_to(const Eigen::VectorXd& xi);

  std::unique_ptr<const experiment::Experiment> experiment_;  // the assembly refers to it
  std::unique_ptr<const assembly::Assembly> assembly_;
  assembly::WorkspacePointer workspace_;
  assembly::Whitening whitening_;
  std::vector<std::string> channels_;
  std::vector<bool> stated_;
  Eigen::VectorXd best_;
  std::vector<double> free_, slope_, predictions_, jacobian_, residuals_, residual_jacobian_;
};

/// The coordinate of a parameter.
double to_coordinate(Scale scale, double value);
double from_coordinate(Scale scale, double xi);

}  // namespace tunica::cohort
