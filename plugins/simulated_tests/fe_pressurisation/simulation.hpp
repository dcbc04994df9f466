// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "curve.hpp"
#include "sensitivity.hpp"

namespace tunica::fe {

/// A tube as it is simulated: geometry and mesh in mm, how accurate and how long.
struct Tube {
  std::size_t order = 1, radial = 25, axial = 100;
  double inner = 0, outer = 0, length = 0, grading = 1.5;
  Ends ends = Ends::clamped;
  std::vector<double> interfaces = {};  ///< between layers with models of their own: fractions of the thickness
  double tolerance = 1e-6;   ///< of interpolated curves, of the outer radius; ten times that of the largest force
  std::size_t steps = 1000;  ///< load steps at most
  double time_limit = 60;    ///< s

  friend bool operator==(const Tube&, const Tube&) = default;
};

Mesh mesh_of(const Tube& tube);
/// The support that begins to act at a state without pressure.
Support support_of(const Solver& solver, const State& free, double slope);

/// Observed at each load, with derivatives on demand. Loads of the same axial stretch lie on a line of pressures, which
/// is solved at Chebyshev points where that takes fewer solutions than rows. Their number is doubled until the curve is
/// as accurate as the tolerance says; else the rows are solved.
class Simulation {
 public:
  explicit Simulation(const Tube& tube);

  [[nodiscard]] const Tube& tube() const { return tube_; }
  [[nodiscard]] Solver& solver() { return solver_; }

  /// `samples` has one entry a load, with the `derivatives` asked for. `failed_at` is the first load not reached, in
  /// the order of the line. `support` is the slope of the support from outside, kPa/mm.
  Status run(const Material& material, std::span<const Load> loads, const Wanted& derivatives,
             std::vector<Sample>& samples, std::size_t& failed_at, double support = 0);
  [[nodiscard]] std::size_t solutions() const { return solutions_; }
  /// The state that the last run ended with.
  [[nodiscard]] const State& last() const { return last_; }

 private:
  Status line(Path& path, const Path::Mark& trunk, std::span<const Load> loads, std::span<const std::size_t> rows,
              std::vector<Sample>& samples, std::size_t& failed_at);
  Status interpolated(Path& path, const Path::Mark& trunk, std::span<const Load> loads,
                      std::span<const std::size_t> rows, std::size_t points, std::vector<Sample>& nodes,
                      std::vector<Sample>& samples, std::size_t& failed_at, std::array<double, 3>& errors);
  Status take(Path& path, const Load& load, Sample& sample);

  Tube tube_;
  Solver solver_;
  Sensitivity sensitivity_;
  Wanted wanted_{};
  bool derivatives_ = false;
  std::size_t solutions_ = 0;
  State last_;
};

}  // namespace tunica::fe
