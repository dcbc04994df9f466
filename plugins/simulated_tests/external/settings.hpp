// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "results.hpp"
#include "text_template.hpp"
#include "tunica/test.hpp"

namespace tunica::external {

/// The file of the scratch folder that takes what the program prints; "-" in "results".
inline constexpr const char* printed = "output.txt";

enum class Keep { never, on_failure, always };

/// The checked settings of the solver in the experiment file.
struct Settings {
  std::filesystem::path program;                                     ///< the file that is run
  std::vector<TextTemplate> arguments;                               ///< behind it
  std::vector<std::pair<std::string, TextTemplate>> templates;       ///< name in the scratch folder, text
  std::vector<std::pair<std::string, std::filesystem::path>> files;  ///< name there, file that it links to
  std::vector<ResultPlace> results;  ///< abscissae first, channels in the order of the rows
  bool curve = false;                ///< results.front() is an abscissa: read between points
  std::vector<std::string> reads;    ///< parameters by name, each once
  bool card = false;                 ///< some template has the material card
  CardRequest card_request;
  double time_limit = 0;
  std::size_t memory_limit = 0, output_limit = 0, threads = 1;  ///< MiB, MiB
  Keep keep = Keep::on_failure;
  std::filesystem::path scratch, cache;
  std::function<bool()> interrupted;  ///< TestSetup::interrupted
  std::string content;                ///< what does not depend on the parameters, for the key of the cache
};

/// A name that stays below the scratch folder; throws InputError, which names `option`, where it does not.
const std::string& checked_name(const std::string& name, const char* option);
/// Reads "results" into `settings`. Throws InputError.
void read_results(const TestSetup& setup, const std::vector<Observable>& observables, Settings& settings);
/// The options of the test type; `channels` and `abscissae` of the setup say which results are needed.
std::vector<Option> options();
/// Throws InputError: what is missing, where it was looked for, what to write.
Settings read_settings(const TestSetup& setup, const std::vector<Observable>& observables);

}  // namespace tunica::external
