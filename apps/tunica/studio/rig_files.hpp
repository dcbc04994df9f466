// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "plugins/catalogue.hpp"

/// `tunica import` as a form.
namespace tunica::app::studio {

/// Reads files of a rig as far as `answers` go, and writes nothing: {"columns": [{name, title, quantity, kind, unit,
/// numeric, preview}], "questions": [{text, option, example, length, likely}], "notes", "understood", "warnings",
/// "signals", "curves", "command"}. Where something is missing, the examples of the questions stand for the answers,
/// and "provisional" says so; where the files make no test, "problem" has the reason.
///
/// `request`: {"files": [name], "answers": {option without dashes: text or [text]}, "asked": {option of a question:
/// text}, "output"}. Throws InputError and Refused.
nlohmann::ordered_json look_at_rig_files(const nlohmann::json& request, const plugins::Catalogue& catalogue);
/// Writes the experiment file: {"file", "notes", "understood", "warnings", "command"}. Throws InputError and Refused.
nlohmann::ordered_json import_rig_files(const nlohmann::json& request, const plugins::Catalogue& catalogue);

}  // namespace tunica::app::studio
