// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"

/// Polynomials in x = I1 − 3 and y = I2 − 3 (Rivlin 1948), as parts whose invariants are linear in I1 and I2.
///
/// A product is a difference of powers of s = x + y and d = x − y:
///
///     x y = (s² − d²)/4,   x² y = (s³ − d³)/6 − y³/3,   x y² = (s³ + d³)/6 − x³/3
namespace tunica::isotropic {

/// One term c x^m y^n.
struct PolynomialTerm {
  std::size_t first,    ///< m
      second,           ///< n; m + n is at most 3 where both are above 0
      parameter;        ///< index of c among the parameters of the model
  double factor = 1.0;  ///< times c
};

/// ψ(z) = Σ factor_k p_k z^power_k of z = i1 (I1 − 3) + i2 (I2 − 3). Derivatives are by hand.
class PolynomialPart final : public EnergyPart {
 public:
  /// One summand of ψ.
  struct Summand {
    std::size_t parameter,  ///< index of p_k among the parameters of the model
        power;              ///< from 1
    double factor;          ///< times p_k
  };

  /// A part of z = i1 (I1 − 3) + i2 (I2 − 3); summands may be added until it is used.
  PolynomialPart(std::string name, double i1, double i2) : i1_(i1), i2_(i2) {
    description_.name = std::move(name);
    description_.linear = true;
  }
  /// Adds a summand.
  void add(const Summand& summand) {
    auto& indices = description_.response_parameters;
    auto at = std::find(indices.begin(), indices.end(), summand.parameter);
    rows_.push_back(static_cast<std::size_t>(at - indices.begin()));
    if (at == indices.end()) indices.push_back(summand.parameter);
    summands_.push_back(summand);
    description_.linear = description_.linear && summand.power == 1;
  }
  /// Whether ψ has no summand.
  [[nodiscard]] bool empty() const { return summands_.empty(); }

  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double>, Invariant& value, std::span<Invariant>) const override {
    value = {.i1 = i1_, .i2 = i2_, .offset = -3 * (i1_ + i2_)};
  }
  void respond(std::span<const double> parameters, const ResponseBatch& b) const override {
    for (const std::span<double> rows : {b.value, b.first, b.second, b.value_dp, b.first_dp})
      std::fill(rows.begin(), rows.end(), 0.0);
    const std::size_t n = b.x.size();
    for (std::size_t k = 0; k < summands_.size(); ++k) {
      const auto [parameter, power, factor] = summands_[k];
      const double p = factor * parameters[parameter];
      const auto m = static_cast<double>(power);
      for (std::size_t i = 0; i < n; ++i) {
        double before = 0, slope = 1;  // z^(m−2) and z^(m−1)
        for (std::size_t j = 1; j < power; ++j) {
          before = slope;
          slope *= b.x[i];
        }
        if (!b.value.empty()) b.value[i] += p * slope * b.x[i];
        if (!b.first.empty()) b.first[i] += p * m * slope;
        if (!b.second.empty()) b.second[i] += p * m * (m - 1) * before;
        if (!b.value_dp.empty()) b.value_dp[rows_[k] * n + i] += factor * slope * b.x[i];
        if (!b.first_dp.empty()) b.first_dp[rows_[k] * n + i] += factor * m * slope;
      }
    }
  }

 private:
  double i1_, i2_;
  std::vector<Summand> summands_;
  std::vector<std::size_t> rows_;  ///< of a summand's parameter among those of the response
  Description description_;
};

/// The parts of Σ c x^m y^n: one of I1 ("matrix"), one of I2 ("second_invariant"), one of their sum and one of their
/// difference, each where it has a summand.
inline EnergyParts polynomial_parts(const std::vector<PolynomialTerm>& terms) {
  auto x = std::make_unique<PolynomialPart>("matrix", 1, 0);
  auto y = std::make_unique<PolynomialPart>("second_invariant", 0, 1);
  auto sum = std::make_unique<PolynomialPart>("sum_of_invariants", 1, 1);
  auto difference = std::make_unique<PolynomialPart>("difference_of_invariants", 1, -1);
  for (const auto& [m, n, p, c] : terms) {
    if (n == 0) {
      x->add({p, m, c});
    } else if (m == 0) {
      y->add({p, n, c});
    } else if (m == 1 && n == 1) {
      sum->add({p, 2, c / 4});
      difference->add({p, 2, -c / 4});
    } else {
      sum->add({p, 3, c / 6});
      difference->add({p, 3, m > n ? -c / 6 : c / 6});
      (m > n ? y : x)->add({p, 3, -c / 3});
    }
  }
  EnergyParts parts;
  for (auto* part : {&x, &y, &sum, &difference})
    if (!(*part)->empty()) parts.push_back(std::move(*part));
  return parts;
}

}  // namespace tunica::isotropic
