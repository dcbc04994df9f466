// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "term.hpp"
#include "tunica/models/arterial_fibres.hpp"

namespace tunica::composed {

/// One term as a part of the energy. Its parameters are those of the law, then those of the invariant: angle, and
/// dispersion.
class TermPart final : public EnergyPart {
 public:
  /// `law_parameters` and `invariant_parameters` are indices in the model.
  TermPart(const Term& term, std::vector<std::size_t> law_parameters, std::vector<std::size_t> invariant_parameters)
      : quantity_(term.quantity), family_(term.family), dispersion_(term.dispersion), respond_(term.law.respond) {
    description_.name = term.name;
    // A coupling is not a family, so it cannot be dispersed or recruited late.
    description_.role = quantity_ == Quantity::fibre ? Role::fibre : Role::matrix;
    description_.active = term.active;
    description_.mirrored = term.is_pair();
    description_.invariant_parameters = std::move(invariant_parameters);
    description_.response_parameters = std::move(law_parameters);
    description_.linear = term.law.linear;
  }

  [[nodiscard]] const Description& describe() const override { return description_; }

  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    switch (quantity_) {
      case Quantity::first_invariant:
        value = {.i1 = 1, .offset = -3};
        return;
      case Quantity::second_invariant:
        value = {.i2 = 1, .offset = -3};
        return;
      case Quantity::radial:
        value = {.normal = 1, .offset = -1};
        return;
      case Quantity::coupling:
        return couple(own(parameters, 0) * degree, value, derivatives);
      case Quantity::across:
        value = {.across = 1};
        return turn(parameters, value, derivatives);
      case Quantity::fibre:
      case Quantity::stretches:
      case Quantity::product:
      case Quantity::volume:  // none is one part
        break;
    }
    fibre(parameters, value, derivatives);
  }

  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    std::array<double, hyperelastic::max_part_parameters> p;
    const auto& indices = description_.response_parameters;
    for (std::size_t j = 0; j < indices.size(); ++j) p[j] = parameters[indices[j]];
    respond_({p.data(), indices.size()}, batch);
  }

 private:
  [[nodiscard]] double own(std::span<const double> parameters, std::size_t k) const {
    return parameters[description_.invariant_parameters[k]];
  }

  /// M1·C M2 = cos²θ C_zz − sin²θ C_tt = C_zz − sin²θ (I1 − C_rr); cos 2θ at rest.
  static void couple(double theta, Invariant& value, std::span<Invariant> derivatives) {
    const double s2 = std::sin(theta) * std::sin(theta), slope = std::sin(2 * theta) * degree;
    value = {.i1 = -s2, .fibre = 1, .normal = s2, .offset = -std::cos(2 * theta)};
    if (!derivatives.empty()) derivatives[0] = {.i1 = -slope, .normal = slope, .offset = 2 * slope};
  }

  [[nodiscard]] bool is_angled() const { return family_ == Family::diagonal || family_ == Family::single; }
  /// The family's angle, a parameter or fixed.
  void turn(std::span<const double> parameters, Invariant& value, std::span<Invariant> derivatives) const {
    if (family_ == Family::circumferential) value.angle = 90 * degree;
    if (!is_angled()) return;
    value.angle = own(parameters, 0) * degree;
    if (!derivatives.empty()) derivatives[0] = {.angle = degree};
  }

  /// M·CM − 1;  κ I1 + (1 − 3κ) M·CM − 1;  A I1 + B M·CM + (1 − 3A − B) C_rr − 1.
  void fibre(std::span<const double> parameters, Invariant& value, std::span<Invariant> derivatives) const {
    const std::size_t first = is_angled() ? 1 : 0;
    value = {.fibre = 1, .offset = -1};
    turn(parameters, value, derivatives);
    if (dispersion_ == Dispersion::rotational) {
      const double kappa = own(parameters, first);
      value.i1 = kappa;
      value.fibre = 1 - 3 * kappa;
    } else if (dispersion_ == Dispersion::two_planes) {
      const double a = own(parameters, first), b = own(parameters, first + 1);
      value.i1 = a;
      value.fibre = b;
      value.normal = 1 - 3 * a - b;
    }
    if (derivatives.empty()) return;
    if (dispersion_ == Dispersion::rotational) derivatives[first] = {.i1 = 1, .fibre = -3};
    if (dispersion_ == Dispersion::two_planes) {
      derivatives[first] = {.i1 = 1, .normal = -3};
      derivatives[first + 1] = {.fibre = 1, .normal = -1};
    }
  }

  Quantity quantity_;
  Family family_;
  Dispersion dispersion_;
  Respond respond_;
  Description description_;
};

}  // namespace tunica::composed
