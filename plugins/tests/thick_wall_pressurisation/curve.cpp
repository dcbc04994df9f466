// SPDX-License-Identifier: Apache-2.0
#include "curve.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "tunica/detail/vector_level.hpp"

namespace tunica::thick_wall {
namespace {

constexpr std::size_t count = 8;         ///< samples in a batch
constexpr double sampling_step = 0.08;   ///< of y, between samples that look for the highest pressure
constexpr int batches = 3;               ///< of those
constexpr double beyond_samples = 0.02;  ///< of y: how far the polynomial may be taken beyond its samples
constexpr double least_range = 1e-6;     ///< of y

struct Sample {
  double y, p, p_y;
};
using Samples = std::array<Sample, count>;

bool sample(double axial_stretch, Sections& sections, Samples& at) {
  std::array<Section, count> batch;
  for (std::size_t k = 0; k < count; ++k) batch[k] = {axial_stretch, at[k].y};
  if (!sections.evaluate(batch, false).ok()) return false;
  for (std::size_t k = 0; k < count; ++k) {
    const WallForces forces = sections.forces(k);
    at[k].p = forces.p;
    at[k].p_y = forces.p_y;
  }
  return true;
}

bool sound(const Sample& at) { return std::isfinite(at.p) && std::isfinite(at.p_y) && at.p_y > 0; }

/// y between two samples, cubic in p.
double between(const Sample& a, const Sample& b, double p) {
  const double h = b.p - a.p, t = (p - a.p) / h, left = 1 - t;
  return left * left * ((1 + 2 * t) * a.y + t * h / a.p_y) + t * t * ((3 - 2 * t) * b.y - left * h / b.p_y);
}

/// y where the pressure is `highest`, roughly; false where no sample in reach has it, or the curve falls before.
bool reach(const Equilibrium& free, double highest, Sections& sections, double& end) {
  Samples at;
  Sample before{};
  for (int batch = 0; batch < batches; ++batch) {
    for (std::size_t k = 0; k < count; ++k)
      at[k].y = free.y + sampling_step * static_cast<double>(static_cast<std::size_t>(batch) * count + k);
    if (!sample(free.axial_stretch, sections, at)) return false;
    for (std::size_t k = 0; k < count; before = at[k], ++k) {
      if (!sound(at[k])) return false;
      if (at[k].p < highest) continue;
      end = batch == 0 && k == 0 ? at[k].y : std::clamp(between(before, at[k], highest), before.y, at[k].y);
      return true;
    }
  }
  return false;
}

/// Hermite's polynomial in Newton's form, every sample counting twice.
struct Polynomial {
  static constexpr std::size_t terms = 2 * count;
  std::array<double, terms> at, divided;

  explicit Polynomial(const Samples& samples) {
    for (std::size_t k = 0; k < count; ++k) {
      at[2 * k] = at[2 * k + 1] = samples[k].y;
      divided[2 * k] = divided[2 * k + 1] = samples[k].p;
    }
    for (std::size_t order = 1; order < terms; ++order)
      for (std::size_t k = terms; k-- > order;)
        divided[k] =
            order == 1 && k % 2 == 1 ? samples[k / 2].p_y : (divided[k] - divided[k - 1]) / (at[k] - at[k - order]);
  }

  /// Newton's method from `y`, over lanes.
  void solve(std::span<const double> pressure, std::span<double> y) const {
    constexpr int iterations = 2;
    detail::vectorised([this, p = pressure.data(), root = y.data(), n = y.size()] {
      for (int iteration = 0; iteration < iterations; ++iteration) {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          double value = divided[terms - 1], slope = 0;
          for (std::size_t k = terms - 1; k-- > 0;) {
            const double distance = root[i] - at[k];
            slope = slope * distance + value;
            value = value * distance + divided[k];
          }
          root[i] += (p[i] - value) / slope;
        }
      }
    });
  }
};

}  // namespace

bool find_on_curve(const Equilibrium& free, std::span<const double> pressure, Sections& sections, std::span<double> y,
                   double& error) {
  const auto [lowest, highest] = std::minmax_element(pressure.begin(), pressure.end());
  double end;
  if (!reach(free, *highest, sections, end) || !(end - free.y > least_range)) return false;
  // Chebyshev's points of the first kind
  Samples at;
  for (std::size_t k = 0; k < count; ++k)
    at[k].y = 0.5 * (free.y + end) -
              0.5 * (end - free.y) * std::cos((2 * static_cast<double>(k) + 1) / (2 * count) * std::numbers::pi);
  if (!sample(free.axial_stretch, sections, at)) return false;
  for (std::size_t k = 0; k < count; ++k)
    if (!sound(at[k]) || (k > 0 && !rises(at[k].p - at[k - 1].p, at[k].y - at[k - 1].y, at[k - 1].p_y, at[k].p_y)))
      return false;
  if (!((at.front().p - *lowest) / at.front().p_y < beyond_samples) ||
      !((*highest - at.back().p) / at.back().p_y < beyond_samples))
    return false;
  for (std::size_t k = 0; k < count; ++k) error = std::max(error, sections.pressure_error(k) / at[k].p_y);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    std::size_t k = 1;
    while (k + 1 < count && at[k].p < pressure[i]) ++k;
    y[i] = between(at[k - 1], at[k], pressure[i]);
  }
  Polynomial(at).solve(pressure, y);
  const auto near = [low = free.y - beyond_samples, high = end + beyond_samples](double root) {
    return root > low && root < high;
  };
  return std::all_of(y.begin(), y.end(), near);
}

}  // namespace tunica::thick_wall
