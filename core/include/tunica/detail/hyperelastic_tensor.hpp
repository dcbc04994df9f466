// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/hyperelastic_part_batch.hpp"
#include "tunica/model.hpp"

namespace tunica::hyperelastic {

/// ∂x/∂C in tensor components tt, zz, rr, tz, zr, tr at one point: A + i2 (I1 1 − C).
inline std::array<double, 6> invariant_slope(const Structure& a, const std::array<double, 6>& C) {
  const double i1 = C[0] + C[1] + C[2];
  return {a.tt + a.i2 * (i1 - C[0]), a.zz + a.i2 * (i1 - C[1]), a.rr + a.i2 * (i1 - C[2]),
          a.tz - a.i2 * C[3],        a.zr - a.i2 * C[4],        a.tr - a.i2 * C[5]};
}

/// A : C + i2 I2 + offset, I2 = ½ (I1² − tr C²)
inline double invariant_value(const Structure& a, const std::array<double, 6>& C) {
  const double i2 = C[0] * C[1] + C[1] * C[2] + C[2] * C[0] - C[3] * C[3] - C[4] * C[4] - C[5] * C[5];
  return a.tt * C[0] + a.zz * C[1] + a.rr * C[2] + 2 * (a.tz * C[3] + a.zr * C[4] + a.tr * C[5]) + a.i2 * i2 + a.offset;
}

/// Adds one family of one part at the points [begin, begin + m); side as in structure().
inline void add_part_tensor(const EnergyPart& part, double side, const MaterialPoints& points,
                            const MaterialResponse& out, std::size_t begin, std::size_t m) {
  const EnergyPart::Description& description = part.describe();
  const std::size_t n = points.count;
  const auto tensor = [&](std::size_t i) {
    std::array<double, 6> C;
    for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + begin + i];
    return C;
  };

  Invariant invariant;
  std::array<Invariant, max_part_parameters> derivatives;
  const std::size_t invariant_count = out.stress_dp.empty() ? 0 : description.invariant_parameters.size();
  part.invariant(points.parameters, invariant, {derivatives.data(), invariant_count});
  const Direction fibre(invariant, side);
  const Structure a = structure(invariant, fibre);

  PartBatch batch;
  for (std::size_t i = 0; i < m; ++i) batch.x[i] = invariant_value(a, tensor(i));
  const PartBatch::Wants wants{!out.energy.empty(),
                               !out.stress.empty() || !out.tangent.empty() || !out.stress_dp.empty(),
                               !out.tangent.empty() || invariant_count > 0, !out.stress_dp.empty()};
  batch.respond(part, points.parameters, m, wants);
  const std::size_t response_count = description.response_parameters.size();
  if (description.active == EnergyPart::Active::argument_positive) {
    batch.switch_off_below(batch.x, 0, response_count, m, wants);
  } else if (description.active == EnergyPart::Active::fibre_stretched) {
    PartBatch::Row i4;
    const Structure along = structure(Invariant{.fibre = 1}, fibre);
    for (std::size_t i = 0; i < m; ++i) i4[i] = invariant_value(along, tensor(i));
    batch.switch_off_below(i4, 1, response_count, m, wants);
  }

  for (std::size_t i = 0; i < m; ++i) {
    const std::array<double, 6> C = tensor(i);
    const std::array<double, 6> slope = invariant_slope(a, C);
    if (!out.energy.empty()) out.energy[begin + i] += batch.value[i];
    // S = 2 ψ' ∂x/∂C
    if (!out.stress.empty())
      for (std::size_t c = 0; c < 6; ++c) out.stress[c * n + begin + i] += 2 * batch.first[i] * slope[c];
    // 2 ∂S/∂C = 4 ψ'' ∂x/∂C ⊗ ∂x/∂C + 4 ψ' i2 (1 ⊗ 1 − 𝕀), 𝕀 the symmetric identity
    if (!out.tangent.empty()) {
      for (std::size_t p = 0; p < 6; ++p) {
        for (std::size_t q = 0; q < 6; ++q) {
          const double identity = p == q ? (p < 3 ? 1. : 0.5) : 0.;
          const double second_derivative = (p < 3 && q < 3 ? 1. : 0.) - identity;
          out.tangent[(6 * p + q) * n + begin + i] +=
              4 * (batch.second[i] * slope[p] * slope[q] + batch.first[i] * a.i2 * second_derivative);
        }
      }
    }
    // ∂S/∂p = 2 (ψ'' ∂x/∂p ∂x/∂C + ψ' ∂²x/∂C∂p + ∂ψ'/∂p ∂x/∂C)
    for (std::size_t j = 0; j < invariant_count; ++j) {
      const Structure d = structure_derivative(invariant, derivatives[j], fibre, side);
      const std::array<double, 6> d_slope = invariant_slope(d, C);
      const double x_p = invariant_value(d, C);
      double* const row = out.stress_dp.data() + 6 * description.invariant_parameters[j] * n + begin + i;
      for (std::size_t c = 0; c < 6; ++c)
        row[c * n] += 2 * (batch.second[i] * x_p * slope[c] + batch.first[i] * d_slope[c]);
    }
    for (std::size_t j = 0; wants.parameters && j < response_count; ++j) {
      double* const row = out.stress_dp.data() + 6 * description.response_parameters[j] * n + begin + i;
      for (std::size_t c = 0; c < 6; ++c) row[c * n] += 2 * batch.first_dp[j * batch.lanes + i] * slope[c];
    }
  }
}

/// Model::evaluate for a sum of parts; a mirrored part is two families.
inline void evaluate_tensor_on_this_level(const Parts& parts, const MaterialPoints& points,
                                          const MaterialResponse& out) {
  for (const auto& span : {out.energy, out.stress, out.tangent, out.stress_dp})
    std::fill(span.begin(), span.end(), 0.0);
  for (std::size_t begin = 0; begin < points.count; begin += chunk) {
    const std::size_t m = std::min(chunk, points.count - begin);
    for (const auto& part : parts) {
      add_part_tensor(*part, 1, points, out, begin, m);
      if (part->describe().mirrored) add_part_tensor(*part, -1, points, out, begin, m);
    }
  }
}

}  // namespace tunica::hyperelastic
