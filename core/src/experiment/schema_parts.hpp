// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiment/json_document.hpp"
#include "plugins/catalogue.hpp"

/// Pieces of the JSON Schema of experiment files. The schema accepts what the reader accepts as far as a schema can
/// say it; what compares values (bounds, units, names that refer to each other) is left to the reader.
namespace tunica::experiment {

/// An object with these properties and no others.
Json object_schema(std::string_view description, Json properties, const std::vector<std::string>& required = {});
/// {"$ref": "#/definitions/NAME"}, with a description of its own if given.
Json reference(std::string_view name, std::string_view description = {});
Json quantity_schema(std::string_view description);
Json option_schema(const Option& option);
/// "Stretch along the strip." and "mm" → "Stretch along the strip [mm]".
std::string with_unit(std::string_view doc, std::string_view unit);
/// The block "parameters" of an owner that declares these.
Json parameters_schema(const std::vector<Parameter>& parameters);

/// An object whose key "type" picks the definition PREFIX_type that holds for the rest; editors then complain about
/// the one that is meant, not about all.
Json by_type(std::string_view prefix, const std::vector<std::string>& types, std::string_view description);

/// The keys of "data" for files as a testing machine writes them: definitions, what a block has of them, and "columns".
void define_rig_keys(Json& definitions);
void add_rig_properties(Json& properties, const std::vector<Observable>& observables);
Json columns_schema(const std::vector<Observable>& observables);

/// Definitions model_*, test_*, optimizer_*, mechanism_* of everything in the catalogue.
void define_plugins(Json& definitions, const plugins::Catalogue& catalogue);

}  // namespace tunica::experiment
