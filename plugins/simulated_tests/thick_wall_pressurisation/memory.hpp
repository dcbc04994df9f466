// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "elastic.hpp"

namespace tunica::thick_wall {

/// Derivatives along the path of a wall that remembers, carried forward from row to row (tunica/axis_step.hpp): by all
/// parameters of the one model, and by the test's own but the tethering.
///
/// Directions move the geometric variables of a row, and with them every point of the wall; the unknown y = ln ri
/// follows from the equilibrium of the row. The state of a point carries what a direction did to all rows before.
class MemoryDerivatives {
 public:
  /// Rows of a wall without support. `sector` is that of the elastic model; all have to outlive what follows.
  MemoryDerivatives(const Tube& tube, const Wall& wall, const Rule& rule, const SectorDerivative& sector,
                    const TestInput& input);

  /// At rest, where the state begins.
  Status begin();
  /// Row i, solved, `time_step` after the one before; writes its entries of the Jacobian.
  Status add(std::size_t i, const Row& row, double time_step, std::span<double> jacobian);

 private:
  /// A point of the wall: R² and its share of the quadrature, with their derivatives by the geometric variables.
  struct Point {
    Jet R2, weight;
    std::size_t layer;
  };
  using Variables = std::array<double, variable_count>;

  [[nodiscard]] double* of_point(std::size_t k) { return states_.data() + k * history_ * width_; }
  void set_row(std::size_t place, const Jet& value, double* row) const;
  void load(std::size_t k);
  Status evaluate();

  const Tube& tube_;
  const Wall& wall_;
  const Model& model_;
  std::span<const double> parameters_;
  std::size_t elastic_count_, history_, directions_, width_;
  bool first_ = true;
  std::vector<Variables> by_;  ///< of each direction; y follows from equilibrium
  std::vector<Point> points_;
  std::size_t n_;                                                                  ///< points, and one at rest
  std::vector<double> c_, energy_, gradient_, hessian_, gradient_dp_, energy_dp_;  ///< of all points, as AxisResponse
  std::vector<double> states_, c_rows_, g_rows_, energy_row_, p_, F_, w_, b_, y_by_;  ///< rows of `width_`
};

}  // namespace tunica::thick_wall
