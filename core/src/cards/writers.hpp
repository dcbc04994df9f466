// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "cards/card.hpp"

/// The writers behind write_card(), one a program, and what they share.
namespace tunica::cards {

/// What a writer works with: numbers in the units of the card.
struct Draft {
  const Material& material;
  const CardSettings& settings;
  double stress = 1;  ///< factor from kPa
  double bulk = 0;    ///< bulk modulus in the units of the card; 0 = incompressible
  /// Two over the bulk modulus, the coefficient D1 of (J − 1)²/D1; 0 = incompressible.
  [[nodiscard]] double d1() const { return bulk > 0 ? 2 / bulk : 0; }
  /// In the units of the card; "" where none is given. Throws InputError where it is not positive.
  [[nodiscard]] std::string density() const;
};

/// The exception of a writer whose program cannot express the model. write_card() adds the programs that can.
struct CannotExpress {
  std::string reason;
  std::string cure;  ///< what to fit instead; "" = nothing
};

/// Values with commas, eight a line, each line ended.
std::string data_lines(std::span<const double> values);
std::string joined_lines(std::span<const std::string> values);

/// *HYPERELASTIC of an isotropic model in the keywords that Abaqus and CalculiX share. `most_terms`: of Ogden's energy,
/// and the degree of a polynomial.
std::string hyperelastic_keyword(const Draft& draft, std::size_t most_terms);

/// *HYPERFOAM of these terms in the keywords that Abaqus and CalculiX share: μ and α of every term, then every ν.
std::string hyperfoam_keyword(const Draft& draft, const FoamEnergy& foam);

std::string calculix_card(const Draft& draft);
std::string abaqus_card(const Draft& draft);
std::string febio_card(const Draft& draft);
std::string ansys_card(const Draft& draft);
std::string lsdyna_card(const Draft& draft);

}  // namespace tunica::cards
