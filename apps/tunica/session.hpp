// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "plugins/last_words.hpp"
#include "plugins/loader.hpp"

namespace tunica::app {

/// The options that every verb shares.
struct GlobalOptions {
  std::vector<std::string> plugin_paths;
  bool allow_world_writable_plugins = false;
  double call_limit = 60;   ///< s, for one call of a model
  double memory_limit = 0;  ///< GiB, for the program; 0: nine tenths of what the machine has
  bool quiet = false;       ///< nothing on stderr but errors
};

/// The options by which another process, or a command that is printed, finds the same plugins under the same limits.
std::vector<std::string> plugin_words(const GlobalOptions& global);

/// Something the user named needs a plugin that was refused. Exit code 3.
class PluginRefused : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The plugins of this process. Lives as long as anything that was made with them.
class Session {
 public:
  /// Loads. A file that was named and is refused is an error (PluginRefused); in a folder it is a warning on stderr.
  explicit Session(const GlobalOptions& options);

  [[nodiscard]] const plugins::Catalogue& catalogue() const { return catalogue_; }
  [[nodiscard]] const std::vector<plugins::LoadedPlugin>& loaded() const { return loaded_; }
  /// "plugin X was refused: …", for reports.
  [[nodiscard]] std::vector<std::string> refusals() const;

  /// Reads the experiment. Where it asks for a type that a refused plugin would probably have brought, the refusal is
  /// the error.
  [[nodiscard]] experiment::Experiment read(const std::filesystem::path& file,
                                            experiment::Purpose purpose = experiment::Purpose::search) const;

 private:
  plugins::Catalogue catalogue_;
  std::vector<plugins::LoadedPlugin> loaded_;
  std::vector<plugins::RefusedPlugin> refused_;
  plugins::CallWatch watch_;
};

}  // namespace tunica::app
