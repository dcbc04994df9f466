// SPDX-License-Identifier: Apache-2.0
#include "print_page.hpp"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <initializer_list>
#include <sstream>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "data/nearest.hpp"
#include "execution/files.hpp"
#include "execution/interrupt.hpp"
#include "fresh_process.hpp"
#include "report/html.hpp"
#include "report/report.hpp"
#include "supervisor.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

/// A browser that opens a window, or hangs, would never end.
constexpr std::chrono::seconds print_limit{120};

/// A folder that is gone with what is in it, also where this process is ended in the middle.
struct TemporaryFolder {
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tunica-print-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw execution::WriteFailure(pattern, errno);
    path = std::filesystem::absolute(pattern);
    supervised::unfinished({path}, path);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code left;
    std::filesystem::remove_all(path, left);
    supervised::unfinished({});
  }
  std::filesystem::path path;
};

/// The first of these programs on PATH; empty where there is none.
std::string on_path(std::initializer_list<const char*> programs) {
  const char* const path = std::getenv("PATH");
  for (const char* program : programs) {
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (const auto file = std::filesystem::path(folder) / program; ::access(file.c_str(), X_OK) == 0)
        return file.string();
  }
  return {};
}

std::string browser() {
  if (const char* const named = std::getenv("TUNICA_BROWSER"); named != nullptr && *named != '\0') return named;
  std::string found =
      on_path({"chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "microsoft-edge"});
  if (found.empty())
    throw InputError(
        "--pdf: a browser prints the page, and found none of chromium, google-chrome and microsoft-edge on PATH; "
        "install one (Debian: chromium), name it in TUNICA_BROWSER, or make the page with `tunica report DIR`, open it "
        "and print it");
  return found;
}

}  // namespace

bool print_report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& file) {
  const std::string program = browser();
  const execution::InterruptWatch interrupts;
  const TemporaryFolder scratch;
  const auto page = scratch.path / "report.html", printed = scratch.path / "report.pdf";
  execution::write_atomically(page, report::report(folders, scratch.path));
  // The page draws its charts before the virtual time of the budget, in ms, is over.
  std::vector<std::string> words{"--headless=new",
                                 "--disable-gpu",
                                 "--no-first-run",
                                 "--no-pdf-header-footer",
                                 "--virtual-time-budget=60000",
                                 "--user-data-dir=" + (scratch.path / "profile").string(),
                                 "--print-to-pdf=" + printed.string()};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium has none for root
  words.push_back("file://" + report::address(page.string()));
  const Answer answer = ask_program(program, words, print_limit);
  if (execution::InterruptWatch::interrupted()) return false;
  std::string text;
  if (std::error_code none; std::filesystem::exists(printed, none)) text = execution::read_text(printed);
  if (!answer.problem.empty() || !text.starts_with("%PDF"))
    throw InputError(
        fmt::format("--pdf: {} has printed no PDF{}{}; name another browser in TUNICA_BROWSER, or make the page with "
                    "`tunica report DIR`, open it and print it",
                    program, answer.problem.empty() ? "" : ": " + answer.problem,
                    answer.said.empty() ? "" : fmt::format(" ('{}')", data::excerpt(answer.said))));
  execution::write_atomically(file, text);
  return true;
}

}  // namespace tunica::app
