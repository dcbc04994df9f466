// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "tunica/energy_part.hpp"
#include "tunica/options.hpp"

/// \file
/// Energies that material cards of finite-element programs can have. A model with one of these energies declares it in
/// its factory, and `tunica export` writes its card. Moduli in kPa, angles in degrees. docs/export.md has the cards.
///
/// The axes are those of a wall: circumferential, axial and radial. C is the right Cauchy–Green tensor, I1 = tr C and
/// I2 = (I1² − tr C²)/2; λ are the principal stretches and J their product. Every energy vanishes at rest. Programs
/// with isochoric invariants take the same formula in these invariants, and add an energy of the volume. Names of
/// models do not matter: a program accepts a form from any model, or refuses it with a reason.

namespace tunica {

/// Σ C_mn (I1 − 3)^m (I2 − 3)^n, of Rivlin. A neo-Hookean solid is the term {1, 0, μ/2}, Mooney–Rivlin adds {0, 1, …}.
///
/// A listed term is part of the form, even if its coefficient is 0: programs name their forms by their terms.
struct PolynomialEnergy {
  /// One product of powers; each pair {m, n} occurs once, and m + n ≥ 1.
  struct Term {
    /// Power of I1 − 3.
    std::size_t m;
    /// Power of I2 − 3.
    std::size_t n;
    /// C_mn, kPa; of either sign.
    double coefficient;
  };
  /// In any order.
  std::vector<Term> terms;
};

/// −μ Jm/2 ln(1 − (I1 − 3)/Jm), of Gent (1996): chains with a limit of extension.
struct LimitedChainEnergy {
  double mu;  ///< shear modulus, kPa
  double Jm;  ///< largest I1 − 3
};

/// Σ μ_i/α_i (λ1^α_i + λ2^α_i + λ3^α_i − 3), of Ogden (1972). The shear modulus is ½ Σ μ_i α_i.
struct StretchEnergy {
  /// One power of the principal stretches.
  struct Term {
    /// kPa; of the sign of alpha where it stiffens.
    double mu;
    /// Not 0; writers divide by it.
    double alpha;
  };
  /// In any order.
  std::vector<Term> terms;
};

/// Σ 2μ_i/α_i² [λ1^α_i + λ2^α_i + λ3^α_i − 3 + (J^(−α_i β_i) − 1)/β_i], β = ν/(1 − 2ν), of Storåkers (1986): a foam,
/// whose volume changes. The shear modulus is Σ μ_i.
struct FoamEnergy {
  /// One power of the principal stretches, with its own energy of the volume.
  struct Term {
    double mu;     ///< kPa
    double alpha;  ///< not 0
    double nu;     ///< Poisson's ratio of the term
  };
  /// In any order.
  std::vector<Term> terms;
};

/// One family of fibres, k1/(2 k2) [exp(k2 E²) − 1] with E = A I1 + B M·CM + (1 − 3A − B) C_rr − 1.
///
/// A = 0, B = 1: aligned, of Holzapfel, Gasser, Ogden (2000). A = κ, B = 1 − 3κ: scattered, of Gasser et al. (2006).
struct FibreFamily {
  double angle;  ///< of M from the axial towards the circumferential direction, degrees
  double k1;     ///< kPa
  double k2;     ///< how fast it stiffens; may be 0
  double A = 0;  ///< weight of I1
  double B = 1;  ///< weight of M·CM
};

/// μ/2 (I1 − 3) and families of fibres. A mirrored pair is two families, at ±angle.
struct FibreEnergy {
  double mu;  ///< shear modulus of the matrix, kPa
  /// At least one.
  std::vector<FibreFamily> families;
  /// Where fibres carry load: E > 0, M·CM > 1, or always.
  EnergyPart::Active active = EnergyPart::Active::argument_positive;
};

/// An energy of a card. `tunica plugin check` compares it with the model's own.
using CardEnergy = std::variant<PolynomialEnergy, LimitedChainEnergy, StretchEnergy, FoamEnergy, FibreEnergy>;

/// The energy of a model with these options at these parameters, in the order and base units of its description. Throws
/// InputError if no program has the energy with these options.
using CardFormula = std::function<CardEnergy(const Options& options, std::span<const double> parameters)>;

/// The energy of the volume ratio J that a mechanism adds to a card.
struct CardVolume {
  /// "quadratic" K/2 (J − 1)², "logarithmic" K/2 (ln J)², "simo" K/4 (J² − 1 − 2 ln J); each program has one of them.
  std::string law;
  /// K, kPa; 0 = incompressible.
  double bulk_modulus;
};

/// The softening that a mechanism adds to a card, of Ogden and Roxburgh (1999): below its largest value Wmax so far, an
/// energy W gives the stress η ∂W/∂F with η = 1 − 1/r erf((Wmax − W)/(m + β Wmax)).
/// Programs read the three numbers in this order. W is the energy at constant volume.
struct CardSoftening {
  double r;     ///< above 1: at most 1/r of the stress is lost
  double m;     ///< kPa
  double beta;  ///< of no unit; m and beta are not both 0
};

}  // namespace tunica
