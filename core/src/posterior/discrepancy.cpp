// SPDX-License-Identifier: Apache-2.0
#include "posterior/discrepancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "assembly/curve_shapes.hpp"
#include "assembly/misfit.hpp"
#include "assembly/unlisted_prior.hpp"
#include "numerics/eigenpairs.hpp"
#include "numerics/orthogonal.hpp"

namespace tunica::posterior {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;
namespace unlisted = assembly::unlisted;

constexpr unsigned most_degree = 14;  ///< as the largest of the budget's
constexpr double same_shape = 1e-8;   ///< shapes of unit length that are nearer to others are none of their own
constexpr double factor_reach = 5;    ///< standard deviations of ln s that its grid goes to
constexpr int factor_count = 21;

/// Rows of one channel that lie on one curve.
struct SmoothLine {
  std::vector<Eigen::Index> predictions;
  std::vector<double> abscissa;
  double range;
};

std::vector<SmoothLine> curves_of(const assembly::Layout& layout, std::span<const double> predictions) {
  std::vector<SmoothLine> found;
  for (const auto& view : layout.channels) {
    if (view.is_field() || view.count == 0) continue;
    const auto values = predictions.subspan(view.offset, view.count);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double range = *high > *low ? *high - *low : std::abs(*high);
    const auto& over = view.drawn_over;
    std::map<std::string, SmoothLine> own;
    for (std::size_t row = 0; row < view.count; ++row) {
      SmoothLine& curve = own[over.curves.empty() ? "" : over.curves[row]];
      curve.range = range;
      curve.predictions.push_back(static_cast<Eigen::Index>(view.offset + row));
      curve.abscissa.push_back(over.values.empty() ? view.abscissa[row] : over.values[row]);
    }
    for (auto& [name, curve] : own) found.push_back(std::move(curve));
  }
  return found;
}

/// Shapes at all predictions, as high as the ranges, and their degrees.
assembly::CurveShapes shapes_of(const std::vector<SmoothLine>& curves, Eigen::Index rows) {
  std::vector<assembly::CurveShapes> own;
  Eigen::Index count = 0;
  for (const SmoothLine& curve : curves)
    count += own.emplace_back(assembly::curve_shapes(curve.abscissa, most_degree)).columns.cols();
  assembly::CurveShapes all{Matrix::Zero(rows, count), {}};
  Eigen::Index at = 0;
  for (std::size_t k = 0; k < curves.size(); ++k)
    for (Eigen::Index shape = 0; shape < own[k].columns.cols(); ++shape, ++at) {
      all.degree.push_back(own[k].degree[static_cast<std::size_t>(shape)]);
      for (std::size_t i = 0; i < curves[k].predictions.size(); ++i)
        all.columns(curves[k].predictions[i], at) =
            curves[k].range * own[k].columns(static_cast<Eigen::Index>(i), shape);
    }
  return all;
}

/// Errors in the rows of the predictions as whitened residuals.
Matrix whitened(const assembly::Whitening& whitening, const Matrix& errors) {
  Matrix rows(static_cast<Eigen::Index>(whitening.rows.size()), errors.cols());
  for (std::size_t k = 0; k < whitening.rows.size(); ++k) {
    const auto& row = whitening.rows[k];
    const auto at = static_cast<Eigen::Index>(k);
    rows.row(at) = errors.row(static_cast<Eigen::Index>(row.prediction)) / row.sd;
    if (row.neighbour == 0) continue;
    const auto& before = whitening.rows[k - 1];
    rows.row(at) -= row.neighbour / before.sd * errors.row(static_cast<Eigen::Index>(before.prediction));
    rows.row(at) /= std::sqrt(1 - row.neighbour * row.neighbour);
  }
  return rows;
}

Matrix basis_of(Matrix columns) {
  Eigen::Index kept = 0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k)
    if (const double length = columns.col(k).norm(); length > 0) columns.col(kept++) = (columns.col(k) / length).eval();
  return kept == 0 ? Matrix(columns.rows(), 0) : numerics::orthonormal_basis(columns.leftCols(kept), same_shape);
}

}  // namespace

Discrepancy::Discrepancy(const assembly::Assembly& assembly, const assembly::Whitening& whitening,
                         std::span<const double> predictions, const Vector& residuals) {
  const assembly::Layout& layout = assembly.layout();
  const auto count = static_cast<Eigen::Index>(layout.prediction_count);
  const assembly::CurveShapes shapes = shapes_of(curves_of(layout, predictions), count);
  const Matrix fitted = whitened(whitening, shapes.columns);
  basis_ = basis_of(fitted);
  choose_factors(whitening, residuals, layout.parameters.size());
  const Matrix R = basis_.transpose() * fitted;
  const Eigen::Index q = basis_.cols();
  const double rows = static_cast<double>(fitted.rows());
  double weights = 0;
  for (const double size : unlisted::sizes) weights += std::exp(unlisted::log_weight(size));
  const double highest = shapes.degree.empty() ? 0 : *std::ranges::max_element(shapes.degree);
  for (std::size_t roughness = 0; roughness < unlisted::falls.size(); ++roughness) {
    const unlisted::Variances of_kind(roughness, static_cast<unsigned>(highest));
    Vector D(shapes.columns.cols());
    for (Eigen::Index k = 0; k < D.size(); ++k) D[k] = of_kind.of(shapes.degree[static_cast<std::size_t>(k)]);
    Roughness kind;
    const auto pairs = numerics::eigenpairs(R * D.asDiagonal() * R.transpose());
    kind.directions = pairs.vectors;
    kind.to_misfit = shapes.columns * D.asDiagonal() * R.transpose() * pairs.vectors;
    kind.prior_square = shapes.columns.cwiseAbs2() * D;
    std::vector<double> log_weights;
    const auto add = [&](double size, double log_weight) {
      for (const double factor : factors_) {
        kind.size.push_back(size);
        kind.factor.push_back(factor);
        log_weights.push_back(log_weight);
      }
    };
    // No misfit is as likely as any, and has no roughness.
    if (roughness == 0) add(0, 0);
    for (const double size : unlisted::sizes)
      add(size, unlisted::log_weight(size) - std::log(weights * unlisted::falls.size()));
    const auto entries = static_cast<Eigen::Index>(kind.size.size());
    kind.precision.resize(entries, q);
    kind.constant.resize(entries);
    kind.of_rest.resize(entries);
    for (Eigen::Index c = 0; c < entries; ++c) {
      const double size = kind.size[static_cast<std::size_t>(c)], factor = kind.factor[static_cast<std::size_t>(c)];
      const Vector v = (factor * factor + size * size * pairs.values.array().max(0)).matrix();
      kind.precision.row(c) = v.cwiseInverse();
      kind.of_rest[c] = 1 / (factor * factor);
      kind.constant[c] = log_weights[static_cast<std::size_t>(c)] - (rows - static_cast<double>(q)) * std::log(factor) -
                         0.5 * v.array().log().sum();
    }
    kinds_.push_back(std::move(kind));
  }
}

void Discrepancy::choose_factors(const assembly::Whitening& whitening, const Vector& residuals,
                                 std::size_t parameters) {
  const auto rows = static_cast<std::size_t>(residuals.size());
  const std::size_t taken = parameters + static_cast<std::size_t>(basis_.cols());
  if (taken >= rows) {
    factor_assumed_ = !whitening.stated;
    return;
  }
  const double rest = residuals.squaredNorm() - (basis_.transpose() * residuals).squaredNorm();
  if (whitening.stated && !assembly::misfit_of(rest, rows, rows, taken).contradicts()) return;
  // ln s is known to 1/√(2ν) about what the shapes leave.
  const auto freedom = static_cast<double>(rows - taken);
  const double centre = 0.5 * std::log(std::max(rest / freedom, 1e-18)), reach = factor_reach / std::sqrt(2 * freedom);
  factors_.clear();
  for (int k = 0; k < factor_count; ++k)
    factors_.push_back(std::exp(centre + reach * (2.0 * k / (factor_count - 1) - 1)));
}

double Discrepancy::weigh(const Vector& r, std::vector<Vector>& shares, std::vector<Vector>& g) const {
  const Vector a = basis_.transpose() * r;
  const double rest = std::max(0.0, r.squaredNorm() - a.squaredNorm());
  shares.clear();
  g.clear();
  double largest = -std::numeric_limits<double>::infinity();
  for (const Roughness& kind : kinds_) {
    g.emplace_back(kind.directions.transpose() * a);
    shares.emplace_back(kind.constant - 0.5 * (rest * kind.of_rest + kind.precision * g.back().cwiseAbs2()));
    largest = std::max(largest, shares.back().maxCoeff());
  }
  double sum = 0;
  for (Vector& of_kind : shares) {
    of_kind = (of_kind.array() - largest).exp().matrix();
    sum += of_kind.sum();
  }
  for (Vector& of_kind : shares) of_kind /= sum;
  return largest + std::log(sum);
}

double Discrepancy::log_likelihood(const Vector& r, Vector& pull) const {
  std::vector<Vector> shares, g;
  const double found = weigh(r, shares, g);
  // Σ⁻¹ r = (r − Q a)/s² + Q U (g/v)
  double of_rest = 0;
  Vector along = Vector::Zero(basis_.cols());
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    of_rest += shares[k].dot(kinds_[k].of_rest);
    along += kinds_[k].directions * (kinds_[k].precision.transpose() * shares[k]).cwiseProduct(g[k]);
  }
  pull = of_rest * r + basis_ * (along - of_rest * (basis_.transpose() * r));
  return found;
}

Discrepancy::Metric Discrepancy::metric(const Vector& r) const {
  std::vector<Vector> shares, g;
  static_cast<void>(weigh(r, shares, g));
  double of_rest = 0;
  Matrix inside = Matrix::Zero(basis_.cols(), basis_.cols());  // Qᵀ P Q
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    const Matrix& U = kinds_[k].directions;
    of_rest += shares[k].dot(kinds_[k].of_rest);
    inside += U * (kinds_[k].precision.transpose() * shares[k]).asDiagonal() * U.transpose();
  }
  const auto pairs = numerics::eigenpairs(inside / of_rest);
  Matrix inner = pairs.vectors * pairs.values.cwiseMax(0).cwiseSqrt().asDiagonal() * pairs.vectors.transpose();
  inner.diagonal().array() -= 1;
  return {std::sqrt(of_rest), std::move(inner)};
}

void Discrepancy::transform(const Metric& metric, Eigen::Ref<Matrix> columns) const {
  if (metric.inner.size() > 0) columns += basis_ * (metric.inner * (basis_.transpose() * columns));
  columns *= metric.scale;
}

Discrepancy::Misfit Discrepancy::draw(const Vector& r, CounterRandom& random) const {
  std::vector<Vector> shares, g;
  static_cast<void>(weigh(r, shares, g));
  double left = random.uniform();
  std::size_t kind = 0, entry = 0;
  for (std::size_t k = 0; k < kinds_.size(); ++k)
    for (Eigen::Index c = 0; c < shares[k].size() && left > 0; ++c) {
      left -= shares[k][c];
      kind = k;
      entry = static_cast<std::size_t>(c);
    }
  const Roughness& own = kinds_[kind];
  Misfit found;
  found.size = own.size[entry];
  found.factor = own.factor[entry];
  const double square = found.size * found.size;
  const auto precision = own.precision.row(static_cast<Eigen::Index>(entry)).transpose();
  // r is the whitened −(δ + s σ e), so that E δ = −τ² (F D Rᵀ U) (g/v), var δ = τ² F D Fᵀ − τ⁴ (F D Rᵀ U) v⁻¹ (…)ᵀ
  const Vector mean = -square * (own.to_misfit * precision.cwiseProduct(g[kind]));
  const Vector variance = square * own.prior_square - square * square * (own.to_misfit.cwiseAbs2() * precision);
  found.mean.assign(mean.begin(), mean.end());
  for (const double one : variance) found.sd.push_back(std::sqrt(std::max(one, 0.0)));
  return found;
}

}  // namespace tunica::posterior
