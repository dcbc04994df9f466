// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "execution/files.hpp"
#include "studio/project_folder.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

struct Example {
  const char* name;
  const char* title;
};
constexpr std::array worked = {
    Example{"lamb_aorta", "Lamb aorta: three fibre models on two strips, with intervals and ranking"},
    Example{"lamb_aorta_cause", "Lamb aorta: a strip that loses its stability, and what restores it"},
    Example{"treloar", "Treloar's rubber: five models on three protocols"},
    Example{"treloar_cause", "Treloar's rubber: what a model that is too simple leaves out"},
    Example{"james_1975", "Gum rubber in biaxial tests: some fitted, the others predicted"},
    Example{"human_brain_cortex", "Human brain cortex: one energy for tension, compression and shear"},
    Example{"vhb4910_cause", "Acrylic elastomer: viscoelasticity, not softening, makes the loop"},
    Example{"murine_tube_cause", "Murine artery: three inflations and their diagnosis"},
    Example{"hidden_effect", "Five synthetic tests with a hidden effect to be found"},
    Example{"foam", "A foam in three tests that change its volume"}};

/// Beside the program: where they are installed, and in the tree that it was built in.
fs::path place_of_examples() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* way : {TUNICA_EXAMPLES_FROM_BIN, "../../../examples"})
    if (fs::is_directory(program / way / worked.front().name, none)) return fs::canonical(program / way);
  return {};
}

/// "../lamb_aorta/axial.csv": files of other examples, under "file" and "files" anywhere.
void collect_files(const json& value, std::set<std::string>& names) {
  if (value.is_string() && value.get_ref<const std::string&>().starts_with("../")) names.insert(value);
  if (!value.is_structured()) return;
  for (const auto& [key, child] : value.items())
    if (!key.starts_with('$')) collect_files(child, names);
}

bool is_wanted(const fs::path& file) {
  return file.extension() == ".json" || file.extension() == ".csv" || file.filename() == "README.md";
}

void take_along(const fs::path& from, const fs::path& to) {
  if (fs::exists(fs::symlink_status(to))) return;
  execution::make_folders(to.parent_path());
  execution::write_atomically(to, execution::read_text(from));
}

}  // namespace

json examples() {
  json list = json::array();
  if (place_of_examples().empty()) return list;
  for (const Example& one : worked) list.push_back({{"name", one.name}, {"title", one.title}});
  return list;
}

std::string open_example(const std::string& name) {
  const fs::path place = place_of_examples();
  const bool known = std::any_of(worked.begin(), worked.end(), [&](const Example& one) { return one.name == name; });
  if (!known || place.empty())
    throw InputError(fmt::format("there is no worked example '{}'; choose one of those that the page lists", name));
  std::set<std::string> others;
  for (const auto& entry : fs::directory_iterator(place / name)) {
    if (!entry.is_regular_file() || !is_wanted(entry.path())) continue;
    take_along(entry.path(), fs::path(name) / entry.path().filename());
    if (entry.path().extension() == ".json")
      collect_files(detail::parse_json<json>(execution::read_text(entry.path()), true, true), others);
  }
  for (const std::string& other : others) {
    const fs::path from = fs::weakly_canonical(place / name / other), relative = fs::relative(from, place);
    if (fs::is_regular_file(from) && !relative.native().starts_with("..")) take_along(from, relative);
  }
  return name + "/experiment.json";
}

}  // namespace tunica::app::studio
