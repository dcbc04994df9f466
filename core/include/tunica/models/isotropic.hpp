// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/law_part.hpp"
#include "tunica/models/laws.hpp"

/// Parts of isotropic energies, functions of I1 or of I2. All of them count as matrix, so that mechanisms of the
/// matrix, such as matrix_stiffening, can transform them.
namespace tunica::isotropic {

/// The invariant x = I1 − 3.
struct FirstInvariant {
  /// I1 − 3, whatever the parameters.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    return {.i1 = T(1), .offset = T(-3)};
  }
};

/// The invariant x = I2 − 3.
struct SecondInvariant {
  /// I2 − 3, whatever the parameters.
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    return {.i2 = T(1), .offset = T(-3)};
  }
};

/// ψ(x; p) with the formula of Law (tunica/models/laws.hpp) and x of Geometry.
///
/// `parameters` are the indices of p among the model's parameters, in the order of the law. Set `linear` where ψ'' is
/// zero: the kernels then skip it.
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

/// What a plugin registers for a material whose whole energy is one function of I1 − 3, W = ψ(I1 − 3; p).
/// `description.parameters` are the p of the law, in its order.
template <class Law>
ModelFactory first_invariant_factory(ModelDescription description, std::string doc, std::string reference) {
  return hyperelastic_factory(std::move(description), std::move(doc), std::move(reference), [](const Options&) {
    std::vector<std::size_t> all(Law::parameter_count);
    for (std::size_t j = 0; j < all.size(); ++j) all[j] = j;
    return energy_parts(part<Law, FirstInvariant, Law::parameter_count>("matrix", all));
  });
}

}  // namespace tunica::isotropic
