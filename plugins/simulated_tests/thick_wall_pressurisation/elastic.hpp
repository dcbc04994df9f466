// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "path.hpp"
#include "sector.hpp"

namespace tunica::thick_wall {

/// One row, solved: equilibrium at y with a correction `step` that is so small that it need not be evaluated again but
/// is applied to first order.
struct Row {
  double axial_stretch = 1, pressure = 0;
  double y = 0, step = 0;
  std::size_t free_row = 0;  ///< which of the unpressurised states is that of its axial stretch
  double support_free = 0;   ///< outer radius there, where there is support
  WallForces forces{};
};

/// All rows of an elastic material, and where they are needed the unpressurised states at their axial stretches.
struct Solution {
  std::vector<Row> free_rows, rows;
  bool force = true;  ///< whether rows are to have their axial force
  double error = 0;   ///< estimate of what quadrature leaves in y, the largest of all
};

/// Finds every row on the path from rest; then, where the curve through samples is not exact enough, Newton's method on
/// all of them at once. Where quadrature is seen to leave more than `enough` in y before that, it is left out: `error`
/// says so, and refine_rows() is called with a finer rule.
Status solve_rows(std::span<const double> pressure, std::span<const double> axial_stretch, bool want_free_rows,
                  Sections& sections, const Wall& wall, double enough, Solution& solution);
/// The same rows with another rule, from where they are.
Status refine_rows(bool want_free_rows, Sections& sections, const Wall& wall, Solution& solution);

/// Takes up the steps left and evaluates once more; `sections` then holds these rows.
Status evaluate_rows(std::vector<Row>& rows, const Sections::Wants& wants, Sections& sections, const Wall& wall);

/// Lets `error` grow to the largest estimate of what quadrature leaves in y of rows that have just been evaluated.
void note_error(const std::vector<Row>& rows, Sections& sections, double& error);

/// Jacobian by model and own parameters, and derivatives by the abscissae: implicit differentiation of the equilibrium
/// of every row, of its unpressurised state and of the closing of the sector. The rows have been evaluated with
/// parameters last. Empty spans are not wanted. `solution.error` is then that of this rule.
Status differentiate(const Tube& tube, const Wall& wall, const SectorDerivative& sector, Solution& solution,
                     Sections& sections, std::size_t model_parameters, std::span<double> jacobian,
                     std::span<double> abscissa_derivative);

/// A material without history: all of the above, with the coarsest rule that is good to 1e-12 of the radius, or with
/// the one that was asked for. Values are the same with derivatives and without; derivatives may have a coarser rule.
Status predict_elastic(const Tube& tube, const Rule* rule, const TestInput& input, const TestOutput& output);

/// Pressure and axial stretch of every row, abscissae corrected by mechanisms and by the axial stretch error.
Status prescribed(const Tube& tube, const TestInput& input, std::vector<double>& pressure,
                  std::vector<double>& axial_stretch);
/// Values and diagnostics of solved rows; a status where one is not finite.
Status write_rows(const Tube& tube, const Wall& wall, std::span<const Row> rows, const TestOutput& output);

}  // namespace tunica::thick_wall
