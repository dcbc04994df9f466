// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>

#include <fmt/format.h>

#include "command_tree.hpp"

namespace tunica::app {

namespace {

/// One Unicode character that begins at text[i], which is moved to its last byte.
unsigned long code_point(const std::string& text, std::size_t& i) {
  const auto first = static_cast<unsigned char>(text[i]);
  if (first < 0x80) return first;
  const int more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  unsigned long code = first & (0x3Fu >> more);
  for (int k = 0; k < more && i + 1 < text.size(); ++k)
    code = code << 6 | (static_cast<unsigned char>(text[++i]) & 0x3Fu);
  return code;
}

/// Text for roff: hyphens that can be copied as they are typed, other characters by their number, and no line that
/// would be taken for a request.
std::string roff(const std::string& text) {
  std::string result;
  bool line_begins = true;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    line_begins = c == '\n';
    if (c == '\\')
      result += "\\e";
    else if (c == '-')
      result += "\\-";
    else if (c == '\'')
      result += "\\(aq";
    else if (c == '`')
      result += "\\(ga";
    else if (c == '^')
      result += "\\(ha";
    else if (c == '~')
      result += "\\(ti";
    else if (const auto code = code_point(text, i); code >= 0x80)
      result += fmt::format("\\[u{:04X}]", code);
    else
      result += c;
  }
  return result;
}

// Examples stand near the margin: what fits 80 columns in the help does so in the page too.
constexpr const char *begin_example = ".EX\n.in 2n\n", *end_example = ".in\n.EE\n";

/// What follows the options in the help: headings end with a colon, examples are indented, the rest is text.
std::string footer(const std::string& text) {
  std::string result;
  std::istringstream stream(text);
  bool example = false, after_gap = true;
  for (std::string line; std::getline(stream, line);) {
    const bool indented = line.starts_with("  ");
    if (indented != example && !line.empty()) result += indented ? begin_example : end_example;
    if (!line.empty()) example = indented;
    if (line.empty()) {
      after_gap = true;
    } else if (!indented && line.back() == ':' && after_gap) {
      result += fmt::format(".PP\n{}\n", roff(line));
    } else {
      if (!indented && after_gap) result += ".PP\n";
      result += roff(indented ? line.substr(2) : line) + '\n';
      after_gap = false;
    }
  }
  return example ? result + end_example : result;
}

std::string synopsis(const Verb& verb, const std::string& words) {
  std::string text = ".B " + roff(words) + "\n";
  if (!verb.verbs.empty()) text += "\\fIVERB\\fR\n";
  for (const auto& argument : verb.arguments)
    if (argument.names.empty()) {
      const std::string shown =
          fmt::format("\\fI{}\\fR{}", roff(argument.value.empty() ? argument.label : argument.value),
                      argument.repeats ? "\\&..." : "");
      text += argument.required ? shown + '\n' : fmt::format("[{}]\n", shown);
    }
  return text + "[\\fIoptions\\fR]\n";
}

std::string options(const std::vector<Argument>& arguments, bool help) {
  std::string text;
  for (const auto& argument : arguments) {
    if (argument.label == "--help" && !help) continue;
    std::string names;
    for (const auto& name : argument.names) names += fmt::format("{}\\fB{}\\fR", names.empty() ? "" : ", ", roff(name));
    const std::string value = argument.value.empty() ? argument.label : argument.value;
    if (argument.names.empty())
      names = fmt::format("\\fI{}\\fR", roff(value));
    else if (argument.takes > 0)
      names += fmt::format(" \\fI{}\\fR", roff(argument.value));
    text += fmt::format(".TP\n{}\n{}.\n", names, roff(argument.doc));
  }
  return text;
}

std::string verb_section(const Verb& verb, const std::string& words) {
  const bool a_sentence = verb.doc.ends_with('?') || verb.doc.ends_with('.');
  std::string text = fmt::format(".SS {}\n{}.PP\n{}{}\n{}{}", roff(words), synopsis(verb, words), roff(verb.doc),
                                 a_sentence ? "" : ".", options(verb.arguments, false), footer(verb.footer));
  for (const auto& child : verb.verbs) text += verb_section(child, words + ' ' + child.name);
  return text;
}

constexpr const char* environment = R"(.SH ENVIRONMENT
.TP
.B TUNICA_PLUGIN_PATH
Folders with plugins, colons between them; searched after those of \fB\-\-plugin\-path\fR and before the installed ones.
.TP
.B TUNICA_VECTOR_LEVEL
Instructions that models are evaluated with: \fIbaseline\fR, \fIavx2\fR or \fIavx512\fR. Without it the highest that the machine has.
Results of different levels differ in the last digits.
.TP
.B NO_COLOR
Any value takes the colours off. There are none either where the output is no terminal.
.TP
.B TERM
On a terminal of the kind \fIdumb\fR progress is told in plain lines, without colours.
.SH FILES
.TP
.I results/NAME\-N
What a run or a diagnosis leaves behind, unless \fB\-o\fR names a folder. Nothing is ever overwritten.
)";

}  // namespace

std::string manual_page(const Verb& program, const std::string& version) {
  std::string text = fmt::format(
      ".\\\" made by `tunica man` from the program's own help\n.TH TUNICA 1 \"\" \"tunica {}\" \"User Commands\"\n.SH "
      "NAME\n"
      "tunica \\- material parameters of soft tissue and rubber from mechanical tests\n.SH SYNOPSIS\n{}",
      roff(version), synopsis(program, program.name));
  text += fmt::format(".SH DESCRIPTION\n{}\n", roff(program.doc));
  // The general part of the help goes where a manual page has it.
  text += footer(program.footer);
  text += ".SH OPTIONS\nThese go with every verb.\n" + options(program.arguments, true);
  text += ".SH VERBS\n";
  for (const auto& verb : program.verbs) text += verb_section(verb, program.name + ' ' + verb.name);
  return text + environment;
}

}  // namespace tunica::app
