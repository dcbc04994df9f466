// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

namespace CLI {
class App;
class Error;
class FormatterBase;
}  // namespace CLI

namespace tunica::app {

/// "error: …" and "warning: …" on stderr, the word in colour where stderr is a terminal that has some.
void say_error(const std::string& text);
void say_warning(const std::string& text);
/// The same, in lines of 80 columns.
void say_wrapped_warning(const std::string& text);

/// The parser's error, with the option that was probably meant and a reference to the help.
std::string command_line_error(const CLI::App& program, const CLI::Error& problem);

/// --help in lines of 80 columns.
std::shared_ptr<CLI::FormatterBase> help_format();

}  // namespace tunica::app
