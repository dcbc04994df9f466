// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include <algorithm>
#include <numbers>

namespace tunica::thick_wall {
namespace {

constexpr std::size_t unknown = 1, first_direction = 2;  ///< places in a row behind the value

}  // namespace

MemoryDerivatives::MemoryDerivatives(const Tube& tube, const Wall& wall, const Rule& rule,
                                     const SectorDerivative& sector, const TestInput& input)
    : tube_(tube),
      wall_(wall),
      model_(input.model),
      parameters_(input.model_parameters),
      elastic_count_(input.model.elastic().describe().parameters.size()),
      history_(input.model.describe().axis_history_size),
      directions_(parameters_.size() + own_count),
      width_(first_direction + directions_),
      by_(directions_, Variables{}) {
  for (std::size_t j = 0; j < elastic_count_; ++j) by_[j][ln_sector] = sector.by_parameter[j];
  Variables* const own = by_.data() + parameters_.size();
  own[opening_angle][closing] = wall.closing_by_angle;
  own[opening_angle][ln_sector] = sector.by_closing * wall.closing_by_angle;
  own[axial_stretch_error][axial] = 1;
  own[thickness_error][area] = wall.area_by_error;
  own[thickness_error][ln_sector] = sector.by_area * wall.area_by_error;
  own[layer_ratio][ln_sector] = sector.by_ratio;

  std::vector<Jet> edges;
  wall.edges(edges);
  for (std::size_t layer = 0; layer < wall.layer_count(); ++layer) {
    const Jet length = edges[layer + 1] - edges[layer];
    for (std::size_t k = 0; k < rule.node.size(); ++k)
      points_.push_back(
          {exp(2.0 * (edges[layer] + rule.node[k] * length)), rule.weight[k] * wall.factor(layer) * length, layer});
  }
  n_ = points_.size() + 1;
  c_.assign(3 * n_, 1);
  energy_.resize(n_);
  gradient_.resize(3 * n_);
  hessian_.resize(6 * n_);
  gradient_dp_.resize(3 * n_ * elastic_count_);
  energy_dp_.resize(n_ * elastic_count_);
  states_.assign(points_.size() * history_ * width_, 0);
  for (auto* rows : {&c_rows_, &g_rows_}) rows->assign(3 * width_, 0);
  for (auto* row : {&energy_row_, &p_, &F_, &w_, &b_, &y_by_}) row->assign(width_, 0);
}

/// A geometric quantity as a row: by y, and by every direction at fixed y.
void MemoryDerivatives::set_row(std::size_t place, const Jet& value, double* row) const {
  row[0] = value.a;
  row[unknown] = value.v[ln_inner];
  for (std::size_t d = 0; d < directions_; ++d) {
    double sum = 0;
    for (int m = 0; m < variable_count; ++m) sum += value.v[m] * by_[d][static_cast<std::size_t>(m)];
    row[place + d] = sum;
  }
}

Status MemoryDerivatives::evaluate() {
  return model_.elastic().evaluate_axes({n_, c_, parameters_.first(elastic_count_)},
                                        {energy_, gradient_, hessian_, gradient_dp_, energy_dp_});
}

/// Energy and g of point k as rows, where its squared stretches are rows already.
void MemoryDerivatives::load(std::size_t k) {
  static constexpr std::array<std::array<std::size_t, 3>, 3> pair{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
  const double* const c = c_rows_.data();
  std::array<double, 3> g;
  for (std::size_t a = 0; a < 3; ++a) g[a] = gradient_[a * n_ + k];
  energy_row_[0] = energy_[k];
  for (std::size_t d = 1; d < width_; ++d)
    energy_row_[d] = g[0] * c[d] + g[1] * c[width_ + d] + g[2] * c[2 * width_ + d];
  for (std::size_t a = 0; a < 3; ++a) {
    double* const row = g_rows_.data() + a * width_;
    const double ht = hessian_[pair[a][0] * n_ + k], hz = hessian_[pair[a][1] * n_ + k],
                 hr = hessian_[pair[a][2] * n_ + k];
    row[0] = g[a];
    for (std::size_t d = 1; d < width_; ++d) row[d] = ht * c[d] + hz * c[width_ + d] + hr * c[2 * width_ + d];
    for (std::size_t j = 0; j < elastic_count_; ++j) row[first_direction + j] += gradient_dp_[(3 * j + a) * n_ + k];
  }
  for (std::size_t j = 0; j < elastic_count_; ++j) energy_row_[first_direction + j] += energy_dp_[j * n_ + k];
}

Status MemoryDerivatives::begin() {
  if (wall_.tether != 0)
    return Status::failed("thick_wall_pressurisation: no exact Jacobian with memory and tethering");
  if (Status status = evaluate(); !status.ok()) return status;
  for (std::size_t a = 0; a < 3; ++a) {
    std::fill_n(c_rows_.data() + a * width_, width_, 0.0);
    c_rows_[a * width_] = 1;
  }
  for (std::size_t k = 0; k < points_.size(); ++k) {
    load(n_ - 1);
    model_.remember({width_, first_direction, parameters_, 0, !tube_.time.empty(), true, true, c_rows_.data(),
                     energy_row_.data(), g_rows_.data(), of_point(k)});
  }
  return {};
}

/// p = b Σ w T/c and F = π b/K² Σ w R² (2Z − T), see Sections, with all derivatives.
Status MemoryDerivatives::add(std::size_t i, const Row& row, double time_step, std::span<double> jacobian) {
  const double y = row.y + row.step, lz = row.axial_stretch;
  const Shape<Jet> form = shape_jet(wall_, y, lz);
  std::vector<Jet> ct(points_.size());
  const Jet& cz = form.cz;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    ct[k] = form.b + form.a / points_[k].R2;
    c_[k] = ct[k].a;
    c_[n_ + k] = cz.a;
    c_[2 * n_ + k] = 1 / (ct[k].a * cz.a);
  }
  if (Status status = evaluate(); !status.ok()) return status;

  const std::size_t ratio_place = first_direction + parameters_.size() + layer_ratio;
  std::fill(p_.begin(), p_.end(), 0.0);
  std::fill(F_.begin(), F_.end(), 0.0);
  const Jet K(wall_.K, closing);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    set_row(first_direction, ct[k], c_rows_.data());
    set_row(first_direction, cz, c_rows_.data() + width_);
    set_row(first_direction, 1.0 / (ct[k] * cz), c_rows_.data() + 2 * width_);
    load(k);
    model_.remember({width_, first_direction, parameters_, time_step, !tube_.time.empty(), false, first_,
                     c_rows_.data(), energy_row_.data(), g_rows_.data(), of_point(k)});
    // T = 2 (c g_t − c_r g_r), Z = 2 (c_z g_z − c_r g_r)
    const double* const c = c_rows_.data();
    const double* const g = g_rows_.data();
    const std::size_t z = width_, r = 2 * width_;
    const double normal = c[r] * g[r], T = 2 * (c[0] * g[0] - normal), Q = 4 * (c[z] * g[z] - normal) - T;
    set_row(first_direction, form.b * point.weight / ct[k], w_.data());
    set_row(first_direction, std::numbers::pi * form.b / (K * K) * point.weight * point.R2, b_.data());
    const double factor = wall_.factor(point.layer);
    const double by_ratio = (point.layer == 0 ? wall_.inner_by_ratio : wall_.outer_by_ratio) / factor;
    w_[ratio_place] += by_ratio * w_[0];
    b_[ratio_place] += by_ratio * b_[0];
    p_[0] += w_[0] * T;
    F_[0] += b_[0] * Q;
    for (std::size_t d = 1; d < width_; ++d) {
      const double normal_d = c[r + d] * g[r] + c[r] * g[r + d];
      const double T_d = 2 * (c[d] * g[0] + c[0] * g[d] - normal_d);
      const double Q_d = 4 * (c[z + d] * g[z] + c[z] * g[z + d] - normal_d) - T_d;
      p_[d] += w_[d] * T + w_[0] * T_d;
      F_[d] += b_[d] * Q + b_[0] * Q_d;
    }
  }
  first_ = false;

  // 0 = p_y dy + p_d
  for (std::size_t d = first_direction; d < width_; ++d) y_by_[d] = -p_[d] / p_[unknown];
  for (std::size_t s = 0; s < points_.size() * history_; ++s) {
    double* const state = states_.data() + s * width_;
    for (std::size_t d = first_direction; d < width_; ++d) state[d] += state[unknown] * y_by_[d];
    state[unknown] = 0;
  }

  const std::size_t n = tube_.count(), rows = tube_.channels.size() * n;
  const double ri = std::exp(y), ro = outer_radius(wall_, y, lz);
  for (std::size_t d = 0; d < directions_; ++d) {
    const double dy = y_by_[first_direction + d], area_change = by_[d][area];
    const double ri_change = ri * dy;
    const double ro_change = (2 * ri * ri_change + area_change / lz - wall_.V * by_[d][axial] / (lz * lz)) / (2 * ro);
    for (std::size_t k = 0; k < tube_.channels.size(); ++k) {
      double& entry = jacobian[d * rows + k * n + i];
      switch (tube_.channels[k]) {
        case Channel::outer_diameter:
          entry = 2 * ro_change;
          break;
        case Channel::inner_diameter:
          entry = 2 * ri_change;
          break;
        case Channel::outer_diameter_stretch:
          entry = ro_change / wall_.Ro;
          break;
        case Channel::inner_diameter_stretch:  // Ri² = Ro² − V
          entry = (ri_change + ri * area_change / (2 * wall_.Ri * wall_.Ri)) / wall_.Ri;
          break;
        case Channel::axial_force:
          entry = F_[first_direction + d] + F_[unknown] * dy;
      }
      if (d == parameters_.size() + tethering) entry = 0;
      if (!std::isfinite(entry))
        return Status::failed("thick_wall_pressurisation: a derivative overflows at " +
                              TubeRows::row_name(i, row.pressure, lz));
    }
  }
  return {};
}

}  // namespace tunica::thick_wall
