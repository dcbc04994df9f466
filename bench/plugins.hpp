// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "plugins/guarded.hpp"
#include "plugins/loader.hpp"

/// The benchmarks' access to the built plugins.
namespace tunica::bench {

inline const plugins::Catalogue& catalogue() {
  static const plugins::Catalogue loaded = [] {
    plugins::Catalogue catalogue;
#ifdef TUNICA_AUTOMATIC_DIR  // the models of automatic_gho
    static_cast<void>(plugins::load_all({{TUNICA_PLUGIN_DIR, TUNICA_AUTOMATIC_DIR}, true}, catalogue));
#else
    static_cast<void>(plugins::load_all({{TUNICA_PLUGIN_DIR}, true}, catalogue));
#endif
    return catalogue;
  }();
  return loaded;
}

using OptionValues = std::vector<std::pair<std::string, Option::Value>>;

/// Declared defaults with overrides.
inline Options options_of(const std::vector<Option>& declared, const OptionValues& given = {}) {
  Options options;
  for (const Option& option : declared)
    if (option.fallback) options.set(option.name, *option.fallback);
  for (const auto& [name, value] : given) {
    if (!options.has(name)) throw std::runtime_error("no option is called " + name);
    options.set(name, value);
  }
  return options;
}

inline std::unique_ptr<Model> make_model(const std::string& type) {
  const auto& entry = catalogue().models().at(type);
  return plugins::create(entry, options_of(entry.factory.options));
}

inline auto make_optimizer(const std::string& type, const OptionValues& given) {
  const auto& entry = catalogue().optimizers().at(type);
  return plugins::create(entry, options_of(entry.factory.options, given));
}

}  // namespace tunica::bench
