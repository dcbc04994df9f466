// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "experiment/json_document.hpp"
#include "plugins/catalogue.hpp"

/// What a first experiment is made of: what the user names, else what plugins declare for the
/// specimen; of several files, for that of the first one.
namespace tunica::importing {

using experiment::Json;

/// The test that is named, else the first choice for the specimen. Throws InputError where there is none.
const TestFactory& chosen_test(const std::string& named, Specimen specimen, const plugins::Catalogue& catalogue);

/// The block "models" with the model that is named, else with the first choice for the specimen. Throws InputError
/// where there is none.
Json chosen_model(const std::string& named, Specimen specimen, const plugins::Catalogue& catalogue);

/// The block "optimizers": the one that refines a fit, as "lm". Throws InputError where there is none.
Json chosen_optimizer(const plugins::Catalogue& catalogue);

}  // namespace tunica::importing
