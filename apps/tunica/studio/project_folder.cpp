// SPDX-License-Identifier: Apache-2.0
#include "studio/project_folder.hpp"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <mutex>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "execution/files.hpp"
#include "studio/doorkeeper.hpp"
#include "studio/history.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

/// Folders of results lie in "results", experiments at most one deeper than that.
constexpr int deepest = 3;
constexpr std::size_t most_entries = 5000;

/// Symbolic links on the way are followed, and where they end counts.
bool lies_inside(const fs::path& file) {
  const fs::path root = fs::canonical(fs::current_path()), real = fs::weakly_canonical(fs::absolute(file));
  return std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
}

bool is_result(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "result.json", none) || fs::exists(folder / "checkpoint.json", none) ||
         fs::exists(folder / "simulation.json", none);
}

bool is_experiment(const fs::path& file) {
  constexpr std::uintmax_t largest = std::uintmax_t{4} << 20U;  // bytes
  std::error_code none;
  if (fs::file_size(file, none) > largest || none) return false;
  try {
    const auto document = detail::parse_json<json>(execution::read_text(file), false, true);
    return document.is_object() && document.contains("tests") && document.contains("models");
  } catch (const InputError&) {
    return false;
  }
}

bool is_data(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".csv" || ending == ".txt" || ending == ".tsv" || ending == ".dat" || ending == ".asc";
}

void collect(const fs::path& folder, int depth, const std::vector<JobRecord>& jobs, json& found, std::size_t& left) {
  std::error_code none;
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, none))
    if (left > 0 && --left > 0) entries.push_back(folder / entry.path().filename());
  std::sort(entries.begin(), entries.end());
  for (const fs::path& entry : entries) {
    const std::string name = entry.generic_string();
    if (entry.filename().native().front() == '.' || name.front() == '-' || !text::is_plain(name) ||
        fs::is_symlink(entry, none))
      continue;
    if (fs::is_directory(entry, none)) {
      if (is_result(entry))
        found["results"].push_back(result_entry(entry, jobs));
      else if (depth < deepest)
        collect(entry, depth + 1, jobs, found, left);
    } else if (fs::is_regular_file(entry, none)) {
      if (entry.extension() == ".json" && is_experiment(entry)) found["experiments"].push_back(name);
      if (is_data(entry)) found["data"].push_back(name);
    }
  }
}

std::mutex names_mutex;
std::set<fs::path> names_given;  ///< by free_name(), and not given back

/// A changed copy stays beside its original, even in a result folder, which is not searched for experiments.
bool is_copy_of_result(const fs::path& copy) {
  std::error_code none;
  return text::is_plain(copy.native()) && copy.is_relative() && is_result(copy.parent_path()) &&
         fs::is_regular_file(copy, none) && lies_inside(copy);
}

}  // namespace

fs::path own_place() {
  const fs::path place = execution::own_folder(".tunica-studio");
  if (!fs::is_directory(place)) execution::make_folder(place);
  return place;
}

fs::path inside(const std::string& name) {
  if (name.empty() || !text::is_plain(name)) throw Refused("a name of a file is empty, or is no plain text");
  const fs::path path = name;
  if (name.front() == '-')
    throw Refused(fmt::format("'{}' begins with \"-\", as an option does; rename it", text::excerpt(name)));
  if (path.is_absolute()) throw Refused(fmt::format("'{}' is no name within the project", text::excerpt(name)));
  for (const fs::path& part : path)
    if (part.empty() || part.native().front() == '.')
      throw Refused(fmt::format("'{}' leaves the project, or names something hidden", text::excerpt(name)));
  if (!lies_inside(path)) throw Refused(fmt::format("'{}' leads out of the project", text::excerpt(name)));
  return path;
}

fs::path file_inside(const std::string& name) {
  const fs::path path = inside(name);
  if (!fs::is_regular_file(path))
    throw InputError(fmt::format("{}: there is no such file in the project; load the page again", name));
  return path;
}

void require_inside(const fs::path& file, const std::string& named_by) {
  if (!lies_inside(file))
    throw Refused(
        fmt::format("{} names the file {}, which lies outside of the project. Start `tunica studio` with a "
                    "folder that holds both, or run the experiment from a shell",
                    named_by, file.string()));
}

std::string file_name(std::string_view wished) {
  constexpr std::size_t longest = 100;
  if (const auto slash = wished.find_last_of("/\\"); slash != std::string_view::npos) wished.remove_prefix(slash + 1);
  while (wished.starts_with('.') || wished.starts_with(' ') || wished.starts_with('-')) wished.remove_prefix(1);
  std::string name;
  for (const char c : wished.substr(wished.size() > longest ? wished.size() - longest : 0))
    name += std::isalnum(static_cast<unsigned char>(c)) || std::string_view("._- ").find(c) != std::string_view::npos
                ? c
                : '-';
  while (name.starts_with('.') || name.starts_with('-')) name.erase(0, 1);
  return name.empty() ? "file" : name;
}

fs::path free_name(const fs::path& wished) {
  const std::lock_guard lock(names_mutex);
  fs::path path = wished;
  for (int n = 2; names_given.contains(path) || fs::exists(fs::symlink_status(path)); ++n)
    path.replace_filename(fmt::format("{}-{}{}", wished.stem().string(), n, wished.extension().string()));
  names_given.insert(path);
  return path;
}

void give_back(const fs::path& name) {
  const std::lock_guard lock(names_mutex);
  names_given.erase(name);
}

std::string passing_name() {
  static std::atomic<unsigned long> count = 0;
  return fmt::format(".passing-{}-{}.json", ::getpid(), ++count);
}

json contents() {
  json found = {{"experiments", json::array()}, {"data", json::array()}, {"results", json::array()}};
  std::size_t left = most_entries;
  collect({}, 0, job_records(), found, left);
  found["complete"] = left > 0;
  auto& results = found["results"];
  std::stable_sort(results.begin(), results.end(),
                   [](const json& a, const json& b) { return a["written"] > b["written"]; });
  for (const json& result : results)
    for (const json& next : result["leads_to"]) found["experiments"].push_back(next["file"]);
  found["copies"] = copies();
  for (const auto& [copy, original] : found["copies"].items())
    if (is_copy_of_result(copy)) found["experiments"].push_back(copy);
  return found;
}

}  // namespace tunica::app::studio
