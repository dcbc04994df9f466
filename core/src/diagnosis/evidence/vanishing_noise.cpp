// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/vanishing_noise.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tunica::diagnosis {
namespace {

constexpr double near_zero = 0.3;  ///< of the median σ
constexpr double carried_share = 0.5, beyond_noise = 3;

/// "strip, stress (9 of 32 rows carry 93 % of its |r|²)"; empty where they do not.
std::string carried(const Curve& curve, const std::vector<double>& sd, const Eigen::VectorXd& residuals) {
  double small = 0, all = 0;
  std::size_t count = 0;
  std::vector<double> sorted = sd;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  for (std::size_t k = 0; k < sd.size(); ++k) {
    const double square = std::pow(residuals[curve.first + static_cast<Eigen::Index>(k)], 2);
    all += square;
    if (sd[k] < near_zero * sorted[sorted.size() / 2]) {
      small += square;
      ++count;
    }
  }
  if (!(small > carried_share * all) || !(small > beyond_noise * static_cast<double>(count))) return "";
  return fmt::format("{}, {} ({} of {} rows carry {:.0f} % of its |r|²)", curve.test, curve.channel, count, sd.size(),
                     100 * small / all);
}

}  // namespace

std::optional<Warning> vanishing_noise_warning(const Evidence& evidence) {
  std::vector<std::string> found;
  std::size_t c = 0;
  for (const assembly::MeasuredChannel& view : evidence.base->layout().channels) {
    if (c >= evidence.curves.size() || evidence.curves[c].test != view.test ||
        evidence.curves[c].channel != view.observable)
      continue;
    const Curve& curve = evidence.curves[c++];
    if (view.noise->absolute > 0) continue;
    if (std::string words = carried(curve, row_deviations(view), evidence.fit.residuals); !words.empty())
      found.push_back(std::move(words));
  }
  if (found.empty()) return std::nullopt;
  return Warning{
      WarningKind::noise_vanishes,
      fmt::format("purely relative noise makes rows near zero almost exact: {}. A misfit there may only be the reading "
                  "error of the instrument. State noise.absolute too, the smallest difference that it resolves",
                  fmt::join(found, "; "))};
}

}  // namespace tunica::diagnosis
