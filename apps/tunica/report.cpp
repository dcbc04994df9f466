// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "answer.hpp"
#include "execution/files.hpp"
#include "exit_codes.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string file;
};

int make_report(const ReportOptions& options) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  if (folders.size() == 1 && options.file.empty()) {
    answer("{}\n", report::write_report(folders.front()).string());
    return done;
  }
  if (options.file.empty())
    throw InputError("several folders make one report: say with -o where it goes, for example -o comparison.html");
  const std::filesystem::path file = options.file;
  if (std::filesystem::is_directory(file))
    throw InputError(
        fmt::format("-o {}: is a folder; name a file, for example {}", file.string(), (file / "report.html").string()));
  const auto beside = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(beside))
    throw InputError(fmt::format("-o {}: no folder {}; make it first", file.string(), beside.string()));
  execution::write_atomically(file, report::report(folders, beside));
  answer("{}\n", file.string());
  return done;
}

}  // namespace

void add_report(CLI::App& app, GlobalOptions&, Action& action) {
  auto options = std::make_shared<ReportOptions>();
  auto* verb = app.add_subcommand("report", "Make report.html again from one or several result folders");
  verb->add_option("folders", options->folders, "Folders that run, diagnose or simulate have written")
      ->required()
      ->type_name("DIR");
  verb->add_option("-o,--output", options->file, "The file to write (default for one folder: DIR/report.html)")
      ->type_name("FILE");
  verb->footer(
      "Examples:\n"
      "  tunica report results/a\n"
      "  tunica report results/a results/b -o comparison.html\n\n"
      "The file is self-contained: it opens offline, in any browser.");
  verb->callback([&action, options] { action = [options] { return make_report(*options); }; });
}

}  // namespace tunica::app
