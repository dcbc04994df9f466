// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/strip_derivatives.hpp"
#include "tunica/detail/strip_start.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/detail/vector_math.hpp"
#include "tunica/strip_path.hpp"

namespace tunica::hyperelastic {

/// Equilibrium of all rows of a free strip. Nothing is allocated unless a row is lost on the way.
///
/// Nodes first, then the rows from where the nodes lead to (free_strip::Start); derivatives by parameters and by the
/// stretch are evaluated once more, at the equilibrium. Everything that runs over lanes is inlined by force: of what
/// the compiler has specialised, `flatten` does not see the body. `Along` is W(l, y) along the strip (strip_lanes.hpp
/// has what it sets; StripOfParts is one):
///
///     template <std::size_t width> void evaluate(StripLanes&, std::size_t lanes) const;
///     template <std::size_t width>
///     void differentiate(StripLanes&, bool parameters, StripByParameters&, std::size_t lanes) const;
template <class Along, std::size_t width>
class StripSolver {
 public:
  /// `model` solves rows that Newton's method over lanes does not bring home.
  StripSolver(const Model& model, const Along& along, const StripPath& strip)
      : model_(model), along_(along), strip_(strip) {}

  [[gnu::always_inline]] Status solve() {
    StripLanes lanes;
    AtNodes at_nodes;
    if (!strip_.nodes.empty()) {
      if (Status status = solve_nodes(lanes); !status.ok()) {
        if (strip_.lost != nullptr && *strip_.lost != StripPath::none)
          *strip_.lost = free_strip::nearest(strip_.stretch, strip_.nodes[*strip_.lost]);
        return status;
      }
      read_nodes(lanes, at_nodes);
    }
    const bool derivatives = !strip_.stress_dp.empty() || !strip_.stress_by_l.empty();
    for (std::size_t first = 0; first < strip_.stretch.size(); first += chunk) {
      const std::span<const double> rows =
          strip_.stretch.subspan(first, std::min(chunk, strip_.stretch.size() - first));
      begin(lanes, rows);
      if (!strip_.nodes.empty()) interpolate(lanes, at_nodes, first, rows.size());
      if (Status status = newton(lanes, rows, free_strip::last_step); !status.ok()) {
        if (strip_.lost != nullptr && *strip_.lost != StripPath::none) *strip_.lost += first;
        return status;
      }
      if (!strip_.stress.empty()) std::copy_n(lanes.stress.data(), rows.size(), strip_.stress.data() + first);
      for (std::size_t i = 0; !strip_.lateral.empty() && i < rows.size(); ++i)
        strip_.lateral[first + i] = std::log(lanes.u[i]) + std::log1p(lanes.step[i]);
      if (derivatives) differentiate(lanes, first, rows.size());
    }
    return {};
  }

 private:
  static constexpr std::size_t node_count = free_strip::Start::node_count;
  static constexpr double coarse = 1e-3;  ///< a step at a node; the next one's error is its square and less
  using AtNodes = std::array<double, 2 * node_count>;

  /// Rows filled up to whole vectors.
  [[nodiscard]] static constexpr std::size_t padded(std::size_t n) { return (n + width - 1) / width * width; }

  /// c1 and the u of an isotropic material.
  [[gnu::always_inline]] void begin(StripLanes& s, std::span<const double> stretch) const {
    const std::size_t m = stretch.size();
    TUNICA_LANES
    for (std::size_t i = 0; i < m; ++i) {
      s.c1[i] = stretch[i] * stretch[i];
      s.u[i] = 1 / stretch[i];
    }
    for (std::size_t i = m; i < padded(m); ++i) {
      s.c1[i] = s.c1[m - 1];
      s.u[i] = s.u[m - 1];
    }
  }

  /// Two guesses a node, evaluated at once: a pass over few lanes takes as long as one over twice as many. The inverse
  /// of W_y is interpolated through both.
  [[gnu::always_inline]] Status solve_nodes(StripLanes& s) const {
    for (std::size_t k = 0; k < node_count; ++k) {
      s.c1[k] = s.c1[node_count + k] = strip_.nodes[k] * strip_.nodes[k];
      s.u[k] = strip_.guesses[k];
      s.u[node_count + k] = strip_.guesses[node_count + k];
    }
    evaluate(s, 2 * node_count);
    // The nearer guess becomes the current one; a guess without a step is infinitely far. By way of rows of their own:
    // a row that is read and written here would be written lane by lane.
    alignas(64) std::array<double, node_count> u, r, slope, step;
    TUNICA_LANES
    for (std::size_t k = 0; k < node_count; ++k) {
      const std::size_t b = node_count + k;
      const double step_a = std::abs(s.step[k]) < sound ? std::abs(s.step[k]) : 2 * sound;
      const double step_b = std::abs(s.step[b]) < sound ? std::abs(s.step[b]) : 2 * sound;
      const double nearer = step_b < step_a ? 1 : 0;
      const auto one = [nearer](double is_a, double is_b) { return nearer != 0 ? is_b : is_a; };
      u[k] = one(s.u[k], s.u[b]);
      r[k] = one(s.by_y[k], s.by_y[b]);
      slope[k] = one(s.by_yy[k], s.by_yy[b]);
      step[k] = one(s.step[k], s.step[b]);
      s.bend[k] = one(s.by_ly[k], s.by_ly[b]) / slope[k];
      s.u_before[k] = one(s.u[b], s.u[k]);
      s.r_before[k] = one(s.by_y[b], s.by_y[k]);
      s.u_per_r[k] = s.u_before[k] / one(s.by_yy[b], s.by_yy[k]);
    }
    // Of known size, and so without a call.
    std::memcpy(s.u.data(), u.data(), sizeof u);
    std::memcpy(s.by_y.data(), r.data(), sizeof r);
    std::memcpy(s.by_yy.data(), slope.data(), sizeof slope);
    std::memcpy(s.step.data(), step.data(), sizeof step);
    move<true>(s, node_count);
    if (Status status = newton<true>(s, strip_.nodes, coarse, 1); !status.ok()) return status;
    keep_bend(s);
    return {};
  }

  [[gnu::always_inline]] static void keep_bend(StripLanes& s) {
    TUNICA_LANES
    for (std::size_t k = 0; k < node_count; ++k) {
      s.bend_before[k] = s.bend[k];
      s.bend[k] = s.by_ly[k] / s.by_yy[k];
    }
  }

  /// u of each node after its last step, and its slope along the path: with f = λ1 u
  ///     ∂f/∂λ1 = u (1 + y_l),  y_l = −W_ly/W_yy,
  /// the latter followed from the last pass to the end of the step as it changed from the pass before.
  [[gnu::always_inline]] static void read_nodes(StripLanes& s, AtNodes& at) {
    std::array<double, node_count> before;
    std::memcpy(before.data(), s.u_before.data(), sizeof before);
    move<true>(s, node_count);
    TUNICA_LANES
    for (std::size_t k = 0; k < node_count; ++k) {
      const double u = s.u[k], ahead = (u - s.u_before[k]) / (s.u_before[k] - before[k]);
      const double more = ahead * (s.bend[k] - s.bend_before[k]);
      const double bend = s.bend[k] + (std::abs(more) < std::abs(s.bend[k]) ? more : 0);
      at[k] = u;
      at[node_count + k] = u * (1 - 2 * bend);
    }
  }

  /// u of the rows. Eight weights at a time, which fit into registers.
  [[gnu::always_inline]] void interpolate(StripLanes& s, const AtNodes& at_nodes, std::size_t first,
                                          std::size_t m) const {
    const double* const weights = strip_.interpolation.data() + first;
    const std::size_t stride = strip_.row_stride, end = padded(m);
    add_nodes<true>(s, at_nodes.data(), weights, stride, end);
    add_nodes<false>(s, at_nodes.data() + node_count, weights + node_count * stride, stride, end);
  }
  template <bool assign>
  [[gnu::always_inline]] static void add_nodes(StripLanes& s, const double* at, const double* w, std::size_t stride,
                                               std::size_t end) {
    static_assert(node_count == 8);
    const double a0 = at[0], a1 = at[1], a2 = at[2], a3 = at[3], a4 = at[4], a5 = at[5], a6 = at[6], a7 = at[7];
    TUNICA_LANES
    for (std::size_t i = 0; i < end; ++i) {
      const double* const v = w + i;
      const double low = (v[0] * a0 + v[stride] * a1) + (v[2 * stride] * a2 + v[3 * stride] * a3);
      const double high = (v[4 * stride] * a4 + v[5 * stride] * a5) + (v[6 * stride] * a6 + v[7 * stride] * a7);
      s.u[i] = (assign ? 0 : s.u[i]) + (low + high);
    }
  }

  [[gnu::always_inline]] void evaluate(StripLanes& s, std::size_t lanes) const {
    along_.template evaluate<width>(s, lanes);
  }

  /// u after a step. From the second step on the inverse of W_y is interpolated through both passes with its slopes
  /// (Hermite): of order 2.7 instead of 2 (Traub 1964, §5.2). Rows without a step stay where they are.
  template <bool again>
  [[gnu::always_inline]] static void move(StripLanes& s, std::size_t lanes) {
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) {
      const double u = s.u[i], r = s.by_y[i], step = s.step[i], by_r = u / s.by_yy[i];
      double kept = step < -0.6 ? -0.6 : step;
      kept = kept > 1.5 ? 1.5 : kept;
      double change = std::abs(step) < sound ? u * kept : 0;
      if constexpr (again) {
        const double h = 1 / (r - s.r_before[i]), secant = (u - s.u_before[i]) * h, q = r * h;
        const double more = (by_r - secant) * r * q - (by_r - 2 * secant + s.u_per_r[i]) * q * q * s.r_before[i];
        change += std::abs(more) < 0.5 * std::abs(change) ? more : 0;
      }
      s.u_before[i] = u;
      s.r_before[i] = r;
      s.u_per_r[i] = by_r;
      s.u[i] = u + change;
    }
  }

  /// Passes until every step is below the tolerance; that last step is left to be applied to first order. Rows that do
  /// not get there are followed from rest, one by one.
  template <bool nodes = false>
  [[gnu::always_inline]] Status newton(StripLanes& s, std::span<const double> stretch, double tolerance,
                                       int pass = 0) const {
    const std::size_t lanes = padded(stretch.size());
    for (; pass < free_strip::newton_iterations; ++pass) {
      evaluate(s, lanes);
      if (!detail::any_not_below(s.step.data(), lanes, tolerance)) return {};
      if (detail::any_not_below(s.step.data(), lanes, sound) && none_moves(s, lanes, tolerance)) break;
      if constexpr (nodes) keep_bend(s);
      if (pass == 0)
        move<false>(s, lanes);
      else
        move<true>(s, lanes);
    }
    Status status = follow_from_rest(s, stretch, tolerance);
    if (!status.ok()) return status;
    evaluate(s, lanes);
    if constexpr (nodes) return status;  // where rows only begin
    const std::size_t row = free_strip::first_unsettled(s.step.data(), stretch.size(), tolerance);
    if (row == stretch.size()) return status;
    if (strip_.lost != nullptr) *strip_.lost = row;
    return free_strip::jumping_row();
  }

  /// Whether all that is open has no step at all.
  [[gnu::always_inline]] static bool none_moves(const StripLanes& s, std::size_t lanes, double tolerance) {
    return std::none_of(s.step.data(), s.step.data() + lanes,
                        [tolerance](double step) { return std::abs(step) < sound && !(std::abs(step) < tolerance); });
  }

  [[gnu::noinline]] Status follow_from_rest(StripLanes& s, std::span<const double> stretch, double tolerance) const {
    free_strip::Scratch scratch;
    const free_strip::Pull pull{model_, strip_.parameters, strip_.loaded};
    for (std::size_t i = 0; i < stretch.size(); ++i) {
      if (std::abs(s.step[i]) < tolerance) continue;
      if (free_strip::solve_from_rest(pull, stretch[i], scratch, s.u[i])) continue;
      if (strip_.lost != nullptr) *strip_.lost = i;
      return Status::failed(free_strip::lost_row);
    }
    const std::size_t m = stretch.size();
    for (std::size_t i = m; i < padded(m); ++i) s.u[i] = s.u[m - 1];
    return {};
  }

  /// Derivatives of σ and y at the equilibrium, by parameters and along the path:
  ///     dy/dp = −W_yp/W_yy,  dσ/dp = W_lp + W_ly dy/dp,   dy/dl = −W_ly/W_yy,  dσ/dl = W_ll + W_ly dy/dl
  [[gnu::always_inline]] void differentiate(StripLanes& s, std::size_t first, std::size_t m) {
    const std::size_t lanes = padded(m);
    StripByParameters by_p;
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) s.u[i] *= 1 + s.step[i];
    along_.template differentiate<width>(s, !strip_.stress_dp.empty(), by_p, lanes);
    const std::size_t n = strip_.stretch.size(), parameters = strip_.stress_dp.size() / n;
    for (std::size_t i = 0; i < lanes; ++i) s.x[i] = 1 / s.by_yy[i];
    for (std::size_t i = 0; !strip_.stress_by_l.empty() && i < m; ++i)
      strip_.stress_by_l[first + i] = 4 * (s.by_ll[i] - s.by_ly[i] * s.by_ly[i] * s.x[i]);
    for (std::size_t i = 0; !strip_.lateral_by_l.empty() && i < m; ++i)
      strip_.lateral_by_l[first + i] = -2 * s.by_ly[i] * s.x[i];
    for (std::size_t i = 0; i < lanes; ++i) s.first[i] = s.by_ly[i] * s.x[i];
    for (std::size_t j = 0; j < parameters; ++j) {
      double* const stress = strip_.stress_dp.data() + j * n + first;
      double* const lateral = strip_.lateral_dp.empty() ? nullptr : strip_.lateral_dp.data() + j * n + first;
      if (!by_p.written[j]) {
        std::fill_n(stress, m, 0.0);
        if (lateral != nullptr) std::fill_n(lateral, m, 0.0);
        continue;
      }
      const double* const y = by_p.y[j].data();
      const double* const l = by_p.l[j].data();
      if (by_p.along_path) {
        TUNICA_LANES
        for (std::size_t i = 0; i < m; ++i) stress[i] = 2 * l[i];
        continue;
      }
      TUNICA_LANES
      for (std::size_t i = 0; i < m; ++i) stress[i] = 2 * (l[i] - s.first[i] * y[i]);
      TUNICA_LANES
      for (std::size_t i = 0; lateral != nullptr && i < m; ++i) lateral[i] = -y[i] * s.x[i];
    }
  }

  static constexpr double sound = 1e10;  ///< a larger step is none

  const Model& model_;
  const Along& along_;
  const StripPath& strip_;
};

/// The same on the level of this library, so that there is one copy of it a level. Along is made from `arguments`.
template <class Along, class... Argument>
Status solve_strip(const Model& model, const StripPath& strip, const Argument&... arguments) {
  Status status;
  detail::vectorised([&](auto width) __attribute__((always_inline)) {
    const Along along(arguments...);
    status = StripSolver<Along, width>(model, along, strip).solve();
  });
  return status;
}

}  // namespace tunica::hyperelastic
