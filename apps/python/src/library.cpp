// SPDX-License-Identifier: Apache-2.0
#include "library.hpp"

#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "data/csv.hpp"
#include "experiment/json_document.hpp"
#include "experiment/limits.hpp"
#include "experiment/parse.hpp"
#include "tunica/error.hpp"

namespace tunica::python {

namespace {

/// Each definition counts as a separate plugin, which results name.
template <class Factories>
void commit(const Factories& factories, plugins::Catalogue& catalogue) {
  for (const auto& [name, factory] : factories) {
    plugins::Catalogue::Registration registration;
    registration.add(factory);
    try {
      catalogue.commit(std::move(registration), name + " (Python)");
    } catch (const std::invalid_argument& problem) {
      throw InputError(fmt::format("'{}', defined in Python: {}", name, problem.what()));
    }
  }
}

}  // namespace

Library::Library(const std::vector<std::string>& paths, const std::string& installed, bool allow_world_writable) {
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path path : paths) {
    if (!std::filesystem::exists(path))
      throw InputError(fmt::format(
          "plugin path {}: no such file or folder; name a plugin file, or a folder that holds some", path.string()));
    if (std::filesystem::is_directory(path)) {
      folders.push_back(path);
      continue;
    }
    try {
      plugins::load_file(path, plugins_, allow_world_writable);
    } catch (const plugins::LoadError& refused) {
      throw InputError(fmt::format("plugin path {}: {}", path.string(), refused.what()));
    }
  }
  auto search = plugins::search_path(folders, installed);
  search.allow_world_writable = allow_world_writable;
  for (const auto& refusal : plugins::load_all(search, plugins_).refused)
    refusals_.push_back(fmt::format("plugin {} was refused: {}", refusal.file.string(), refusal.reason));
}

std::shared_ptr<const plugins::Catalogue> Library::catalogue() const {
  auto catalogue = std::make_shared<plugins::Catalogue>(plugins_);
  commit(models_, *catalogue);
  commit(tests_, *catalogue);
  commit(optimizers_, *catalogue);
  commit(mechanisms_, *catalogue);
  return catalogue;
}

std::shared_ptr<Loaded> Library::read(const std::string& file) const {
  return parse(data::read_bytes(file, experiment::limits::file_bytes), file);
}

std::shared_ptr<Loaded> Library::parse(std::string text, const std::string& file) const {
  auto known = catalogue();
  auto experiment = experiment::parse_experiment(text, file, *known);
  std::string given = experiment::JsonDocument(file, std::move(text)).root().dump();
  return std::make_shared<Loaded>(Loaded{std::move(known), std::move(experiment), refusals_, std::move(given)});
}

}  // namespace tunica::python
