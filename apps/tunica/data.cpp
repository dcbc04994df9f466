// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>

#include "answer.hpp"
#include "comparison/taken_rows.hpp"
#include "execution/run_directory.hpp"
#include "exit_codes.hpp"
#include "messages.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct DataOptions {
  std::string file, directory;
  bool as_json = false;
};

int data(const GlobalOptions& global, const DataOptions& options) {
  const Session session(global);
  const auto experiment = session.read(options.file);
  const auto tests = comparison::taken_rows(experiment, session.catalogue());
  for (const auto& taken : tests)
    for (const auto& warning : taken.warnings) say_wrapped_warning(warning);
  if (!options.directory.empty()) {
    const auto directory = execution::RunDirectory::create(std::filesystem::path(options.directory), experiment.name);
    execution::NewResults results(directory);
    for (const auto& taken : tests) {
      const auto file = comparison::write_table(directory.path(), taken.table);
      if (!options.as_json) answer("{}\n", file.string());
    }
    results.complete();
  }
  if (options.as_json) {
    print_json(comparison::taken_rows_json(tests));
    return done;
  }
  for (const auto& taken : tests) {
    answer("{}: {}\n", taken.table.test, text::counted(taken.table.columns.front().size(), "row", "rows"));
    for (const auto& line : taken.understood) answer("{}\n", text::hanging("  ", line));
  }
  return done;
}

}  // namespace

void add_data(CLI::App& app, GlobalOptions& global, Action& action) {
  auto options = std::make_shared<DataOptions>();
  auto* verb = app.add_subcommand("data", "Show the rows that a fit takes, in base units");
  verb->add_option("experiment", options->file, "Experiment file (JSON)")->required()->type_name("EXP");
  verb->add_option("-o,--output", options->directory, "New folder for a table of each test, <test>.csv")
      ->type_name("DIR");
  verb->add_flag("--json", options->as_json, "Print one JSON object with all rows, and their lines in the file");
  verb->footer(
      "Examples:\n"
      "  tunica data experiment.json -o rows    after units, cycles and branches");
  verb->callback([&global, &action, options] { action = [&global, options] { return data(global, *options); }; });
}

}  // namespace tunica::app
