// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tunica::app {

/// An option, or an argument that is known by its place.
struct Argument {
  std::vector<std::string> names;    ///< "-o", "--output"; empty for one that is known by its place
  std::string label;                 ///< what stands for it in a synopsis: "EXP", "folders"
  std::string value;                 ///< what it takes, as the help prints it: "DIR"; empty for a flag
  std::vector<std::string> choices;  ///< where only these are allowed
  std::string doc;
  int takes = 0;  ///< words that follow an option, 0 for a flag
  bool required = false, repeats = false;
};

/// A verb with what can follow it, the program itself on top: what --help says, for completion and the manual page,
/// read from the parser itself so that there is no second list to keep.
struct Verb {
  std::string name, doc, footer;
  std::vector<Argument> arguments;
  std::vector<Verb> verbs;
};

Verb command_tree(const CLI::App& app);

/// The shell's suggestions for a value, chosen by the value's name in the help.
enum class Offer { nothing, words, experiment, file, folder, names, mechanisms };
Offer offer_for(const Argument& argument);

/// What `source` in a shell makes it complete tunica's command lines.
std::string bash_completion(const Verb& program);
std::string zsh_completion(const Verb& program);
/// tunica(1) for man, in the man macros of roff.
std::string manual_page(const Verb& program, const std::string& version);

}  // namespace tunica::app
