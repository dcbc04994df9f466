// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include "discovery/subject.hpp"

namespace tunica::discovery {

/// The strains that the material of the subject has in its tests at given parameters: components of C in the order tt,
/// zz, rr, tz, zr, tr, a point each. They are those at which the tests ask for derivatives, so that trial steps of a
/// solver do not count; where no test asks for any, all of them.
using States = std::vector<std::array<double, 6>>;

States reached_states(const Subject& subject, std::span<const double> free);

/// From the least to the largest value of an invariant.
struct Reach {
  double low = 0, high = 0;
};

Reach reach_of_first(const States& states);                           ///< I1 − 3
Reach reach_of_second(const States& states);                          ///< I2 − 3
Reach reach_of_fibre(const States& states, double angle_from_axial);  ///< I4 − 1; angle in degrees
Reach reach_of_stretches(const States& states);                       ///< ln of the principal stretches
Reach reach_of_volume(const States& states);                          ///< J − 1
Reach reach_of_product(const States& states, int m, int n);           ///< (I1 − 3)^m (I2 − 3)^n

/// C̄ = J^(−2/3) C of every state.
States at_constant_volume(const States& states);

}  // namespace tunica::discovery
