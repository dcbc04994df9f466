// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <span>

#include "tunica/detail/strip_derivatives.hpp"
#include "tunica/detail/strip_lanes.hpp"
#include "tunica/strip_path.hpp"

namespace tunica::hyperelastic {

/// W(l, y) of a sum of parts along one strip, for StripSolver. What does not change along it, such as the invariants of
/// the parts, is evaluated once.
class StripOfParts {
 public:
  static constexpr std::size_t max_parts = 32;

  StripOfParts(const Parts& parts, const StripPath& strip) : strip_(strip) {
    for (const auto& part : parts) add(*part);
    if (curved_count_ != 1) return;
    const StripInvariant& x = parts_[curved_[0]].part.x;
    single_ = x.i2 == 0 && x.f1 == 0 && x.f2 == 0;
  }

  /// The derivatives of W at u, Newton's step, and σ after it.
  template <std::size_t width>
  [[gnu::always_inline]] void evaluate(StripLanes& s, std::size_t lanes) const {
    if (single_) {
      const StripPart& p = parts_[curved_[0]].part;
      begin_single(s, p.x, lanes);
      respond(s, p, lanes, {}, {});
      return end_single(s, p.x, linear_, lanes);
    }
    begin_strip(s, linear_, lanes);
    for (std::size_t k = 0; k < curved_count_; ++k) {
      const StripPart& p = parts_[curved_[k]].part;
      strip_invariant(s, p.x, lanes);
      respond(s, p, lanes, {}, {});
      add_to_strip(s, p.x, lanes);
    }
    end_strip(s, lanes);
  }

  /// c3, W_yy, ½ W_ly and ¼ W_ll at u; with `parameters` W_yp and ½ W_lp too.
  template <std::size_t width>
  [[gnu::always_inline]] void differentiate(StripLanes& s, bool parameters, StripByParameters& by_p,
                                            std::size_t lanes) const {
    const double k1 = linear_[0], k2 = linear_[1], k3 = linear_[2];
    TUNICA_LANES
    for (std::size_t i = 0; i < lanes; ++i) {
      const double c1 = s.c1[i], u = s.u[i], c3 = 1 / (c1 * u);
      s.c3[i] = c3;
      s.by_yy[i] = k2 * u + k3 * c3;
      s.by_ly[i] = k3 * c3;
      s.by_ll[i] = k1 * c1 + k3 * c3;
    }
    if (parameters && curved_count_ <= 1 && strip_.lateral_dp.empty()) return differentiate_along(s, by_p, lanes);
    for (std::size_t k = 0; k < count_; ++k) add_derivatives(s, parts_[k].part, parameters, by_p, lanes);
  }

 private:
  /// Room for a part that nothing is set to beforehand.
  union Slot {
    Slot() {}
    StripPart part;
  };

  void add(const EnergyPart& part) {
    // Not cleared beforehand: that takes longer than to set it.
    StripPart& p = *::new (static_cast<void*>(&parts_[count_++])) StripPart;
    p.part = &part;
    p.description = &part.describe();
    part.invariant(strip_.parameters, p.invariant, {});
    p.direction = Direction(p.invariant, 1);
    const Structure a = structure(p.invariant, p.direction);
    const bool axial = strip_.loaded == 1;
    const EnergyPart::Active active = p.description->active;
    constexpr double tolerance = 1e-12;  // as PartBatch::switch_off_below
    p.x = {axial ? a.zz : a.tt,
           axial ? a.tt : a.zz,
           a.rr,
           a.i2,
           a.offset,
           p.description->mirrored ? 2. : 1.,
           -std::numeric_limits<double>::infinity(),
           0,
           0,
           -1};
    if (active == EnergyPart::Active::argument_positive) p.x.edge = -tolerance;
    if (active == EnergyPart::Active::fibre_stretched) {
      const double s2 = p.direction.s * p.direction.s, c2 = p.direction.c * p.direction.c;
      p.x.f1 = axial ? c2 : s2;
      p.x.f2 = axial ? s2 : c2;
      p.x.fibre_edge = 1 - tolerance;
    }
    p.is_linear = p.description->linear && active == EnergyPart::Active::always && a.i2 == 0;
    if (!p.is_linear) {
      curved_[curved_count_++] = count_ - 1;
      return;
    }
    const double anywhere = 0;
    const std::size_t responses = strip_.stress_dp.empty() ? 0 : p.description->response_parameters.size();
    part.respond(strip_.parameters, {{&anywhere, 1}, {}, {&p.slope, 1}, {}, {}, {p.slope_dp.data(), responses}});
    p.slope *= p.x.weight;
    linear_[0] += p.slope * p.x.a1;
    linear_[1] += p.slope * p.x.a2;
    linear_[2] += p.slope * p.x.a3;
  }

  [[gnu::always_inline]] void respond(StripLanes& s, const StripPart& p, std::size_t lanes, std::span<double> value_dp,
                                      std::span<double> first_dp) const {
    const bool curved = !p.description->linear;
    p.part->respond(
        strip_.parameters,
        {{s.x.data(), lanes}, {}, {s.first.data(), lanes}, {s.second.data(), curved ? lanes : 0}, value_dp, first_dp});
    if (!curved) std::fill_n(s.second.data(), lanes, 0.0);
  }

  [[gnu::always_inline]] void add_derivatives(StripLanes& s, const StripPart& p, bool parameters,
                                              StripByParameters& by_p, std::size_t lanes) const {
    if (p.is_linear && !parameters) return;
    const auto& responses = p.description->response_parameters;
    alignas(64) std::array<double, chunk * max_part_parameters> first_dp;
    strip_invariant(s, p.x, lanes);
    respond(s, p, lanes, {}, {first_dp.data(), parameters ? responses.size() * lanes : 0});
    StripSlopes slopes;
    begin_derivatives(s, p, slopes, lanes);
    if (!parameters) return;
    for (std::size_t j = 0; j < responses.size(); ++j)
      by_p.add_response(s, slopes, first_dp.data() + j * lanes, responses[j], lanes);
    for_moving(
        p, [&](std::size_t parameter, const Structure& d) __attribute__((always_inline)) {
          by_p.add_invariant(s, slopes, d, strip_.loaded == 1, parameter, lanes);
        });
  }

  /// How parameters change the stress, y following along: one row for each parameter. At most one part is curved.
  [[gnu::always_inline]] void differentiate_along(StripLanes& s, StripByParameters& by_p, std::size_t lanes) const {
    const bool axial = strip_.loaded == 1;
    if (curved_count_ == 1) {
      const StripPart& p = parts_[curved_[0]].part;
      const auto& responses = p.description->response_parameters;
      alignas(64) std::array<double, chunk * max_part_parameters> first_dp;
      StripSlopes slopes;
      strip_invariant(s, p.x, lanes);
      respond(s, p, lanes, {}, {first_dp.data(), responses.size() * lanes});
      begin_derivatives(s, p, slopes, lanes);
      by_p.follow_path(s, lanes);
      by_p.turn_slopes(slopes, lanes);
      for (std::size_t j = 0; j < responses.size(); ++j)
        by_p.add_response_along(s, slopes, first_dp.data() + j * lanes, responses[j], lanes);
      for_moving(
          p, [&](std::size_t parameter, const Structure& d)
                 __attribute__((always_inline)) { by_p.add_invariant_along(s, slopes, d, axial, parameter, lanes); });
    } else {
      by_p.follow_path(s, lanes);
    }
    for (std::size_t k = 0; k < count_; ++k) {
      const StripPart& p = parts_[k].part;
      if (!p.is_linear) continue;
      const auto& responses = p.description->response_parameters;
      const Structure a = structure(p.invariant, p.direction);
      for (std::size_t j = 0; j < responses.size(); ++j)
        by_p.add_slope_along(s, p.x.weight * p.slope_dp[j], a, axial, responses[j], lanes);
      for_moving(
          p, [&](std::size_t parameter, const Structure& d)
                 __attribute__((always_inline)) { by_p.add_slope_along(s, p.slope, d, axial, parameter, lanes); });
    }
  }

  /// Calls act(parameter, derivatives of the invariant's coefficients) for each parameter of the invariant.
  template <class Act>
  [[gnu::always_inline]] void for_moving(const StripPart& p, const Act& act) const {
    const auto& moving = p.description->invariant_parameters;
    if (moving.empty()) return;
    std::array<Invariant, max_part_parameters> derivatives;
    Invariant again;
    p.part->invariant(strip_.parameters, again, {derivatives.data(), moving.size()});
    for (std::size_t j = 0; j < moving.size(); ++j)
      act(moving[j], structure_derivative(p.invariant, derivatives[j], p.direction, 1));
  }

  const StripPath& strip_;
  std::size_t count_ = 0, curved_count_ = 0;
  bool single_ = false;             ///< one curved part without I2 or a switch by the fibres' own stretch
  std::array<double, 3> linear_{};  ///< w ψ' a of the linear parts, summed up
  std::array<std::size_t, max_parts> curved_;
  std::array<Slot, max_parts> parts_;
};

}  // namespace tunica::hyperelastic
