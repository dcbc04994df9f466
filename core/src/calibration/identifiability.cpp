// SPDX-License-Identifier: Apache-2.0
#include "calibration/identifiability.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>

#include "calibration/valley_words.hpp"
#include "calibration/valleys.hpp"
#include "calibration/whitening.hpp"

namespace tunica::calibration {
namespace {

constexpr double on_bound = 1e-6;  // of the range

/// Residual rows by free parameters, whitened, in the unit box.
Status whitened(const Assembly& assembly, std::span<const double> free, Matrix& rows, Whitening& noise) {
  const auto& parameters = assembly.parameters();
  const std::size_t n = parameters.size();
  std::vector<double> predictions(assembly.prediction_count()), by_prediction(predictions.size() * n);
  const auto workspace = assembly.make_workspace();
  if (Status status = assembly.predict(free, predictions, by_prediction, *workspace); !status.ok()) return status;
  noise = whitening(assembly, predictions);
  if (noise.rows.empty()) return Status::failed("no row is fitted");
  std::vector<double> jacobian(noise.count() * n);
  whitened_residuals(noise, free, predictions, by_prediction, {}, jacobian);
  rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      jacobian.data(), static_cast<Eigen::Index>(noise.count()), static_cast<Eigen::Index>(n));
  for (std::size_t j = 0; j < n; ++j) rows.col(static_cast<Eigen::Index>(j)) *= unit_slope(parameters[j], free[j]);
  return {};
}

/// Parameters inside their bounds, from the singular values of their columns.
Spectrum spectrum_of(const Matrix& rows, const std::vector<bool>& at_bound, double weakest, const Whitening& noise) {
  std::vector<Eigen::Index> position;
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    if (!at_bound[static_cast<std::size_t>(j)]) position.push_back(j);
  }
  const auto inside = static_cast<Eigen::Index>(position.size());
  const Matrix inner = rows(Eigen::all, position);
  const Eigen::JacobiSVD<Matrix> svd(inner, Eigen::ComputeFullV);
  Spectrum found;
  found.values = Vector::Zero(inside);
  found.values.head(svd.singularValues().size()) = svd.singularValues();
  found.V = Matrix::Zero(rows.cols(), inside);
  found.V(position, Eigen::all) = svd.matrixV();
  found.variance = Vector::Ones(inside);
  for (Eigen::Index k = 0; k < inside; ++k) {
    const double s = found.values[k];
    const bool flat = !(s > weakest * found.values[0]);
    found.seen.push_back(flat ? Seen::not_at_all : 1 / s > 1 ? Seen::weakly : Seen::well);
    if (!flat) found.variance[k] = 1 / (s * s);
  }
  found.quantile = noise.quantile(static_cast<std::size_t>(inside));
  return found;
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
  Whitening noise;
  if (Status status = whitened(assembly, free, rows, noise); !status.ok()) return status;
  if (std::find(at_bound.begin(), at_bound.end(), false) == at_bound.end()) return {};

  const double weakest = assembly.jacobian_is_exact() ? weakest_exact : weakest_differenced;
  const Spectrum spectrum = spectrum_of(rows, at_bound, weakest, noise);
  found.singular_values.assign(spectrum.values.begin(), spectrum.values.end());
  const Matrix flat = spectrum.projector(Seen::not_at_all);
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double half_width = spectrum.half_width(Vector::Unit(flat.rows(), at));
    if (at_bound[j] || flat(at, at) >= moved * moved || half_width > widest) continue;
    found.parameters[j].identified = true;
    found.parameters[j].ci95 = half_width * unit_slope(parameters[j], free[j]);
    std::vector<double> end = unit, mapped(n);
    end[j] = unit[j] - half_width, assembly.from_unit(end, mapped), found.parameters[j].lower = mapped[j];
    end[j] = unit[j] + half_width, assembly.from_unit(end, mapped), found.parameters[j].upper = mapped[j];
  }
  for (const Seen seen : {Seen::not_at_all, Seen::weakly}) add_valleys(assembly, free, spectrum, seen, found);
  return {};
}

std::vector<std::string> Identifiability::sentences() const {
  std::vector<std::string> all;
  for (const Valley& valley : valleys) all.push_back(valley.sentence);
  if (const std::string bounds = bounds_in_words(parameters); !bounds.empty()) all.push_back(bounds);
  return all;
}

}  // namespace tunica::calibration
