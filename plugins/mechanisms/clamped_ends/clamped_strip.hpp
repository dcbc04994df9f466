// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "../../simulated_tests/plane_specimen/pulling.hpp"
#include "tunica/test.hpp"

namespace tunica::clamped_ends {

/// Lengths of a strip in mm.
struct Size {
  double length = 0, width = 0;
  double gauge = 0;  ///< distance of the marks that the stretch is measured between; 0 = of the clamps
};

/// What clamps change of a strip: force over unloaded section, kPa, and stretch of the width in the middle, less those
/// of the homogeneous strip at the same stretch.
///
/// A plane-stress mesh of the strip is pulled to a few stretches between rest and the ends of the range, with the model
/// itself. Between them a polynomial stands for the difference, which is smooth. Six elements across give it to about a
/// thirtieth.
class ClampedStrip {
 public:
  enum Channel : std::size_t { force, width };
  static constexpr std::size_t channels = 2;

  /// `along`: the pulled direction in the material axes t and z. `angled`: whether it is none of the two.
  ClampedStrip(const Size& size, std::array<double, 2> along, bool angled, std::span<const double> stretches);

  /// The stretches that are simulated.
  [[nodiscard]] const std::vector<double>& places() const { return places_; }
  /// The differences there, channel by channel, and their derivatives by the model's parameters, as TestOutput has
  /// them. Fails where the mesh finds no equilibrium.
  Status differences(const TestInput& input, const TestOutput& output) const;

  /// How much each place weighs at a stretch, and the slopes of these weights.
  struct Weights {
    std::vector<double> of_place, slope;
  };
  [[nodiscard]] Weights weights(double stretch) const;

 private:
  Status solve(const TestInput& input, const TestOutput& output, bool compressible) const;
  Status clamped(const TestInput& input, const TestOutput& output, bool compressible) const;
  Status subtract_homogeneous(const TestInput& input, const TestOutput& output, bool compressible) const;
  [[nodiscard]] bool is_symmetric(const TestInput& input, bool compressible) const;
  [[nodiscard]] std::shared_ptr<const plane::Body> body(bool quarter) const;
  [[nodiscard]] plane::Gauge gauge(const plane::Body& body, std::size_t axis, double size) const;

  Size size_;
  std::array<double, 2> along_;
  bool angled_;
  std::vector<double> places_;  ///< above 1 and rising, then below 1 and falling
  std::size_t pulled_ = 0;      ///< how many are above 1
  mutable std::mutex mutex_;
  mutable std::array<std::shared_ptr<const plane::Body>, 2> bodies_;  ///< the whole, a quarter
};

}  // namespace tunica::clamped_ends
