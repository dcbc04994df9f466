// SPDX-License-Identifier: Apache-2.0
#include "posterior/target.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "numerics/distributions.hpp"

namespace tunica::posterior {
namespace {

constexpr double farthest = 7;  ///< |z| at a bound: 1e-12 of the range away from it

using Rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Φ(z).
double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// σ of channels without a statement as the fit weighs by it, without what the model misses.
void believe_estimates(const assembly::Assembly& assembly, assembly::Whitening& whitening) {
  std::size_t at = 0;
  for (const auto& view : assembly.layout().channels) {
    if (at == whitening.rows.size()) return;
    if (const std::size_t first = whitening.rows[at].prediction;
        first < view.offset || first >= view.offset + view.count)
      continue;
    for (const double sd : view.sigma.rows.sd) whitening.rows[at++].sd = sd;
  }
}

}  // namespace

std::optional<Question> question_at(const assembly::Assembly& assembly, std::span<const double> best,
                                    std::span<const double> measured, Status& status, bool discrepancy) {
  const auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> predictions(assembly.layout().prediction_count);
  status = assembly.evaluator().predict(best, predictions, {}, *workspace);
  if (!status.ok()) return {};
  Question question{assembly, assembly::whitening(assembly, predictions, measured, discrepancy), true};
  if (question.whitening.rows.empty()) {
    status = Status::failed("no row is fitted that counts");
    return {};
  }
  if (discrepancy) {
    believe_estimates(assembly, question.whitening);
    std::vector<double> residuals(question.whitening.count());
    assembly::whitened_residuals(question.whitening, best, predictions, {}, residuals, {});
    const Eigen::Map<const Eigen::VectorXd> r(residuals.data(),
                                              static_cast<Eigen::Index>(question.whitening.rows.size()));
    question.discrepancy.emplace(assembly, question.whitening, predictions, r);
    question.factor_known = question.discrepancy->factor_known();
    return question;
  }
  const bool left = question.whitening.rows.size() > best.size();  // as Whitening::quantile()
  question.factor_known = (question.whitening.stated && question.whitening.widening == 1) || !left;
  return question;
}

Target::Target(const Question& question, Metric metric)
    : question_(question),
      metric_(std::move(metric)),
      n_(question.assembly.layout().parameters.size()),
      workspace_(question.assembly.evaluator().make_workspace()),
      unit_(n_),
      free_(n_),
      predictions_(question.assembly.layout().prediction_count),
      by_free_(predictions_.size() * n_),
      residuals_(question.whitening.count()),
      jacobian_(residuals_.size() * n_) {}

std::vector<double> Target::free(const Eigen::VectorXd& z) const {
  std::vector<double> x(n_), values(n_);
  for (std::size_t j = 0; j < n_; ++j) x[j] = below(z[static_cast<Eigen::Index>(j)]);
  question_.assembly.box().from_unit(x, values);
  return values;
}

Eigen::VectorXd Target::coordinates(std::span<const double> free) const {
  std::vector<double> x(n_);
  question_.assembly.box().to_unit(free, x);
  Eigen::VectorXd z(static_cast<Eigen::Index>(n_));
  for (std::size_t j = 0; j < n_; ++j)
    z[static_cast<Eigen::Index>(j)] = numerics::normal_quantile(std::clamp(x[j], below(-farthest), below(farthest)));
  return z;
}

Target::Metric Target::metric_at(const Point& point) const {
  if (question_.discrepancy) return question_.discrepancy->metric(point.residuals);
  if (question_.factor_known) return {};
  return {std::sqrt(question_.rows() / point.residuals.squaredNorm()), {}};
}

bool Target::evaluate(const Eigen::VectorXd& z, Point& point) {
  const auto& assembly = question_.assembly;
  const auto n = static_cast<Eigen::Index>(n_), fitted = static_cast<Eigen::Index>(question_.whitening.rows.size()),
             all = static_cast<Eigen::Index>(residuals_.size());
  if (!z.allFinite()) return false;
  for (std::size_t j = 0; j < n_; ++j) unit_[j] = below(z[static_cast<Eigen::Index>(j)]);
  assembly.box().from_unit(unit_, free_);
  ++evaluations;
  if (!assembly.evaluator().predict(free_, predictions_, by_free_, *workspace_).ok()) {
    ++failures;
    return false;
  }
  assembly::whitened_residuals(question_.whitening, free_, predictions_, by_free_, residuals_, jacobian_);
  assembly.box().jacobian_to_unit(free_, jacobian_);
  const Eigen::Map<const Eigen::VectorXd> r(residuals_.data(), all);
  // dx/dz = φ(z)
  const Eigen::VectorXd x_by_z = (-0.5 * z.array().square()).exp() / std::sqrt(2 * std::numbers::pi);
  point.z = z;
  point.residuals = r.head(fitted);
  point.rows.resize(all + n);
  point.rows << r, z;
  point.slopes.resize(all + n, n);
  point.slopes.topRows(all) = Rows(jacobian_.data(), all, n) * x_by_z.asDiagonal();
  point.slopes.bottomRows(n).setIdentity();
  // ln L, and −∂ ln L/∂r
  Eigen::VectorXd pull;
  if (question_.discrepancy) {
    point.log_density = question_.discrepancy->log_likelihood(point.residuals, pull);
  } else {
    const double squares = point.residuals.squaredNorm(), rows = question_.rows();
    point.log_density = question_.factor_known ? -0.5 * squares : -0.5 * rows * std::log(squares);
    pull = (question_.factor_known ? 1 : rows / squares) * point.residuals;
  }
  point.log_density -= 0.5 * (r.tail(all - fitted).squaredNorm() + z.squaredNorm());
  point.gradient.noalias() = -point.slopes.topRows(fitted).transpose() * pull;
  point.gradient.noalias() -= point.slopes.bottomRows(all - fitted + n).transpose() * point.rows.tail(all - fitted + n);
  if (question_.discrepancy) {
    question_.discrepancy->transform(metric_, point.slopes.topRows(fitted));
    question_.discrepancy->transform(metric_, point.rows.head(fitted));
  } else {
    point.slopes.topRows(fitted) *= metric_.scale;
    point.rows.head(fitted) *= metric_.scale;
  }
  // A prior is a density in p: on a logarithmic scale dp/dx = p ln(max/min) comes with it.
  for (const auto& prior : question_.whitening.priors) {
    const auto& parameter = assembly.layout().parameters[prior.index];
    if (parameter.scale != Scale::log) continue;
    const auto j = static_cast<Eigen::Index>(prior.index);
    point.log_density += std::log(free_[prior.index]);
    point.gradient[j] += std::log(parameter.max / parameter.min) * x_by_z[j];
  }
  if (assembly.constraints().count() > 0 && !assembly.constraints().feasibility(free_, *workspace_).ok())
    point.log_density = -std::numeric_limits<double>::infinity();
  return point.rows.allFinite() && point.slopes.allFinite() && !std::isnan(point.log_density);
}

}  // namespace tunica::posterior
