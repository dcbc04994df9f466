// SPDX-License-Identifier: Apache-2.0
#include "maxwell_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "maxwell_block.hpp"
#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/lanes.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
using namespace maxwell;

/// g' with its derivative by y, where dc2 = c2 and dc3 = −c3:
///
///   g'_a = g_a − w/c_a,   dg'_a = dg_a − (dw − w dc_a/c_a)/c_a,   w = ⅓ Σ_b g_b c_b
inline void MaxwellPath::prepare() {
  BlockScratch& s = thread_block();
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  std::array<const double*, 3> c, g, h2, h3;
  for (std::size_t a = 0; a < 3; ++a) {
    c[a] = s.c.data() + axis[a] * size_;
    g[a] = s.gradient.data() + axis[a] * size_;
    h2[a] = s.hessian.data() + free_strip::pair[axis[a]][axis[1]] * size_;
    h3[a] = s.hessian.data() + free_strip::pair[axis[a]][2] * size_;
  }
  TUNICA_LANES
  for (std::size_t i = 0; i < size_; ++i) {
    const double c1 = c[0][i], c2 = c[1][i], c3 = c[2][i], g1 = g[0][i], g2 = g[1][i], g3 = g[2][i];
    const double work = (g1 * c1 + g2 * c2 + g3 * c3) / 3;
    const double s1 = h2[0][i] * c2 - h3[0][i] * c3;
    const double s2 = h2[1][i] * c2 - h3[1][i] * c3;
    const double s3 = h2[2][i] * c2 - h3[2][i] * c3;
    const double work_y = (s1 * c1 + s2 * c2 + s3 * c3 + g2 * c2 - g3 * c3) / 3;
    const double v1 = 1 / c1, v2 = 1 / c2, v3 = c1 * c2;
    s.slope[0][i] = s1;
    s.slope[1][i] = s2;
    s.slope[2][i] = s3;
    s.dev[0][i] = g1 - work * v1;
    s.dev[1][i] = g2 - work * v2;
    s.dev[2][i] = g3 - work * v3;
    s.dev_slope[0][i] = s1 - work_y * v1;
    s.dev_slope[1][i] = s2 - (work_y - work) * v2;
    s.dev_slope[2][i] = s3 - (work_y + work) * v3;
  }
}

/// h of every branch, with its derivative by τ, and g with all of them.
template <std::size_t branches>
inline void MaxwellPath::remember(bool parameters) {
  BlockScratch& s = thread_block();
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  for (std::size_t a = 0; a < 3; ++a) std::copy_n(s.gradient.data() + axis[a] * size_, size_, s.all[a].data());
  for (std::size_t b = 0; b < branches; ++b) {
    Branch& branch = s.branches[b];
    const double* const decay = branch.relaxation.decay.data();
    const double* const taken = branch.relaxation.taken.data();
    const double* const by_tau = branch.relaxation.by_tau.data();
    const double* const by_tau_of_h = branch.relaxation.by_tau_of_h.data();
    std::array<double, 3> h = branch.h_before, before = s.dev_before;
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        h[a] = decay[i] * h[a] + taken[i] * (s.dev[a][i] - before[a]);
        before[a] = s.dev[a][i];
        branch.h[a][i] = h[a];
      }
    for (std::size_t a = 0; a < 3; ++a) {
      TUNICA_LANES
      for (std::size_t i = 0; i < size_; ++i) s.all[a][i] += branch.g * branch.h[a][i];
    }
    if (!parameters) continue;
    std::array<double, 3> t = branch.t_before;
    h = branch.h_before;
    before = s.dev_before;
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t a = 0; a < 3; ++a) {
        t[a] = decay[i] * t[a] + (by_tau[i] * (s.dev[a][i] - before[a]) + by_tau_of_h[i] * h[a]);
        before[a] = s.dev[a][i];
        h[a] = branch.h[a][i];
        branch.t[a][i] = branch.g * t[a];
      }
    branch.t_after = t;
  }
}

/// r = c2 g2 − c3 g3 = 0, σ = 2 (c1 g1 − c3 g3), g the elastic response and all h. `moved`: what the steps of the rows
/// before do to h.
template <std::size_t branches>
inline void MaxwellPath::follow() {
  BlockScratch& s = thread_block();
  const double* const c1 = s.c.data() + strip_.loaded * size_;
  const double* const c2 = s.c.data() + strip_.transverse * size_;
  const double* const c3 = s.c.data() + 2 * size_;
  Column taken;
  for (std::size_t i = 0; i < size_; ++i) {
    taken[i] = 0;
    for (std::size_t b = 0; b < branches; ++b) taken[i] += s.branches[b].g * s.branches[b].relaxation.taken[i];
  }
  TUNICA_LANES
  for (std::size_t i = 0; i < size_; ++i) {
    const double g1 = s.all[0][i], g2 = s.all[1][i], g3 = s.all[2][i];
    const double slope1 = s.slope[0][i] + taken[i] * s.dev_slope[0][i];
    const double slope2 = s.slope[1][i] + taken[i] * s.dev_slope[1][i];
    const double slope3 = s.slope[2][i] + taken[i] * s.dev_slope[2][i];
    s.residual[i] = c2[i] * g2 - c3[i] * g3;
    s.by_y[i] = c2[i] * (g2 + slope2) + c3[i] * (g3 - slope3);
    s.by_residual[i] = -1 / s.by_y[i];
    s.still_stress[i] = 2 * (c1[i] * g1 - c3[i] * g3);
    s.stress_by_y[i] = 2 * (c1[i] * slope1 + c3[i] * (g3 - slope3));
  }
  s.y_again[0] = s.stress_again[0] = 0;
  std::array<Column, 3> again;
  for (std::size_t b = 0; b < branches; ++b) {
    Branch& branch = s.branches[b];
    const double* const decay = branch.relaxation.decay.data();
    const double* const taken_up = branch.relaxation.taken.data();
    for (std::size_t a = 0; a < 3; ++a) {
      branch.again[a][0] = 0;
      TUNICA_LANES
      for (std::size_t i = 1; i < size_; ++i) {
        branch.again[a][i] = (decay[i] * taken_up[i - 1] - taken_up[i]) * s.dev_slope[a][i - 1];
        again[a][i] = (b == 0 ? 0 : again[a][i]) + branch.g * branch.again[a][i];
      }
    }
  }
  TUNICA_LANES
  for (std::size_t i = 1; i < size_; ++i) {
    s.y_again[i] = s.by_residual[i] * (c2[i] * again[1][i] - c3[i] * again[2][i]);
    s.stress_again[i] = 2 * (c1[i] * again[0][i] - c3[i] * again[2][i]);
  }
  if (!step_along<branches, false>()) step_along<branches, true>();
}

/// Newton's step along the rows: that of the row before is the only number that a row waits for. Undamped steps end
/// false where one of them is to be damped.
template <std::size_t branches, bool damped>
inline bool MaxwellPath::step_along() {
  BlockScratch& s = thread_block();
  const double* const c1 = s.c.data() + strip_.loaded * size_;
  const double* const c2 = s.c.data() + strip_.transverse * size_;
  const double* const c3 = s.c.data() + 2 * size_;
  newton_ = {};
  std::array<std::array<double, 3>, branches> moved{};
  double step = 0;
  for (std::size_t i = 0; i < size_; ++i) {
    std::array<double, 3> past{};
#pragma GCC unroll 6
    for (std::size_t b = 0; b < branches; ++b)
#pragma GCC unroll 3
      for (std::size_t a = 0; a < 3; ++a) {
        const double faded = s.branches[b].relaxation.decay[i] * moved[b][a];
        past[a] += s.branches[b].g * faded;
        moved[b][a] = faded + s.branches[b].again[a][i] * step;
      }
    const double still = (s.residual[i] + (c2[i] * past[1] - c3[i] * past[2])) * s.by_residual[i];
    s.past_stress[i] = 2 * (c1[i] * past[0] - c3[i] * past[2]) + s.stress_again[i] * step;
    step = still + s.y_again[i] * step;
    if constexpr (damped) step = newton_.damped(step, s.by_y[i], s.before[i]);
    s.step[i] = step;
  }
  if (!damped && !newton_.undamped({s.step.data(), size_}, {s.by_y.data(), size_}, {s.before.data(), size_}))
    return false;
  const std::size_t last = size_ - 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const double dev_moved = s.dev_slope[a][last] * step;
    s.dev_after[a] = s.dev[a][last] + dev_moved;
    for (std::size_t b = 0; b < branches; ++b) {
      Branch& branch = s.branches[b];
      branch.h_after[a] = branch.h[a][last] + (moved[b][a] + branch.relaxation.taken[last] * dev_moved);
    }
  }
  TUNICA_LANES
  for (std::size_t i = 0; i < size_; ++i)
    s.stress[i] = s.still_stress[i] + s.past_stress[i] + s.stress_by_y[i] * s.step[i];
  return true;
}

/// By as many parameters from the first of them as a vector holds: at fixed y in h first, which gives y, which moves h.
/// By the own ones of a branch, h itself changes by h (of stiffness 1) and by ∂h/∂τ.
template <std::size_t branches, std::size_t width>
inline void MaxwellPath::differentiate(std::size_t first_parameter) {
  using Group = detail::Lanes<width>;
  BlockScratch& s = thread_block();
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  const std::size_t padded = count_ + detail::widest;
  std::array<std::array<const double*, width>, 3> columns;
  Group elastic;  // 1 in lanes of parameters of the elastic response
  for (std::size_t l = 0; l < width; ++l) {
    const std::size_t j = first_parameter + l;
    elastic.v[l] = j < elastic_count_ ? 1 : 0;
    for (std::size_t a = 0; a < 3; ++a) {
      columns[a][l] = j < elastic_count_ ? s.gradient_dp.data() + (3 * j + axis[a]) * size_ : s.nothing.data();
      for (std::size_t b = 0; b < branches; ++b) {
        if (branches_[b].g == j) columns[a][l] = s.branches[b].h[a].data();
        if (branches_[b].tau == j) columns[a][l] = s.branches[b].t[a].data();
      }
    }
  }
  const double* const c1s = s.c.data() + strip_.loaded * size_;
  const double* const c2s = s.c.data() + strip_.transverse * size_;
  const double* const c3s = s.c.data() + 2 * size_;
  std::array<std::array<Group, 3>, branches> h;
  std::array<Group, 3> before;
  for (std::size_t a = 0; a < 3; ++a) {
    before[a] = Group::load(s.dev_dp_before.data() + a * padded + first_parameter);
    for (std::size_t b = 0; b < branches; ++b)
      h[b][a] = Group::load(s.memory_dp.data() + (3 * b + a) * padded + first_parameter);
  }
  Group y;
  const std::size_t lanes = std::min(width, count_ - first_parameter);
  double* const stress_dp = rows_.stress_dp.data() + first_parameter * n_ + first_;
  double* const y_dp = rows_.y_dp.empty() ? nullptr : rows_.y_dp.data() + first_parameter * n_ + first_;
  for (std::size_t i = 0; i < size_; ++i) {
    std::array<Group, 3> g, dev;
    for (std::size_t a = 0; a < 3; ++a) g[a] = gathered<width>(columns[a], i);
    const double c1 = c1s[i], c2 = c2s[i], c3 = c3s[i];
    const Group work = (g[0] * Group(c1) + g[1] * Group(c2) + g[2] * Group(c3)) * elastic * Group(1.0 / 3);
    dev[0] = g[0] * elastic - work * Group(1 / c1);
    dev[1] = g[1] * elastic - work * Group(1 / c2);
    dev[2] = g[2] * elastic - work * Group(c1 * c2);
#pragma GCC unroll 6
    for (std::size_t b = 0; b < branches; ++b) {
      const Branch& branch = s.branches[b];
      const Group decay(branch.relaxation.decay[i]), taken(branch.relaxation.taken[i]), stiffness(branch.g);
#pragma GCC unroll 3
      for (std::size_t a = 0; a < 3; ++a) {
        const Group still = decay * h[b][a] + taken * (dev[a] - before[a]);
        g[a] += stiffness * still;
        h[b][a] = still + Group(branch.again[a][i]) * y;
      }
    }
    before = dev;
    Group stress = Group(2 * c1) * g[0] - Group(2 * c3) * g[2] + Group(s.stress_again[i]) * y;
    y = (Group(c2) * g[1] - Group(c3) * g[2]) * Group(s.by_residual[i]) + Group(s.y_again[i]) * y;
    stress += Group(s.stress_by_y[i]) * y;
    for (std::size_t l = 0; l < lanes; ++l) stress_dp[l * n_ + i] = stress.v[l];
    for (std::size_t l = 0; y_dp != nullptr && l < lanes; ++l) y_dp[l * n_ + i] = y.v[l];
  }
  const std::size_t last = size_ - 1;
  for (std::size_t a = 0; a < 3; ++a) {
    const Group moved = Group(s.dev_slope[a][last]) * y;
    (before[a] + moved).store(s.dev_dp_before.data() + a * padded + first_parameter);
    for (std::size_t b = 0; b < branches; ++b)
      (h[b][a] + Group(s.branches[b].relaxation.taken[last]) * moved)
          .store(s.memory_dp.data() + (3 * b + a) * padded + first_parameter);
  }
}

/// Without parameters Newton's step of every row, that of the rows before it included.
template <std::size_t branches>
bool MaxwellPath::solve_block(bool parameters, Status& status) {
  bool by_parameters = false;
  for (int k = 0; k < NewtonStep::most; ++k) {
    if (status = evaluate(by_parameters); !status.ok()) return false;
    detail::vectorised([this, by_parameters] {
      prepare();
      remember<branches>(by_parameters);
    });
    detail::vectorised([this] { follow<branches>(); });
    if (!newton_.sound) return false;
    if (by_parameters && newton_.largest < NewtonStep::settled) {
      detail::vectorised([this](auto width) {
        // What is left over goes in a vector that is no wider than needed.
        for (std::size_t j = 0; j<count_; j += count_ - j> 2 ? width() : 2)
          count_ - j > 2 ? differentiate<branches, width()>(j) : differentiate<branches, 2>(j);
      });
      return true;
    }
    if (!parameters && newton_.largest < free_strip::last_step) return true;
    by_parameters = by_parameters || (parameters && newton_.largest < NewtonStep::near);
    const BlockScratch& s = thread_block();
    for (std::size_t i = 0; i < size_; ++i) y_[first_ + i] += s.step[i];
  }
  return false;
}

bool MaxwellPath::solve(bool parameters, Status& status) {
  if (status = evaluate_rest(parameters); !status.ok()) return false;
  const auto with = [&]<std::size_t... number>(std::index_sequence<number...>) {
    return ((branches_.size() == number + 1 && solve_block<number + 1>(parameters, status)) || ...);
  };
  for (first_ = 0; first_ < n_; first_ += size_) {
    size_ = std::min(block, n_ - first_);
    enter();
    if (!with(std::make_index_sequence<most_branches>())) return false;
    leave();
  }
  return true;
}

}  // namespace tunica::uniaxial
