// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "elastic.hpp"

namespace tunica::thick_wall {

/// A material with history: row by row in loading order, each point of the wall with the state that the row before has
/// left, and with the time between them. The sector is closed, and the support begins to act, at equilibrium. The
/// Jacobian is exact for one model that remembers in principal axes, without support. Points stay where they are, so
/// kinks of the material inside the wall cost accuracy.
Status predict_with_history(const Tube& tube, const Rule& rule, const TestInput& input, const TestOutput& output);

}  // namespace tunica::thick_wall
