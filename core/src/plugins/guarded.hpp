// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "plugins/catalogue.hpp"
#include "tunica/error.hpp"

/// The boundary for calls into plugins: nothing a plugin throws gets past it as it is. Wrong input stays an
/// InputError, anything else becomes a PluginFailure; both carry the plugin's name.
namespace tunica::plugins {

/// A plugin broke its promise: a bug to report to its author, not wrong input. Exit code 4.
class PluginFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The host's own complaint, thrown through a plugin that called back into it: passed on as it is. Exit code 2.
class __attribute__((visibility("default"))) HostFault : public InputError {
 public:
  using InputError::InputError;
};

/// Runs `call` on behalf of the plugin (as an Entry names it: "gho 0.1.0").
template <class Call>
std::invoke_result_t<Call> guarded(const std::string& plugin, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const HostFault&) {
    throw;
  } catch (const InputError& problem) {
    throw InputError("plugin '" + plugin + "': " + problem.what());
  } catch (const std::exception& problem) {
    throw PluginFailure("plugin '" + plugin + "' failed: " + problem.what());
  } catch (...) {
    throw PluginFailure("plugin '" + plugin + "' threw something that is not a std::exception");
  }
}

/// The same for calls that make an object; a null pointer is a broken promise too.
template <class Call>
std::invoke_result_t<Call> guarded_object(const std::string& plugin, Call&& call) {
  auto object = guarded(plugin, std::forward<Call>(call));
  if (!object) throw PluginFailure("plugin '" + plugin + "' made no object: its factory returned a null pointer");
  return object;
}

inline std::unique_ptr<Model> create(const Catalogue::Entry<ModelFactory>& entry, const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(options); });
}

inline std::unique_ptr<Test> create(const Catalogue::Entry<TestFactory>& entry, const TestSetup& setup) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(setup); });
}

inline std::unique_ptr<Optimizer> create(const Catalogue::Entry<OptimizerFactory>& entry, const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(options); });
}

/// The mechanism around a model; the mechanism must act on models (Stage::invariants … Stage::history).
inline std::unique_ptr<Model> wrap(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Model> base,
                                   const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.wrap_model(std::move(base), options); });
}

/// The mechanism around a test; the mechanism must act on tests (Stage::test, Stage::data).
inline std::unique_ptr<Test> wrap(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Test> base,
                                  const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.wrap_test(std::move(base), options); });
}

}  // namespace tunica::plugins
