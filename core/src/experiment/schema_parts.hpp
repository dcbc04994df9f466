// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
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
/// What users name; dots join the parts of parameter names.
inline const char* const name_pattern = "^[^-. /\\\\][^. /\\\\]*$";
/// An object with an entry for each name. It stands in its place rather than in the definitions: valijson refuses every
/// object whose propertyNames lie behind a $ref.
Json named_entries_schema(std::string_view description, Json entry);
/// {"$ref": "#/definitions/NAME"}, with a description of its own if given.
Json reference(std::string_view name, std::string_view description = {});
Json quantity_schema(std::string_view description);
Json text_schema(std::string_view description);
Json flag_schema(std::string_view description);
Json choice_schema(std::string_view description, const std::vector<std::string>& names);
Json count_schema(std::string_view description, std::uint64_t at_least, std::optional<std::uint64_t> at_most = {});
Json number_schema(std::string_view description, double least, double most);
Json list_schema(std::string_view description, Json items);
Json option_schema(const Option& option);
/// "Stretch along the strip." and "mm" → "Stretch along the strip [mm]".
std::string with_unit(std::string_view doc, std::string_view unit);
/// The block "parameters" of an owner that declares these.
Json parameters_schema(const std::vector<Parameter>& parameters);

/// An object whose key "type" picks the definition PREFIX_type that holds for the rest; editors then complain about
/// the one that is meant, not about all.
Json by_type(std::string_view prefix, const std::vector<std::string>& types, std::string_view description);

/// "What it is. – Where it is from (plugin X)."
std::string described(const std::string& doc, const std::string& reference, const std::string& plugin);

}  // namespace tunica::experiment
