// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <vector>

#include "assembly.hpp"
#include "factor.hpp"

namespace tunica::fe {

/// max |x_i|. Not finite where an entry is not.
inline double largest(std::span<const double> x) {
  double value = 0, sum = 0;
  for (const double entry : x) {
    value = std::max(value, std::abs(entry));
    sum += entry;
  }
  return std::isfinite(sum) ? value : sum;
}

/// Σ a_i b_i, in sums that do not wait for each other.
inline double dot(std::span<const double> a, std::span<const double> b) {
  constexpr std::size_t sums = 8;
  double partial[sums] = {}, rest = 0;
  std::size_t i = 0;
  for (; i + sums <= a.size(); i += sums)
    for (std::size_t k = 0; k < sums; ++k) partial[k] += a[i + k] * b[i + k];
  for (; i < a.size(); ++i) rest += a[i] * b[i];
  for (const double sum : partial) rest += sum;
  return rest;
}

/// What holds the tube: its ends at `stretch` times their distance, and a pressure in the lumen, kPa.
struct Load {
  double stretch = 1, pressure = 0;
};

/// The purpose of a solution.
enum class Aim {
  state,   ///< nothing beside
  factor,  ///< the factor of a state nearby, too
  weights  ///< that for weigh(), which makes up for a state that is good to 1e-9 alone
};

/// What solutions took since begin(), and the last of them.
struct Effort {
  std::size_t factorisations = 0, iterations = 0;
  std::vector<double> steps;  ///< the largest |dx| of each iteration over the outer radius, of the last solution
};

/// Newton's method on one mesh. Prescribed are z at both ends and, where the ends are held, r at the far one.
///
/// A step assembles and factorises until the state moves by less than 1e-3 of the radius; from there on the last factor
/// serves, while each of its steps is three tenths of the one before at most: a residual costs a fifth of a factor.
/// Where a factor is wanted the last one is of a state within 2e-5 of the solution.
class Solver {
 public:
  static constexpr double tolerance = 1e-11;  ///< of the positions, over the outer radius

  explicit Solver(const Mesh& mesh);
  Solver(const Solver&) = delete;
  Solver& operator=(const Solver&) = delete;
  /// Of memory that it takes, as far as it grows with the mesh.
  static double bytes(const Mesh& mesh);
  /// Observables that weigh() is asked for at most: each takes as much memory as the mesh.
  static std::size_t together(const Mesh& mesh);

  [[nodiscard]] const Mesh& mesh() const { return mesh_; }
  [[nodiscard]] const State& rest() const { return rest_; }
  Assembly& assembly() { return *assembly_; }

  /// Begins with another material, which must outlive what follows.
  Status begin(const Material& material);
  void hold_ends(bool held) { held_ = held; }
  /// r at the far end, where it is held from now on: that of `state`.
  void hold_at(const State& state);
  /// A deadline after which solutions fail.
  void set_deadline(std::chrono::steady_clock::time_point deadline) { deadline_ = deadline; }
  void set_time_limit(double seconds) {
    using std::chrono::duration, std::chrono::steady_clock;
    set_deadline(steady_clock::now() + std::chrono::duration_cast<steady_clock::duration>(duration<double>(seconds)));
  }

  /// Improves `state`, on which the prescribed positions are imposed first, until it is in equilibrium.
  Status solve(const Load& load, State& state, Aim aim);
  /// The same with the volume of the lumen given (of half the tube, over 2π, mm³) and the pressure found, which begins
  /// with that of `load`: there is a solution also where the pressure hardly rises any more, or falls.
  Status solve_volume(double volume, Load& load, State& state);
  /// ½ ∫ r² dz of a state that was solved for.
  [[nodiscard]] double volume(const State& state) const;
  /// Of the factor at hand: 0 where the equilibrium is stable.
  [[nodiscard]] std::size_t negative_pivots() const { return negative_; }
  [[nodiscard]] bool late() const { return std::chrono::steady_clock::now() > deadline_; }
  [[nodiscard]] const Effort& effort() const { return effort_; }
  [[nodiscard]] const System& system() const { return system_; }

  /// The derivative of the solution by what adds −`right` to ∂Π/∂x at a fixed state and moves the prescribed positions
  /// by `moved` (all nodes, zero elsewhere). What is empty adds nothing, or moves nothing.
  void derive(std::span<const double> right, std::span<const double> moved, State& derivative);
  /// `right` by the pressure, ∂V/∂x; `moved` by the axial stretch.
  [[nodiscard]] std::span<const double> by_pressure() const { return system_.volume; }
  [[nodiscard]] std::span<const double> by_stretch() const { return end_moved_; }

  /// The weights of some entries of State::x and, on demand, last of all of the axial force at a solution, by the
  /// adjoint of the equations: whatever the number of parameters. `moved` counts at the end alone. With a factor of a
  /// state nearby they are refined until they are exact to 1e-9; fails where that comes to nothing. `changes` are of
  /// the equations there.
  Status weigh(const Load& load, const State& state, std::span<const std::size_t> positions, bool axial_force,
               std::vector<Weights>& weights, Changes& changes);
  /// After weigh(), what the observables of the solution that the state nearly is have more than those of the state, to
  /// second order of what is left to it. The axial force has it in place of all but the support.
  [[nodiscard]] std::span<const double> defects() const { return defects_; }
  [[nodiscard]] double force_of_support() const { return -2 * std::numbers::pi * middle_support_; }
  [[nodiscard]] std::size_t outer() const { return 2 * (mesh_.across() - 1); }  ///< r there at mid-length, in State::x
  [[nodiscard]] std::size_t inner() const { return 0; }

  /// Reduced axial force in mN: −2π Σ ∂Π/∂z over the plane of symmetry, the derivative of Π by its position, less what
  /// the support stores there.
  [[nodiscard]] double axial_force() const { return -2 * std::numbers::pi * (middle_force_ + middle_support_); }
  [[nodiscard]] double outer_radius(const State& state) const { return state.x[outer()]; }
  [[nodiscard]] double inner_radius(const State& state) const { return state.x[inner()]; }

 private:
  void impose(const Load& load, State& state) const;
  Status iterate(const Load& load, State& state, Aim aim);
  Status iterate_volume(double volume, Load& load, State& state);
  /// False where the deadline came first.
  bool factorise();
  void move(State& state, bool mixed);
  void begin_adjoint(std::span<const std::size_t> positions, bool axial_force);
  Status refine_adjoint(const Load& load, const State& state, std::span<const std::size_t> positions, Changes* changes,
                        double& step);
  void add_observable(std::span<const std::size_t> positions, std::size_t k, std::span<double> to) const;
  void add_own(std::span<const std::size_t> positions, std::size_t k, std::span<double> x) const;
  void solve_rights();
  void note_force();
  void note_support(const State& state);
  /// Sets prescribed entries to zero.
  void prescribe(std::span<double> dx) const;

  Mesh mesh_;
  std::unique_ptr<Assembly> assembly_;
  const Material* material_ = nullptr;
  State rest_;
  std::vector<double> held_radius_;  ///< r at the far end, where it is held
  std::vector<double> end_moved_;    ///< ∂x/∂λz of the prescribed positions
  System system_;
  Factor factor_;
  std::vector<std::size_t> fixed_;           ///< positions that are prescribed
  std::vector<State> adjoint_, multiplied_;  ///< of each observable, and what the equations make of it
  State residual_;
  std::vector<std::vector<double>> rights_, moved_ends_;
  std::vector<double> defects_;
  std::vector<double> dx_, dq_, product_, middle_;  ///< middle_: the sum of the matrix's rows of z at mid-length
  double middle_force_ = 0;                         ///< Σ ∂Π/∂z there after the last step
  double middle_support_ = 0, middle_pressed_ = 0;  ///< h of the support there and h'(r), after the last solution
  State step_, moved_;                              ///< the last step and what it came to
  bool mixes_ = false;
  std::size_t negative_ = 0;
  bool held_ = true, has_factor_ = false;
  std::chrono::steady_clock::time_point deadline_ = std::chrono::steady_clock::time_point::max();
  Effort effort_;
};

}  // namespace tunica::fe
