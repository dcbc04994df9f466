// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <dlfcn.h>

#include "tunica/plugin.hpp"

namespace tunica::testing {

/// What the plugin TUNICA_PLUGIN_DIR/<name>.so registers, loaded by hand: the suites need no host. The library
/// stays mapped, as it does in the product.
class PluginUnderTest : public Registry {
 public:
  explicit PluginUnderTest(const std::string& name) {
    const std::string file = std::string(TUNICA_PLUGIN_DIR) + "/" + name + ".so";
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(::dlerror());
    const auto entry = reinterpret_cast<const PluginHeader* (*)()>(::dlsym(library, "tunica_plugin"));
    if (entry == nullptr) throw std::runtime_error(file + " has no symbol tunica_plugin");
    entry()->register_into(*this);
  }
  void add(ModelFactory) override {}
  void add(TestFactory) override {}
  void add(OptimizerFactory factory) override { optimizers.push_back(std::move(factory)); }
  void add(MechanismFactory) override {}

  std::vector<OptimizerFactory> optimizers;
};

using Given = std::vector<std::pair<std::string, Option::Value>>;

/// The factory of an optimiser: its plugin is called as the type is, or as the part before the underscore.
inline OptimizerFactory factory_of(const std::string& type) {
  const PluginUnderTest plugin(type.starts_with("pagmo_") ? "pagmo" : type);
  for (const OptimizerFactory& factory : plugin.optimizers) {
    if (factory.type == type) return factory;
  }
  throw std::runtime_error("no plugin registers " + type);
}

/// An optimiser as the host would make it: declared defaults, and what is given instead.
inline std::unique_ptr<Optimizer> make_optimizer(const std::string& type, const Given& given = {}) {
  const OptimizerFactory factory = factory_of(type);
  Options options;
  for (const Option& option : factory.options) options.set(option.name, option.fallback.value());
  for (const auto& [name, value] : given) {
    if (!options.has(name)) throw std::runtime_error(type + " declares no option " + name);
    options.set(name, value);
  }
  return factory.create(options);
}

}  // namespace tunica::testing
