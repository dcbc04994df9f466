// SPDX-License-Identifier: Apache-2.0
#include "report/folder.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "execution/files.hpp"
#include "report/pieces.hpp"
#include "text/escaped.hpp"
#include "text/shell.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::report {

Folder::Folder(std::filesystem::path path, std::string address) : path_(std::move(path)), address_(std::move(address)) {
  if (!std::filesystem::is_directory(path_))
    throw InputError(fmt::format("{}: no such folder; name one that `tunica run`, `diagnose` or `simulate` has written",
                                 path_.string()));
  const auto file = path_ / "result.json";
  if (!std::filesystem::exists(file)) {
    if (tables("").empty())
      throw InputError(
          fmt::format("{}: holds neither result.json nor a table; name a folder that `tunica run`, `diagnose` or "
                      "`simulate` has written, or finish the run with --resume",
                      path_.string()));
    kind_ = Kind::simulation;
    read_result(path_ / "simulation.json");
    return;
  }
  read_result(file);
  if (member(result_, key::discovery).is_object()) kind_ = Kind::discovery;
  if (member(result_, key::diagnosis).is_object()) kind_ = Kind::diagnosis;
  if (member(result_, key::cohort).is_object()) kind_ = Kind::cohort;
}

void Folder::read_result(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return;
  try {
    result_ = detail::parse_json<Json>(execution::read_text(file));
  } catch (const Json::exception& reason) {
    throw InputError(
        fmt::format("{}: is not JSON ({}); run it again", file.string(), text::json_problem(reason.what())));
  }
  if (!result_.is_object())
    throw InputError(fmt::format("{}: expected an object at the top; run it again", file.string()));
  if (file.filename() == "result.json" && member(result_, key::format).is_null())
    throw InputError(fmt::format(
        "{}: has no \"format\", so that it is not what `tunica run` or `diagnose` has written; name a folder "
        "that they have written",
        file.string()));
  if (const Json& format = member(result_, key::format); !format.is_null() && format != 1)
    throw InputError(
        fmt::format("{}: \"format\" is {}, and this version of tunica reads 1. Use the version that wrote it.",
                    file.string(), text::excerpt(format.dump())));
}

std::string Folder::name() const {
  std::string given = word(result_, key::name);
  if (!given.empty()) return given;
  const auto last = path_.filename().empty() ? path_.parent_path().filename() : path_.filename();
  return last.string();
}

std::string Folder::in_command(const std::string& file) const {
  return text::quoted((path_ / file).lexically_normal().string());
}

std::optional<Table> Folder::table(const std::string& file) const {
  std::string problem;
  auto table = Table::read(path_ / file, problem);
  remember(problem);
  return table;
}

std::optional<Json> Folder::document(const std::string& file) const {
  if (!has(file)) return {};
  try {
    return detail::parse_json<Json>(execution::read_text(path_ / file));
  } catch (const Json::exception& reason) {
    remember(fmt::format("{}: is not JSON ({})", file, text::json_problem(reason.what())));
    return {};
  }
}

std::optional<Grid> Folder::grid(const std::string& file) const {
  std::string problem;
  auto grid = Grid::read(path_ / file, problem);
  remember(problem);
  return grid;
}

void Folder::remember(const std::string& problem) const {
  if (!problem.empty() && std::find(problems_.begin(), problems_.end(), problem) == problems_.end())
    problems_.push_back(problem);
}

std::vector<std::string> Folder::tables(const std::string& prefix) const { return tables_in("", prefix); }

std::vector<std::string> Folder::tables_in(const std::string& folder, const std::string& prefix) const {
  std::vector<std::string> names;
  if (!std::filesystem::is_directory(path_ / folder)) return names;
  for (const auto& entry : std::filesystem::directory_iterator(path_ / folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() == ".csv" && name.starts_with(prefix))
      names.push_back(folder.empty() ? name : fmt::format("{}/{}", folder, name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool Folder::has(const std::string& file) const { return std::filesystem::exists(path_ / file); }

}  // namespace tunica::report
