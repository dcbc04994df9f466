// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "plugins/loader.hpp"

namespace tunica::python {

/// An experiment with the catalogue at the time of reading, which later definitions do not change.
struct Loaded {
  std::shared_ptr<const plugins::Catalogue> catalogue;
  experiment::Experiment experiment;
  std::vector<std::string> refusals;  ///< of plugins, for the warnings of a run
  std::string given_json = {};        ///< the experiment as it was given, without comments
};

/// The plugins of this process, and what Python code has defined beside them. Files are loaded once; a definition
/// replaces an earlier one of the same name, as a notebook does whose cell runs twice.
class Library {
 public:
  /// Loads the files and folders that are named, TUNICA_PLUGIN_PATH, and the folder that the package came with. Throws
  /// InputError where a file that was named is refused.
  Library(const std::vector<std::string>& paths, const std::string& installed, bool allow_world_writable);

  [[nodiscard]] const std::vector<std::string>& refusals() const { return refusals_; }
  /// Plugins and definitions together. Throws InputError where a definition has the name of something in a plugin.
  [[nodiscard]] std::shared_ptr<const plugins::Catalogue> catalogue() const;
  /// Reads a file, or a text that messages call `file`.
  [[nodiscard]] std::shared_ptr<Loaded> read(const std::string& file) const;
  [[nodiscard]] std::shared_ptr<Loaded> parse(std::string text, const std::string& file) const;

  void define(ModelFactory factory) { models_.insert_or_assign(factory.type, factory); }
  void define(TestFactory factory) { tests_.insert_or_assign(factory.type, factory); }
  void define(OptimizerFactory factory) { optimizers_.insert_or_assign(factory.type, factory); }
  void define(MechanismFactory factory) { mechanisms_.insert_or_assign(factory.id, factory); }
  /// Removes the definition of this name.
  void forget(const std::string& name) {
    models_.erase(name);
    tests_.erase(name);
    optimizers_.erase(name);
    mechanisms_.erase(name);
  }

 private:
  plugins::Catalogue plugins_;
  std::vector<std::string> refusals_;
  std::map<std::string, ModelFactory> models_;
  std::map<std::string, TestFactory> tests_;
  std::map<std::string, OptimizerFactory> optimizers_;
  std::map<std::string, MechanismFactory> mechanisms_;
};

}  // namespace tunica::python
