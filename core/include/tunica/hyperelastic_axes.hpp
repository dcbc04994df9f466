// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/hyperelastic_part_batch.hpp"
#include "tunica/model.hpp"

namespace tunica::hyperelastic {

/// Adds one part to energy, gradient, Hessian and parameter derivatives at the points [begin, begin + m).
/// C is diagonal, so a mirrored pair of families sees the same x: weight 2 instead of a second evaluation.
inline void add_part_axes(const EnergyPart& part, const AxisPoints& points, const AxisResponse& out, std::size_t begin,
                          std::size_t m) {
  const EnergyPart::Description& description = part.describe();
  const std::size_t n = points.count;
  const double* const ct = points.c.data() + begin;
  const double* const cz = ct + n;
  const double* const cr = cz + n;
  const double weight = description.mirrored ? 2 : 1;

  Invariant invariant;
  std::array<Invariant, max_part_parameters> derivatives;
  const std::size_t invariant_count = out.gradient_dp.empty() ? 0 : description.invariant_parameters.size();
  part.invariant(points.parameters, invariant, {derivatives.data(), invariant_count});
  const Structure a = structure(invariant, 1);

  // x = A : C + i2 I2 + offset
  PartBatch batch;
  double* const x = batch.x.data();
  for (std::size_t i = 0; i < m; ++i) x[i] = a.tt * ct[i] + a.zz * cz[i] + a.rr * cr[i] + a.offset;
  if (a.i2 != 0)
    for (std::size_t i = 0; i < m; ++i) x[i] += a.i2 * (ct[i] * cz[i] + cz[i] * cr[i] + cr[i] * ct[i]);

  const PartBatch::Wants wants{!out.energy.empty(), !out.gradient.empty() || !out.gradient_dp.empty() || a.i2 != 0,
                               !out.hessian.empty() || invariant_count > 0, !out.gradient_dp.empty()};
  batch.respond(part, points.parameters, m, wants);
  const std::size_t response_count = description.response_parameters.size();
  if (description.active == EnergyPart::Active::argument_positive) {
    batch.switch_off_below(batch.x, 0, response_count, m, wants);
  } else if (description.active == EnergyPart::Active::fibre_stretched) {
    PartBatch::Row i4;
    const double s = std::sin(invariant.angle), c = std::cos(invariant.angle);
    for (std::size_t i = 0; i < m; ++i) i4[i] = s * s * ct[i] + c * c * cz[i];
    batch.switch_off_below(i4, 1, response_count, m, wants);
  }
  const double* const first = batch.first.data();
  const double* const second = batch.second.data();

  if (!out.energy.empty())
    for (std::size_t i = 0; i < m; ++i) out.energy[begin + i] += weight * batch.value[i];

  const std::array<double, 3> diagonal{a.tt, a.zz, a.rr};
  const std::array<const double*, 3> c{ct, cz, cr};
  // ∂I2/∂c_a = I1 − c_a; everything with i2 takes this slower general route.
  const auto slope = [&](std::size_t component, std::size_t i) {
    return diagonal[component] + a.i2 * (ct[i] + cz[i] + cr[i] - c[component][i]);
  };

  // g_a = Σ w ψ' ∂x/∂c_a
  if (!out.gradient.empty()) {
    for (std::size_t k = 0; k < 3; ++k) {
      double* const g = out.gradient.data() + k * n + begin;
      if (a.i2 != 0)
        for (std::size_t i = 0; i < m; ++i) g[i] += weight * first[i] * slope(k, i);
      else
        for (std::size_t i = 0; i < m; ++i) g[i] += weight * diagonal[k] * first[i];
    }
  }
  // H_ab = Σ w (ψ'' ∂x/∂c_a ∂x/∂c_b + ψ' ∂²x/∂c_a∂c_b),  ∂²I2/∂c_a∂c_b = 1 for a ≠ b
  static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
  const bool curved = wants.second && std::any_of(second, second + m, [](double s) { return s != 0; });
  if (!out.hessian.empty() && (curved || a.i2 != 0)) {
    for (std::size_t k = 0; k < 6; ++k) {
      double* const h = out.hessian.data() + k * n + begin;
      const auto [p, q] = pair[k];
      if (a.i2 != 0) {
        const double mixed = p != q ? a.i2 : 0;
        for (std::size_t i = 0; i < m; ++i) h[i] += weight * (second[i] * slope(p, i) * slope(q, i) + first[i] * mixed);
      } else {
        const double factor = weight * diagonal[p] * diagonal[q];
        for (std::size_t i = 0; i < m; ++i) h[i] += factor * second[i];
      }
    }
  }
  // ∂g_a/∂p = Σ w (ψ'' ∂x/∂p ∂x/∂c_a + ψ' ∂²x/∂c_a∂p + ∂ψ'/∂p ∂x/∂c_a)
  for (std::size_t j = 0; j < invariant_count; ++j) {
    const Structure d = structure_derivative(invariant, derivatives[j], 1);
    const std::array<double, 3> d_diagonal{d.tt, d.zz, d.rr};
    PartBatch::Row x_p;
    for (std::size_t i = 0; i < m; ++i)
      x_p[i] = second[i] * (d.tt * ct[i] + d.zz * cz[i] + d.rr * cr[i] + d.offset +
                            d.i2 * (ct[i] * cz[i] + cz[i] * cr[i] + cr[i] * ct[i]));
    double* const g = out.gradient_dp.data() + 3 * description.invariant_parameters[j] * n + begin;
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.i2 != 0 || d.i2 != 0)
        for (std::size_t i = 0; i < m; ++i)
          g[k * n + i] +=
              weight * (x_p[i] * slope(k, i) + first[i] * (d_diagonal[k] + d.i2 * (ct[i] + cz[i] + cr[i] - c[k][i])));
      else
        for (std::size_t i = 0; i < m; ++i) g[k * n + i] += weight * (x_p[i] * diagonal[k] + first[i] * d_diagonal[k]);
    }
  }
  for (std::size_t j = 0; wants.parameters && j < response_count; ++j) {
    const double* const first_p = batch.first_dp.data() + j * m;
    double* const g = out.gradient_dp.data() + 3 * description.response_parameters[j] * n + begin;
    for (std::size_t k = 0; k < 3; ++k) {
      if (a.i2 != 0)
        for (std::size_t i = 0; i < m; ++i) g[k * n + i] += weight * first_p[i] * slope(k, i);
      else if (diagonal[k] != 0)
        for (std::size_t i = 0; i < m; ++i) g[k * n + i] += weight * diagonal[k] * first_p[i];
    }
  }
}

/// Model::evaluate_axes for a sum of parts.
inline void evaluate_axes(const Parts& parts, const AxisPoints& points, const AxisResponse& out) {
  for (const auto& span : {out.energy, out.gradient, out.hessian, out.gradient_dp})
    std::fill(span.begin(), span.end(), 0.0);
  for (std::size_t begin = 0; begin < points.count; begin += chunk)
    for (const auto& part : parts) add_part_axes(*part, points, out, begin, std::min(chunk, points.count - begin));
}

}  // namespace tunica::hyperelastic
