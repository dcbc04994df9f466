// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <fmt/format.h>

#include "execution/files.hpp"
#include "report/sections.hpp"
#include "tunica/error.hpp"

namespace tunica::report {

namespace {

void add_folder(Page& page, const Folder& folder) {
  switch (folder.kind()) {
    case Folder::Kind::run:
      return add_run(page, folder);
    case Folder::Kind::diagnosis:
      return add_diagnosis(page, folder);
    case Folder::Kind::discovery:
      return add_discovery(page, folder);
    case Folder::Kind::simulation:
      return add_simulation(page, folder);
    case Folder::Kind::cohort:
      return add_cohort(page, folder);
  }
}

const char* word_of(Folder::Kind kind) {
  switch (kind) {
    case Folder::Kind::run:
      return "calibration";
    case Folder::Kind::diagnosis:
      return "diagnosis";
    case Folder::Kind::discovery:
      return "discovery";
    case Folder::Kind::simulation:
      return "simulation";
    case Folder::Kind::cohort:
      return "cohort";
  }
  return "";
}

}  // namespace

std::string report(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& beside) {
  if (folders.empty()) throw InputError("a report needs at least one folder of results");
  std::vector<Folder> read;
  std::string title;
  for (const auto& path : folders) {
    std::string address = std::filesystem::proximate(path, beside).generic_string();
    read.emplace_back(path, address == "." ? "" : address);
    title += (title.empty() ? "" : " | ") + read.back().name();
  }
  Page page(fmt::format("{}: {}", title, read.size() == 1 ? word_of(read.front().kind()) : "comparison"));
  if (read.size() > 1) add_comparison(page, read);
  for (const Folder& folder : read) {
    if (read.size() > 1) page.part(fmt::format("{}: {}", folder.name(), folder.address()));
    add_folder(page, folder);
  }
  return page.document();
}

std::filesystem::path write_report(const std::filesystem::path& folder) {
  auto file = folder / "report.html";
  execution::write_atomically(file, report({folder}, folder));
  return file;
}

}  // namespace tunica::report
