// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "command_tree.hpp"
#include "comparison/provenance.hpp"
#include "data/nearest.hpp"
#include "exit_codes.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

int complete(const CLI::App& app, const std::string& shell) {
  const std::vector<std::string> shells = {"bash", "zsh"};
  if (shell == "bash")
    answer("{}", bash_completion(command_tree(app)));
  else if (shell == "zsh")
    answer("{}", zsh_completion(command_tree(app)));
  else
    throw InputError(fmt::format("there is no completion for '{}'. {}", shell, data::suggestion(shell, shells)));
  return done;
}

}  // namespace

void add_completion(CLI::App& app, GlobalOptions&, Action& action) {
  auto shell = std::make_shared<std::string>();
  auto* verb =
      app.add_subcommand("completion", "Print the script that completes verbs, options, files and names in a shell");
  verb->add_option("shell", *shell, "The shell: bash or zsh")->required()->type_name("bash|zsh");
  verb->footer(
      "Examples:\n"
      "  tunica completion bash > ~/.local/share/bash-completion/completions/tunica\n"
      "  source <(tunica completion bash)\n\n"
      "An installed tunica includes both scripts; you need this only when you run it from its build folder.");
  verb->callback([&app, &action, shell] { action = [&app, shell] { return complete(app, *shell); }; });
}

void add_man(CLI::App& app, GlobalOptions&, Action& action) {
  auto* verb = app.add_subcommand("man", "Print the manual page, tunica(1)");
  verb->footer(
      "Examples:\n"
      "  tunica man | man -l -\n\n"
      "An installed tunica includes it: man tunica.");
  verb->callback([&app, &action] {
    action = [&app] {
      answer("{}", manual_page(command_tree(app), comparison::version()));
      return done;
    };
  });
}

}  // namespace tunica::app
