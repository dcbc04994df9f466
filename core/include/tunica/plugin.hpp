// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/detail/abi_macros.hpp>

#include "tunica/card_energy.hpp"
#include "tunica/mechanism.hpp"
#include "tunica/model.hpp"
#include "tunica/optimizer.hpp"
#include "tunica/options.hpp"
#include "tunica/planned_test.hpp"
#include "tunica/test.hpp"

/// \file
/// The factories that a plugin registers, and the one symbol by which the host finds and checks a plugin.

/// Version of the interface. It rises with every change of an interface or of a struct that crosses the boundary. The
/// host refuses plugins that were built for another number. docs/migration.md says what to change.
#define TUNICA_PLUGIN_API 9

#define TUNICA_TEXT_(x) #x
/// The value of a macro as text, for TUNICA_ABI_FINGERPRINT.
#define TUNICA_TEXT(x) TUNICA_TEXT_(x)
#ifdef _GLIBCXX_DEBUG
#define TUNICA_LIBRARY_DEBUG_ "debug"
#else
#define TUNICA_LIBRARY_DEBUG_ "release"
#endif
/// The properties that both sides must share before C++ objects can cross: compiler, standard library and its modes,
/// language, Eigen and its alignment, JSON. "; " separates the fields, so a refusal can show those that differ.
#define TUNICA_ABI_FINGERPRINT \
  "compiler " TUNICA_TEXT(__GNUC__) "; libstdc++ cxx11-abi " TUNICA_TEXT(_GLIBCXX_USE_CXX11_ABI) " "    \
  TUNICA_LIBRARY_DEBUG_ "; c++ " TUNICA_TEXT(__cplusplus) "; eigen " TUNICA_TEXT(EIGEN_WORLD_VERSION) "." \
  TUNICA_TEXT(EIGEN_MAJOR_VERSION) "." TUNICA_TEXT(EIGEN_MINOR_VERSION) "; alignment "                  \
  TUNICA_TEXT(EIGEN_MAX_ALIGN_BYTES) "; json " TUNICA_TEXT(NLOHMANN_JSON_VERSION_MAJOR) "."             \
  TUNICA_TEXT(NLOHMANN_JSON_VERSION_MINOR) "." TUNICA_TEXT(NLOHMANN_JSON_VERSION_PATCH)

namespace tunica {

/// What a file of measurements was made of. `tunica import` chooses its first test and model by it.
enum class Specimen {
  other,  ///< none of these
  strip,  ///< pulled or pressed along one direction
  sheet,  ///< pulled along two directions
  tube,   ///< under inner pressure
  block   ///< sheared between two plates
};

/// Where the user names no model, `tunica import` proposes this one.
struct FirstChoice {
  /// For files of these specimens; of two models for one specimen the first by name is proposed.
  std::vector<Specimen> specimens;
  /// Options that the proposal states, as ModelFactory::options declares them.
  std::vector<std::pair<std::string, Option::Value>> options = {};
};

/// How the host makes a model, and what it prints about the type before it makes one.
struct ModelFactory {
  /// Name in experiment files: lower case, with underscores. It must be unique among all models.
  std::string type;
  /// One sentence for `tunica list` and the schema.
  std::string doc;
  /// Source in the literature; may be empty.
  std::string reference;
  /// The options of its object in the experiment file.
  std::vector<Option> options;
  /// Makes a model from checked options. Throws InputError for combinations that make no sense.
  std::function<std::unique_ptr<Model>(const Options&)> create;
  /// Optional, for a model whose energy finite-element programs have: that energy. `tunica export` writes its cards.
  CardFormula card = {};
  /// Whether its option "terms" takes any term of the energy, as `composed` documents them. Discovery writes its
  /// results with the model that has this role.
  bool writes_terms = false;
  /// Optional: the files that `tunica import` fits with this type.
  FirstChoice first_choice = {};
};

/// The same factory with the energy of its cards.
inline ModelFactory with_card(ModelFactory factory, CardFormula card) {
  factory.card = std::move(card);
  return factory;
}

/// The same factory as the first choice for these specimens.
///
/// Options of the choice are not checked here. The host reads them as it reads an experiment file, and refuses one that
/// the factory does not declare.
inline ModelFactory with_first_choice(ModelFactory factory, FirstChoice choice) {
  factory.first_choice = std::move(choice);
  return factory;
}

/// A cheaper test that predicts nearly the same rows, for TestFactory::stand_in. Its observables and the parameters
/// that an experiment may free have the same names.
struct StandIn {
  std::string type;  ///< TestFactory::type of the other test
  Options options;   ///< of the other test; missing options take their default there
};

/// How the host makes a test, and what it prints about the type before it makes one.
struct TestFactory {
  /// Name in experiment files: lower case, with underscores. It must be unique among all tests.
  std::string type;
  /// One sentence for `tunica list` and the schema.
  std::string doc;
  /// Source in the literature; may be empty.
  std::string reference;
  /// The options of its object in the experiment file.
  std::vector<Option> options;
  /// The columns that its data can have.
  std::vector<Observable> observables;
  /// Makes a test: once for each data file, and again for simulations. Throws InputError for rows that it cannot
  /// simulate.
  std::function<std::unique_ptr<Test>(const TestSetup&)> create;
  /// Every parameter that a test of this type can have, as TestDescription declares it. The host checks experiment
  /// files against it before there are data to make a test from.
  std::vector<Parameter> parameters = {};
  /// Whether it takes a wall of layers with a model each, see TestSetup::layers.
  bool layered = false;
  /// Optional, for a costly test: the cheaper test that guides a search if an experiment requests a guide. The result
  /// is still that of this test. Empty, or none for these options: there is no guide.
  std::function<std::optional<StandIn>(const Options&)> stand_in = {};
  /// Optional: experiments of this type that a lab could make next. A diagnosis suggests the one that tells its rivals
  /// apart best. It does not suggest types without this function.
  std::function<std::vector<PlannedTest>(const PlanningScope&)> plan = {};
  /// What it tests: `tunica import` asks for the sizes of such a specimen.
  Specimen specimen = Specimen::other;
  /// Whether `tunica import` proposes this type for files of its specimen where the user names no test.
  bool first_choice = false;
};

/// How the host makes an optimizer, and what it prints about the type before it makes one.
struct OptimizerFactory {
  /// Name in experiment files: lower case, with underscores. It must be unique among all optimizers.
  std::string type;
  /// One sentence for `tunica list` and the schema.
  std::string doc;
  /// Source in the literature; may be empty.
  std::string reference;
  /// The options of its object in the experiment file.
  std::vector<Option> options;
  /// Makes an optimizer, a new one for every search. Throws InputError for combinations that make no sense.
  std::function<std::unique_ptr<Optimizer>(const Options&)> create;
  /// Whether it descends from its start by the Jacobian of the residuals, and its option "starts" is the number of
  /// starts. Refits use the optimizer with this role: intervals, certificates, the extended experiment of a diagnosis.
  bool refines = false;
};

/// Receives the factories of a plugin, any number of each kind. They count only if the registration returns normally.
///
/// Names are lower case, with digits and underscores, for example "fibre_damage".
/// The host checks names afterwards. It refuses the whole plugin if a name is already taken or breaks the rules.
class Registry {
 public:
  virtual ~Registry() = default;
  /// Adds a type of models.
  virtual void add(ModelFactory factory) = 0;
  /// Adds a type of tests.
  virtual void add(TestFactory factory) = 0;
  /// Adds a type of optimizers.
  virtual void add(OptimizerFactory factory) = 0;
  /// Adds a mechanism; its id is the name.
  virtual void add(MechanismFactory factory) = 0;
};

/// The result of the one exported symbol, `tunica_plugin`: plain data that the host compares before it touches any C++
/// object of the plugin. TUNICA_PLUGIN fills it in.
struct PluginHeader {
  /// Sizeof(PluginHeader) in the plugin's build.
  std::uint32_t struct_size;
  /// TUNICA_PLUGIN_API of the headers it was built with.
  std::uint32_t api;
  /// TUNICA_ABI_FINGERPRINT in the plugin's build.
  const char* fingerprint;
  /// Name of the plugin in messages and results.
  const char* name;
  /// Version of the plugin, chosen by its author.
  const char* version;
  /// The body that follows TUNICA_PLUGIN; called only if all of the above is right.
  void (*register_into)(Registry&);
};

}  // namespace tunica

/// Defines the exported symbol of a plugin.
///
/// Use it once in a plugin, at global scope, in one of its source files. cmake/tunica_plugin.map hides every other
/// symbol.
///
/// The first argument is the name of the plugin in messages and results, the second its version. The body that follows
/// registers what the plugin provides; the host runs it once, when it loads the plugin.
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
