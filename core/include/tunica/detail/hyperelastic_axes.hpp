// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>

#include "tunica/detail/hyperelastic_part_batch.hpp"
#include "tunica/model.hpp"

namespace tunica::hyperelastic {

/// y_k (+)= a_k x for three rows in one sweep. `assign`: the first part that has something to say writes, the others
/// add. Nothing overlaps.
template <bool assign>
[[gnu::always_inline]] inline void sweep3(double* y, std::size_t n, const double* __restrict x,
                                          const std::array<double, 3>& a, std::size_t m) {
  double* __restrict y0 = y;
  double* __restrict y1 = y + n;
  double* __restrict y2 = y + 2 * n;
  const auto [a0, a1, a2] = a;
  TUNICA_LANES
  for (std::size_t i = 0; i < m; ++i) {
    y0[i] = (assign ? 0 : y0[i]) + a0 * x[i];
    y1[i] = (assign ? 0 : y1[i]) + a1 * x[i];
    y2[i] = (assign ? 0 : y2[i]) + a2 * x[i];
  }
}
/// y_k (+)= a_k x + b_k z
template <bool assign>
[[gnu::always_inline]] inline void sweep_both(double* y, std::size_t n, const double* __restrict x,
                                              const std::array<double, 3>& a, const double* __restrict z,
                                              const std::array<double, 3>& b, std::size_t m) {
  double* __restrict y0 = y;
  double* __restrict y1 = y + n;
  double* __restrict y2 = y + 2 * n;
  const auto [a0, a1, a2] = a;
  const auto [b0, b1, b2] = b;
  TUNICA_LANES
  for (std::size_t i = 0; i < m; ++i) {
    y0[i] = (assign ? 0 : y0[i]) + (a0 * x[i] + b0 * z[i]);
    y1[i] = (assign ? 0 : y1[i]) + (a1 * x[i] + b1 * z[i]);
    y2[i] = (assign ? 0 : y2[i]) + (a2 * x[i] + b2 * z[i]);
  }
}
/// H_ab (+)= w ψ'' A_a A_b, six rows in the order tt, zz, rr, tz, zr, tr.
template <bool assign>
[[gnu::always_inline]] inline void sweep_hessian(double* h, std::size_t n, const double* __restrict second,
                                                 const std::array<double, 3>& a, double w, std::size_t m) {
  sweep3<assign>(h, n, second, {w * a[0] * a[0], w * a[1] * a[1], w * a[2] * a[2]}, m);
  sweep3<assign>(h + 3 * n, n, second, {w * a[0] * a[1], w * a[1] * a[2], w * a[2] * a[0]}, m);
}

/// What the parts before have written in this chunk; the first to write a row assigns it, so that no row is cleared
/// beforehand.
struct Written {
  bool values = false, hessian = false;  ///< energy and gradient; Hessian
  std::bitset<max_model_parameters> parameters, energy_parameters;
};

/// One part at the points [begin, begin + m), C diagonal. A mirrored pair of families then sees the same x: weight 2
/// instead of a second evaluation.
class AxesPart {
 public:
  AxesPart(const EnergyPart& part, const AxisPoints& points, const AxisResponse& out, std::size_t begin, std::size_t m)
      : description_(part.describe()),
        part_(part),
        points_(points),
        out_(out),
        begin_(begin),
        m_(m),
        n_(points.count),
        c_{points.c.data() + begin, points.c.data() + n_ + begin, points.c.data() + 2 * n_ + begin},
        weight_(description_.mirrored ? 2 : 1) {}

  void add(Written& written) {
    if (out_.gradient_dp.empty()) {
      prepare({}, written);
    } else {
      std::array<Invariant, max_part_parameters> derivatives;
      const std::span<Invariant> wanted(derivatives.data(), description_.invariant_parameters.size());
      prepare(wanted, written);
      add_energy_parameters(wanted, written);
      add_invariant_parameters(wanted, written);
      add_response_parameters(written);
    }
  }

 private:
  /// Invariant, response, switch; then energy, gradient and Hessian.
  void prepare(std::span<Invariant> derivatives, Written& written) {
    part_.invariant(points_.parameters, invariant_, derivatives);
    direction_ = Direction(invariant_, 1);
    a_ = structure(invariant_, direction_);
    diagonal_ = {a_.tt, a_.zz, a_.rr};
    // x = A : C + i2 I2 + offset
    double* __restrict x = batch_.x.data();
    const double* __restrict ct = c_[0];
    const double* __restrict cz = c_[1];
    const double* __restrict cr = c_[2];
    TUNICA_LANES
    for (std::size_t i = 0; i < m_; ++i) x[i] = a_.tt * ct[i] + a_.zz * cz[i] + a_.rr * cr[i] + a_.offset;
    if (a_.i2 != 0)
      for (std::size_t i = 0; i < m_; ++i) x[i] += a_.i2 * second_invariant(i);

    const bool parameters = !out_.gradient_dp.empty();
    const PartBatch::Wants wants{!out_.energy.empty(), !out_.gradient.empty() || parameters || a_.i2 != 0,
                                 !description_.linear && (!out_.hessian.empty() || !derivatives.empty()), parameters,
                                 !out_.energy_dp.empty()};
    if (description_.linear) std::fill_n(batch_.second.data(), derivatives.empty() ? 0 : m_, 0.0);
    batch_.respond(part_, points_.parameters, m_, wants);
    const std::size_t response_count = description_.response_parameters.size();
    if (description_.active == EnergyPart::Active::argument_positive) {
      batch_.switch_off_below(batch_.x, 0, response_count, m_, wants);
    } else if (description_.active == EnergyPart::Active::fibre_stretched) {
      PartBatch::Row i4;
      for (std::size_t i = 0; i < m_; ++i)
        i4[i] = direction_.s * direction_.s * ct[i] + direction_.c * direction_.c * cz[i];
      batch_.switch_off_below(i4, 1, response_count, m_, wants);
    }
    if (!out_.energy.empty()) {
      double* const energy = out_.energy.data() + begin_;
      for (std::size_t i = 0; i < m_; ++i) energy[i] = (written.values ? energy[i] : 0) + weight_ * batch_.value[i];
    }
    if (!out_.gradient.empty()) add_gradient(written.values);
    if (!out_.hessian.empty() && !(description_.linear && a_.i2 == 0)) {
      add_hessian(written.hessian);
      written.hessian = true;
    }
    written.values = true;
  }

  /// g_a = Σ w ψ' ∂x/∂c_a
  void add_gradient(bool onto) const {
    double* const g = out_.gradient.data() + begin_;
    if (a_.i2 == 0) return sweep(onto, g, batch_.first.data());
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t i = 0; i < m_; ++i)
        g[k * n_ + i] = (onto ? g[k * n_ + i] : 0) + weight_ * batch_.first[i] * slope(k, i);
  }

  /// H_ab = Σ w (ψ'' ∂x/∂c_a ∂x/∂c_b + ψ' ∂²x/∂c_a∂c_b),  ∂²I2/∂c_a∂c_b = 1 for a ≠ b
  void add_hessian(bool onto) const {
    double* const h = out_.hessian.data() + begin_;
    const double* const second = batch_.second.data();
    if (a_.i2 == 0) {
      if (onto)
        sweep_hessian<false>(h, n_, second, diagonal_, weight_, m_);
      else
        sweep_hessian<true>(h, n_, second, diagonal_, weight_, m_);
      return;
    }
    static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t k = 0; k < 6; ++k) {
      const auto [p, q] = pair[k];
      const double mixed = p != q ? a_.i2 : 0;
      for (std::size_t i = 0; i < m_; ++i) {
        const double curvature = description_.linear ? 0 : second[i] * slope(p, i) * slope(q, i);
        const double bend = mixed != 0 ? batch_.first[i] * mixed : 0;
        h[k * n_ + i] = (onto ? h[k * n_ + i] : 0) + weight_ * (curvature + bend);
      }
    }
  }

  /// ∂W/∂p = Σ w (ψ' ∂x/∂p + ∂ψ/∂p). Before the rows of g_a by the same parameters: those mark them as written.
  void add_energy_parameters(std::span<const Invariant> derivatives, Written& written) const {
    if (out_.energy_dp.empty()) return;
    const auto row = [this, &written](std::size_t parameter) {
      double* const to = out_.energy_dp.data() + parameter * n_ + begin_;
      if (!written.energy_parameters[parameter]) std::fill_n(to, m_, 0.0);
      written.energy_parameters.set(parameter);
      return to;
    };
    for (std::size_t j = 0; j < derivatives.size(); ++j) {
      const Structure d = structure_derivative(invariant_, derivatives[j], direction_, 1);
      double* const to = row(description_.invariant_parameters[j]);
      for (std::size_t i = 0; i < m_; ++i)
        to[i] += weight_ * batch_.first[i] *
                 (d.tt * c_[0][i] + d.zz * c_[1][i] + d.rr * c_[2][i] + d.offset +
                  (d.i2 != 0 ? d.i2 * second_invariant(i) : 0));
    }
    for (std::size_t j = 0; j < description_.response_parameters.size(); ++j) {
      double* const to = row(description_.response_parameters[j]);
      for (std::size_t i = 0; i < m_; ++i) to[i] += weight_ * batch_.value_dp[j * batch_.lanes + i];
    }
  }

  /// ∂g_a/∂p = Σ w (ψ'' ∂x/∂p ∂x/∂c_a + ψ' ∂²x/∂c_a∂p) for the parameters of the invariant
  void add_invariant_parameters(std::span<const Invariant> derivatives, Written& written) const {
    PartBatch::Row x_p;
    for (std::size_t j = 0; j < derivatives.size(); ++j) {
      const std::size_t parameter = description_.invariant_parameters[j];
      const Structure d = structure_derivative(invariant_, derivatives[j], direction_, 1);
      const std::array<double, 3> d_diagonal{d.tt, d.zz, d.rr};
      for (std::size_t i = 0; i < m_; ++i)
        x_p[i] = batch_.second[i] * (d.tt * c_[0][i] + d.zz * c_[1][i] + d.rr * c_[2][i] + d.offset);
      if (d.i2 != 0)
        for (std::size_t i = 0; i < m_; ++i) x_p[i] += batch_.second[i] * d.i2 * second_invariant(i);
      double* const g = dp(parameter);
      const bool onto = written.parameters[parameter];
      if (a_.i2 == 0 && d.i2 == 0) {
        const std::array<double, 3> of_x = scaled(diagonal_), of_first = scaled(d_diagonal);
        if (onto)
          sweep_both<false>(g, n_, x_p.data(), of_x, batch_.first.data(), of_first, m_);
        else
          sweep_both<true>(g, n_, x_p.data(), of_x, batch_.first.data(), of_first, m_);
      } else {
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t i = 0; i < m_; ++i)
            g[k * n_ + i] =
                (onto ? g[k * n_ + i] : 0) +
                weight_ * (x_p[i] * slope(k, i) + batch_.first[i] * (d_diagonal[k] + d.i2 * (trace(i) - c_[k][i])));
      }
      written.parameters.set(parameter);
    }
  }

  /// ∂g_a/∂p = Σ w ∂ψ'/∂p ∂x/∂c_a for the parameters of the response
  void add_response_parameters(Written& written) const {
    for (std::size_t j = 0; j < description_.response_parameters.size(); ++j) {
      const std::size_t parameter = description_.response_parameters[j];
      const double* const first_p = batch_.first_dp.data() + j * batch_.lanes;
      double* const g = dp(parameter);
      const bool onto = written.parameters[parameter];
      if (a_.i2 == 0) {
        sweep(onto, g, first_p);
      } else {
        for (std::size_t k = 0; k < 3; ++k)
          for (std::size_t i = 0; i < m_; ++i)
            g[k * n_ + i] = (onto ? g[k * n_ + i] : 0) + weight_ * first_p[i] * slope(k, i);
      }
      written.parameters.set(parameter);
    }
  }

  /// y_k (+)= w A_k x. No pointers to functions: what is called by one is not inlined.
  void sweep(bool onto, double* y, const double* x) const {
    if (onto)
      sweep3<false>(y, n_, x, scaled(diagonal_), m_);
    else
      sweep3<true>(y, n_, x, scaled(diagonal_), m_);
  }
  [[nodiscard]] std::array<double, 3> scaled(const std::array<double, 3>& a) const {
    return {weight_ * a[0], weight_ * a[1], weight_ * a[2]};
  }
  [[nodiscard]] double trace(std::size_t i) const { return c_[0][i] + c_[1][i] + c_[2][i]; }
  [[nodiscard]] double second_invariant(std::size_t i) const {
    return c_[0][i] * c_[1][i] + c_[1][i] * c_[2][i] + c_[2][i] * c_[0][i];
  }
  /// ∂x/∂c_a = A_a + i2 (I1 − c_a)
  [[nodiscard]] double slope(std::size_t a, std::size_t i) const {
    return diagonal_[a] + a_.i2 * (trace(i) - c_[a][i]);
  }
  [[nodiscard]] double* dp(std::size_t parameter) const {
    return out_.gradient_dp.data() + 3 * parameter * n_ + begin_;
  }

  const EnergyPart::Description& description_;
  const EnergyPart& part_;
  const AxisPoints& points_;
  const AxisResponse& out_;
  std::size_t begin_, m_, n_;
  std::array<const double*, 3> c_;
  double weight_;
  Invariant invariant_;
  Direction direction_;
  Structure a_;
  std::array<double, 3> diagonal_;
  PartBatch batch_;
};

/// Model::evaluate_axes for a sum of parts.
inline void evaluate_axes_on_this_level(const Parts& parts, const AxisPoints& points, const AxisResponse& out) {
  const std::size_t n = points.count;
  const auto clear = [n](std::span<double> rows, std::size_t first, std::size_t count, std::size_t begin,
                         std::size_t m) {
    for (std::size_t k = first; k < first + count; ++k) std::fill_n(rows.data() + k * n + begin, m, 0.0);
  };
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    const std::size_t m = std::min(chunk, n - begin);
    Written written;
    for (const auto& part : parts) AxesPart(*part, points, out, begin, m).add(written);
    // Rows that no part has anything to say about.
    if (!written.hessian && !out.hessian.empty()) clear(out.hessian, 0, 6, begin, m);
    for (std::size_t j = 0; !out.gradient_dp.empty() && j < points.parameters.size(); ++j)
      if (!written.parameters[j]) clear(out.gradient_dp, 3 * j, 3, begin, m);
    for (std::size_t j = 0; !out.energy_dp.empty() && j < points.parameters.size(); ++j)
      if (!written.energy_parameters[j]) clear(out.energy_dp, j, 1, begin, m);
  }
}

}  // namespace tunica::hyperelastic
