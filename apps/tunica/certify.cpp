// SPDX-License-Identifier: Apache-2.0
#include "comparison/certify.hpp"

#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <sys/prctl.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include "answer.hpp"
#include "execution/files.hpp"
#include "execution/plan.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct CertifyOptions {
  std::string folder, best_points;
  unsigned threads = static_cast<unsigned>(tbb::info::default_concurrency());
};

int certify(const GlobalOptions& global, const CertifyOptions& options) {
  if (!options.best_points.empty()) ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // only `run` reads the answer
  const std::filesystem::path folder = options.folder;
  const std::filesystem::path points =
      options.best_points.empty() ? folder / "result.json" : std::filesystem::path(options.best_points);
  const tbb::global_control budget(tbb::global_control::max_allowed_parallelism, options.threads);
  for (const auto& file : {folder / "input.json", points})
    if (!std::filesystem::exists(file))
      throw InputError(fmt::format("{}: there is no {}; name the folder of a finished run", folder.string(),
                                   file.filename().string()));
  const Session session(global);
  const auto experiment = session.read(folder / "input.json");
  const auto plan = execution::make_plan(experiment, session.catalogue());
  std::vector<std::string> contradictions;
  answer("{}", comparison::certify(plan, execution::read_text(points), &contradictions, &session.catalogue()));
  for (const auto& contradiction : contradictions) say_error(contradiction);
  return contradictions.empty() ? done : not_converged;
}

}  // namespace

void add_certify(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<CertifyOptions>();
  auto* verb = app.add_subcommand("certify", "Check the best points of a finished run and their neighbours once more");
  verb->add_option("folder", options->folder, "Folder that `tunica run` has written")->required()->type_name("DIR");
  verb->add_option("-j,--threads", options->threads, "Threads for the neighbours (default: all of the machine)")
      ->check(CLI::Range(1, 1024))
      ->type_name("N");
  verb->add_option("--best-points", options->best_points, "Before there is a result.json: the points to evaluate")
      ->type_name("FILE")
      ->group("");
  verb->add_flag("--quiet", global.quiet, "Print only errors on stderr");
  verb->footer(
      "Prints JSON: for every run the objective in this process, its difference from the recorded one, and the lowest\n"
      "of the neighbours. Where a recorded objective is not confirmed, a line on stderr says so and the exit code is "
      "1.\n"
      "`tunica run` asks a fresh process for the same, and result.json has the answer as `certificate`.\n\n"
      "Examples:\n"
      "  tunica certify results/a\n"
      "  tunica certify results/a | jq '.runs[].difference'");
  verb->callback([&global, &action, options] { action = [&global, options] { return certify(global, *options); }; });
}

}  // namespace tunica::app
