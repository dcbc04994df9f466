// SPDX-License-Identifier: Apache-2.0
#include "calibration/identifiability.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/SVD>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "calibration/noise.hpp"
#include "calibration/valley_words.hpp"
#include "calibration/valleys.hpp"

namespace tunica::calibration {
namespace {

constexpr double on_bound = 1e-6;  // of the range

/// A channel of weight 0 is predicted, and says nothing about the parameters.
bool counts(const ChannelView& view) { return view.weight > 0; }

/// Residual rows by free parameters, whitened, in the unit box; `stated` says that all noise is known.
Status whitened(const Assembly& assembly, std::span<const double> free, Matrix& rows, bool& stated) {
  const auto& parameters = assembly.parameters();
  const std::size_t n = parameters.size();
  std::vector<double> predictions(assembly.prediction_count()), jacobian(predictions.size() * n);
  const auto workspace = assembly.make_workspace();
  if (Status status = assembly.predict(free, predictions, jacobian, *workspace); !status.ok()) return status;

  std::size_t fitted = 0, silent = 0;  // rows that count, rows of weight 0
  for (const ChannelView& view : assembly.channels())
    (counts(view) ? fitted : silent) +=
        static_cast<std::size_t>(std::count(view.fitted.begin(), view.fitted.end(), true));
  if (fitted == 0) return Status::failed("no row is fitted");
  const std::size_t priors = assembly.residual_count() - fitted - silent;
  rows = Matrix::Zero(static_cast<Eigen::Index>(fitted + priors), static_cast<Eigen::Index>(n));
  stated = true;
  Eigen::Index row = 0;
  for (const ChannelView& view : assembly.channels()) {
    if (!counts(view)) continue;
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
            jacobian[(view.offset + i) * n + j] * unit_slope(parameters[j], free[j]) / sd;
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
    rows(row++, static_cast<Eigen::Index>(j)) = unit_slope(parameters[j], free[j]) / parameters[j].prior->sd;
  }
  return {};
}

/// Parameters inside their bounds, from the singular values of their columns.
Spectrum spectrum_of(const Matrix& rows, const std::vector<bool>& at_bound, double weakest, bool stated) {
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
  const double freedom = static_cast<double>(rows.rows() - inside);
  found.quantile = stated || freedom < 1 ? boost::math::quantile(boost::math::normal(), 0.975)
                                         : boost::math::quantile(boost::math::students_t(freedom), 0.975);
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
  bool stated = true;
  if (Status status = whitened(assembly, free, rows, stated); !status.ok()) return status;
  if (std::find(at_bound.begin(), at_bound.end(), false) == at_bound.end()) return {};

  const double weakest = assembly.jacobian_is_exact() ? weakest_exact : weakest_differenced;
  const Spectrum spectrum = spectrum_of(rows, at_bound, weakest, stated);
  found.singular_values.assign(spectrum.values.begin(), spectrum.values.end());
  const Matrix flat = spectrum.projector(Seen::not_at_all);
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double half_width = spectrum.half_width(Vector::Unit(flat.rows(), at));
    if (at_bound[j] || flat(at, at) >= moved * moved || half_width > widest) continue;
    found.parameters[j].identified = true;
    found.parameters[j].ci95 = half_width * unit_slope(parameters[j], free[j]);
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
