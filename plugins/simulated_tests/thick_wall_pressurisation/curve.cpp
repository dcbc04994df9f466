// SPDX-License-Identifier: Apache-2.0
#include "curve.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "tunica/detail/vector_level.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::thick_wall {
namespace {

constexpr std::size_t scouts = 8, count = 16;  ///< samples that look for the highest pressure, and on the curve
constexpr double scouting_step = 0.12;         ///< of y
constexpr int batches = 2;                     ///< of scouts
constexpr double beyond_samples = 0.02;        ///< of y: how far the polynomial may be taken beyond its samples
constexpr double farthest_out = 1.01;          ///< of half the range: where the polynomial is as good as inside
constexpr double least_range = 1e-6;           ///< of y
constexpr double last_step = 1e-6;  ///< of y: the last step of Newton's method on a polynomial squares what is left

struct Sample {
  double y, p, p_y, F, F_y;
};

template <std::size_t n>
bool sample(double axial_stretch, bool force, Sections& sections, std::array<Sample, n>& at) {
  std::array<Section, n> batch;
  for (std::size_t k = 0; k < n; ++k) batch[k] = {axial_stretch, at[k].y};
  if (!sections.evaluate(batch, {.geometry = false, .force = force}).ok()) return false;
  for (std::size_t k = 0; k < n; ++k) {
    const WallForces forces = sections.forces(k);
    at[k] = {at[k].y, forces.p, forces.p_y, forces.F, forces.F_y};
  }
  return true;
}

bool sound(const Sample& at) { return std::isfinite(at.p) && std::isfinite(at.p_y) && at.p_y > 0; }

/// y between two samples, cubic in p.
double between(const Sample& a, const Sample& b, double p) {
  const double h = b.p - a.p, t = (p - a.p) / h, left = 1 - t;
  return left * left * ((1 + 2 * t) * a.y + t * h / a.p_y) + t * t * ((3 - 2 * t) * b.y - left * h / b.p_y);
}

/// The unpressurised state, from one batch along the path that stretches the tube. Each state is guessed, and corrected
/// by one step of Newton's method. False where the pressure does not rise, where a guess is far off, or where states
/// are not where the tangents of their neighbours point to: then the path has to be followed.
bool stretch_at_once(double axial_stretch, const Wall& wall, Sections& sections, Equilibrium& free) {
  constexpr std::size_t most = 8;
  constexpr double axial_step = 0.1, far_off = 0.1, aligned = 3e-3;  // of ln λz; of y
  const double whole = std::log(axial_stretch), steps = std::ceil(std::abs(whole) / axial_step);
  if (!(steps < most)) return false;
  const std::size_t n = 1 + static_cast<std::size_t>(steps);
  std::array<Section, most> at;
  for (std::size_t k = 0; k < n; ++k) {
    const double done = k == 0 ? 0 : whole * static_cast<double>(k) / steps;
    at[k] = {k + 1 == n ? axial_stretch : std::exp(done), std::log(wall.Ri) - 0.5 * done};
  }
  if (!sections.evaluate(std::span(at).first(n), {.force = false}).ok()) return false;
  double slope_before = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const WallForces forces = sections.forces(k);
    const double correction = -forces.p / forces.p_y, slope = -forces.p_axial / forces.p_y;
    if (!(forces.p_y > 0) || !(std::abs(correction) < far_off)) return false;
    at[k].y += correction;
    if (k > 0) {
      const double expected = 0.5 * (slope + slope_before) * (at[k].axial_stretch - at[k - 1].axial_stretch);
      if (!(std::abs(at[k].y - at[k - 1].y - expected) < aligned)) return false;
    }
    slope_before = slope;
  }
  free = {.axial_stretch = axial_stretch, .y = at[n - 1].y};
  return true;
}

/// y where the pressure is `highest`, roughly; false where no sample in reach has it, or the curve falls before.
bool reach(const Equilibrium& free, double highest, Sections& sections, double& end) {
  std::array<Sample, scouts> at;
  Sample before{};
  for (int batch = 0; batch < batches; ++batch) {
    for (std::size_t k = 0; k < scouts; ++k)
      at[k].y = free.y + scouting_step * static_cast<double>(static_cast<std::size_t>(batch) * scouts + k);
    if (!sample(free.axial_stretch, false, sections, at)) return false;
    for (std::size_t k = 0; k < scouts; before = at[k], ++k) {
      if (!sound(at[k])) return false;
      if (at[k].p < highest) continue;
      end = batch == 0 && k == 0 ? at[k].y : std::clamp(between(before, at[k], highest), before.y, at[k].y);
      return true;
    }
  }
  return false;
}

/// Chebyshev's points of the first kind on [−1, 1], and what is the same for every function on them.
struct Points {
  static constexpr std::size_t terms = 2 * count;
  std::array<double, count> at;                                 ///< ascending
  std::array<std::size_t, count> order;                         ///< each as far as can be from those before
  std::array<double, terms> twice;                              ///< in that order, each counting twice
  std::array<std::array<double, terms>, terms> per_difference;  ///< [order][k]: 1/(twice_k − twice_(k−order))
  std::array<std::array<double, count>, 2> last;                ///< the last coefficients, by a scalar product

  Points() {
    for (std::size_t k = 0; k < count; ++k) at[k] = -std::cos(angle(k));
    for (std::size_t k = 0; k < count; ++k) order[k] = k;
    for (std::size_t k = 0; k < count; ++k) {  // Leja's order: Newton's form then loses nothing to rounding
      const auto apart = [&](std::size_t i) {
        double product = std::abs(at[i]) + (k == 0 ? 0 : 2);
        for (std::size_t j = 0; j < k; ++j) product *= std::abs(at[i] - at[order[j]]);
        return product;
      };
      std::iter_swap(&order[k], std::max_element(&order[k], order.data() + count,
                                                 [&](std::size_t i, std::size_t j) { return apart(i) < apart(j); }));
      twice[2 * k] = twice[2 * k + 1] = at[order[k]];
    }
    for (std::size_t m = 1; m < terms; ++m)
      for (std::size_t k = m; k < terms; ++k) per_difference[m][k] = 1 / (twice[k] - twice[k - m]);
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < count; ++i)
        last[k][i] = 2. / count * std::cos(static_cast<double>(count - 1 - k) * (std::numbers::pi - angle(i)));
  }
  static double angle(std::size_t k) { return (2 * static_cast<double>(k) + 1) / (2 * count) * std::numbers::pi; }
};
const Points& points() {
  static const Points all;
  return all;
}

/// A function on an interval by values and slopes at Chebyshev's points: Hermite's polynomial in Newton's form.
class Polynomial {
 public:
  Polynomial(const std::array<Sample, count>& samples, double Sample::*value, double Sample::*slope, double half) {
    const Points& of = points();
    std::array<double, terms> one, other, slopes;
    for (std::size_t k = 0; k < count; ++k) {
      const Sample& at = samples[of.order[k]];
      one[2 * k] = one[2 * k + 1] = at.*value;
      slopes[2 * k + 1] = half * (at.*slope);
    }
    detail::vectorised([this, &of, &one, &other, &slopes] {
      double* from = one.data();
      double* to = other.data();
      divided_[0] = from[0];
      for (std::size_t m = 1; m < terms; ++m) {
        const double* const per = of.per_difference[m].data();
        TUNICA_LANES
        for (std::size_t k = m; k < terms; ++k) to[k] = (from[k] - from[k - 1]) * per[k];
        for (std::size_t k = 1; m == 1 && k < terms; k += 2) to[k] = slopes[k];
        divided_[m] = to[m];
        std::swap(from, to);
      }
    });
    double last = 0, last_but_one = 0, mean = 0;
    for (std::size_t k = 0; k < count; ++k) {
      mean += std::abs(samples[k].*value) / count;
      last += of.last[0][k] * (samples[k].*value);
      last_but_one += of.last[1][k] * (samples[k].*value);
    }
    error_ = coefficient_behind(std::max(std::abs(last), std::abs(last_but_one)), mean);
  }
  /// Estimate of what is left of the function, of the order of the first coefficient that is missing.
  [[nodiscard]] double error() const { return error_; }

  /// One step of Newton's method from each t towards value(t) = wanted.
  void step(std::span<const double> wanted, std::span<double> t, std::span<double> by) const {
    detail::vectorised(
        [this, &of = points().twice, wanted = wanted.data(), t = t.data(), by = by.data(), n = t.size()] {
          TUNICA_LANES
          for (std::size_t i = 0; i < n; ++i) {
            double value = divided_[terms - 1], slope = 0;
            for (std::size_t k = terms - 1; k-- > 0;) {
              const double distance = t[i] - of[k];
              slope = slope * distance + value;
              value = value * distance + divided_[k];
            }
            by[i] = (wanted[i] - value) / slope;
            t[i] += by[i];
          }
        });
  }
  void values(std::span<const double> t, std::span<double> value) const {
    detail::vectorised([this, &of = points().twice, t = t.data(), to = value.data(), n = t.size()] {
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        double sum = divided_[terms - 1];
        for (std::size_t k = terms - 1; k-- > 0;) sum = sum * (t[i] - of[k]) + divided_[k];
        to[i] = sum;
      }
    });
  }

 private:
  static constexpr std::size_t terms = Points::terms;
  std::array<double, terms> divided_;
  double error_ = 0;
};

/// Starts for Newton's method: y between samples, cubic in p.
void start(const std::array<Sample, count>& at, std::span<const double> pressure, std::span<double> y) {
  struct Cubic {
    double p, per_h, y, first, second, third;
  };
  std::array<Cubic, count> pieces;
  for (std::size_t k = 1; k < count; ++k) {
    const Sample& a = at[k - 1];
    const Sample& b = at[k];
    const double h = b.p - a.p, D = b.y - a.y, at_a = h / a.p_y, at_b = h / b.p_y;
    pieces[k] = {a.p, 1 / h, a.y, at_a, 3 * D - 2 * at_a - at_b, at_a + at_b - 2 * D};
  }
  std::size_t k = 1;
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    while (k + 1 < count && pressure[i] > at[k].p) ++k;
    while (k > 1 && pressure[i] < at[k - 1].p) --k;
    const Cubic& of = pieces[k];
    const double t = (pressure[i] - of.p) * of.per_h;
    y[i] = of.y + t * (of.first + t * (of.second + t * of.third));
  }
}

}  // namespace

bool find_on_curve(double axial_stretch, std::span<const double> pressure, const Wall& wall, Sections& sections,
                   std::span<double> y, std::span<double> force, CurveError& error) {
  constexpr int iterations = 2;
  const auto [lowest, highest] = std::minmax_element(pressure.begin(), pressure.end());
  const Rule& rule = sections.rule();
  Equilibrium free;
  double end;
  if (rules().front().node.size() < rule.node.size()) sections.take(rules().front());  // where to look
  bool reached = stretch_at_once(axial_stretch, wall, sections, free);
  if (!reached) {
    Path path(sections, wall);
    reached = path.begin(free).ok() && path.follow(free, axial_stretch, 0).ok();
  }
  reached = reached && reach(free, *highest, sections, end);
  sections.take(rule);
  if (!reached || !(end - free.y > least_range)) return false;
  std::array<Sample, count> at;
  const double middle = 0.5 * (free.y + end), half = 0.5 * (end - free.y);
  for (std::size_t k = 0; k < count; ++k) at[k].y = middle + half * points().at[k];
  if (!sample(axial_stretch, !force.empty(), sections, at)) return false;
  for (std::size_t k = 0; k < count; ++k)
    if (!sound(at[k]) || (k > 0 && !rises(at[k].p - at[k - 1].p, at[k].y - at[k - 1].y, at[k - 1].p_y, at[k].p_y)))
      return false;
  if (!((at.front().p - *lowest) / at.front().p_y < beyond_samples) ||
      !((*highest - at.back().p) / at.back().p_y < beyond_samples))
    return false;

  const std::span<const double> errors = sections.pressure_errors();
  double least_slope = at[0].p_y;
  for (std::size_t k = 0; k < count; ++k) {
    error.quadrature = std::max(error.quadrature, errors[k] / at[k].p_y);
    least_slope = std::min(least_slope, at[k].p_y);
  }
  start(at, pressure, y);
  const double per_half = 1 / half;
  for (double& t : y) t = (t - middle) * per_half;
  thread_local std::vector<double> last;
  last.resize(y.size());
  const Polynomial p(at, &Sample::p, &Sample::p_y, half);
  for (int iteration = 0; iteration < iterations; ++iteration) p.step(pressure, y, last);
  const bool smooth = sections.smooth(axial_stretch, middle - farthest_out * half, middle + farthest_out * half);
  error.interpolation = smooth ? p.error() / least_slope : std::numeric_limits<double>::infinity();
  if (!force.empty()) {
    const Polynomial F(at, &Sample::F, &Sample::F_y, half);
    F.values(y, force);
    double largest = 0;
    for (const Sample& one : at) largest = std::max(largest, std::abs(one.F));
    error.force = F.error() / largest;
  }
  const std::size_t n = y.size();
  if (detail::any_not_below(y.data(), n, 1 + beyond_samples / half)) return false;
  if (detail::any_not_below(last.data(), n, last_step / half) || detail::any_not_below(y.data(), n, farthest_out))
    error.interpolation = std::numeric_limits<double>::infinity();
  for (double& t : y) t = middle + half * t;
  return true;
}

}  // namespace tunica::thick_wall
