// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>

#include "plugins/guarded.hpp"
#include "plugins/loader.hpp"

/// What the tests see of the built plugins: the same objects, through the same loader, as a user gets.
namespace tunica::testing {

inline const plugins::Catalogue& catalogue() {
  static const plugins::Catalogue loaded = [] {
    plugins::Catalogue catalogue;
    const plugins::LoadReport report = plugins::load_all({{TUNICA_PLUGIN_DIR}, true}, catalogue);
    for (const auto& refusal : report.refused) throw std::runtime_error(refusal.file.string() + ": " + refusal.reason);
    return catalogue;
  }();
  return loaded;
}

/// Options with every declared default.
inline Options defaults(const std::vector<Option>& declared) {
  Options options;
  for (const Option& option : declared)
    if (option.fallback) options.set(option.name, *option.fallback);
  return options;
}

inline std::unique_ptr<Model> make_model(const std::string& type, Options options = {}) {
  const auto& entry = catalogue().models().at(type);
  Options all = defaults(entry.factory.options);
  for (const auto& [name, value] : options.values()) all.set(name, value);
  return plugins::create(entry, all);
}

}  // namespace tunica::testing
