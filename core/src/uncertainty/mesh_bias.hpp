// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "uncertainty/identifiability.hpp"

namespace tunica::uncertainty {

/// The bias of fitted parameters by the discretisation of finite elements.
struct MeshBias {
  std::vector<std::string> tests;    ///< those that were simulated on a finer mesh; empty: none can
  std::vector<double> of_parameter;  ///< value less what the finer mesh would give, by free parameter; NaN: not fixed
};

/// Asks every test of the run what a finer discretisation adds to its predictions (Agreement::shift), and moves the
/// minimum of the objective by it in one linearised step. Only the parameters that the data fix move. Costs one
/// simulation with derivatives and the comparison; nothing but questions where no test has a finer mesh. Says nothing
/// where a constraint holds the fit. `tests`: the names of the run's tests, in order.
///
/// Returns failed where a finer simulation fails; `bias` then has no test.
Status mesh_bias(const assembly::Assembly& assembly, std::span<const std::string> tests, std::span<const double> free,
                 const Identifiability& fixed, MeshBias& bias);

}  // namespace tunica::uncertainty
