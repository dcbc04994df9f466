// SPDX-License-Identifier: Apache-2.0
#include "messages.hpp"

#include <algorithm>
#include <cstdio>
#include <sstream>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "data/nearest.hpp"
#include "text/aside.hpp"
#include "text/escaped.hpp"
#include "text/terminal.hpp"
#include "text/wrapping.hpp"

namespace tunica::app {

namespace {

constexpr const char *red = "\033[1;31m", *yellow = "\033[33m", *plain = "\033[0m";

void say(const char* word, const char* colour, const std::string& text) {
  const bool colours = text::Terminal::of(STDERR_FILENO).colours;
  const std::string shown = colours ? fmt::format("{}{}{}", colour, word, plain) : word;
  // What stands in files is quoted, and must not reach the terminal as commands to it.
  text::aside_raw(fmt::format("{}: {}\n", shown, text::message(text)));
}

/// "tunica plugin new" for what was being parsed when it went wrong.
const CLI::App* innermost(const CLI::App& program, std::string& words) {
  const CLI::App* app = &program;
  words = program.get_name();
  for (auto chosen = app->get_subcommands(); !chosen.empty(); chosen = app->get_subcommands()) {
    app = chosen.front();
    words += ' ' + app->get_name();
  }
  return app;
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options([](const CLI::Option* one) { return !one->get_group().empty(); }))
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// The help of CLI11, its texts wrapped in their columns.
class Wrapped final : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    return text::hanging("", app->get_description()) + '\n';
  }
  std::string make_option_desc(const CLI::Option* option) const override { return wrapped(option->get_description()); }
  /// Examples are indented and stay as they are; of the other lines those that belong together are filled.
  std::string make_footer(const CLI::App* app) const override {
    std::string result, paragraph;
    const auto end_paragraph = [&] {
      if (!paragraph.empty()) result += text::hanging("", paragraph) + '\n';
      paragraph.clear();
    };
    std::istringstream stream(app->get_footer());
    for (std::string line; std::getline(stream, line);) {
      const bool alone = line.empty() || line.front() == ' ' || line.back() == ':';
      if (alone) end_paragraph();
      if (alone)
        result += line + '\n';
      else
        paragraph += line + ' ';
    }
    end_paragraph();
    return result;
  }
  std::string make_subcommand(const CLI::App* verb) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, verb->get_display_name(true), wrapped(verb->get_description()), column_width_);
    return out.str();
  }

 private:
  [[nodiscard]] std::string wrapped(const std::string& text) const {
    return text::hanging("", text, 80 - column_width_);
  }
};

/// The option, else the argument, that the parser had no place for.
std::string surplus(const CLI::App& program, const CLI::App& innermost) {
  auto words = innermost.remaining();
  if (&innermost != &program)
    for (auto& word : program.remaining()) words.push_back(std::move(word));
  const auto option = std::find_if(words.begin(), words.end(), [](const auto& word) { return word.starts_with('-'); });
  return words.empty() ? "" : option == words.end() ? words.front() : *option;
}

}  // namespace

void say_error(const std::string& text) { say("error", red, text); }
void say_warning(const std::string& text) { say("warning", yellow, text); }

void say_wrapped_warning(const std::string& text) {
  const std::string lead(std::string_view("warning: ").size(), ' ');
  say_warning(text::hanging(lead, text).substr(lead.size()));
}

std::shared_ptr<CLI::FormatterBase> help_format() { return std::make_shared<Wrapped>(); }

std::string command_line_error(const CLI::App& program, const CLI::Error& problem) {
  std::string words;
  const CLI::App* app = innermost(program, words);
  std::string text = problem.what();
  const auto code = static_cast<CLI::ExitCodes>(problem.get_exit_code());
  if (const std::string word = code == CLI::ExitCodes::ExtrasError ? surplus(program, *app) : ""; !word.empty()) {
    if (word.starts_with('-')) {
      auto known = option_names(*app);
      if (app != &program)
        for (auto& name : option_names(program)) known.push_back(std::move(name));
      const std::string meant = data::nearest(word.substr(0, word.find('=')), known);
      text = fmt::format("{}: there is no such option{}", data::excerpt(word),
                         meant.empty() ? "." : fmt::format(". Did you mean '{}'?", meant));
    } else {
      text = fmt::format("'{}' is one argument too many.", data::excerpt(word));
    }
  } else if (code == CLI::ExitCodes::RequiredError && app == &program) {
    std::vector<std::string> verbs;
    for (const auto* verb : program.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
      verbs.push_back(verb->get_name());
    text = fmt::format("a verb is missing: {}.", fmt::join(verbs, ", "));
  } else if (!text.empty() && text.back() != '.') {
    text += '.';
  }
  const std::string lead(std::string_view("error: ").size(), ' ');
  return text::hanging(lead, fmt::format("{} `{} --help` shows what it takes, with examples.", text, words))
      .substr(lead.size());
}

}  // namespace tunica::app
