// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/hyperelastic_part_batch.hpp"
#include "tunica/model.hpp"

namespace tunica::hyperelastic {

/// y += factor x; x and y do not overlap.
inline void add_multiple(double* __restrict y, const double* __restrict x, double factor, std::size_t m) {
  for (std::size_t i = 0; i < m; ++i) y[i] += factor * x[i];
}

/// The three gradient and six Hessian rows in one sweep, for an invariant that is linear in C:
///   g_a (+)= w ψ' A_a,  H_ab (+)= w ψ'' A_a A_b.
/// `assign`: the first part writes, the others add.
template <bool assign>
void sweep(const double* __restrict first, const double* __restrict second, const std::array<double, 3>& a, double w,
           double* g, double* h, std::size_t n, std::size_t m) {
  double* __restrict gt = g;
  double* __restrict gz = g + n;
  double* __restrict gr = g + 2 * n;
  double* __restrict htt = h;
  double* __restrict hzz = h + n;
  double* __restrict hrr = h + 2 * n;
  double* __restrict htz = h + 3 * n;
  double* __restrict hzr = h + 4 * n;
  double* __restrict hrt = h + 5 * n;
  const double at = w * a[0], az = w * a[1], ar = w * a[2];
  const double att = at * a[0], azz = az * a[1], arr = ar * a[2], atz = at * a[1], azr = az * a[2], art = ar * a[0];
  for (std::size_t i = 0; i < m; ++i) {
    gt[i] = (assign ? 0 : gt[i]) + at * first[i];
    gz[i] = (assign ? 0 : gz[i]) + az * first[i];
    gr[i] = (assign ? 0 : gr[i]) + ar * first[i];
  }
  for (std::size_t i = 0; i < m; ++i) {
    htt[i] = (assign ? 0 : htt[i]) + att * second[i];
    hzz[i] = (assign ? 0 : hzz[i]) + azz * second[i];
    hrr[i] = (assign ? 0 : hrr[i]) + arr * second[i];
    htz[i] = (assign ? 0 : htz[i]) + atz * second[i];
    hzr[i] = (assign ? 0 : hzr[i]) + azr * second[i];
    hrt[i] = (assign ? 0 : hrt[i]) + art * second[i];
  }
}

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

  void add(bool first_part) {
    if (out_.gradient_dp.empty()) {
      prepare({}, first_part);
    } else {
      std::array<Invariant, max_part_parameters> derivatives;
      const std::span<Invariant> wanted(derivatives.data(), description_.invariant_parameters.size());
      prepare(wanted, first_part);
      add_invariant_parameters(wanted);
      add_response_parameters();
    }
  }

 private:
  /// Invariant, response, switch; then energy, gradient and Hessian.
  void prepare(std::span<Invariant> derivatives, bool first_part) {
    part_.invariant(points_.parameters, invariant_, derivatives);
    direction_ = Direction(invariant_, 1);
    a_ = structure(invariant_, direction_);
    diagonal_ = {a_.tt, a_.zz, a_.rr};
    // x = A : C + i2 I2 + offset
    double* __restrict x = batch_.x.data();
    const double* __restrict ct = c_[0], * __restrict cz = c_[1], * __restrict cr = c_[2];
    for (std::size_t i = 0; i < m_; ++i) x[i] = a_.tt * ct[i] + a_.zz * cz[i] + a_.rr * cr[i] + a_.offset;
    if (a_.i2 != 0)
      for (std::size_t i = 0; i < m_; ++i) x[i] += a_.i2 * second_invariant(i);

    const bool parameters = !out_.gradient_dp.empty();
    const PartBatch::Wants wants{!out_.energy.empty(), !out_.gradient.empty() || parameters || a_.i2 != 0,
                                 !out_.hessian.empty() || !derivatives.empty(), parameters};
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
      for (std::size_t i = 0; i < m_; ++i) energy[i] = (first_part ? 0 : energy[i]) + weight_ * batch_.value[i];
    }
    const bool both = !out_.gradient.empty() && !out_.hessian.empty();
    if (both && a_.i2 == 0) {
      double *const g = out_.gradient.data() + begin_, *const h = out_.hessian.data() + begin_;
      (first_part ? sweep<true> : sweep<false>)(batch_.first.data(), batch_.second.data(), diagonal_, weight_, g, h, n_,
                                                m_);
    } else {
      add_gradient_and_hessian(first_part);
    }
  }

  /// The general route: any combination of outputs, invariants with I2.
  void add_gradient_and_hessian(bool first_part) {
    const auto add = [&](double& y, double term) { y = (first_part ? 0 : y) + weight_ * term; };
    for (std::size_t k = 0; k < 3 && !out_.gradient.empty(); ++k) {
      double* const g = out_.gradient.data() + k * n_ + begin_;
      for (std::size_t i = 0; i < m_; ++i) add(g[i], batch_.first[i] * slope(k, i));
    }
    // H_ab = Σ w (ψ'' ∂x/∂c_a ∂x/∂c_b + ψ' ∂²x/∂c_a∂c_b),  ∂²I2/∂c_a∂c_b = 1 for a ≠ b
    static constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};
    for (std::size_t k = 0; k < 6 && !out_.hessian.empty(); ++k) {
      double* const h = out_.hessian.data() + k * n_ + begin_;
      const auto [p, q] = pair[k];
      const double mixed = p != q ? a_.i2 : 0;
      for (std::size_t i = 0; i < m_; ++i)
        add(h[i], batch_.second[i] * slope(p, i) * slope(q, i) + (mixed != 0 ? batch_.first[i] * mixed : 0));
    }
  }

  /// ∂g_a/∂p = Σ w (ψ'' ∂x/∂p ∂x/∂c_a + ψ' ∂²x/∂c_a∂p) for the parameters of the invariant
  void add_invariant_parameters(std::span<const Invariant> derivatives) {
    PartBatch::Row x_p;
    for (std::size_t j = 0; j < derivatives.size(); ++j) {
      const Structure d = structure_derivative(invariant_, derivatives[j], direction_, 1);
      const std::array<double, 3> d_diagonal{d.tt, d.zz, d.rr};
      for (std::size_t i = 0; i < m_; ++i)
        x_p[i] = batch_.second[i] * (d.tt * c_[0][i] + d.zz * c_[1][i] + d.rr * c_[2][i] + d.offset);
      if (d.i2 != 0)
        for (std::size_t i = 0; i < m_; ++i) x_p[i] += batch_.second[i] * d.i2 * second_invariant(i);
      for (std::size_t k = 0; k < 3; ++k) {
        double* const g = dp(description_.invariant_parameters[j], k);
        if (a_.i2 != 0 || d.i2 != 0) {
          for (std::size_t i = 0; i < m_; ++i)
            g[i] += weight_ * (x_p[i] * slope(k, i) + batch_.first[i] * (d_diagonal[k] + d.i2 * (trace(i) - c_[k][i])));
        } else {
          add_multiple(g, x_p.data(), weight_ * diagonal_[k], m_);
          add_multiple(g, batch_.first.data(), weight_ * d_diagonal[k], m_);
        }
      }
    }
  }

  /// ∂g_a/∂p = Σ w ∂ψ'/∂p ∂x/∂c_a for the parameters of the response
  void add_response_parameters() {
    for (std::size_t j = 0; j < description_.response_parameters.size(); ++j) {
      const double* const first_p = batch_.first_dp.data() + j * m_;
      for (std::size_t k = 0; k < 3; ++k) {
        double* const g = dp(description_.response_parameters[j], k);
        if (a_.i2 != 0)
          for (std::size_t i = 0; i < m_; ++i) g[i] += weight_ * first_p[i] * slope(k, i);
        else
          add_multiple(g, first_p, weight_ * diagonal_[k], m_);
      }
    }
  }

  [[nodiscard]] double trace(std::size_t i) const { return c_[0][i] + c_[1][i] + c_[2][i]; }
  [[nodiscard]] double second_invariant(std::size_t i) const {
    return c_[0][i] * c_[1][i] + c_[1][i] * c_[2][i] + c_[2][i] * c_[0][i];
  }
  /// ∂x/∂c_a = A_a + i2 (I1 − c_a)
  [[nodiscard]] double slope(std::size_t a, std::size_t i) const {
    return diagonal_[a] + a_.i2 * (trace(i) - c_[a][i]);
  }
  [[nodiscard]] double* dp(std::size_t parameter, std::size_t component) const {
    return out_.gradient_dp.data() + (3 * parameter + component) * n_ + begin_;
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
inline void evaluate_axes(const Parts& parts, const AxisPoints& points, const AxisResponse& out) {
  std::fill(out.gradient_dp.begin(), out.gradient_dp.end(), 0.0);
  for (std::size_t begin = 0; begin < points.count; begin += chunk)
    for (std::size_t k = 0; k < parts.size(); ++k)
      AxesPart(*parts[k], points, out, begin, std::min(chunk, points.count - begin)).add(k == 0);
}

}  // namespace tunica::hyperelastic
