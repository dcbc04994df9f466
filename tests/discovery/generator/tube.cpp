// SPDX-License-Identifier: Apache-2.0
#include "tube.hpp"

#include <algorithm>
#include <numbers>

#include "root.hpp"

namespace blind {
namespace {

constexpr int tube_substeps = 12;  ///< between two rows, where the material remembers

/// The wall in its stress-free configuration, an open sector or the unloaded tube, and its nodes.
class Wall {
 public:
  struct Forces {
    double pressure, axial;  ///< inner less outer pressure; F_total − p π ri²
  };

  Wall(const Material& material, double inner, double outer, const TubeFaults& faults, int intervals)
      : material_(material),
        inner_(inner),
        outer_(outer),
        area_(outer * outer - inner * inner),
        faults_(faults),
        closing_(360 / (360 - faults.opening_angle)) {
    lay_nodes(0.5 * (closing_ * (outer + inner) - (outer - inner)), intervals);
    if (faults.opening_angle != 0) close(intervals);
    memory_.assign(R_.size(), material.at_rest());
  }

  /// Equilibrium with that true pressure, `dt` after the last one.
  bool follow(double lambda_z, double pressure, double dt, bool supported) {
    const auto excess = [&](double y) {
      return forces(lambda_z, std::exp(y), dt, false).pressure + support(lambda_z, std::exp(y), supported) - pressure;
    };
    y_ = rising_root(excess, std::isnan(y_) ? std::log(inner_ / std::sqrt(lambda_z)) : y_, 0.01, 2);
    if (std::isnan(y_)) return false;
    held_ = forces(lambda_z, std::exp(y_), dt, true);
    return true;
  }
  /// Outer radius of the unpressurised, stretched, elastic state, from which the support is reckoned.
  void rest_support(double lambda_z) {
    follow(lambda_z, 0, 0, false);
    free_ = outer_now(lambda_z, std::exp(y_));
    std::fill(memory_.begin(), memory_.end(), material_.at_rest());
  }
  [[nodiscard]] double diameter_stretch(double lambda_z) const { return outer_now(lambda_z, std::exp(y_)) / outer_; }
  /// The support presses on the outer face.
  [[nodiscard]] double axial_force(double lambda_z) const {
    const double ro = outer_now(lambda_z, std::exp(y_));
    return held_.axial - std::numbers::pi * support(lambda_z, std::exp(y_), true) * ro * ro;
  }

  /// p = ∫ (σt − σr) R dR/(K λz r²), F = π ∫ (2(σz − σr) − (σt − σr)) R dR/(K λz); the unit of R is that of the sector.
  Forces forces(double lambda_z, double ri, double dt, bool keep) {
    Forces sum{0, 0};
    const double cz = lambda_z * lambda_z, per_length = closing_ * lambda_z;
    for (std::size_t k = 0; k < R_.size(); ++k) {
      const double r2 = ri * ri + (R_[k] * R_[k] - R_.front() * R_.front()) / per_length;
      const double ct = closing_ * closing_ * r2 / (R_[k] * R_[k]);
      const Triple c{ct, cz, 1 / (ct * cz)};
      Triple S;
      if (material_.remembers() && !memory_.empty()) {
        const Memory old = memory_[k];
        S = material_.with_memory(c, old, dt, keep ? &memory_[k] : nullptr);
      } else {
        S = material_.elastic(c);
      }
      const double radial = c[2] * S[2], around = c[0] * S[0] - radial, along = c[1] * S[1] - radial;
      const double w = weight_[k] * R_[k] / per_length;
      sum.pressure += w * around / r2;
      sum.axial += std::numbers::pi * w * (2 * along - around);
    }
    return sum;
  }

 private:
  void lay_nodes(double sector_inner, int intervals) {
    const double sector_outer = std::sqrt(sector_inner * sector_inner + closing_ * area_);
    const double f = faults_.interface, ratio = faults_.layer_ratio, mean = f * ratio + 1 - f;
    R_.clear();
    weight_.clear();
    if (ratio == 1) {
      lay_piece(sector_inner, sector_outer, 1, intervals);
    } else {
      const double at = sector_inner + f * (sector_outer - sector_inner);
      lay_piece(sector_inner, at, ratio / mean, intervals);
      lay_piece(at, sector_outer, 1 / mean, intervals);
    }
  }
  void lay_piece(double from, double to, double factor, int intervals) {
    const double step = (to - from) / intervals;
    for (int i = 0; i <= intervals; ++i) {
      R_.push_back(from + i * step);
      weight_.push_back(factor * step / 3 * (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2));
    }
  }
  /// The sector that closes to the unloaded tube without pressure, the tissue being passive.
  void close(int intervals) {
    Tissue passive = material_.tissue();
    passive.tone = passive.branch = passive.softening = 0;
    const Material bare(passive, Material::First::circumferential, 0);
    const auto vacuum = [&](double log_inner) {
      TubeFaults layers = faults_;
      Wall trial(bare, inner_, outer_, layers, closing_, std::exp(log_inner), intervals);
      return -trial.forces(1, inner_, 0, false).pressure;
    };
    const double found = rising_root(vacuum, std::log(R_.front()), 0.01, 2);
    lay_nodes(std::exp(found), intervals);
  }
  Wall(const Material& material, double inner, double outer, const TubeFaults& faults, double closing,
       double sector_inner, int intervals)
      : material_(material),
        inner_(inner),
        outer_(outer),
        area_(outer * outer - inner * inner),
        faults_(faults),
        closing_(closing) {
    lay_nodes(sector_inner, intervals);
  }

  [[nodiscard]] double outer_now(double lambda_z, double ri) const { return std::sqrt(ri * ri + area_ / lambda_z); }
  [[nodiscard]] double support(double lambda_z, double ri, bool supported) const {
    return supported && faults_.support != 0 ? faults_.support * (outer_now(lambda_z, ri) - free_) / outer_ : 0;
  }

  const Material& material_;
  double inner_, outer_, area_;
  TubeFaults faults_;
  double closing_;
  std::vector<double> R_, weight_;
  std::vector<Memory> memory_;
  double y_ = std::numeric_limits<double>::quiet_NaN(), free_ = 0;
  Forces held_{};
};

}  // namespace

TubeRecord record(const Tube& tube, const Tissue& tissue, const TubeFaults& faults) {
  return record(tube, tissue, faults, default_intervals);
}

TubeRecord record(const Tube& tube, const Tissue& tissue, const TubeFaults& faults, int intervals) {
  const Material material(tissue, Material::First::circumferential, 0);
  const double outer = tube.inner_radius + tube.thickness, inner = outer - tube.thickness * (1 + faults.thickness);
  Wall wall(material, inner, outer, faults, intervals);
  const double largest = *std::max_element(tube.pressure.begin(), tube.pressure.end());
  const auto truth = [&](double p) {
    return p * (1 + faults.pressure_gain + faults.pressure_bend * p / largest) + faults.pressure_offset;
  };
  const auto held = [&](double p) { return tube.axial_stretch + faults.axial_stretch - faults.slip * p / largest; };
  if (faults.support != 0) wall.rest_support(held(0));

  TubeRecord all;
  double before = 0, clock = 0;
  bool lost = false;
  for (std::size_t i = 0; i < tube.pressure.size(); ++i) {
    const double now = tube.pressure[i], dt = tube.time[i] - clock;
    const int steps = material.remembers() && dt > 0 ? tube_substeps : 1;
    for (int k = 1; k <= steps && !lost; ++k) {
      const double p = before + (now - before) * k / steps;
      lost = !wall.follow(held(p), truth(p), dt / steps, true);
    }
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const double oval = 1 + faults.ovality * std::exp(-3 * now / largest);
    all.diameter.push_back(lost ? none : oval * wall.diameter_stretch(held(now)) / (1 + faults.diameter_gain));
    all.force.push_back(lost ? none : (wall.axial_force(held(now)) - faults.force_offset) / (1 + faults.force_gain));
    before = now;
    clock = tube.time[i];
  }
  return all;
}

double pressure_at(const Tube& tube, const Tissue& tissue, double widened) {
  const Material material(tissue, Material::First::circumferential, 0);
  Wall wall(material, tube.inner_radius, tube.inner_radius + tube.thickness, {}, default_intervals);
  return wall.forces(tube.axial_stretch, widened * tube.inner_radius, 0, false).pressure;
}

}  // namespace blind
