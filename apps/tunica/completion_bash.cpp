// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "command_tree.hpp"

namespace tunica::app {

namespace {

constexpr const char* bash_head =
    R"sh(# bash completion for tunica, made by `tunica completion bash` from the program's own help.
# Installed as share/bash-completion/completions/tunica; without that: source <(tunica completion bash)

# Asks the program on this command line, with its plugins.
_tunica_ask() {
  local i plugins=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${COMP_WORDS[i]} in
      --plugin-path) plugins+=(--plugin-path "${COMP_WORDS[i + 1]}") ;;
      --allow-world-writable-plugins) plugins+=("${COMP_WORDS[i]}") ;;
    esac
  done
  "${COMP_WORDS[0]/#\~/$HOME}" "$@" "${plugins[@]}" 2>/dev/null
}

_tunica_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$current"); }

# Words with commas between them.
_tunica_list() {
  local before=
  [[ $current == *,* ]] && before=${current%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${current##*,}")
  compopt -o nospace 2>/dev/null
}

# Files that a pattern matches, and folders, for one may be on the way to a file.
_tunica_files() {
  local plain=${current//\\/}
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -f -X "!$1" -- "$plain"; [[ $1 == '*' ]] || compgen -d -- "$plain")
}

_tunica_folders() {
  compopt -o filenames 2>/dev/null
  mapfile -t COMPREPLY < <(compgen -d -- "${current//\\/}")
}

)sh";

constexpr const char* walk = R"sh(_tunica() {
  local current=${COMP_WORDS[COMP_CWORD]} option='' path=tunica place=0 verbs options i word
  ((COMP_CWORD > 0)) && option=${COMP_WORDS[COMP_CWORD - 1]}
  # readline takes --output=DIR for three words.
  if [[ $current == = ]]; then
    current=
  elif [[ $option == = ]]; then
    option=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    _tunica_grammar "$path"
    if [[ $word == -* ]]; then
      _tunica_takes "$path" "$word"
      local words=$?
      ((words > 0)) && [[ ${COMP_WORDS[i + 1]} == = ]] && ((++i))
      ((i += words))
    elif [[ " $verbs " == *" $word "* ]]; then
      path+=" $word" place=0
    else
      ((++place))
    fi
  done
  _tunica_grammar "$path"
  COMPREPLY=()
  if _tunica_value "$path" "$option"; then
    return
  elif [[ $current == -* ]]; then
    _tunica_words "$options"
  elif [[ $verbs ]]; then
    _tunica_words "$verbs"
  else
    _tunica_value "$path" "$place"
  fi
}

complete -F _tunica tunica
)sh";

/// The shell command that suggests values of an argument.
std::string action(const Argument& argument) {
  switch (offer_for(argument)) {
    case Offer::words:
      return fmt::format("_tunica_words '{}'", fmt::join(argument.choices, " "));
    case Offer::experiment:
      return "_tunica_files '*.json'";
    case Offer::file:
      return "_tunica_files '*'";
    case Offer::folder:
      return "_tunica_folders";
    case Offer::names:
      return "_tunica_words \"$(_tunica_ask list --names)\"";
    case Offer::mechanisms:
      return "_tunica_list \"$(_tunica_ask list mechanisms --names)\"";
    case Offer::nothing:
      break;
  }
  return ":";
}

struct Tables {
  std::string grammar, takes, values;
};

void add(const Verb& verb, const std::string& path, std::vector<Argument> inherited, Tables& tables) {
  std::vector<std::string> verbs, options;
  for (const auto& child : verb.verbs) verbs.push_back(child.name);
  auto arguments = verb.arguments;
  arguments.insert(arguments.end(), inherited.begin(), inherited.end());
  std::size_t place = 0;
  for (const auto& argument : arguments) {
    options.insert(options.end(), argument.names.begin(), argument.names.end());
    std::vector<std::string> patterns;
    for (const auto& name : argument.names)
      if (argument.takes > 0) patterns.push_back(fmt::format("'{} {}'", path, name));
    if (!patterns.empty())
      tables.takes += fmt::format("    {}) return {} ;;\n", fmt::join(patterns, " | "), argument.takes);
    if (argument.names.empty())
      patterns.push_back(argument.repeats ? fmt::format("'{} '[0-9]*", path) : fmt::format("'{} {}'", path, place++));
    if (!patterns.empty())
      tables.values += fmt::format("    {}) {} ;;\n", fmt::join(patterns, " | "), action(argument));
    if (&argument - arguments.data() < static_cast<std::ptrdiff_t>(verb.arguments.size()) && !argument.names.empty() &&
        argument.label != "--help" && argument.label != "--version")
      inherited.push_back(argument);
  }
  tables.grammar += fmt::format("    '{}')\n      verbs='{}'\n      options='{}'\n      ;;\n", path,
                                fmt::join(verbs, " "), fmt::join(options, " "));
  for (const auto& child : verb.verbs) add(child, path + ' ' + child.name, inherited, tables);
}

}  // namespace

std::string bash_completion(const Verb& program) {
  Tables tables;
  add(program, program.name, {}, tables);
  return fmt::format(
      "{}# What can follow a verb.\n_tunica_grammar() {{\n  verbs='' options=''\n  case $1 in\n{}  esac\n}}\n\n"
      "# How many words an option takes.\n_tunica_takes() {{\n  case \"$1 $2\" in\n{}  esac\n  return 0\n}}\n\n"
      "# Offers the value of an option, or the argument at a place; false for a flag.\n"
      "_tunica_value() {{\n  case \"$1 $2\" in\n{}    *) return 1 ;;\n  esac\n}}\n\n{}",
      bash_head, tables.grammar, tables.takes, tables.values, walk);
}

}  // namespace tunica::app
