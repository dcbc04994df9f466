// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/identifiability.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "assembly/whitening.hpp"
#include "numerics/singular.hpp"
#include "uncertainty/sandwich.hpp"
#include "uncertainty/straightness.hpp"
#include "uncertainty/valley_words.hpp"
#include "uncertainty/valleys.hpp"

namespace tunica::uncertainty {
namespace {

/// One end of a linearised interval, to be judged.
struct IntervalEnd {
  Eigen::Index parameter;
  double side, half_width, quantile;
  bool straight = true;
};

constexpr double on_bound = 1e-6;  // of the range

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Residual rows, whitened, and all predictions (`curves`) by free parameters, in the unit box.
Status whitened(const assembly::Assembly& assembly, std::span<const double> free, Matrix& rows, Matrix& curves,
                assembly::Whitening& noise, bool is_fit) {
  const auto& parameters = assembly.layout().parameters;
  const std::size_t n = parameters.size();
  std::vector<double> predictions(assembly.layout().prediction_count), by_prediction(predictions.size() * n);
  const auto workspace = assembly.evaluator().make_workspace();
  if (Status status = assembly.evaluator().predict(free, predictions, by_prediction, *workspace); !status.ok())
    return status;
  noise = assembly::whitening(assembly, predictions, {}, !is_fit);
  if (noise.rows.empty()) return Status::failed("no row is fitted");
  std::vector<double> jacobian(noise.count() * n);
  assembly::whitened_residuals(noise, free, predictions, by_prediction, {}, jacobian);
  const auto columns = static_cast<Eigen::Index>(n);
  rows = Eigen::Map<const Rows>(jacobian.data(), static_cast<Eigen::Index>(noise.count()), columns);
  curves = Eigen::Map<const Rows>(by_prediction.data(), static_cast<Eigen::Index>(predictions.size()), columns);
  for (std::size_t j = 0; j < n; ++j) {
    rows.col(static_cast<Eigen::Index>(j)) *= assembly.box().slope(j, free[j]);
    curves.col(static_cast<Eigen::Index>(j)) *= assembly.box().slope(j, free[j]);
  }
  return {};
}

/// t √Σ_k min(1, var_k) (g·v_k)² of every row g: a direction that the data do not see is as wide as the box.
std::vector<double> curve_intervals(const Matrix& curves, const Spectrum& spectrum) {
  const Vector sd = spectrum.variance.cwiseMin(1).cwiseSqrt();
  const Vector widths = spectrum.quantile * (curves * spectrum.V * sd.asDiagonal()).rowwise().norm();
  return {widths.begin(), widths.end()};
}

/// Gradients in the unit box of the constraints that hold with equality at the point, to `active_margin`; none where
/// one is broken. `where`: the tightest of them in words.
Status active_gradients(const assembly::Assembly& assembly, std::span<const double> free, Matrix& gradients,
                        std::string& where) {
  constexpr double active_margin = 1e-4;
  const std::size_t n = free.size(), count = assembly.constraints().count();
  gradients.resize(0, static_cast<Eigen::Index>(n));
  if (count == 0) return {};
  std::vector<double> values(count), jacobian(count * n);
  if (Status status = assembly.constraints().evaluate(free, values, jacobian); !status.ok()) return status;
  if (*std::max_element(values.begin(), values.end()) > active_margin) return {};
  std::size_t active = 0, tightest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (values[i] < -active_margin) continue;
    if (active == 0 || values[i] > values[tightest]) tightest = i;
    ++active;
    gradients.conservativeResize(static_cast<Eigen::Index>(active), Eigen::NoChange);
    for (std::size_t j = 0; j < n; ++j)
      gradients(gradients.rows() - 1, static_cast<Eigen::Index>(j)) =
          jacobian[i * n + j] * assembly.box().slope(j, free[j]);
  }
  if (active > 0) where = assembly.constraints().words(tightest, values[tightest]);
  return {};
}

/// A basis of the directions that keep all given gradients' values, rows whose gradients are nearly parallel counting
/// once; the identity without any.
Matrix tangent_space(const Matrix& gradients) {
  const Eigen::Index n = gradients.cols();
  if (gradients.rows() == 0 || n == 0) return Matrix::Identity(n, n);
  constexpr double parallel = 0.02;
  const auto [values, V] = numerics::right_singular_vectors(gradients.rowwise().normalized());
  Eigen::Index rank = 0;
  while (rank < values.size() && values[rank] > parallel * values[0]) ++rank;
  return V.rightCols(n - rank);
}

/// Parameters inside their bounds, along active constraints, from the singular values of their columns. Empty where
/// that leaves no direction.
Spectrum spectrum_of(const Matrix& rows, const Matrix& active, const std::vector<bool>& at_bound, double weakest,
                     const assembly::Whitening& noise) {
  std::vector<Eigen::Index> position;
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    if (!at_bound[static_cast<std::size_t>(j)]) position.push_back(j);
  }
  const Matrix tangent = tangent_space(active(Eigen::all, position));
  const Eigen::Index inside = tangent.cols();
  if (inside == 0) return {Matrix::Zero(rows.cols(), 0), Vector(), Vector(), {}, 0};
  const Matrix inner = rows(Eigen::all, position) * tangent;
  const numerics::SingularVectors singular = numerics::right_singular_vectors(inner);
  Spectrum found;
  found.values = Vector::Zero(inside);
  found.values.head(singular.values.size()) = singular.values;
  found.V = Matrix::Zero(rows.cols(), inside);
  found.V(position, Eigen::all) = tangent * singular.vectors;
  found.variance = Vector::Ones(inside);
  for (Eigen::Index k = 0; k < inside; ++k) {
    const double s = found.values[k];
    const bool flat = !(s > weakest * found.values[0]);
    found.seen.push_back(flat ? Visibility::not_at_all : 1 / s > 1 ? Visibility::weakly : Visibility::well);
    if (!flat) found.variance[k] = 1 / (s * s);
  }
  found.quantile = noise.quantile(static_cast<std::size_t>(inside));
  return found;
}

/// What active constraints do to the intervals.
std::string constrained_in_words(bool all_held, const std::vector<ParameterInterval>& parameters,
                                 const std::string& where) {
  if (where.empty()) return "";
  if (all_held)
    return fmt::format(
        "Constraints and bounds hold every parameter, so the data determine no interval. Active constraint: {}.",
        where);
  std::vector<std::string> held;
  for (const ParameterInterval& parameter : parameters)
    if (parameter.held) held.push_back(parameter.name);
  return fmt::format(
      "A constraint, not the data, holds the result; the intervals are those along its border.{} Active constraint: "
      "{}.",
      held.empty() ? ""
                   : fmt::format(" Along it {} cannot move; a profile shows how far the data would let it leave.",
                                 fmt::join(held, ", ")),
      where);
}

/// Parameters whose interval fills the box although no direction by itself is weak: the direction that costs each of
/// them most counts as weak, so that what is not fixed is said. Only these are left weak.
Spectrum hardly_seen(const Spectrum& spectrum, const Identifiability& found) {
  Spectrum result = spectrum;
  std::fill(result.seen.begin(), result.seen.end(), Visibility::well);
  for (std::size_t j = 0; j < found.parameters.size(); ++j) {
    const ParameterInterval& parameter = found.parameters[j];
    const bool said = std::any_of(found.valleys.begin(), found.valleys.end(), [&](const Valley& valley) {
      return std::find(valley.parameters.begin(), valley.parameters.end(), parameter.name) != valley.parameters.end();
    });
    if (parameter.identified || parameter.at_bound || parameter.held || said) continue;
    Eigen::Index worst = 0;
    spectrum.V.row(static_cast<Eigen::Index>(j))
        .cwiseAbs2()
        .cwiseProduct(spectrum.variance.transpose())
        .maxCoeff(&worst);
    result.seen[static_cast<std::size_t>(worst)] = Visibility::weakly;
  }
  return result;
}

}  // namespace

Status identify(const assembly::Assembly& assembly, std::span<const double> free, Identifiability& found, bool is_fit) {
  const auto& parameters = assembly.layout().parameters;
  const std::size_t n = parameters.size();
  found = {};
  std::vector<double> unit(n);
  assembly.box().to_unit(free, unit);
  std::vector<bool> at_bound(n);
  for (std::size_t j = 0; j < n; ++j) {
    at_bound[j] = unit[j] <= on_bound || unit[j] >= 1 - on_bound;
    found.parameters.push_back({parameters[j].name, parameters[j].unit, free[j]});
    found.parameters.back().at_bound = at_bound[j];
    const auto kind = parameters[j].kind_of(unit[j] > 0.5);
    found.parameters.back().natural = at_bound[j] && (kind == assembly::FreeParameter::Bound::symmetry ||
                                                      kind == assembly::FreeParameter::Bound::physical);
  }
  Matrix rows, curves;
  assembly::Whitening noise;
  if (Status status = whitened(assembly, free, rows, curves, noise, is_fit); !status.ok()) return status;
  if (std::find(at_bound.begin(), at_bound.end(), false) == at_bound.end()) return {};

  const double weakest = assembly.layout().jacobian_is_exact ? weakest_exact : weakest_differenced;
  Matrix active;
  std::string where;
  if (Status status = active_gradients(assembly, free, active, where); !status.ok()) return status;
  const Spectrum likelihood = spectrum_of(rows, active, at_bound, weakest, noise);
  Spectrum spectrum = likelihood;
  if (Status status = apply_sandwich(assembly, free, noise, spectrum); !status.ok()) return status;
  for (std::size_t j = 0; j < n; ++j)
    found.parameters[j].held =
        !at_bound[j] && spectrum.V.row(static_cast<Eigen::Index>(j)).squaredNorm() < moved * moved;
  found.constrained = constrained_in_words(spectrum.V.cols() == 0, found.parameters, where);
  if (spectrum.V.cols() == 0) return {};
  found.curve_ci95 = curve_intervals(curves, spectrum);
  found.singular_values.assign(likelihood.values.begin(), likelihood.values.end());
  const Matrix flat = spectrum.projector(Visibility::not_at_all);
  const Straightness straightness(assembly, noise, free);
  std::vector<IntervalEnd> ends;
  for (std::size_t j = 0; j < n; ++j) {
    const auto at = static_cast<Eigen::Index>(j);
    const double half_width = spectrum.half_width(Vector::Unit(flat.rows(), at));
    if (at_bound[j] || found.parameters[j].held || flat(at, at) >= moved * moved || half_width > widest) continue;
    found.parameters[j].identified = true;
    // The likelihood has to be straight over the whole of the interval, which another objective makes wider.
    const double times = half_width / likelihood.half_width(Vector::Unit(flat.rows(), at));
    for (const double side : {-1.0, 1.0}) ends.push_back({at, side, half_width, times * spectrum.quantile});
    found.parameters[j].ci95 = half_width * assembly.box().slope(j, free[j]);
    std::vector<double> end = unit, mapped(n);
    end[j] = unit[j] - half_width;
    assembly.box().from_unit(end, mapped);
    found.parameters[j].lower = mapped[j];
    end[j] = unit[j] + half_width;
    assembly.box().from_unit(end, mapped);
    found.parameters[j].upper = mapped[j];
  }
  // Isolated: a thread that waits here must not begin something else in between.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, ends.size(), [&](std::size_t k) {
      IntervalEnd& end = ends[k];
      end.straight = straightness.holds(end.parameter, end.side, end.half_width, end.quantile);
    });
  });
  for (const IntervalEnd& end : ends) {
    bool& straight = found.parameters[static_cast<std::size_t>(end.parameter)].straight;
    straight = straight && end.straight;
  }
  for (std::size_t j = 0; j < n; ++j)
    if (found.parameters[j].identified) found.fixed_by_data.push_back(j);
  const Matrix covariance = spectrum.V * spectrum.variance.asDiagonal() * spectrum.V.transpose();
  for (const std::size_t i : found.fixed_by_data)
    for (const std::size_t j : found.fixed_by_data)
      found.covariance.push_back(covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  for (const Visibility seen : {Visibility::not_at_all, Visibility::weakly})
    add_valleys(assembly, free, spectrum, seen, found);
  add_valleys(assembly, free, hardly_seen(spectrum, found), Visibility::weakly, found);
  return {};
}

std::vector<std::string> Identifiability::sentences() const {
  std::vector<std::string> all;
  for (const Valley& valley : valleys) all.push_back(valley.sentence);
  if (!constrained.empty()) all.push_back(constrained);
  if (const std::string bounds = bounds_in_words(parameters); !bounds.empty()) all.push_back(bounds);
  return all;
}

}  // namespace tunica::uncertainty
