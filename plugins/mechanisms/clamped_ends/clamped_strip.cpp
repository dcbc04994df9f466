// SPDX-License-Identifier: Apache-2.0
#include "clamped_strip.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tunica/detail/compressible_prediction.hpp"

namespace tunica::clamped_ends {
namespace {

constexpr std::size_t places_a_side = 8;
constexpr std::size_t elements_across = 6, most_along = 48;

plane::Shape shape_of(const Size& size) {
  plane::Shape shape;
  shape.length = size.length;
  shape.width = size.width;
  return shape;
}

plane::Mesh mesh_of(const Size& size, bool quarter) {
  const auto along = static_cast<std::size_t>(std::lround(elements_across * size.length / size.width));
  return plane::mesh_of(shape_of(size), std::clamp<std::size_t>(along, 4, most_along), elements_across, quarter);
}

/// Chebyshev's points between rest and `end`.
void add_places(double end, std::vector<double>& places) {
  for (std::size_t k = 0; k < places_a_side; ++k)
    places.push_back(1 + 0.5 * (end - 1) *
                             (1 - std::cos((static_cast<double>(k) + 0.5) * std::numbers::pi / places_a_side)));
}

}  // namespace

ClampedStrip::ClampedStrip(const Size& size, std::array<double, 2> along, bool angled,
                           std::span<const double> stretches)
    : size_(size), along_(along), angled_(angled) {
  constexpr double least = 1e-3;  // strains below it are errors of the zero
  const auto [low, high] = std::minmax_element(stretches.begin(), stretches.end());
  if (*high > 1 + least) add_places(*high, places_);
  pulled_ = places_.size();
  if (*low < 1 - least) add_places(*low, places_);
}

std::shared_ptr<const plane::Body> ClampedStrip::body(bool quarter) const {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const plane::Body>& made = bodies_[quarter ? 1 : 0];
  if (made == nullptr)
    made = std::make_shared<const plane::Body>(shape_of(size_), mesh_of(size_, quarter), plane::Ends::clamped);
  return made;
}

/// The distance of two points on an axis, `size` apart, over that unloaded.
plane::Gauge ClampedStrip::gauge(const plane::Body& body, std::size_t axis, double size) const {
  plane::Gauge gauge;
  gauge.kind = plane::Gauge::Kind::stretch;
  for (const double sign : {1.0, -1.0}) {
    plane::Vector mark{0, 0};
    mark[axis] = sign * size / 2;
    for (const auto& [dof, weight] : body.displacement(mark, axis))
      gauge.reading.emplace_back(dof, sign * weight / size);
  }
  return gauge;
}

/// Whether stretches along x and y cause no shear in the material. A quarter then represents the whole strip.
bool ClampedStrip::is_symmetric(const TestInput& input, bool compressible) const {
  if (angled_) return false;
  const std::size_t sides = 3, n = sides * places_.size();
  plane::Membrane membrane(input.model, input.model_parameters, along_,
                           compressible ? plane::Faces::free : plane::Faces::incompressible);
  membrane.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double x = places_[i / sides], y = std::pow(x, -0.5 * static_cast<double>(i % sides));
    membrane.C[i] = x * x;
    membrane.C[n + i] = y * y;
  }
  if (!membrane.evaluate(false, false)) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (std::abs(membrane.stress[2 * n + i]) >
        1e-10 * (std::abs(membrane.stress[i]) + std::abs(membrane.stress[n + i])))
      return false;
  return true;
}

Status ClampedStrip::differences(const TestInput& input, const TestOutput& output) const {
  if (places_.empty()) {
    std::fill(output.values.begin(), output.values.end(), 0.0);
    std::fill(output.jacobian.begin(), output.jacobian.end(), 0.0);
    return {};
  }
  return free_faces::by_volume(
      input, output, [this](const TestInput& at, const TestOutput& out) { return solve(at, out, false); },
      [this](const TestInput& at, const TestOutput& out) { return solve(at, out, true); });
}

Status ClampedStrip::solve(const TestInput& input, const TestOutput& output, bool compressible) const {
  if (Status status = clamped(input, output, compressible); !status.ok()) return status;
  return subtract_homogeneous(input, output, compressible);
}

Status ClampedStrip::clamped(const TestInput& input, const TestOutput& output, bool compressible) const {
  const auto used = body(is_symmetric(input, compressible));
  const std::size_t n = places_.size(), size = channels * n, count = input.model_parameters.size();
  std::array<plane::Gauge, channels> read{plane::Gauge{}, gauge(*used, 1, size_.width)};
  read[force].area = size_.width;
  const plane::Gauge marks = size_.gauge > 0 ? gauge(*used, 0, size_.gauge) : plane::Gauge{};
  const plane::Gauge* const driver = size_.gauge > 0 ? &marks : nullptr;
  std::optional<plane::Pulling> pulling;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == 0 || i == pulled_) pulling.emplace(*used, input.model, input.model_parameters, along_, compressible);
    const double x = places_[i];
    const auto problem = pulling->move_to(driver == nullptr ? (x - 1) * size_.length : x, driver);
    if (problem) return Status::failed("clamped_ends: at stretch " + std::to_string(x) + ": " + *problem);
    for (std::size_t k = 0; k < channels && !output.values.empty(); ++k)
      output.values[k * n + i] = pulling->value(read[k]);
    if (output.jacobian.empty()) continue;
    if (!pulling->linearise(true, driver))
      return Status::failed("clamped_ends: the stiffness is singular at stretch " + std::to_string(x) +
                            "; narrow the bounds of the model's parameters");
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t k = 0; k < channels; ++k)
        output.jacobian[j * size + k * n + i] = pulling->by_parameter(read[k], j);
  }
  return {};
}

/// The strip that contracts alike everywhere and does not shear: S̄_yy(C_xx = λ², C_yy, C_xy = 0) = 0, with
///
///     P = λ S̄_xx,   dC_yy/dθ = −∂S̄_yy/∂θ / ½𝔸_yyyy,   dP/dθ = λ (∂S̄_xx/∂θ + ½𝔸_xxyy dC_yy/dθ),   𝔸 = 2 ∂S̄/∂C̄
Status ClampedStrip::subtract_homogeneous(const TestInput& input, const TestOutput& output, bool compressible) const {
  const std::size_t n = places_.size(), size = channels * n, count = input.model_parameters.size();
  const bool with_parameters = !output.jacobian.empty();
  plane::Membrane strip(input.model, input.model_parameters, along_,
                        compressible ? plane::Faces::free : plane::Faces::incompressible);
  strip.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    strip.C[i] = places_[i] * places_[i];
    strip.C[n + i] = 1 / places_[i];
  }
  const auto stiffness = [&](std::size_t a, std::size_t i) { return 0.5 * strip.tangent[(3 * a + 1) * n + i]; };
  bool settled = false;
  for (int iteration = 0; iteration < 50 && !settled; ++iteration) {
    if (!strip.evaluate(true, false)) break;
    settled = true;
    for (std::size_t i = 0; i < n; ++i) {
      const double C = strip.C[n + i], step = -strip.stress[n + i] / (C * stiffness(1, i));  // of ln C_yy
      settled = settled && std::abs(step) < 1e-12;
      strip.C[n + i] = C * std::exp(std::clamp(step, -0.5, 0.5));
    }
  }
  if (!settled || !strip.evaluate(true, with_parameters))
    return Status::failed(
        "clamped_ends: the homogeneous strip finds no equilibrium; narrow the bounds of the model's parameters");
  for (std::size_t i = 0; i < n; ++i) {
    const double x = places_[i], y = std::sqrt(strip.C[n + i]);
    if (!output.values.empty()) {
      output.values[force * n + i] -= x * strip.stress[i];
      output.values[width * n + i] -= y;
    }
    for (std::size_t j = 0; with_parameters && j < count; ++j) {
      const double by_C = -strip.stress_dp[(3 * j + 1) * n + i] / stiffness(1, i);
      output.jacobian[j * size + force * n + i] -= x * (strip.stress_dp[3 * j * n + i] + stiffness(0, i) * by_C);
      output.jacobian[j * size + width * n + i] -= by_C / (2 * y);
    }
  }
  return {};
}

/// Lagrange's polynomials over the places on the same side of rest:
///
///     ℓ_k(x) = Π_{m≠k} (x − x_m)/(x_k − x_m),   ℓ_k'(x) = Σ_{l≠k} 1/(x_k − x_l) Π_{m≠k,l} (x − x_m)/(x_k − x_m)
ClampedStrip::Weights ClampedStrip::weights(double stretch) const {
  const std::size_t n = places_.size();
  Weights found{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  const bool pulled = pulled_ == n || (pulled_ > 0 && stretch >= 1);
  const std::size_t first = pulled ? 0 : pulled_, last = pulled ? pulled_ : n;
  for (std::size_t k = first; k < last; ++k) {
    double& weight = found.of_place[k] = 1;
    for (std::size_t l = first; l < last; ++l) {
      if (l == k) continue;
      weight *= (stretch - places_[l]) / (places_[k] - places_[l]);
      double slope = 1 / (places_[k] - places_[l]);
      for (std::size_t m = first; m < last; ++m)
        if (m != k && m != l) slope *= (stretch - places_[m]) / (places_[k] - places_[m]);
      found.slope[k] += slope;
    }
  }
  return found;
}

}  // namespace tunica::clamped_ends
