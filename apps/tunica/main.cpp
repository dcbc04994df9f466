// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "comparison/provenance.hpp"
#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "finite_range.hpp"
#include "messages.hpp"
#include "plugins/guarded.hpp"
#include "supervisor.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

/// For debuggers and profilers; read before the command line is.
constexpr std::string_view in_process = "--in-process";

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
    if (word == "--plugin-path" || word == "--call-limit" || word == "--memory-limit")
      ++i;  // its value may be anything
    if (word.empty() || word.front() == '-') continue;
    std::vector<std::string> verbs;
    for (const auto* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
      if (verb->get_name() == word) return;
      verbs.push_back(verb->get_name());
    }
    throw InputError(fmt::format("there is no verb '{}'. {}", word, data::suggestion(word, verbs)));
  }
}

/// An option with an empty value is probably an unset variable of a script; its intended value is unknown.
void check_values(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (value.empty())
        throw InputError(
            fmt::format("{}: found an empty value. Give one, or leave the option out", option->get_name()));
  for (const CLI::App* verb : app.get_subcommands()) check_values(*verb);
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
  app.add_option("--call-limit", global.call_limit,
                 "Give up a call of a model that takes longer, in seconds; it counts as failed (default: 60)")
      ->check(FiniteRange(0.1, 1e6))
      ->type_name("S")
      ->allow_extra_args(false);
  app.add_option("--memory-limit", global.memory_limit,
                 "Give up a call of a plugin that takes the program's memory to so many GiB; it counts as failed "
                 "(default: nine tenths of the machine's)")
      ->check(FiniteRange(0.1, 1e6))
      ->type_name("GIB")
      ->allow_extra_args(false);
  bool alone = false;
  app.add_flag(std::string(in_process), alone,
               "Run in this process, as debuggers want it. A plugin that crashes then ends the program");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(examples);
  add_verbs(app, global, action);
  check_verb(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) {
      std::ostringstream help;
      app.exit(problem, help, help);
      write_answer(help.str());
      flush_answer();
      return done;
    }
    say_error(command_line_error(app, problem));
    return invalid_input;
  }
  check_values(app);
  const int code = action();
  flush_answer();
  return code;
}

/// The return value of main() for any exception.
int contained(int argc, char** argv) {
  const auto fault = [](const std::string& what) {
    say_error(
        fmt::format("internal: {}; this is a fault of tunica, please report it with the files that caused it", what));
    return internal_error;
  };
  try {
    return run(argc, argv);
  } catch (const InputError& problem) {
    say_error(problem.what());
    return invalid_input;
  } catch (const PluginRefused& problem) {
    say_error(problem.what());
    return plugin_refused;
  } catch (const execution::WriteFailure& problem) {
    say_error(problem.what());
    return invalid_input;
  } catch (const plugins::MemoryLack& problem) {
    say_error(fmt::format("{}: there is not enough memory for this; take fewer realisations, draws, rows or threads",
                          problem.what()));
    return invalid_input;
  } catch (const plugins::PluginFailure& problem) {
    say_error(
        fmt::format("nothing goes on with this plugin: {}. Take it out, or report this to its author", problem.what()));
    return internal_error;
  } catch (const std::filesystem::filesystem_error& problem) {
    say_error(fmt::format("the system refused {}: {}; check the path, its permissions and the free space",
                          problem.path1().string(), problem.code().message()));
    return invalid_input;
  } catch (const std::bad_alloc&) {
    say_error("there is not enough memory for this; take fewer realisations, draws, rows or threads");
    return invalid_input;
  } catch (const std::exception& problem) {
    return fault(problem.what());
  } catch (...) {
    return fault("something that is no std::exception was thrown");
  }
}

}  // namespace

}  // namespace tunica::app

int main(int argc, char** argv) {
  using namespace tunica::app;
  const auto work = [&] { return contained(argc, argv); };
  const bool alone = std::any_of(argv, argv + argc, [](const char* word) { return word == in_process; });
  return alone ? work() : supervise(work);
}
