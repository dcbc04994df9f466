// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/sandwich.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/cholesky.hpp"
#include "numerics/eigenpairs.hpp"
#include "numerics/singular.hpp"

namespace tunica::uncertainty {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// 2 w ρ' of every residual.
Vector weights(const assembly::Assembly& assembly, std::span<const double> residuals) {
  Vector found(static_cast<Eigen::Index>(residuals.size()));
  for (const ResidualBlock& block : assembly.layout().blocks) {
    double s = 0;
    for (const double r : residuals.subspan(block.offset, block.size)) s += r * r;
    constexpr double epsilon = Problem::root_smoothing;
    const bool root = block.loss == ResidualBlock::Loss::root;
    found.segment(static_cast<Eigen::Index>(block.offset), static_cast<Eigen::Index>(block.size))
        .setConstant(2 * block.weight * (root ? 0.5 / std::sqrt(s + epsilon * epsilon) : 1));
  }
  return found;
}

/// Lᵀ t for every column of t: whitened errors z = L⁻¹ e are own e_k − previous e_{k−1} within a channel, so that
/// L⁻ᵀ u = t is solved from the last row backwards.
Matrix by_unit_noise(const assembly::Whitening& noise, const Matrix& by_prediction) {
  Matrix u(static_cast<Eigen::Index>(noise.rows.size()), by_prediction.cols());
  const auto innovation = [](const assembly::Whitening::Row& row) {
    return std::sqrt(1 - row.neighbour * row.neighbour);
  };
  for (std::size_t k = noise.rows.size(); k-- > 0;) {
    const assembly::Whitening::Row& row = noise.rows[k];
    const auto at = static_cast<Eigen::Index>(k);
    u.row(at) = by_prediction.row(static_cast<Eigen::Index>(row.prediction));
    if (k + 1 < noise.rows.size() && noise.rows[k + 1].neighbour != 0)
      u.row(at) += noise.rows[k + 1].neighbour / (row.sd * innovation(noise.rows[k + 1])) * u.row(at + 1);
    u.row(at) *= row.sd * innovation(row);
  }
  return u;
}

/// What the minimum of an objective moves by, in some coordinates: H and M of the header.
struct Bread {
  Matrix weighted;       ///< 2 w ρ' times the Jacobian of the residuals
  Matrix by_prediction;  ///< ∂g/∂ŷ, transposed
  Matrix curvature;      ///< H
  Matrix score;          ///< M, covariance of the gradient
};

/// All but the score at `free`, in the coordinates that the columns of `basis` span in the unit box. `measured` stands
/// in for the data unless empty.
Status linearise(const assembly::Assembly& assembly, std::span<const double> free, std::span<const double> measured,
                 const Matrix& basis, Bread& found) {
  const auto n = static_cast<Eigen::Index>(free.size()), k = basis.cols(),
             m = static_cast<Eigen::Index>(assembly.layout().residual_count);
  std::vector<double> residuals(assembly.layout().residual_count), entries(residuals.size() * free.size());
  const auto workspace = assembly.evaluator().make_workspace();
  assembly.evaluator().measure(measured, *workspace);
  double objective = 0;
  if (Status status = assembly.evaluator().evaluate(free, objective, {}, residuals, entries, *workspace);
      status.kind() == Status::Kind::failed)
    return status;
  assembly.box().jacobian_to_unit(free, entries);
  const Matrix rows = Eigen::Map<const Rows>(entries.data(), m, n) * basis;
  found.weighted = weights(assembly, residuals).asDiagonal() * rows;
  found.curvature = rows.transpose() * found.weighted;
  found.by_prediction.resize(static_cast<Eigen::Index>(assembly.layout().prediction_count), k);
  for (Eigen::Index j = 0; j < k; ++j) {
    const Vector column = found.weighted.col(j);
    assembly.evaluator().transpose_residuals({column.data(), residuals.size()},
                                             {&found.by_prediction(0, j), assembly.layout().prediction_count});
  }
  return {};
}

void add_score(const assembly::Whitening& noise, Bread& found) {
  const Matrix u = by_unit_noise(noise, found.by_prediction);
  found.score = u.transpose() * u;
  const auto priors = static_cast<Eigen::Index>(noise.priors.size());
  found.score += found.weighted.bottomRows(priors).transpose() * found.weighted.bottomRows(priors);
}

}  // namespace

Status apply_sandwich(const assembly::Assembly& assembly, std::span<const double> free,
                      const assembly::Whitening& noise, Spectrum& spectrum) {
  std::vector<Eigen::Index> seen, unseen;
  for (Eigen::Index k = 0; k < spectrum.values.size(); ++k)
    (spectrum.seen[static_cast<std::size_t>(k)] == Visibility::not_at_all ? unseen : seen).push_back(k);
  const auto k = static_cast<Eigen::Index>(seen.size());
  if (k == 0) return {};

  // In directions scaled by their singular values the likelihood's JᵀJ is the identity, and H no worse than the
  // weights.
  const Vector width = spectrum.values(seen).cwiseInverse();
  const Matrix scaled = spectrum.V(Eigen::all, seen) * width.asDiagonal();
  Bread bread;
  if (Status status = linearise(assembly, free, {}, scaled, bread); !status.ok()) return status;
  add_score(noise, bread);
  const std::optional<Matrix> half = numerics::half_sandwich(bread.curvature, bread.score);
  if (!half) return Status::failed("the objective's curvature is singular in directions that the data see");
  const Matrix spread = width.asDiagonal() * *half;
  const numerics::SingularVectors singular = numerics::left_singular_vectors(spread);
  const Matrix V = spectrum.V(Eigen::all, seen) * singular.vectors;
  for (Eigen::Index a = 0; a < k; ++a) {  // singular values fall, so widths in reverse
    const Eigen::Index from = k - 1 - a, to = seen[static_cast<std::size_t>(a)];
    const double sd = singular.values[from];
    spectrum.V.col(to) = V.col(from);
    spectrum.values[to] = 1 / sd;
    spectrum.variance[to] = sd * sd;
    spectrum.seen[static_cast<std::size_t>(to)] = sd > 1 ? Visibility::weakly : Visibility::well;
  }
  return {};
}

Status minimum_shift(const assembly::Assembly& assembly, std::span<const double> free,
                     std::span<const std::size_t> moving, std::span<const double> change, std::span<double> shift) {
  std::fill(shift.begin(), shift.end(), 0.0);
  Matrix basis = Matrix::Zero(static_cast<Eigen::Index>(free.size()), static_cast<Eigen::Index>(moving.size()));
  for (std::size_t k = 0; k < moving.size(); ++k)
    basis(static_cast<Eigen::Index>(moving[k]), static_cast<Eigen::Index>(k)) = 1;
  Bread bread;
  if (Status status = linearise(assembly, free, {}, basis, bread); !status.ok()) return status;
  const Eigen::Map<const Vector> moved(change.data(), static_cast<Eigen::Index>(change.size()));
  const Vector gradient = bread.by_prediction.transpose() * moved;
  // Scaled to a diagonal of one, so that no unit decides which direction is seen.
  const Vector width = bread.curvature.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const auto [values, vectors] = numerics::eigenpairs(width.asDiagonal() * bread.curvature * width.asDiagonal());
  const Vector along = vectors.transpose() * width.cwiseProduct(gradient);
  Vector step = Vector::Zero(along.size());
  for (Eigen::Index k = 0; k < step.size(); ++k)
    if (values[k] > 1e-13 * values.maxCoeff()) step -= along[k] / values[k] * vectors.col(k);
  for (std::size_t k = 0; k < moving.size(); ++k)
    shift[moving[k]] = width[static_cast<Eigen::Index>(k)] * step[static_cast<Eigen::Index>(k)];
  return {};
}

Status objective_scales(const assembly::Assembly& assembly, std::span<const double> free,
                        const assembly::Whitening& noise, std::span<const double> measured,
                        std::vector<double>& scales) {
  constexpr double edge = 1e-6;
  const std::size_t n = free.size();
  scales.assign(n, 1);
  std::vector<double> unit(n);
  assembly.box().to_unit(free, unit);
  const auto size = static_cast<Eigen::Index>(n);
  Bread all;
  if (Status status = linearise(assembly, free, measured, Matrix::Identity(size, size), all); !status.ok())
    return status;
  add_score(noise, all);
  const double weakest = assembly.layout().jacobian_is_exact ? weakest_exact : weakest_differenced;
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<Eigen::Index> moving;  // a parameter at a bound moves in its own profile only
    Eigen::Index own = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == j) own = static_cast<Eigen::Index>(moving.size());
      if (i == j || (unit[i] > edge && unit[i] < 1 - edge)) moving.push_back(static_cast<Eigen::Index>(i));
    }
    const Matrix H = all.curvature(moving, moving), M = all.score(moving, moving);
    // Scaled to a diagonal of one, so that no unit decides which direction is seen.
    const Vector width = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const auto [values, vectors] = numerics::eigenpairs(width.asDiagonal() * H * width.asDiagonal());
    Vector d = Vector::Zero(H.rows());
    const double least = std::max(weakest * weakest, 1e-13) * values.maxCoeff();
    for (Eigen::Index k = 0; k < d.size(); ++k)
      if (values[k] > least) d += vectors(own, k) / values[k] * vectors.col(k);
    d = width.cwiseProduct(d);
    const double curvature = d.dot(H * d), score = d.dot(M * d);
    if (curvature > 0 && score > 0 && std::isfinite(score / curvature)) scales[j] = score / (2 * curvature);
  }
  return {};
}

}  // namespace tunica::uncertainty
