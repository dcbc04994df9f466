// SPDX-License-Identifier: Apache-2.0
#include "calibration/identifiability.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "calibration/noise.hpp"
#include "calibration/valley_words.hpp"

namespace tunica::calibration {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

constexpr double on_bound = 1e-6;    // of the range
constexpr double moved = 1e-2;       // share of the box per unit length
constexpr double orthogonal = 1e-3;  // of a gradient's length

/// dp/dx of the map from the unit box.
double slope(const FreeParameter& parameter, double value) {
  return parameter.scale == Scale::log ? value * std::log(parameter.max / parameter.min)
                                       : parameter.max - parameter.min;
}

/// Residual rows by free parameters, whitened, in the unit box; `stated` says that all noise is known.
Status whitened(const Assembly& assembly, std::span<const double> free, Matrix& rows, bool& stated) {
  const auto& parameters = assembly.parameters();
  const std::size_t n = parameters.size();
  std::vector<double> predictions(assembly.prediction_count()), jacobian(predictions.size() * n);
  const auto workspace = assembly.make_workspace();
  if (Status status = assembly.predict(free, predictions, jacobian, *workspace); !status.ok()) return status;

  std::size_t fitted = 0;
  for (const ChannelView& view : assembly.channels()) {
    fitted += static_cast<std::size_t>(std::count(view.fitted.begin(), view.fitted.end(), true));
  }
  if (fitted == 0) return Status::failed("no row is fitted");
  const std::size_t priors = assembly.residual_count() - fitted;
  rows = Matrix::Zero(static_cast<Eigen::Index>(fitted + priors), static_cast<Eigen::Index>(n));
  stated = true;
  Eigen::Index row = 0;
  for (const ChannelView& view : assembly.channels()) {
    const auto count = static_cast<double>(std::count(view.fitted.begin(), view.fitted.end(), true));
    double squares = 0, largest = 0;
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      squares += std::pow(predictions[view.offset + i] - view.measured[i], 2);
      largest = std::max(largest, std::abs(view.measured[i]));
    }
    stated = stated && (view.noise || count == 0);
    if (count == 0) continue;
    NoiseModel noise;
    if (view.noise) {
      std::vector<std::string> known;  // warnings that the assembly has given where they matter
      noise = noise_model({view.observable, view.unit, view.measured, {}, view.noise}, view.abscissa, view.fitted,
                          view.test, known);
    } else {
      // Each channel pays its share of the parameters; a perfect fit is no licence for infinite weight.
      const double freedom = std::max(1.0, count * (1 - static_cast<double>(n) / static_cast<double>(fitted)));
      const double sd = std::max({std::sqrt(squares / freedom), 1e-9 * largest, 1e-300});
      noise.sd.assign(static_cast<std::size_t>(count), sd);
    }
    const Eigen::Index first = row;
    for (std::size_t i = 0; i < view.count; ++i) {
      if (!view.fitted[i]) continue;
      const double sd = noise.sd[static_cast<std::size_t>(row - first)];
      for (std::size_t j = 0; j < n; ++j) {
        rows(row, static_cast<Eigen::Index>(j)) =
            jacobian[(view.offset + i) * n + j] * slope(parameters[j], free[j]) / sd;
      }
      ++row;
    }
    // Correlated neighbours: (row_k − φ row_{k−1})/√(1 − φ²), from the last row on.
    for (Eigen::Index k = row - 1; k > first && !noise.neighbour.empty(); --k) {
      const double phi = noise.neighbour[static_cast<std::size_t>(k - first)];
      rows.row(k) = (rows.row(k) - phi * rows.row(k - 1)) / std::sqrt(1 - phi * phi);
    }
  }
  if (priors == 0) return {};
  for (std::size_t j = 0; j < n; ++j) {
    if (!parameters[j].prior) continue;
    rows(row++, static_cast<Eigen::Index>(j)) = slope(parameters[j], free[j]) / parameters[j].prior->sd;
  }
  return {};
}

/// The gradient of a combination in the unit box, by central differences; parameters at a bound stand still.
Vector gradient(const Combination& combination, const Assembly& assembly, std::span<const double> free,
                const std::vector<bool>& at_bound) {
  const auto& parameters = assembly.parameters();
  Vector found = Vector::Zero(static_cast<Eigen::Index>(free.size()));
  std::vector<double> shifted(free.begin(), free.end());
  for (const std::size_t j : combination.arguments) {
    if (at_bound[j]) continue;
    const double h = 1e-6 * (parameters[j].max - parameters[j].min);
    shifted[j] = free[j] + h;
    const double above = combination.value(shifted);
    shifted[j] = free[j] - h;
    const double below = combination.value(shifted);
    shifted[j] = free[j];
    found[static_cast<Eigen::Index>(j)] = (above - below) / (2 * h) * slope(parameters[j], free[j]);
  }
  return found;
}

/// Splits parameters into groups that weak directions connect; P = Σ v vᵀ is block-diagonal over them, whatever basis
/// of the weak space the decomposition has chosen.
std::vector<std::vector<Eigen::Index>> connected(const Matrix& P) {
  std::vector<std::vector<Eigen::Index>> groups;
  std::vector<bool> seen(static_cast<std::size_t>(P.rows()), false);
  for (Eigen::Index first = 0; first < P.rows(); ++first) {
    if (seen[static_cast<std::size_t>(first)] || P(first, first) < moved * moved) continue;
    std::vector<Eigen::Index> group{first};
    seen[static_cast<std::size_t>(first)] = true;
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (Eigen::Index j = 0; j < P.rows(); ++j) {
        if (seen[static_cast<std::size_t>(j)] || P(j, j) < moved * moved || std::abs(P(group[k], j)) < moved * moved)
          continue;
        seen[static_cast<std::size_t>(j)] = true;
        group.push_back(j);
      }
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace

Status identify(const Assembly& assembly, std::span<const double> free, Identifiability& found) {
  const auto& parameters = assembly.parameters();
  const std::size_t n = parameters.size();
  found = {};
  std::vector<double> unit(n);
  assembly.to_unit(free, unit);
  std::vector<bool> at_bound(n);
  for (std::size_t j = 0; j < n; ++j) {
    at_bound[j] = unit[j] <= on_bound || unit[j] >= 1 - on_bound;
    found.parameters.push_back({parameters[j].name, parameters[j].unit, free[j]});
    found.parameters.back().at_bound = at_bound[j];
  }
  Matrix rows;
  bool stated = true;
  if (Status status = whitened(assembly, free, rows, stated); !status.ok()) return status;
  const auto columns = static_cast<Eigen::Index>(n);
  for (Eigen::Index j = 0; j < columns; ++j) {
    if (at_bound[static_cast<std::size_t>(j)]) rows.col(j).setZero();
  }
  const auto inside = static_cast<Eigen::Index>(std::count(at_bound.begin(), at_bound.end(), false));
  if (inside == 0) return {};

  // Columns of zeros put parameters at bounds into the null space; their unit vectors are taken out of it again.
  Matrix inner(rows.rows(), inside);
  std::vector<Eigen::Index> position;
  for (Eigen::Index j = 0; j < columns; ++j) {
    if (at_bound[static_cast<std::size_t>(j)]) continue;
    inner.col(static_cast<Eigen::Index>(position.size())) = rows.col(j);
    position.push_back(j);
  }
  const Eigen::JacobiSVD<Matrix> svd(inner, Eigen::ComputeFullV);
  Vector s = Vector::Zero(inside);
  s.head(svd.singularValues().size()) = svd.singularValues();
  Matrix V = Matrix::Zero(columns, inside);
  for (Eigen::Index k = 0; k < inside; ++k) V.row(position[static_cast<std::size_t>(k)]) = svd.matrixV().row(k);
  found.singular_values.assign(s.begin(), s.end());

  const double threshold = (assembly.jacobian_is_exact() ? weakest_exact : weakest_differenced) * s[0];
  std::vector<bool> flat, weak;
  Matrix P = Matrix::Zero(columns, columns);
  Vector variance_along(inside);
  for (Eigen::Index k = 0; k < inside; ++k) {
    flat.push_back(!(s[k] > threshold));
    weak.push_back(flat.back() || 1 / s[k] > 1);
    variance_along[k] = weak.back() ? 1 : 1 / (s[k] * s[k]);
    if (weak.back()) P += V.col(k) * V.col(k).transpose();
  }
  const double freedom = static_cast<double>(rows.rows() - inside);
  const double quantile = stated || freedom < 1 ? boost::math::quantile(boost::math::normal(), 0.975)
                                                : boost::math::quantile(boost::math::students_t(freedom), 0.975);
  const auto half_width = [&](const Vector& direction) {
    return quantile * std::sqrt((V.transpose() * direction).cwiseAbs2().dot(variance_along));
  };
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    if (at_bound[j] || P(at, at) >= moved * moved) continue;
    found.parameters[j].identified = true;
    found.parameters[j].ci95 = half_width(Vector::Unit(columns, at)) * slope(parameters[j], free[j]);
  }

  for (const std::vector<Eigen::Index>& group : connected(P)) {
    Valley valley;
    const auto size = static_cast<Eigen::Index>(group.size());
    Matrix block(size, size);
    for (Eigen::Index a = 0; a < size; ++a) {
      valley.parameters.push_back(parameters[static_cast<std::size_t>(group[static_cast<std::size_t>(a)])].name);
      for (Eigen::Index b = 0; b < size; ++b) {
        block(a, b) = P(group[static_cast<std::size_t>(a)], group[static_cast<std::size_t>(b)]);
      }
    }
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(block);
    for (Eigen::Index k = size - 1; k >= 0 && eigen.eigenvalues()[k] > 0.5; --k) {
      Vector v = eigen.eigenvectors().col(k);
      Eigen::Index largest = 0;
      v.cwiseAbs().maxCoeff(&largest);
      if (v[largest] < 0) v = -v;
      auto& direction = valley.directions.emplace_back();
      for (Eigen::Index a = 0; a < size; ++a) {
        const auto j = static_cast<std::size_t>(group[static_cast<std::size_t>(a)]);
        if (std::abs(v[a]) >= moved) direction.emplace_back(parameters[j].name, v[a] * slope(parameters[j], free[j]));
      }
    }
    // Not exact as soon as a direction that the data see a little takes part.
    for (Eigen::Index k = 0; k < inside; ++k) {
      if (!weak[static_cast<std::size_t>(k)] || flat[static_cast<std::size_t>(k)]) continue;
      for (const Eigen::Index j : group) valley.exact = valley.exact && std::abs(V(j, k)) < moved;
    }
    std::string remedy;
    for (const Combination& combination : assembly.combinations()) {
      const auto concerns = [&](std::size_t j) {
        return std::find(group.begin(), group.end(), static_cast<Eigen::Index>(j)) != group.end();
      };
      if (std::none_of(combination.arguments.begin(), combination.arguments.end(), concerns)) continue;
      const Vector g = gradient(combination, assembly, free, at_bound);
      if (!(g.norm() > 0) || !std::isfinite(g.norm()) || (P * g).norm() > orthogonal * g.norm()) continue;
      valley.fixed.push_back({combination.name, combination.unit, combination.value(free), half_width(g)});
      if (remedy.empty()) remedy = combination.remedy;
    }
    valley.sentence = in_words(valley, found.parameters, remedy);
    found.valleys.push_back(std::move(valley));
  }
  return {};
}

std::vector<std::string> Identifiability::sentences() const {
  std::vector<std::string> all;
  for (const Valley& valley : valleys) all.push_back(valley.sentence);
  if (const std::string bounds = bounds_in_words(parameters); !bounds.empty()) all.push_back(bounds);
  return all;
}

}  // namespace tunica::calibration
