// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_tree.hpp"

namespace tunica::app {

namespace {

constexpr const char* zsh_head = R"sh(#compdef tunica
# zsh completion for tunica, made by `tunica completion zsh` from the program's own help.
# Installed as share/zsh/site-functions/_tunica; without that: source <(tunica completion zsh)

# Asks the program on this command line, with its plugins.
_tunica_ask() {
  local -a plugins
  local -i i
  for ((i = 2; i < ${#tunica_line}; ++i)); do
    case $tunica_line[i] in
      --plugin-path) plugins+=(--plugin-path ${(Q)~tunica_line[i + 1]}) ;;
      --allow-world-writable-plugins) plugins+=($tunica_line[i]) ;;
    esac
  done
  ${(Q)~tunica_line[1]} "$@" $plugins 2>/dev/null
}

_tunica_names() {
  local -a names=(${(f)"$(_tunica_ask list --names)"})
  compadd "$@" -a names
}

_tunica_mechanisms() {
  local -a names=(${(f)"$(_tunica_ask list mechanisms --names)"})
  _values -s , mechanism $names
}

)sh";

constexpr const char* tail = R"sh(
if [[ $funcstack[1] == _tunica ]]; then
  _tunica_program "$@"
else
  compdef _tunica_program tunica
fi
)sh";

std::string zsh_action(const Argument& argument) {
  switch (offer_for(argument)) {
    case Offer::words:
      return fmt::format("({})", fmt::join(argument.choices, " "));
    case Offer::experiment:
      return "_files -g \"*.json\"";
    case Offer::file:
      return "_files";
    case Offer::folder:
      return "_files -/";
    case Offer::names:
      return "_tunica_names";
    case Offer::mechanisms:
      return "_tunica_mechanisms";
    case Offer::nothing:
      break;
  }
  return " ";
}

/// With `special` behind a backslash; in single quotes of the shell.
std::string escaped(const std::string& text, const std::string& special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string::npos) result += '\\';
    result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return result;
}

/// For _arguments: '(-o --output)'{-o+,--output=}'[New folder]:DIR:_files -/'.
std::string specification(const Argument& argument) {
  std::string message;
  for (int i = 0; i < argument.takes; ++i)
    message += fmt::format(":{}:{}", escaped(argument.value.empty() ? argument.label : argument.value, ":"),
                           escaped(zsh_action(argument), ":"));
  if (argument.names.empty())
    return fmt::format("'{}{}'", argument.repeats ? "*" : argument.required ? "" : ":", message);
  const std::string doc = fmt::format("[{}]", escaped(argument.doc, "[]:\\"));
  std::vector<std::string> names;
  for (const auto& name : argument.names)
    names.push_back(argument.takes == 0 ? name : name + (name.starts_with("--") ? "=" : "+"));
  if (argument.takes > 1) names = argument.names;
  const std::string shared = argument.repeats             ? "'*'"
                             : argument.names.size() == 1 ? ""
                                                          : fmt::format("'({})'", fmt::join(argument.names, " "));
  return fmt::format("{}{}'{}{}'", shared,
                     names.size() == 1 ? names.front() : fmt::format("{{{}}}", fmt::join(names, ",")), doc, message);
}

void add(const Verb& verb, const std::string& function, std::vector<Argument> inherited, std::string& text) {
  auto arguments = verb.arguments;
  arguments.insert(arguments.end(), inherited.begin(), inherited.end());
  for (const auto& argument : verb.arguments)
    if (!argument.names.empty() && argument.label != "--help" && argument.label != "--version")
      inherited.push_back(argument);
  for (const auto& child : verb.verbs) add(child, function + '_' + child.name, inherited, text);
  text += fmt::format("{}() {{\n", function);
  if (!verb.verbs.empty()) text += "  local curcontext=$curcontext state line\n  local -A opt_args\n";
  if (function == "_tunica_program") text += "  local -a tunica_line=($words)\n";
  text += fmt::format("  _arguments {}", verb.verbs.empty() ? "-S" : "-C");
  for (const auto& argument : arguments) text += " \\\n    " + specification(argument);
  if (verb.verbs.empty()) {
    text += "\n}\n\n";
    return;
  }
  text += fmt::format(
      " \\\n    '1:verb:->verb' \\\n    '*::argument:->argument'\n  local result=$?\n  case $state in\n"
      "    verb)\n      local -a verbs=(\n");
  for (const auto& child : verb.verbs) text += fmt::format("        '{}:{}'\n", child.name, escaped(child.doc, ":\\"));
  text += fmt::format(
      "      )\n      _describe -t verbs verb verbs\n      ;;\n"
      "    argument)\n      (($+functions[{0}_$words[1]])) && {0}_$words[1]\n      ;;\n"
      "    *) return $result ;;\n  esac\n}}\n",
      function);
}

}  // namespace

std::string zsh_completion(const Verb& program) {
  std::string text = zsh_head;
  add(program, "_tunica_program", {}, text);
  return text + tail;
}

}  // namespace tunica::app
