// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

#include "plugins/calls.hpp"
#include "plugins/casualties.hpp"
#include "plugins/catalogue.hpp"
#include "plugins/declared_bounds.hpp"
#include "plugins/destroyed.hpp"
#include "plugins/guarded_model.hpp"
#include "plugins/guarded_test.hpp"
#include "plugins/usual_arithmetic.hpp"
#include "tunica/error.hpp"

/// The boundary for calls into plugins: it converts every exception of a plugin. Wrong input stays an InputError,
/// anything else becomes a PluginFailure; both carry the plugin's name.
namespace tunica::plugins {

/// A plugin broke its promise: a bug to report to its author, not wrong input. Exit code 4.
class PluginFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Memory was denied while a plugin had the word. Asked again, it may have enough: no bug of the plugin, and nothing
/// that its object was asked about.
class MemoryLack : public std::bad_alloc {
 public:
  explicit MemoryLack(const std::string& words) : words_(words) {}  // NOLINT(bugprone-throw-keyword-missing): a member
  [[nodiscard]] const char* what() const noexcept override { return words_.what(); }

 private:
  std::runtime_error words_;  ///< copied without asking for memory
};

/// An exception of the host, thrown through a plugin that called back into it: passed on unchanged. Exit code 2.
class __attribute__((visibility("default"))) HostFault : public InputError {
 public:
  using InputError::InputError;
};

/// The key of a call; `input` distinguishes it from others of the same name.
inline std::uint64_t plain_key(const Call& call) {
  CallKey key(call.plugin, call.what);
  key.add(*static_cast<const std::uint64_t*>(call.input));
  return key.value();
}

/// Runs `body` on behalf of the plugin (as an Entry names it: "gho 0.1.0"). `what` names the call; `input` tells it
/// from others of the same name, where one that ended a process must not be made again.
template <class Body>
std::invoke_result_t<Body> guarded(const std::string& plugin, const char* what, Body&& body, std::uint64_t input = 0) {
  const Call call{plugin.c_str(), what, plain_key, &input};
  if (is_stricken(plugin))
    if (const std::string reason = refusal(plugin, plain_key(call)); !reason.empty()) throw PluginFailure(reason);
  const CallScope scope(call);
  UsualArithmetic arithmetic;
  const auto blame = [&] {
    if (arithmetic.take_change()) throw PluginFailure("plugin '" + plugin + "' " + changed_arithmetic);
  };
  try {
    if constexpr (std::is_void_v<std::invoke_result_t<Body>>) {
      std::forward<Body>(body)();
      blame();
    } else {
      std::invoke_result_t<Body> result = std::forward<Body>(body)();
      blame();
      return result;
    }
  } catch (const PluginFailure&) {
    throw;
  } catch (const HostFault&) {
    throw;
  } catch (const InputError& problem) {
    throw InputError("plugin '" + plugin + "': " + problem.what());
  } catch (const std::bad_array_new_length& problem) {  // a size that cannot be: this is a bug
    throw PluginFailure("plugin '" + plugin + "' failed: " + problem.what());
  } catch (const std::bad_alloc& problem) {
    throw MemoryLack("plugin '" + plugin + "' failed: " + problem.what());
  } catch (const std::exception& problem) {
    throw PluginFailure("plugin '" + plugin + "' failed: " + problem.what());
  } catch (...) {
    throw PluginFailure("plugin '" + plugin + "' threw something that is not a std::exception");
  }
}

/// The same for calls that make an object; a null pointer is a broken promise too.
template <class Body>
std::invoke_result_t<Body> guarded_object(const std::string& plugin, Body&& body) {
  auto object = guarded(plugin, "create", std::forward<Body>(body));
  if (!object) throw PluginFailure("plugin '" + plugin + "' made no object: its factory returned a null pointer");
  return object;
}

/// The object as the plugin made it, for `tunica plugin check`, which tests its faults directly.
inline std::unique_ptr<Model> create_bare(const Catalogue::Entry<ModelFactory>& entry, const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(options); });
}
inline std::unique_ptr<Test> create_bare(const Catalogue::Entry<TestFactory>& entry, const TestSetup& setup) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(setup); });
}

inline std::unique_ptr<Optimizer> create_bare(const Catalogue::Entry<OptimizerFactory>& entry, const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.create(options); });
}

/// Names must differ here; those of a mechanism around a model have its own name before them.
inline std::unique_ptr<Model> create(const Catalogue::Entry<ModelFactory>& entry, const Options& options) {
  auto model = std::make_unique<GuardedModel>(create_bare(entry, options), entry.plugin);
  refuse_equal_names(model->describe().parameters, entry.plugin, "model");
  return model;
}
inline std::unique_ptr<Test> create(const Catalogue::Entry<TestFactory>& entry, const TestSetup& setup) {
  auto test = std::make_unique<GuardedTest>(create_bare(entry, setup), entry.plugin);
  refuse_equal_names(test->describe().parameters, entry.plugin, "test");
  return test;
}

/// Destroys a search in a watched call.
struct WatchedEnd {
  std::string plugin;
  void operator()(Optimizer* search) const {
    std::unique_ptr<Optimizer> owned(search);
    destroy(plugin, owned);
  }
};

inline std::unique_ptr<Optimizer, WatchedEnd> create(const Catalogue::Entry<OptimizerFactory>& entry,
                                                     const Options& options) {
  return {create_bare(entry, options).release(), WatchedEnd{entry.plugin}};
}

/// The optimizer's requirements on its problems.
inline Optimizer::Needs needs(const std::string& plugin, const Optimizer& optimizer) {
  return guarded(plugin, "needs", [&] { return optimizer.needs(); });
}

/// Takes the guard off `base`: one goes around both. Names the two plugins.
template <class Guard, class Guarded>
std::string opened(const std::string& plugin, std::unique_ptr<Guarded>& base) {
  auto* guard = dynamic_cast<Guard*>(base.get());
  if (guard == nullptr) return plugin;
  std::string both = guard->plugin() + "' with '" + plugin;
  base = guard->release();
  return both;
}

/// The mechanism around a model; the mechanism must act on models (Stage::invariants … Stage::history).
inline std::unique_ptr<Model> wrap_bare(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Model> base,
                                        const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.wrap_model(std::move(base), options); });
}
inline std::unique_ptr<Model> wrap(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Model> base,
                                   const Options& options) {
  const std::string both = opened<GuardedModel>(entry.plugin, base);
  return std::make_unique<GuardedModel>(wrap_bare(entry, std::move(base), options), both);
}

/// The mechanism around a test; the mechanism must act on tests (Stage::test, Stage::data).
inline std::unique_ptr<Test> wrap_bare(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Test> base,
                                       const Options& options) {
  return guarded_object(entry.plugin, [&] { return entry.factory.wrap_test(std::move(base), options); });
}
inline std::unique_ptr<Test> wrap(const Catalogue::Entry<MechanismFactory>& entry, std::unique_ptr<Test> base,
                                  const Options& options) {
  const std::string both = opened<GuardedTest>(entry.plugin, base);
  return std::make_unique<GuardedTest>(wrap_bare(entry, std::move(base), options), both);
}

}  // namespace tunica::plugins
