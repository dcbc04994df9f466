// SPDX-License-Identifier: Apache-2.0
#include "maxwell_pass.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "tunica/detail/lanes.hpp"
#include "tunica/detail/symmetric_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

constexpr std::size_t together = 4;  ///< parameters
using Group = detail::Lanes<together>;

/// Columns over the rows and the state at rest, which comes last. Axes: 0 the loaded one, 1 transverse, 2 normal.
struct Columns {
  std::vector<double> c, gradient, hessian, gradient_dp;     ///< of the elastic response, in the axes of the material
  std::array<std::vector<double>, 3> slope, dev, dev_slope;  ///< dg/dy; g'; dg'/dy
  std::vector<double> dev_dp, zero;                          ///< 3 columns of g' a parameter; nothing
  std::vector<double> by_residual, stress_by_y;              ///< dy/dr, ∂σ11/∂y
  struct Branch {
    std::vector<double> decay, relaxed, slope;  ///< e^{−Δt/τ}, φ, g φ
    std::vector<double> by_tau, by_tau_of_h;    ///< ∂h₊/∂τ = by_tau Δg' + by_tau_of_h h
    std::array<std::vector<double>, 3> h;
  };
  std::array<Branch, MaxwellPass::most_branches> branches;
};
Columns& thread_columns() {
  thread_local Columns instance;
  return instance;
}

void make_room(std::vector<double>& column, std::size_t n) {
  if (column.size() < n) column.resize(n);
}

/// 1 − e^{−x} without cancellation: by its series Σ (−1)^k x^{k+1}/(k+1)! below 0.35, to 1e-17.
inline double lost_after(double x) {
  double series = 0;
  for (int k = 13; k >= 1; --k) series = x * (1.0 / k) * (1 - series);
  const double plain = 1 - detail::lane_exp(-x);
  return x < 0.35 ? series : plain;
}

inline Group group_of(const std::array<const double*, together>& columns, std::size_t row) {
  return Group(Group::Vector{columns[0][row], columns[1][row], columns[2][row], columns[3][row]});
}

}  // namespace

MaxwellPass::MaxwellPass(const Strip& strip, const TestInput& input, const PathRows& rows, bool symmetric,
                         std::span<const MaxwellModel::Branch> branches)
    : strip_(strip),
      input_(input),
      rows_(rows),
      branches_(branches),
      n_(rows.stretch.size()),
      points_(n_ + 1),
      count_(input.model_parameters.size()),
      elastic_count_(input.model.elastic().describe().parameters.size()),
      symmetric_(symmetric) {
  Columns& m = thread_columns();
  make_room(m.c, 3 * points_);
  make_room(m.gradient, 3 * points_);
  make_room(m.hessian, 6 * points_);
  for (auto* const columns : {&m.slope, &m.dev, &m.dev_slope})
    for (auto& column : *columns) make_room(column, points_);
  make_room(m.by_residual, n_);
  make_room(m.stress_by_y, n_);
  relax();
}

/// Time steps stay, and so does what fades in them.
void MaxwellPass::relax() {
  Columns& m = thread_columns();
  for (std::size_t b = 0; b < branches_.size(); ++b) {
    Columns::Branch& branch = m.branches[b];
    for (auto* const column : {&branch.decay, &branch.relaxed, &branch.slope, &branch.by_tau, &branch.by_tau_of_h})
      make_room(*column, n_);
    for (auto& column : branch.h) make_room(column, n_);
    const double g = input_.model_parameters[branches_[b].g], tau = input_.model_parameters[branches_[b].tau];
    detail::vectorised([n = n_, g, tau, time = strip_.time.data(), decay = branch.decay.data(),
                        relaxed = branch.relaxed.data(), slope = branch.slope.data(), by_tau = branch.by_tau.data(),
                        by_tau_of_h = branch.by_tau_of_h.data()] {
      decay[0] = std::max(0.0, time[0]) / tau;
      TUNICA_LANES
      for (std::size_t i = 1; i < n; ++i) decay[i] = (time[i] - time[i - 1]) / tau;
      TUNICA_LANES
      for (std::size_t i = 0; i < n; ++i) {
        const double x = decay[i], lost = lost_after(x);
        decay[i] = 1 - lost;
        relaxed[i] = x > 0 ? lost / x : 1;
        slope[i] = g * relaxed[i];
        by_tau[i] = -g * (decay[i] - relaxed[i]) / tau;
        by_tau_of_h[i] = x * decay[i] / tau;
      }
    });
  }
}

Status MaxwellPass::evaluate(bool parameters) {
  Columns& m = thread_columns();
  double* const c1 = m.c.data() + strip_.loaded * points_;
  double* const c2 = m.c.data() + strip_.transverse * points_;
  double* const c3 = m.c.data() + 2 * points_;
  detail::vectorised([=, n = n_, stretch = rows_.stretch.data(), u = rows_.u.data()] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      c1[i] = stretch[i] * stretch[i];
      c2[i] = u[i];
      c3[i] = 1 / (c1[i] * c2[i]);
    }
  });
  c1[n_] = c2[n_] = c3[n_] = 1;
  if (parameters) make_room(m.gradient_dp, 3 * points_ * elastic_count_);
  return input_.model.elastic().evaluate_axes(
      {points_, {m.c.data(), 3 * points_}, input_.model_parameters.first(elastic_count_)},
      {{},
       {m.gradient.data(), 3 * points_},
       {m.hessian.data(), 6 * points_},
       {m.gradient_dp.data(), parameters ? 3 * points_ * elastic_count_ : 0}});
}

/// g' with its derivative by y, where dc2 = c2 and dc3 = −c3:
///
///   g'_a = g_a − w/c_a,   dg'_a = dg_a − (dw − w dc_a/c_a)/c_a,   w = ⅓ Σ_b g_b c_b
void MaxwellPass::prepare() {
  Columns& m = thread_columns();
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  std::array<const double*, 3> c, g, h2, h3;
  for (std::size_t a = 0; a < 3; ++a) {
    c[a] = m.c.data() + axis[a] * points_;
    g[a] = m.gradient.data() + axis[a] * points_;
    h2[a] = m.hessian.data() + free_strip::pair[axis[a]][axis[1]] * points_;
    h3[a] = m.hessian.data() + free_strip::pair[axis[a]][2] * points_;
  }
  detail::vectorised([=, n = points_, s1 = m.slope[0].data(), s2 = m.slope[1].data(), s3 = m.slope[2].data(),
                      d1 = m.dev[0].data(), d2 = m.dev[1].data(), d3 = m.dev[2].data(), y1 = m.dev_slope[0].data(),
                      y2 = m.dev_slope[1].data(), y3 = m.dev_slope[2].data()] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      const double c1 = c[0][i], c2 = c[1][i], c3 = c[2][i], g1 = g[0][i], g2 = g[1][i], g3 = g[2][i];
      const double work = (g1 * c1 + g2 * c2 + g3 * c3) / 3;
      s1[i] = h2[0][i] * c2 - h3[0][i] * c3;
      s2[i] = h2[1][i] * c2 - h3[1][i] * c3;
      s3[i] = h2[2][i] * c2 - h3[2][i] * c3;
      const double work_y = (s1[i] * c1 + s2[i] * c2 + s3[i] * c3 + g2 * c2 - g3 * c3) / 3;
      d1[i] = g1 - work / c1;
      d2[i] = g2 - work / c2;
      d3[i] = g3 - work / c3;
      y1[i] = s1[i] - work_y / c1;
      y2[i] = s2[i] - (work_y - work) / c2;
      y3[i] = s3[i] - (work_y + work) / c3;
    }
  });
}

/// g' of the derivative by a parameter of the elastic response.
void MaxwellPass::prepare_parameter(std::size_t parameter) {
  Columns& m = thread_columns();
  const double* const c = m.c.data();
  const double* const g = m.gradient_dp.data() + 3 * parameter * points_;
  double* const dev = m.dev_dp.data() + 3 * parameter * points_;
  detail::vectorised([=, n = points_] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      const double work = (g[i] * c[i] + g[n + i] * c[n + i] + g[2 * n + i] * c[2 * n + i]) / 3;
      dev[i] = g[i] - work / c[i];
      dev[n + i] = g[n + i] - work / c[n + i];
      dev[2 * n + i] = g[2 * n + i] - work / c[2 * n + i];
    }
  });
}

/// r = c2 g2 − c3 g3 = 0, σ = 2 (c1 g1 − c3 g3), g the elastic response and all h. `moved`: what the steps of the rows
/// before do to h.
template <std::size_t branches>
inline void MaxwellPass::follow() {
  Columns& m = thread_columns();
  const double* const c1s = m.c.data() + strip_.loaded * points_;
  const double* const c2s = m.c.data() + strip_.transverse * points_;
  const double* const c3s = m.c.data() + 2 * points_;
  const std::array<const double*, 3> gs{m.gradient.data() + strip_.loaded * points_,
                                        m.gradient.data() + strip_.transverse * points_,
                                        m.gradient.data() + 2 * points_};
  std::array<std::array<double, 3>, branches> h{}, moved{};
  std::array<double, 3> before, before_moved{};
  for (std::size_t a = 0; a < 3; ++a) before[a] = m.dev[a][n_];
  for (std::size_t i = 0; i < n_; ++i) {
    const double c1 = c1s[i], c2 = c2s[i], c3 = c3s[i];
    std::array<double, 3> g{gs[0][i], gs[1][i], gs[2][i]}, past{}, slope;
    double all_slopes = 0;
    for (std::size_t b = 0; b < branches; ++b) {
      const double decay = m.branches[b].decay[i], own = m.branches[b].slope[i];
      all_slopes += own;
      for (std::size_t a = 0; a < 3; ++a) {
        h[b][a] = decay * h[b][a] + own * (m.dev[a][i] - before[a]);
        moved[b][a] = decay * moved[b][a] - own * before_moved[a];
        m.branches[b].h[a][i] = h[b][a];
        g[a] += h[b][a];
        past[a] += moved[b][a];
      }
    }
    for (std::size_t a = 0; a < 3; ++a) slope[a] = m.slope[a][i] + all_slopes * m.dev_slope[a][i];
    const double residual = c2 * g[1] - c3 * g[2];
    const double by_y = c2 * (g[1] + slope[1]) + c3 * (g[2] - slope[2]);
    const double stress_by_y = 2 * (c1 * slope[0] + c3 * (g[2] - slope[2]));
    const double at_step = residual + (c2 * past[1] - c3 * past[2]);
    const bool rests =
        symmetric_ && std::abs(at_step) <= free_strip::alike * c2 * (std::abs(g[0]) + std::abs(g[1]) + std::abs(g[2]));
    m.by_residual[i] = rests ? 0 : -1 / by_y;
    m.stress_by_y[i] = stress_by_y;
    const double step = rows_.step[i] = newton_.take(at_step, by_y, m.by_residual[i], rests, rows_.before[i]);
    rows_.stress[i] = 2 * (c1 * (g[0] + past[0]) - c3 * (g[2] + past[2])) + stress_by_y * step;
    for (std::size_t a = 0; a < 3; ++a) {
      before[a] = m.dev[a][i];
      before_moved[a] = m.dev_slope[a][i] * step;
      for (std::size_t b = 0; b < branches; ++b) moved[b][a] += m.branches[b].slope[i] * before_moved[a];
    }
  }
}

/// By the parameters `first` and those behind it: at fixed y in h first, which gives y, which moves h. For the own ones
/// of a branch ∂h₊/∂g = φ Δg',  ∂h₊/∂τ = (x e^{−x} h − g (e^{−x} − φ) Δg')/τ with x = Δt/τ.
template <std::size_t branches>
inline void MaxwellPass::differentiate(std::size_t first) {
  Columns& m = thread_columns();
  const std::array<std::size_t, 3> axis{strip_.loaded, strip_.transverse, 2};
  std::array<std::array<const double*, together>, 3> gs, devs;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t l = 0; l < together; ++l) {
      const bool elastic = first + l < elastic_count_;
      const std::size_t at = (3 * (first + l) + axis[a]) * points_;
      gs[a][l] = elastic ? m.gradient_dp.data() + at : m.zero.data();
      devs[a][l] = elastic ? m.dev_dp.data() + at : m.zero.data();
    }
  std::array<Group, branches> of_g, of_tau;  // 1 in the lane of the own parameter
  bool own = false;
  for (std::size_t b = 0; b < branches; ++b)
    for (std::size_t l = 0; l < together; ++l) {
      of_g[b].v[l] = branches_[b].g == first + l ? 1 : 0;
      of_tau[b].v[l] = branches_[b].tau == first + l ? 1 : 0;
      own = own || of_g[b].v[l] != 0 || of_tau[b].v[l] != 0;
    }
  std::array<std::array<Group, 3>, branches> h;
  std::array<Group, 3> before;
  std::array<double, 3> dev_before;
  for (std::size_t a = 0; a < 3; ++a) {
    before[a] = group_of(devs[a], n_);
    dev_before[a] = m.dev[a][n_];
  }
  const std::size_t lanes = std::min(together, count_ - first);
  for (std::size_t i = 0; i < n_; ++i) {
    std::array<Group, 3> g, dev;
    for (std::size_t a = 0; a < 3; ++a) {
      g[a] = group_of(gs[a], i);
      dev[a] = group_of(devs[a], i);
    }
    for (std::size_t b = 0; b < branches; ++b) {
      const Columns::Branch& branch = m.branches[b];
      const Group decay(branch.decay[i]), slope(branch.slope[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        h[b][a] = decay * h[b][a] + slope * (dev[a] - before[a]);
        if (own) {
          const double change = m.dev[a][i] - dev_before[a], faded = i == 0 ? 0 : branch.h[a][i - 1];
          h[b][a] += of_g[b] * Group(branch.relaxed[i] * change) +
                     of_tau[b] * Group(branch.by_tau[i] * change + branch.by_tau_of_h[i] * faded);
        }
        g[a] += h[b][a];
      }
    }
    const double c1 = m.c[axis[0] * points_ + i], c2 = m.c[axis[1] * points_ + i], c3 = m.c[2 * points_ + i];
    const Group y = (Group(c2) * g[1] - Group(c3) * g[2]) * Group(m.by_residual[i]);
    const Group stress = Group(2 * c1) * g[0] - Group(2 * c3) * g[2] + Group(m.stress_by_y[i]) * y;
    for (std::size_t a = 0; a < 3; ++a) {
      const Group moved = Group(m.dev_slope[a][i]) * y;
      before[a] = dev[a] + moved;
      dev_before[a] = m.dev[a][i];
      for (std::size_t b = 0; b < branches; ++b) h[b][a] += Group(m.branches[b].slope[i]) * moved;
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      rows_.y_dp[(first + l) * n_ + i] = y.v[l];
      rows_.stress_dp[(first + l) * n_ + i] = stress.v[l];
    }
  }
}

Status MaxwellPass::run(bool parameters) {
  if (Status status = evaluate(parameters); !status.ok()) return status;
  Columns& m = thread_columns();
  prepare();
  if (parameters) {
    make_room(m.dev_dp, 3 * points_ * elastic_count_);
    make_room(m.zero, points_);
    for (std::size_t j = 0; j < elastic_count_; ++j) prepare_parameter(j);
  }
  newton_ = {};
  const auto with = [&]<std::size_t... branches>(std::index_sequence<branches...>) {
    const auto one = [&]<std::size_t number>() {
      if (branches_.size() != number) return;
      detail::vectorised([this] { follow<number>(); });
      for (std::size_t j = 0; parameters && j < count_; j += together)
        detail::vectorised([this, j] { differentiate<number>(j); });
    };
    (one.template operator()<branches + 1>(), ...);
  };
  with(std::make_index_sequence<most_branches>());
  return {};
}

}  // namespace tunica::uniaxial
