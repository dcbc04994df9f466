// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "assembly/whitening.hpp"
#include "uncertainty/valleys.hpp"

namespace tunica::uncertainty {

/// Whether a linearised interval can be believed: at both its ends (or at a bound that comes before), with the
/// parameter held there and the others fitted again by Gauss–Newton steps, −2 ln L should have risen by t² (at a bound
/// in proportion to the square of the distance). It holds when both rises are between a half and twice that: the ends
/// then are within some 40 % of where a profile would put them. A linearisation an end and more where it bends.
/// Constraints are kept on the way, by steps of constrained_step.hpp and an exact penalty, so that the border may bend,
/// or be left, as in a profile.
class Straightness {
 public:
  Straightness(const assembly::Assembly& assembly, const assembly::Whitening& noise, std::span<const double> free);
  /// At the lower end of the interval, side −1, or the upper one, 1; `half_width` in the unit box, `quantile` t.
  /// Threads: works in memory of its own, so that ends can be asked for side by side.
  [[nodiscard]] bool holds(Eigen::Index parameter, double side, double half_width, double quantile) const;

 private:
  /// The same with a workspace of its own.
  Straightness(const Straightness& other);
  void move_along(Eigen::Index parameter, double by, std::vector<double>& x) const;
  struct Between {
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };
  /// Least −2 ln L from x on, with one coordinate held; x is moved there. Infinity where nothing can be evaluated. It
  /// ends where the value at hand and the least one of the linear model are `settled` between two bounds.
  double fit(std::vector<double>& x, std::optional<Eigen::Index> held, const Between& settled);
  /// The step of Gauss and Newton from x in the coordinates `moving`; empty where the constraints allow none.
  Vector step(const std::vector<double>& x, const std::vector<Eigen::Index>& moving);
  /// −2 ln L at x, and the penalty of broken constraints; residuals, constraints and their Jacobians by the unit box.
  double linearise(const std::vector<double>& x);

  const assembly::Assembly& assembly_;
  const assembly::Whitening& noise_;
  assembly::WorkspacePointer workspace_;
  std::vector<double> free_, predictions_, by_free_, residuals_, jacobian_, constraints_, by_constraint_;
  double penalty_ = 0;                                      ///< of a unit of violation
  double violation_ = 0;                                    ///< at the last point
  bool here_ = false;                                       ///< whether that is where the last fit ended
  std::vector<double> centre_;                              ///< the optimum of the likelihood next to the point
  std::vector<double> centre_residuals_, centre_jacobian_;  ///< there; empty under constraints
  double least_;
};

}  // namespace tunica::uncertainty
