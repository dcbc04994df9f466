// SPDX-License-Identifier: Apache-2.0
#include "comparison/certify.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "execution/files.hpp"
#include "execution/plan.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

int certify(const GlobalOptions& global, const std::filesystem::path& folder, unsigned threads) {
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, threads);
  for (const char* file : {"input.json", "result.json"})
    if (!std::filesystem::exists(folder / file))
      throw InputError(fmt::format("{}: there is no {}; name the folder of a finished run", folder.string(), file));
  const Session session(global);
  const auto experiment = session.read(folder / "input.json");
  const auto plan = execution::make_plan(experiment, session.catalogue());
  std::vector<std::string> contradictions;
  fmt::print("{}", comparison::certify(plan, execution::read_text(folder / "result.json"), &contradictions));
  for (const auto& contradiction : contradictions) say_error(contradiction);
  return contradictions.empty() ? done : not_converged;
}

}  // namespace

void add_certify(CLI::App& app, GlobalOptions& global, Action& action) {
  auto folder = std::make_shared<std::string>();
  auto threads = std::make_shared<unsigned>(static_cast<unsigned>(tbb::info::default_concurrency()));
  auto* verb = app.add_subcommand("certify", "Evaluate the best points of a finished run and their neighbours again");
  verb->add_option("folder", *folder, "Folder that `tunica run` has written")->required()->type_name("DIR");
  verb->add_option("-j,--threads", *threads, "Threads for the neighbours; all of the machine without it")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_flag("--quiet", global.quiet, "Nothing on stderr but errors");
  verb->footer(
      "Prints JSON: for every run the objective in this process, its difference from the recorded one, and the lowest\n"
      "of the neighbours. Exit code 1, and a line on stderr, where a recorded objective is not confirmed.\n"
      "`tunica run` asks a process of its own for it, for `certificate` in result.json.\n\n"
      "Examples:\n"
      "  tunica certify results/a\n"
      "  tunica certify results/a | jq '.runs[].difference'");
  verb->callback([&global, &action, folder, threads] {
    action = [&global, folder, threads] { return certify(global, *folder, *threads); };
  });
}

}  // namespace tunica::app
