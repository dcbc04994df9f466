// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tunica/detail/safeguarded_newton.hpp"
#include "tunica/model.hpp"

/// The incompressible strip pulled along a material axis with free lateral faces: its equilibrium path, all rows at
/// once, for models with a principal-axes path.
///
/// With the squared stretches c = (λ1², u = λ2², 1/(λ1² u)) and g_a = ∂W/∂c_a:
///     σ11 = 2 (c1 g1 − c3 g3),   0 = r = 2 (u g2 − c3 g3)       (physics: docs/theory.md, uniaxial strip)
/// Newton's method on r(y), y = ln u, runs over a whole batch.
namespace tunica::free_strip {

/// A relative step of λ2² this small may be applied to first order: the error left behind is its square.
inline constexpr double last_step = 1e-6;
/// Of a batch; rows that need more are solved one by one.
inline constexpr int newton_iterations = 12;
/// The message about a row without equilibrium.
inline constexpr const char* lost_row =
    "no lateral equilibrium: the energy overflows or has no stationary point on the path from rest";

/// Positions of the Hessian components (a, b) in the order tt, zz, rr, tz, zr, tr.
inline constexpr std::array<std::array<std::size_t, 3>, 3> pair{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

/// The material and the axis it is pulled along: 0 = circumferential, 1 = axial.
struct Pull {
  const Model& model;                                                  ///< with a principal-axes path
  std::span<const double> parameters;                                  ///< of the model
  std::size_t loaded;                                                  ///< the axis
  [[nodiscard]] std::size_t transverse() const { return 1 - loaded; }  ///< the free axis in the plane
};

/// Scratch for one call at a time: callers keep one a thread. It grows to the largest batch seen and then allocates
/// nothing.
struct Scratch {
  std::vector<double> c,          ///< squared stretches, as AxisPoints::c
      gradient,                   ///< as in AxisResponse
      hessian,                    ///< as in AxisResponse
      gradient_dp,                ///< as in AxisResponse
      u,                          ///< λ2²
      step,                       ///< of Newton in y = ln u
      stress,                     ///< σ11, kPa
      slope,                      ///< ½ ∂r/∂y
      stress_by_y,                ///< ∂σ11/∂y
      ratio;                      ///< stress_by_y/slope
  std::vector<std::size_t> open;  ///< rows that the batch iteration left unsolved
  /// Room for n rows and that many parameters; never shrinks.
  void reserve(std::size_t n, std::size_t parameters) {
    if (step.size() < n) {
      for (auto* v : {&u, &step, &stress, &slope, &stress_by_y, &ratio}) v->resize(n);
      c.resize(3 * n);
      gradient.resize(3 * n);
      hessian.resize(6 * n);
    }
    if (gradient_dp.size() < 3 * n * parameters) gradient_dp.resize(3 * n * parameters);
  }
};

/// One batch of squared stretches through the model: lateral residual, its slope and the Newton step in y = ln u.
class Batch {
 public:
  /// For rows of these stretches; spans and scratch must outlive it.
  Batch(const Pull& pull, std::span<const double> stretch, Scratch& scratch)
      : pull_(pull), n_(stretch.size()), s_(scratch), stretch_(stretch), l_(pull.loaded), t_(pull.transverse()) {
    s_.reserve(n_, pull.parameters.size());
  }

  /// Evaluates at u; afterwards step, stress, slope, stress_by_y hold their values for every row.
  Status evaluate(const double* __restrict u, bool parameters) {
    double* __restrict c1 = s_.c.data() + l_ * n_;
    double* __restrict c2 = s_.c.data() + t_ * n_;
    double* __restrict c3 = s_.c.data() + 2 * n_;
    const double* __restrict stretch = stretch_.data();
    for (std::size_t i = 0; i < n_; ++i) {
      c1[i] = stretch[i] * stretch[i];
      c2[i] = u[i];
      c3[i] = 1 / (c1[i] * u[i]);
    }
    Status status =
        pull_.model.evaluate_axes({n_, {s_.c.data(), 3 * n_}, pull_.parameters},
                                  {{},
                                   {s_.gradient.data(), 3 * n_},
                                   {s_.hessian.data(), 6 * n_},
                                   {s_.gradient_dp.data(), parameters ? 3 * n_ * pull_.parameters.size() : 0}});
    if (!status.ok()) return status;
    const double* __restrict g1 = g(l_);
    const double* __restrict g2 = g(t_);
    const double* __restrict g3 = g(2);
    const double* __restrict h12 = h(l_, t_);
    const double* __restrict h13 = h(l_, 2);
    const double* __restrict h22 = h(t_, t_);
    const double* __restrict h23 = h(t_, 2);
    const double* __restrict h33 = h(2, 2);
    double* __restrict stress = s_.stress.data();
    double* __restrict slope = s_.slope.data();
    double* __restrict by_y = s_.stress_by_y.data();
    double* __restrict step = s_.step.data();
    for (std::size_t i = 0; i < n_; ++i) {
      // ∂c2/∂y = c2, ∂c3/∂y = −c3
      const double inner = c3[i] * (g3[i] + c3[i] * h33[i]);
      const double cross = c2[i] * c3[i] * h23[i];
      const double r = c2[i] * g2[i] - c3[i] * g3[i];
      slope[i] = c2[i] * (g2[i] + c2[i] * h22[i]) - 2 * cross + inner;
      stress[i] = 2 * (c1[i] * g1[i] - c3[i] * g3[i]);
      by_y[i] = 2 * (c1[i] * (c2[i] * h12[i] - c3[i] * h13[i]) - cross + inner);
      step[i] = -r / slope[i];
    }
    return {};
  }

  /// Total derivatives by l = ln λ1 along the free path: of the stress, and of y.
  void by_stretch(std::size_t i, double& stress_by_l, double& y_by_l) const {
    const double c1 = s_.c[l_ * n_ + i], c2 = s_.c[t_ * n_ + i], c3 = s_.c[2 * n_ + i];
    const double g3 = g(2)[i], h13 = h(l_, 2)[i], h33 = h(2, 2)[i];
    // ∂c1/∂l = 2 c1, ∂c3/∂l = −2 c3 at fixed y
    const double outer = 2 * c3 * (g3 - c1 * h13 + c3 * h33);
    const double r_l = c2 * (2 * c1 * h(l_, t_)[i] - 2 * c3 * h(t_, 2)[i]) + outer;
    const double stress_l = 2 * (c1 * (2 * g(l_)[i] + 2 * c1 * h(l_, l_)[i] - 2 * c3 * h13) + outer);
    y_by_l = -r_l / s_.slope[i];
    stress_by_l = stress_l + s_.stress_by_y[i] * y_by_l;
  }

  /// The same for every row at once, stress only: dσ/dp = ∂σ/∂p − (∂σ/∂y / ∂r/∂y) ∂r/∂p.
  void stress_by_parameter(std::size_t j, double* __restrict column) {
    const double* __restrict gp1 = s_.gradient_dp.data() + (3 * j + l_) * n_;
    const double* __restrict gp2 = s_.gradient_dp.data() + (3 * j + t_) * n_;
    const double* __restrict gp3 = s_.gradient_dp.data() + (3 * j + 2) * n_;
    const double* __restrict c1 = s_.c.data() + l_ * n_;
    const double* __restrict c2 = s_.c.data() + t_ * n_;
    const double* __restrict c3 = s_.c.data() + 2 * n_;
    const double* __restrict ratio = s_.ratio.data();
    for (std::size_t i = 0; i < n_; ++i)
      column[i] = 2 * (c1[i] * gp1[i] - c3[i] * gp3[i]) - ratio[i] * (c2[i] * gp2[i] - c3[i] * gp3[i]);
  }
  /// To be called once after evaluate(u, true), before stress_by_parameter().
  void prepare_parameters() {
    for (std::size_t i = 0; i < n_; ++i) s_.ratio[i] = s_.stress_by_y[i] / s_.slope[i];
  }

  /// Total derivatives by model parameter j: implicit differentiation of r(y; p) = 0.
  void by_parameter(std::size_t i, std::size_t j, double& stress_p, double& y_p) const {
    const double* const gp = s_.gradient_dp.data() + 3 * j * n_ + i;
    const double normal = s_.c[2 * n_ + i] * gp[2 * n_];
    y_p = -(s_.c[t_ * n_ + i] * gp[t_ * n_] - normal) / s_.slope[i];
    stress_p = 2 * (s_.c[l_ * n_ + i] * gp[l_ * n_] - normal) + s_.stress_by_y[i] * y_p;
  }

  /// ½ r and its slope, of a batch of one.
  detail::Residual residual() const { return {-s_.step[0] * s_.slope[0], s_.slope[0]}; }
  Scratch& scratch_of() { return s_; }  ///< where the values of the rows are

 private:
  const double* g(std::size_t a) const { return s_.gradient.data() + a * n_; }
  const double* h(std::size_t a, std::size_t b) const { return s_.hessian.data() + pair[a][b] * n_; }

  Pull pull_;
  std::size_t n_;
  Scratch& s_;
  std::span<const double> stretch_;
  std::size_t l_, t_;
};

/// The root for one stretch on the path from rest, by continuation in ln λ1 with step halving. It serves rows in which
/// the batch iteration failed: overflow on the way, more than one root, a kink.
inline bool solve_from_rest(const Pull& pull, double stretch, Scratch& scratch, double& u) {
  const double target = std::log(stretch);
  double l = 0, y = 0, step = target / 4;
  for (int trial = 0; trial < 400; ++trial) {
    const double next = std::abs(step) >= std::abs(target - l) ? target : l + step;
    const double lambda = std::exp(next);
    const std::span<const double> one(&lambda, 1);
    Batch batch(pull, one, scratch);
    double trial_y = y;
    const bool found = detail::safeguarded_newton(
        [&](double at) {
          const double u_at = std::exp(at);
          if (!batch.evaluate(&u_at, false).ok()) return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
          return batch.residual();
        },
        trial_y);
    if (found) {
      l = next;
      y = trial_y;
      if (l == target) {
        u = std::exp(y);
        return true;
      }
    } else {
      step /= 2;
      if (std::abs(step) < 1e-6 * (std::abs(target) + 1e-6)) return false;
    }
  }
  return false;
}

/// Newton's method over the batch until every step is below `tolerance`. `u` lacks only the last step, which stays in
/// the batch. Rows that do not converge are solved one by one; `lost` is the first of them that cannot be followed from
/// rest, or none. A row that was solved alone may end at a jump, which first_unsettled() detects.
inline Status iterate(const Pull& pull, std::span<const double> stretch, double tolerance, Batch& batch,
                      std::span<double> u, std::optional<std::size_t>& lost) {
  const std::size_t n = stretch.size();
  lost.reset();
  for (int iteration = 0; iteration < newton_iterations; ++iteration) {
    if (Status status = batch.evaluate(u.data(), false); !status.ok()) return status;
    const double* const step = batch.scratch_of().step.data();
    const double* const slope = batch.scratch_of().slope.data();
    std::size_t unsound = 0, large = 0;  // rows; a NaN is unsound
    for (std::size_t i = 0; i < n; ++i) {
      const bool sound = (slope[i] > 0) & (std::abs(step[i]) < 1e10);
      unsound += !sound;
      large += sound & !(std::abs(step[i]) < tolerance);
    }
    if (unsound + large == 0) return {};
    if (large == 0) break;
    for (std::size_t i = 0; i < n; ++i)
      if (slope[i] > 0 && std::abs(step[i]) < 1e10) u[i] *= 1 + std::clamp(step[i], -0.6, 1.5);
  }
  // What the batch left: row by row. The scratch of the batch is overwritten, so find the rows first.
  std::vector<std::size_t>& open = batch.scratch_of().open;
  open.clear();
  for (std::size_t i = 0; i < n; ++i) {
    const double step = batch.scratch_of().step[i], slope = batch.scratch_of().slope[i];
    if (!(std::abs(step) < tolerance) || !(slope > 0)) open.push_back(i);
  }
  for (const std::size_t i : open) {
    if (solve_from_rest(pull, stretch[i], batch.scratch_of(), u[i])) continue;
    lost = i;
    return Status::failed(lost_row);
  }
  return batch.evaluate(u.data(), false);
}

/// A row where ∂W/∂y changes sign in a jump. With dispersion, "fibre_switch": "stretch" makes such energies.
inline Status jumping_row() {
  return Status::failed(
      "no lateral equilibrium: where a family of fibres switches, the lateral stress jumps from one sign to the other");
}

/// The first of n rows that is not in equilibrium, judged by its Newton step or a missing step; n = none.
inline std::size_t first_unsettled(const double* step, std::size_t n, double tolerance) {
  return static_cast<std::size_t>(
      std::find_if(step, step + n, [tolerance](double value) { return !(std::abs(value) < tolerance); }) - step);
}

}  // namespace tunica::free_strip
