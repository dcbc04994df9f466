// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "data/dataset.hpp"
#include "execution/files.hpp"
#include "experiment/experiment.hpp"
#include "studio/project_folder.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app::studio {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

namespace {

struct Example {
  const char *name, *title, *learnt;
};
constexpr std::array worked = {
    Example{"lamb_aorta", "Lamb aorta: three fibre models on two strips",
            "Which model describes both strips, how well each parameter is known, and whether the material is stable."},
    Example{"lamb_aorta_cause", "Lamb aorta: a strip that loses its stability",
            "A good fit may belong to a material that loses its stability. The diagnosis says where, and what restores "
            "it."},
    Example{"treloar", "Treloar's rubber: five models on three protocols",
            "One protocol hardly tells models apart; three of them together do."},
    Example{"treloar_cause", "Treloar's rubber: what a simple model leaves out",
            "How to read a misfit: how much of the range one modulus misses, and what would take it."},
    Example{"james_1975", "Gum rubber in biaxial tests", "A model is tried on series that it was not fitted to."},
    Example{"human_brain_cortex", "Human brain cortex: tension, compression and shear",
            "One energy for three loads is harder to find than one for each."},
    Example{"vhb4910_cause", "Acrylic elastomer: loops at three rates",
            "A loop may be viscoelasticity or softening; tests at several rates tell which."},
    Example{"murine_tube_cause", "Murine artery: three inflations",
            "What inflations at three axial stretches say against a fibre model."},
    Example{"hidden_effect", "Five synthetic tests with a hidden effect",
            "The data hide one effect that the model lacks: see whether the diagnosis finds it."},
    Example{"foam", "A foam in three tests that change its volume",
            "A material that changes its volume shows it in more than one test; a model that keeps it can carry one "
            "alone."}};

/// Beside the program: where they are installed, and in the tree that it was built in.
fs::path place_of_examples() {
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* way : {TUNICA_EXAMPLES_FROM_BIN, "../../../examples"})
    if (fs::is_directory(program / way / worked.front().name, none)) return fs::canonical(program / way);
  return {};
}

/// Of one that is listed.
fs::path place_of(const std::string& name) {
  const bool known = std::any_of(worked.begin(), worked.end(), [&](const Example& one) { return one.name == name; });
  fs::path place = place_of_examples();
  if (!known || place.empty())
    throw InputError(fmt::format("there is no worked example '{}'; choose one of those that the page lists", name));
  return place;
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
  for (const Example& one : worked) list.push_back({{"name", one.name}, {"title", one.title}, {"learnt", one.learnt}});
  return list;
}

json example_curves(const std::string& name, const plugins::Catalogue& catalogue) {
  constexpr std::size_t most_curves = 3, most_rows = 300;
  const auto experiment = experiment::read_experiment(place_of(name) / name / "experiment.json", catalogue);
  json curves = json::array();
  for (const auto& test : experiment.tests) {
    if (curves.size() == most_curves) break;
    const auto dataset = data::read_dataset(test.data, catalogue.tests().find(test.type)->second.factory.observables);
    if (dataset.abscissae.empty() || dataset.channels.empty()) continue;
    const auto& [over, x] = dataset.abscissae.front();
    const auto& channel = dataset.channels.front();
    json one = {{"test", test.name}, {"x", json::array()}, {"y", json::array()}};
    const std::size_t step = 1 + x.size() / most_rows;
    for (std::size_t row = 0; row < x.size(); row += step) {
      one["x"].push_back(x[row]);
      one["y"].push_back(std::isfinite(channel.values[row]) ? json(channel.values[row]) : json(nullptr));
    }
    curves.push_back(std::move(one));
    curves.back().update({{"over", over}, {"observable", channel.observable}, {"unit", channel.unit}});
  }
  return curves;
}

std::string open_example(const std::string& name) {
  const fs::path place = place_of(name);
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
