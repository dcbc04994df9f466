// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/models/law_part.hpp"
#include "tunica/models/laws.hpp"

/// The parts of isotropic energies in I1 and I2: each of them is matrix, so that mechanisms can transform it.
namespace tunica::isotropic {

/// x = I1 − 3
struct FirstInvariant {
  /// I1 − 3, of no parameter.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    InvariantOf<T> x;
    x.i1 = T(1);
    x.offset = T(-3);
    return x;
  }
};

/// x = I2 − 3
struct SecondInvariant {
  /// I2 − 3, of no parameter.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    InvariantOf<T> x;
    x.i2 = T(1);
    x.offset = T(-3);
    return x;
  }
};

/// ψ(x; p) with the law's formula, x as Geometry says, p the model parameters of the given indices.
template <class Law, class Geometry, std::size_t model_parameters>
std::unique_ptr<EnergyPart> part(std::string name, std::vector<std::size_t> parameters, bool linear = false) {
  return std::make_unique<LawPart<Law, Geometry, model_parameters>>(EnergyPart::Description{
      std::move(name), EnergyPart::Role::matrix, EnergyPart::Active::always, false, {}, std::move(parameters), linear});
}

/// The neo-Hookean matrix ψ = μ/2 (I1 − 3), linear in its invariant; `mu` is the index of μ.
template <std::size_t model_parameters>
std::unique_ptr<EnergyPart> neo_hookean(std::size_t mu) {
  return part<laws::Linear, FirstInvariant, model_parameters>("matrix", {mu}, true);
}

}  // namespace tunica::isotropic
