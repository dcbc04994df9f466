// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json_fwd.hpp>

/// Results on stdout, which plugins cannot get at.
namespace tunica::app {

/// From here on, all other output to stdout goes to stderr: a plugin that prints must not spoil an answer. Call it
/// before plugins are loaded.
void keep_stdout();
/// The descriptor that answers go to: stdout as the program was started with it.
int answer_descriptor();
/// Adds `words` to the answer.
void write_answer(const std::string& words);
/// Writes the buffered answer. Throws execution::WriteFailure if that fails.
void flush_answer();

/// Prints a part of the answer.
template <class... Values>
void answer(fmt::format_string<Values...> form, Values&&... values) {
  write_answer(fmt::format(form, std::forward<Values>(values)...));
}

/// The one document that --json puts on stdout; numbers that are not finite as null.
void print_json(const nlohmann::ordered_json& document);

}  // namespace tunica::app
