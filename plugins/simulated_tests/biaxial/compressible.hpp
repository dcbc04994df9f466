// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sheet.hpp"

namespace tunica::biaxial {

/// The sheet of a material that changes its volume: its thickness follows from faces without traction.
///
///   C = λt² e_t⊗e_t + λz² e_z⊗e_z + u r⊗r,   S_rr = 0,   σ_a = λ_a² S_aa/J,  P_a = λ_a S_aa
///
/// `columns` are the mapped abscissae.
Status predict_compressible(const Sheet& sheet, std::span<const std::span<const double>> columns,
                            const TestInput& input, const TestOutput& output);

}  // namespace tunica::biaxial
