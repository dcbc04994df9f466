// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "comparison/provenance.hpp"
#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

constexpr const char* examples = R"(Examples:
  tunica check experiment.json             is everything in order?
  tunica run experiment.json -o results/a  calibrate and compare all "runs"
  tunica run experiment.json -o results/a --resume
                                           go on after Ctrl-C or a power cut
  tunica list models                       what the plugins provide
  tunica describe gho                      parameters, units, bounds, reference

stdout carries results, stderr progress and messages. Exit codes: 0 done, 1 ran but
not converged, 2 invalid input, 3 plugin refused, 4 internal error, 130 interrupted
and resumable.)";

/// CLI11 says of a mistyped verb only that one is needed.
void check_verb(const CLI::App& app, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--plugin-path") ++i;  // its value may be anything
    if (word.empty() || word.front() == '-') continue;
    std::vector<std::string> verbs;
    for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
      if (verb->get_name() == word) return;
      verbs.push_back(verb->get_name());
    }
    throw InputError(fmt::format("there is no verb '{}'. {}", word, data::suggestion(word, verbs)));
  }
}

int run(int argc, char** argv) {
  CLI::App app(
      "Finds the material parameters of soft tissue and rubber from mechanical tests, and compares models and "
      "optimisers.",
      "tunica");
  GlobalOptions global;
  Action action;
  app.formatter(help_format());
  app.set_version_flag("--version", "tunica " + comparison::version());
  app.add_option("--plugin-path", global.plugin_paths,
                 "Plugin file, or folder to search for plugins first; may be repeated")
      ->type_name("PATH")
      ->allow_extra_args(false);
  app.add_flag("--allow-world-writable-plugins", global.allow_world_writable_plugins,
               "Load plugins that other users of this machine could have changed");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(examples);
  for (const auto add :
       {add_run, add_diagnose, add_discover, add_cohort, add_report, add_export, add_certify, add_import, add_check,
        add_simulate, add_stability, add_list, add_describe, add_schema, add_plugin, add_completion, add_man})
    add(app, global, action);
#ifdef TUNICA_SERVES
  add_serve(app, global, action);
#endif
  check_verb(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);
    say_error(command_line_error(app, problem));
    return invalid_input;
  }
  return action();
}

}  // namespace

}  // namespace tunica::app

int main(int argc, char** argv) {
  using namespace tunica::app;
  try {
    return run(argc, argv);
  } catch (const tunica::InputError& problem) {
    say_error(problem.what());
    return invalid_input;
  } catch (const PluginRefused& problem) {
    say_error(problem.what());
    return plugin_refused;
  } catch (const tunica::execution::WriteFailure& problem) {
    say_error(problem.what());
    return invalid_input;
  } catch (const std::filesystem::filesystem_error& problem) {
    say_error(fmt::format("the system refused {}: {}; check the path, its permissions and the free space",
                          problem.path1().string(), problem.code().message()));
    return invalid_input;
  } catch (const std::bad_alloc&) {
    say_error("there is not enough memory for this; take fewer realisations, draws, rows or threads");
    return invalid_input;
  } catch (const std::exception& problem) {
    say_error(fmt::format("internal: {}; this is a fault of tunica, please report it with the files that caused it",
                          problem.what()));
    return internal_error;
  }
}
