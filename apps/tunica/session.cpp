// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "answer.hpp"
#include "data/read_bytes.hpp"
#include "messages.hpp"
#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::app {

namespace {

std::string describe(const plugins::RefusedPlugin& refusal) {
  return fmt::format("plugin {} was refused: {}", refusal.file.string(), refusal.reason);
}

/// Nothing where it cannot be read, which was said before.
std::string text_of(const std::filesystem::path& file) {
  try {
    return data::read_bytes(file);
  } catch (const InputError&) {
    return {};
  }
}

/// Every text under a key "type" in the file, as far as it can be read.
std::set<std::string> types_named_in(const std::filesystem::path& file) {
  std::set<std::string> types;
  const auto document = tunica::detail::parse_json(text_of(file), false, true);
  constexpr int deepest = 64;  // nested deeper it is no experiment
  const auto collect = [&](const auto& self, const nlohmann::json& value, int depth) -> void {
    if (value.is_object() && value.contains("type") && value["type"].is_string()) types.insert(value["type"]);
    if (value.is_structured() && depth < deepest)
      for (const auto& child : value) self(self, child, depth + 1);
  };
  if (!document.is_discarded()) collect(collect, document, 0);
  return types;
}

plugins::CallWatch::Limits limits_of(const GlobalOptions& options) {
  plugins::CallWatch::Limits limits;
  limits.longest_model_call = std::chrono::duration<double>(options.call_limit);
  constexpr double gibibyte = 1024.0 * 1024 * 1024;
  if (options.memory_limit > 0) {
    limits.memory = options.memory_limit * gibibyte;
    limits.memory_of_model = 0.25 * limits.memory;
  }
  return limits;
}

}  // namespace

std::vector<std::string> plugin_words(const GlobalOptions& global) {
  std::vector<std::string> words;
  for (const std::string& path : global.plugin_paths) words.insert(words.end(), {"--plugin-path", path});
  if (global.allow_world_writable_plugins) words.emplace_back("--allow-world-writable-plugins");
  const GlobalOptions usual;
  if (global.call_limit != usual.call_limit)
    words.insert(words.end(), {"--call-limit", fmt::format("{}", global.call_limit)});
  if (global.memory_limit != usual.memory_limit)
    words.insert(words.end(), {"--memory-limit", fmt::format("{}", global.memory_limit)});
  return words;
}

Session::Session(const GlobalOptions& options) : watch_(limits_of(options)) {
  keep_stdout();
  plugins::leave_last_words();
  std::vector<std::filesystem::path> folders;
  for (const std::filesystem::path path : options.plugin_paths) {
    if (!std::filesystem::exists(path))
      throw InputError(fmt::format(
          "--plugin-path {}: no such file or folder; name a plugin file, or a folder that holds some", path.string()));
    if (std::filesystem::is_directory(path)) {
      folders.push_back(path);
      continue;
    }
    try {
      loaded_.push_back(plugins::load_file(path, catalogue_, options.allow_world_writable_plugins));
    } catch (const plugins::LoadError& refused) {
      throw PluginRefused(fmt::format("--plugin-path {}: {}", path.string(), refused.what()));
    }
  }
  auto search = plugins::default_search_path(folders);
  search.allow_world_writable = options.allow_world_writable_plugins;
  const std::size_t named = loaded_.size();
  auto report = plugins::load_all(search, catalogue_);
  loaded_.insert(loaded_.end(), report.loaded.begin(), report.loaded.end());
  for (auto& refusal : report.refused) {
    // The same file met again on the search path is the one that is loaded already.
    const bool again =
        std::any_of(loaded_.begin(), loaded_.begin() + static_cast<std::ptrdiff_t>(named), [&](const auto& entry) {
          std::error_code error;
          return std::filesystem::equivalent(entry.file, refusal.file, error);
        });
    if (again) continue;
    if (!options.quiet) say_warning(describe(refusal));
    refused_.push_back(std::move(refusal));
  }
  plugins::leave_last_words();
}

std::vector<std::string> Session::refusals() const {
  std::vector<std::string> lines;
  for (const auto& refusal : refused_) lines.push_back(describe(refusal));
  return lines;
}

experiment::Experiment Session::read(const std::filesystem::path& file, experiment::Purpose purpose) const {
  try {
    return experiment::read_experiment(file, catalogue_, purpose);
  } catch (const InputError& problem) {
    if (refused_.empty()) throw;
    const auto types = types_named_in(file);
    for (const auto& refusal : refused_) {
      const std::string type = refusal.file.stem().string();
      const bool provided = catalogue_.models().count(type) + catalogue_.tests().count(type) +
                                catalogue_.optimizers().count(type) + catalogue_.mechanisms().count(type) >
                            0;
      if (types.count(type) > 0 && !provided)
        throw PluginRefused(
            fmt::format("{}\nThe type '{}' is missing because its {}", problem.what(), type, describe(refusal)));
    }
    throw;
  }
}

}  // namespace tunica::app
