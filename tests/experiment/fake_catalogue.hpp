// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugins/catalogue.hpp"

namespace tunica::testing {

/// A catalogue of plugins that declare much and compute nothing: models "gho" (needs nothing), "plain" (no fibres);
/// tests "uniaxial" and "tube"; optimizers "es" and "ceres_lm"; mechanisms of every stage. The experiment file is
/// checked against declarations, so that is all it takes.
const plugins::Catalogue& fake_catalogue();

}  // namespace tunica::testing
