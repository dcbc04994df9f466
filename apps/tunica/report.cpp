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
#include "print_page.hpp"
#include "text/aside.hpp"
#include "tunica/error.hpp"
#include "verbs.hpp"

namespace tunica::app {

namespace {

struct ReportOptions {
  std::vector<std::string> folders;
  std::string file, printed;
};

/// The folder that a file goes to.
std::filesystem::path folder_of(const char* option, const std::filesystem::path& file, const char* usual) {
  if (std::filesystem::is_directory(file))
    throw InputError(
        fmt::format("{} {}: is a folder; name a file, for example {}", option, file.string(), (file / usual).string()));
  auto beside = std::filesystem::absolute(file).parent_path();
  if (!std::filesystem::is_directory(beside))
    throw InputError(fmt::format("{} {}: no folder {}; make it first", option, file.string(), beside.string()));
  return beside;
}

int make_report(const ReportOptions& options) {
  const std::vector<std::filesystem::path> folders(options.folders.begin(), options.folders.end());
  const std::filesystem::path file = options.file;
  const auto beside = options.file.empty() ? std::filesystem::path() : folder_of("-o", file, "report.html");
  if (!options.printed.empty()) {
    static_cast<void>(folder_of("--pdf", options.printed, "report.pdf"));
    if (!print_report(folders, options.printed)) {
      text::aside("interrupted; nothing is printed\n");
      return interrupted;
    }
    answer("{}\n", options.printed);
    if (options.file.empty()) return done;
  }
  if (folders.size() == 1 && options.file.empty()) {
    answer("{}\n", report::write_report(folders.front()).string());
    return done;
  }
  if (options.file.empty())
    throw InputError("several folders make one report: say with -o where it goes, for example -o comparison.html");
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
  verb->add_option("-o,--output", options->file,
                   "The file to write (default for one folder without --pdf: DIR/report.html)")
      ->type_name("FILE");
  verb->add_option("--pdf", options->printed, "Print it into this file, by Chromium, Chrome or Edge")
      ->type_name("FILE");
  verb->footer(
      "Examples:\n"
      "  tunica report results/a\n"
      "  tunica report results/a results/b -o comparison.html\n"
      "  tunica report results/a --pdf report.pdf\n\n"
      "The file is self-contained: it opens offline, in any browser.");
  verb->callback([&action, options] { action = [options] { return make_report(*options); }; });
}

}  // namespace tunica::app
