// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/detail/abi_macros.hpp>

#include "tunica/mechanism.hpp"
#include "tunica/model.hpp"
#include "tunica/optimizer.hpp"
#include "tunica/options.hpp"
#include "tunica/test.hpp"

/// \file
/// What a plugin registers, and the one symbol by which the host finds and checks it.

/// Raised with every change of an interface or of a struct that crosses the boundary.
#define TUNICA_PLUGIN_API 4

#define TUNICA_TEXT_(x) #x
/// The value of a macro as text, for TUNICA_ABI_FINGERPRINT.
#define TUNICA_TEXT(x) TUNICA_TEXT_(x)
#ifdef _GLIBCXX_DEBUG
#define TUNICA_LIBRARY_DEBUG_ "debug"
#else
#define TUNICA_LIBRARY_DEBUG_ "release"
#endif
/// What must be equal on both sides for C++ objects to cross: compiler, standard library and its modes, language,
/// Eigen and its alignment, JSON. Fields are separated by "; " so that a refusal can show the ones that differ.
#define TUNICA_ABI_FINGERPRINT \
  "compiler " TUNICA_TEXT(__GNUC__) "; libstdc++ cxx11-abi " TUNICA_TEXT(_GLIBCXX_USE_CXX11_ABI) " "    \
  TUNICA_LIBRARY_DEBUG_ "; c++ " TUNICA_TEXT(__cplusplus) "; eigen " TUNICA_TEXT(EIGEN_WORLD_VERSION) "." \
  TUNICA_TEXT(EIGEN_MAJOR_VERSION) "." TUNICA_TEXT(EIGEN_MINOR_VERSION) "; alignment "                  \
  TUNICA_TEXT(EIGEN_MAX_ALIGN_BYTES) "; json " TUNICA_TEXT(NLOHMANN_JSON_VERSION_MAJOR) "."             \
  TUNICA_TEXT(NLOHMANN_JSON_VERSION_MINOR) "." TUNICA_TEXT(NLOHMANN_JSON_VERSION_PATCH)

namespace tunica {

/// How the host makes a model, and what it prints of it before there is one.
struct ModelFactory {
  std::string type,             ///< its name in files: lower case, with underscores
      doc,                      ///< one sentence for `list` and the schema
      reference;                ///< source; may be empty
  std::vector<Option> options;  ///< of its object in the experiment file
  /// Called with checked options; throws InputError for combinations that make no sense.
  std::function<std::unique_ptr<Model>(const Options&)> create;
};

/// How the host makes a test, and what it prints of it before there is one.
struct TestFactory {
  std::string type,                     ///< its name in files: lower case, with underscores
      doc,                              ///< one sentence for `list` and the schema
      reference;                        ///< source; may be empty
  std::vector<Option> options;          ///< of its object in the experiment file
  std::vector<Observable> observables;  ///< columns its data can have
  /// Called once a data file and again for simulations; throws InputError for rows it cannot simulate.
  std::function<std::unique_ptr<Test>(const TestSetup&)> create;
  /// Every parameter a test of this type can have, as TestDescription declares it: files are checked against it
  /// before there are data to make a test from.
  std::vector<Parameter> parameters = {};
  bool layered = false;  ///< takes a wall of layers with models of their own, see TestSetup::layers
};

/// How the host makes an optimiser, and what it prints of it before there is one.
struct OptimizerFactory {
  std::string type,             ///< its name in files: lower case, with underscores
      doc,                      ///< one sentence for `list` and the schema
      reference;                ///< source; may be empty
  std::vector<Option> options;  ///< of its object in the experiment file
  /// Called anew for every search, so that an optimiser may keep scratch in members.
  std::function<std::unique_ptr<Optimizer>(const Options&)> create;
};

/// Receives what a plugin provides. Registration is staged: it counts only if `register_into` returns normally.
class Registry {
 public:
  virtual ~Registry() = default;
  virtual void add(ModelFactory factory) = 0;  ///< checked after register_into has returned: a name can be taken once
  virtual void add(TestFactory factory) = 0;   ///< as for models
  virtual void add(OptimizerFactory factory) = 0;  ///< as for models
  virtual void add(MechanismFactory factory) = 0;  ///< as for models; its id is the name
};

/// What the one exported symbol, `tunica_plugin`, returns: plain data, compared before any C++ object is touched.
struct PluginHeader {
  std::uint32_t struct_size;         ///< sizeof(PluginHeader) of the plugin's build
  std::uint32_t api;                 ///< TUNICA_PLUGIN_API of the headers it was built with
  const char* fingerprint;           ///< TUNICA_ABI_FINGERPRINT there
  const char* name;                  ///< of the plugin, for messages and results
  const char* version;               ///< of the plugin itself, its author's own count
  void (*register_into)(Registry&);  ///< the body that follows TUNICA_PLUGIN; not called before all above is right
};

}  // namespace tunica

/// Defines the exported symbol of a plugin; the body that follows registers what it provides, once, at loading:
///
///     TUNICA_PLUGIN("gho", "0.1.0") { registry.add(tunica::ModelFactory{…}); }
#define TUNICA_PLUGIN(plugin_name, plugin_version)                                                \
  static void tunica_register_(tunica::Registry& registry);                                       \
  extern "C" __attribute__((visibility("default"))) const tunica::PluginHeader* tunica_plugin() { \
    static constexpr tunica::PluginHeader header{sizeof(tunica::PluginHeader),                    \
                                                 TUNICA_PLUGIN_API,                               \
                                                 TUNICA_ABI_FINGERPRINT,                          \
                                                 plugin_name,                                     \
                                                 plugin_version,                                  \
                                                 &tunica_register_};                              \
    return &header;                                                                               \
  }                                                                                               \
  static void tunica_register_([[maybe_unused]] tunica::Registry& registry)
