// SPDX-License-Identifier: Apache-2.0
#include "cohort/mode.hpp"

#include <Eigen/Dense>
#include <ceres/tiny_solver.h>

namespace tunica::cohort {

namespace {

constexpr double out_of_reach = 1e100;  ///< residuals where a specimen cannot be evaluated

/// Residuals r_c/s_c of all channels, then u.
class Residuals {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = Eigen::Dynamic };

  Residuals(SpecimenLikelihood& specimen, const Eigen::VectorXd& mean, const Eigen::MatrixXd& factor,
            const std::vector<double>& noise)
      : specimen_(specimen), mean_(mean), factor_(factor), weights_(weights_of(specimen, noise)) {}

  bool operator()(const double* u, double* residuals, double* jacobian) const {
    const Eigen::Index n = factor_.cols(), rows = weights_.size();
    const Eigen::Map<const Eigen::VectorXd> step(u, n);
    Eigen::Map<Eigen::VectorXd> r(residuals, rows + n);
    status_ = specimen_.residuals(mean_ + factor_ * step, raw_, jacobian ? &raw_jacobian_ : nullptr);
    if (!status_.ok()) {
      r.setConstant(out_of_reach);
      return false;
    }
    r.head(rows) = weights_.cwiseProduct(raw_);
    r.tail(n) = step;
    if (!jacobian) return true;
    Eigen::Map<Eigen::MatrixXd> J(jacobian, rows + n, n);
    J.topRows(rows) = weights_.asDiagonal() * (raw_jacobian_ * factor_);
    J.bottomRows(n).setIdentity();
    return true;
  }
  [[nodiscard]] int NumResiduals() const { return static_cast<int>(weights_.size() + factor_.cols()); }
  [[nodiscard]] int NumParameters() const { return static_cast<int>(factor_.cols()); }
  [[nodiscard]] const Status& status() const { return status_; }

 private:
  static Eigen::VectorXd weights_of(const SpecimenLikelihood& specimen, const std::vector<double>& noise) {
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(specimen.rows()));
    for (std::size_t c = 0; c + 1 < specimen.first().size(); ++c)
      for (std::size_t k = specimen.first()[c]; k < specimen.first()[c + 1]; ++k)
        weights[static_cast<Eigen::Index>(k)] = 1 / noise.at(c);
    return weights;
  }

  SpecimenLikelihood& specimen_;
  const Eigen::VectorXd& mean_;
  const Eigen::MatrixXd& factor_;
  const Eigen::VectorXd weights_;
  mutable Eigen::VectorXd raw_;
  mutable Eigen::MatrixXd raw_jacobian_;
  mutable Status status_;
};

ChannelSquares squares_of(const Eigen::VectorXd& r, const Eigen::MatrixXd& J, std::size_t from, std::size_t to) {
  const auto first = static_cast<Eigen::Index>(from), count = static_cast<Eigen::Index>(to - from);
  const auto rows = r.segment(first, count);
  const auto columns = J.middleRows(first, count);
  return {columns.transpose() * columns, columns.transpose() * rows, rows.squaredNorm(), to - from};
}

}  // namespace

Mode most_likely(SpecimenLikelihood& specimen, const Eigen::VectorXd& mean, const Eigen::MatrixXd& factor,
                 const std::vector<double>& noise, const Eigen::VectorXd& start) {
  Mode mode;
  const Residuals residuals(specimen, mean, factor, noise);
  Eigen::VectorXd u = factor.completeOrthogonalDecomposition().solve(start - mean);
  ceres::TinySolver<Residuals> solver;
  solver.options.gradient_tolerance = 1e-8;
  solver.options.function_tolerance = 1e-9;
  solver.options.max_num_iterations = 100;
  if (u.size() > 0) solver.Solve(residuals, &u);
  mode.at = mean + factor * u;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  mode.status = specimen.residuals(mode.at, r, &J);
  if (!mode.status.ok()) return mode;
  const auto& first = specimen.first();
  for (std::size_t c = 0; c + 1 < first.size(); ++c) mode.channels.push_back(squares_of(r, J, first[c], first[c + 1]));
  mode.channels.push_back(squares_of(r, J, first.back(), specimen.rows()));
  return mode;
}

}  // namespace tunica::cohort
