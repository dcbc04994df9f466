// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numbers>

#include "sections.hpp"

namespace tunica::thick_wall {

/// A node moves with the edges of its slot: ∂c/∂x = −2 (c − b), ∂R²/∂x = 2 R². The integrand is continuous at a cut:
/// moving one changes nothing.
void Sections::add_edges(std::size_t slot, bool force) {
  const std::size_t nodes = rule_->node.size(), layer = slot_layer_[slot];
  std::fill_n(numbers(left), 4 * count_, 0.0);
  over_points([this, slot, nodes, layer, force](auto weight, auto R2, auto) TUNICA_INLINE {
    const std::size_t count = count_;
    double* const sum = numbers(left);
    const double* const b_of = numbers(b);
    for (std::size_t k = 0; k < nodes; ++k) {
      const std::size_t m = slot * nodes + k, first = m * count;
      const double* const c = c_.data() + first;
      const double* const h = h_.data() + first;
      const double* const h_c = h_c_.data() + first;
      const double* const q = q_.data() + first;
      const double* const q_c = q_c_.data() + first;
      const double there = rule_->node[k], here = 1 - there, mean_weight = rule_->weight[k] * wall_->factor(layer);
      const auto w = weight(m), s = R2(m);
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) {
        const double slope = -2 * (c[i] - b_of[i]), h_x = w[i] * slope * h_c[i], of_length = mean_weight * h[i];
        sum[i] += here * h_x - of_length;
        sum[count + i] += there * h_x + of_length;
      }
      if (!force) continue;
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) {
        const double slope = -2 * (c[i] - b_of[i]), of_length = mean_weight * s[i] * q[i],
                     q_x = w[i] * s[i] * (slope * q_c[i] + 2 * q[i]);
        sum[2 * count + i] += here * q_x - of_length;
        sum[3 * count + i] += there * q_x + of_length;
      }
    }
    const Jet& from = edges_[layer];
    const Jet& to = edges_[layer + 1];
    for (int k = 0; k < variable_count; ++k) {
      const double by_from = from.v[k], by_to = to.v[k];
      if (by_from == 0 && by_to == 0) continue;
      double* const p_k = numbers(p_by) + static_cast<std::size_t>(k) * count;
      double* const F_k = numbers(F_by) + static_cast<std::size_t>(k) * count;
      const double* const begins = cut_ ? begins_.data() + slot * count : nullptr;
      const double* const ends = cut_ ? ends_.data() + slot * count : nullptr;
      for (std::size_t i = 0; i < count; ++i) {
        const double at_begin = begins == nullptr ? by_from : by_from * begins[i],
                     at_end = ends == nullptr ? by_to : by_to * ends[i];
        p_k[i] += sum[i] * at_begin + sum[count + i] * at_end;
        F_k[i] += sum[2 * count + i] * at_begin + sum[3 * count + i] * at_end;
      }
    }
  });
}

/// ∂p and ∂F of p = b I and F = π b/K² J, where I and J change with a, b, c_z and the edges of the layers.
GeometricDerivatives Sections::by_geometry(bool force) {
  std::fill_n(numbers(p_by), 2 * variable_count * count_, 0.0);
  for (std::size_t slot = 0; slot < slots(); ++slot) add_edges(slot, force);
  // How a = K² ri² − b R_i², b = K/λz and c_z = λz² change.
  const auto add = [this](int variable, auto by_a, auto by_b, auto by_z) {
    detail::vectorised([this, variable, by_a, by_b, by_z, count = count_] {
      const double* const lz = numbers(axial_stretch);
      const double* const ri2 = numbers(inner2);
      const double* const b_of = numbers(b);
      const double* const sum = numbers(I);
      double* const p = numbers(p_by + static_cast<std::size_t>(variable));
      double* const F = numbers(F_by + static_cast<std::size_t>(variable));
      const double K = wall_->K, sector2 = sector2_, area_factor = std::numbers::pi / (K * K),
                   F_else = variable == closing ? -2 / K : 0;
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) {
        const double per = 1 / lz[i], a_k = by_a(K, ri2[i], sector2, per), b_k = by_b(K, per), z_k = by_z(lz[i]);
        const double dI = p[i] + sum[count + i] * a_k + sum[2 * count + i] * b_k + sum[3 * count + i] * z_k;
        const double dJ = F[i] + sum[5 * count + i] * a_k + sum[6 * count + i] * b_k + sum[7 * count + i] * z_k;
        p[i] = b_k * sum[i] + b_of[i] * dI;
        F[i] = area_factor * ((b_k + F_else * b_of[i]) * sum[4 * count + i] + b_of[i] * dJ);
      }
    });
  };
  const auto no_b = [](double, double) { return 0.; };
  const auto no_z = [](double) { return 0.; };
  add(
      ln_inner, [](double K, double ri2, double, double) { return 2 * K * K * ri2; }, no_b, no_z);
  add(
      axial, [](double K, double, double sector2, double per) { return K * per * per * sector2; },
      [](double K, double per) { return -K * per * per; }, [](double lz) { return 2 * lz; });
  add(
      closing, [](double K, double ri2, double sector2, double per) { return 2 * K * ri2 - sector2 * per; },
      [](double, double per) { return per; }, no_z);
  add(
      area, [](double, double, double, double) { return 0.; }, no_b, no_z);
  add(
      ln_sector, [](double K, double, double sector2, double per) { return -2 * K * per * sector2; }, no_b, no_z);
  GeometricDerivatives found;
  for (std::size_t k = 0; k < variable_count; ++k) {
    found.p[k] = numbers(p_by + k);
    found.F[k] = numbers(F_by + k);
  }
  return found;
}

/// p = b Σ w T/c and F = π b/K² Σ w R² (2Z − T), with T = 2 (c g_t − c_r g_r), Z = 2 (c_z g_z − c_r g_r) and c c_z c_r
/// = 1, are linear in g. Their factors are the same for every parameter.
void Sections::prepare_parameters(bool force) {
  if (adjoint_.size() < 5 * n_) adjoint_.resize(5 * n_);
  over_points([this, force, n = n_, count = count_, K = wall_->K, b_of = numbers(b)](auto weight, auto R2, auto)
                  TUNICA_INLINE {
                    for (std::size_t m = 0; m * count < n; ++m) {
                      const double* const ct = c_.data() + m * count;
                      const double* const cz_of = ct + n;
                      const double* const cr = ct + 2 * n;
                      double* const to = adjoint_.data() + m * count;
                      const auto w_of = weight(m), s_of = R2(m);
                      TUNICA_LANES
                      for (std::size_t i = 0; i < count; ++i) {
                        const double w = 2 * b_of[i] * w_of[i];
                        to[i] = w;
                        to[n + i] = -w * cr[i] * cr[i] * cz_of[i];
                      }
                      if (!force) continue;
                      const double area_factor = std::numbers::pi / (K * K);
                      TUNICA_LANES
                      for (std::size_t i = 0; i < count; ++i) {
                        const double w = 2 * area_factor * b_of[i] * w_of[i] * s_of[i];
                        to[2 * n + i] = -w * ct[i];
                        to[3 * n + i] = 2 * w * cz_of[i];
                        to[4 * n + i] = -w * cr[i];
                      }
                    }
                  });
}

void Sections::by_parameter(std::size_t j, double* p, double* F) const {
  const std::size_t nodes = rule_->node.size(), material = layers_->material_of(j);
  const double at_rest = rest_ == nullptr ? 0 : rest_->by_parameter[j];
  std::fill_n(p, count_, 0.0);
  if (F != nullptr) std::fill_n(F, count_, 0.0);
  detail::vectorised([this, j, p, F, nodes, material, at_rest, n = n_, count = count_] {
    for (std::size_t m = 0; m < slots() * nodes; ++m) {
      if (layers_->size() > 1 && slot_layer_[m / nodes] != material) continue;
      const double* const gt = gradient_dp_.data() + 3 * j * n + m * count;
      const double* const gz = gt + n;
      const double* const gr = gz + n;
      const double* const by = adjoint_.data() + m * count;
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) p[i] += by[i] * gt[i] + by[n + i] * gr[i];
      if (at_rest != 0) {
        const double* const cz_of = c_.data() + n + m * count;
        for (std::size_t i = 0; i < count; ++i) p[i] -= 0.5 * at_rest * by[i] * cz_of[i] * cz_of[n + i];
      }
      if (F == nullptr) continue;
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i)
        F[i] += by[2 * n + i] * gt[i] + by[3 * n + i] * gz[i] + by[4 * n + i] * gr[i];
    }
  });
}

void Sections::by_ratio(double* p, double* F) const {
  const std::size_t nodes = rule_->node.size();
  std::fill_n(p, count_, 0.0);
  if (F != nullptr) std::fill_n(F, count_, 0.0);
  over_points([this, p, F, nodes, count = count_](auto weight, auto R2, auto) TUNICA_INLINE {
    const double* const b_of = numbers(b);
    const double area_factor = std::numbers::pi / (wall_->K * wall_->K);
    for (std::size_t m = 0; m < slots() * nodes; ++m) {
      const std::size_t layer = slot_layer_[m / nodes];
      const double change = (layer == 0 ? wall_->inner_by_ratio : wall_->outer_by_ratio) / wall_->factor(layer);
      const double* const h = h_.data() + m * count;
      const double* const q = q_.data() + m * count;
      const auto w = weight(m), s = R2(m);
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) p[i] += b_of[i] * change * w[i] * h[i];
      if (F == nullptr) continue;
      TUNICA_LANES
      for (std::size_t i = 0; i < count; ++i) F[i] += area_factor * b_of[i] * change * w[i] * s[i] * q[i];
    }
  });
}

}  // namespace tunica::thick_wall
