// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tunica/model.hpp"

namespace tunica::controlled_strip {

/// A number with its derivatives by l = ln λ1 and y = ln λ2² at a fixed past.
struct Slope {
  double value = 0, by_l = 0, by_y = 0;
};

/// One point of an incompressible strip over time: its response at a trial state, and its history.
///
///     c = (e^{2l}, e^y, e^{−2l−y}),   σ = 2 (c1 g1 − c3 g3),   r = c2 g2 − c3 g3
///
/// with g_a = ½ S_aa along the strip (1), across it (2) and normal to the wall (3); r = 0 where the faces are free.
/// Models that can be followed in principal axes carry derivatives by their parameters forward, see AxisStep. Others
/// are asked on tensors and have none.
class StripPoint {
 public:
  /// `loaded` is the axis that the strip is pulled along, 0 or 1; `timed`: whether there is a clock. With
  /// `by_parameters`, derivatives are carried, by those of the model and by `others`, which the material feels through
  /// its path alone. Model and parameters outlive this.
  StripPoint(const Model& model, std::span<const double> parameters, std::size_t loaded, bool timed, bool by_parameters,
             std::size_t others = 0);

  /// Whether derivatives by parameters can be carried.
  static bool can_be_followed(const Model& model);

  /// The state at rest, before the first step. False where the model fails.
  bool begin();
  /// The response at (l, y), `time_step` after the last accepted state. False, or numbers that are not finite, where
  /// there is none.
  bool evaluate(double l, double y, double time_step, bool by_parameters = false);
  /// What evaluate() found.
  [[nodiscard]] const Slope& stress() const { return stress_; }
  [[nodiscard]] const Slope& lateral() const { return lateral_; }
  /// Derivatives of σ and r by parameter j at fixed (l, y), those through the past included.
  [[nodiscard]] double stress_by(std::size_t j) const { return stress_dp_[j]; }
  [[nodiscard]] double lateral_by(std::size_t j) const { return lateral_dp_[j]; }
  /// Makes the state of the last evaluate() the past of the next. What parameters do to l and y, where they are
  /// carried, is needed for its derivatives.
  void accept(std::span<const double> l_dp = {}, std::span<const double> y_dp = {});
  /// The reason of the last failure; may be empty.
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  bool on_axes(double time_step, bool at_rest, bool by_parameters);
  bool on_tensors(double time_step);
  void take_slopes(const std::array<const double*, 3>& g, std::size_t directions);

  static constexpr std::size_t moving = 2;  ///< directions l and y

  const Model &model_, &elastic_;
  std::span<const double> parameters_;
  std::array<std::size_t, 3> axis_;  ///< of the model: along, across, normal
  bool timed_, followed_, carries_, first_ = true;
  std::size_t elastic_count_, history_, carried_, full_;  ///< full_ = width of a row with parameters
  std::array<double, 3> c_{1, 1, 1};
  Slope stress_, lateral_;
  std::vector<double> stress_dp_, lateral_dp_;
  std::vector<double> past_, now_;  ///< rows of the state; `past_` has width full_ where derivatives are carried
  std::size_t now_width_ = 1;
  std::vector<double> c_rows_, energy_row_, g_rows_, gradient_dp_, energy_dp_;
  std::string failure_;
};

}  // namespace tunica::controlled_strip
