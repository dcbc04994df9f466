// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "population/design.hpp"
#include "text/codes.hpp"

namespace tunica::population {

/// What exchanges labels under the hypothesis of no effect.
enum class Scheme {
  specimens,       ///< not nested
  within_animals,  ///< the factor varies within an animal: its specimens exchange theirs
  over_animals,    ///< the factor is constant in every animal: whole animals exchange theirs
};
inline constexpr text::Codes<Scheme, 3> scheme_codes = {{{Scheme::specimens, "specimens"},
                                                         {Scheme::within_animals, "within_animals"},
                                                         {Scheme::over_animals, "over_animals"}}};

/// Levels of one factor as they might have been dealt out: every row a level for each specimen, in the cohort's order.
/// Units exchange labels only where all other factors of the design agree, so that the null model, which has those
/// factors, is the same for every arrangement.
struct Arrangements {
  Scheme scheme = Scheme::specimens;
  double possible = 1;      ///< distinct arrangements; may be larger than any integer type
  bool exhaustive = false;  ///< all of them, the observed one included; else draws, without it
  std::vector<std::vector<std::size_t>> levels;
};

/// All arrangements where there are `most` + 1 at most, else `most` draws from the seed.
Arrangements arrangements(const Cohort& cohort, std::size_t factor, const std::vector<std::size_t>& other_factors,
                          std::size_t most, std::uint64_t seed);

}  // namespace tunica::population
