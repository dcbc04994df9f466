// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/gross_rows.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/evidence/projection.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double gross_contrast = 4;
constexpr Eigen::Index one_row_in = 30;      ///< at most
constexpr std::size_t one_of_curve_in = 10;  ///< or one: more of a curve are a shape

std::string four_digits(double value, const std::string& unit) {
  return unit == "1" || unit.empty() ? fmt::format("{:.4g}", value) : fmt::format("{:.4g} {}", value, unit);
}

/// "stretch 1.25, measured 14 kPa": rows are counted from 0 behind `rows` and `where`, which is hard to find in a file.
GrossRow gross_row(const Evidence& evidence, const Curve& curve, std::size_t row, double residual) {
  GrossRow found{curve.test, curve.channel, row, row, residual, {}};
  for (const assembly::MeasuredChannel& view : evidence.base->layout().channels)
    if (view.test == curve.test && view.observable == curve.channel) {
      found.file_row = view.file_row(row);
      found.where =
          fmt::format("{} {}, measured {}", view.abscissa_name, four_digits(view.abscissa[row], view.abscissa_unit),
                      four_digits(view.measured[row], view.unit));
    }
  return found;
}

/// The distance of a residual from the straight line through two neighbours, in its standard deviations. The neighbours
/// are one on either side, or at an end both on one side. It is 0 if a neighbour is almost as large, because both then
/// belong to one shape. It is also 0 at an end if the rows before bend the same way: a curve that departs from the
/// model at its end departs progressively.
double contrast(const Evidence& evidence, const Curve& curve, Eigen::Index k) {
  if (curve.count < 4) return 0;
  const auto residual = [&](Eigen::Index row) { return -evidence.fit.residuals[curve.first + row]; };
  const bool first = k == 0, last = k + 1 == curve.count;
  const double near = first ? residual(1) : residual(k - 1);
  const double far = first ? residual(2) : last ? residual(k - 2) : residual(k + 1);
  const double r = residual(k);
  constexpr double of_noise = 3.5;  // of a difference of two rows: 2.5 standard deviations
  if ((first || last) && std::abs(near - far) > of_noise && (r - near) * (near - far) > 0) return 0;
  const double line = first || last ? 2 * near - far : (near + far) / 2;
  constexpr double alone = 2.5;
  if (std::abs(r) < alone * std::max(std::abs(near), std::abs(far))) return 0;
  return (r - line) / std::sqrt(first || last ? 6.0 : 1.5);
}

}  // namespace

std::vector<GrossRow> gross_rows(const Evidence& evidence) {
  const Eigen::MatrixXd J = interior(evidence.fit), Q = basis(J, 1e-8);
  std::vector<GrossRow> found;
  const auto& channels = evidence.base->layout().channels;
  for (const Curve& curve : evidence.curves) {
    // Neighbours in a field are not neighbours in the file, so a steep place would pass for gross errors.
    if (std::ranges::any_of(channels, [&](const assembly::MeasuredChannel& view) {
          return view.test == curve.test && view.observable == curve.channel && view.is_field();
        }))
      continue;
    std::vector<GrossRow> of_curve;
    for (Eigen::Index k = 0; k < curve.count; ++k) {
      const Eigen::Index i = curve.first + k;
      const double r = -evidence.fit.residuals[i], free = 1 - Q.row(i).squaredNorm();
      if (!(free > 0.05) || r * r / free < gross_score) continue;
      if (std::abs(contrast(evidence, curve, k)) > gross_contrast)
        of_curve.push_back(gross_row(evidence, curve, curve.rows[static_cast<std::size_t>(k)], r));
    }
    if (of_curve.size() <= std::max<std::size_t>(1, static_cast<std::size_t>(curve.count) / one_of_curve_in))
      found.insert(found.end(), of_curve.begin(), of_curve.end());
  }
  if (static_cast<Eigen::Index>(found.size()) > std::max<Eigen::Index>(1, evidence.fit.residuals.size() / one_row_in))
    found.clear();
  std::stable_sort(found.begin(), found.end(),
                   [](const GrossRow& a, const GrossRow& b) { return std::abs(a.residual) > std::abs(b.residual); });
  return found;
}

experiment::Experiment without_rows(experiment::Experiment experiment, const std::vector<GrossRow>& rows) {
  for (auto& test : experiment.tests)
    for (auto& [channel, noise] : test.data.noise)
      for (const GrossRow& row : rows)
        if (row.test == test.name && row.channel == channel) noise.gross.push_back(row.row);
  return experiment;
}

std::string words_of(const std::vector<GrossRow>& rows) {
  std::vector<std::string> all;
  for (const GrossRow& row : rows)
    all.push_back(
        fmt::format("row {} of {}, {} ({}; {:+.1f} σ)", row.file_row, row.test, row.channel, row.where, row.residual));
  return fmt::format("{}", fmt::join(all, "; "));
}

}  // namespace tunica::diagnosis
