// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "execution/plan.hpp"
#include "execution/results.hpp"

namespace tunica::execution {

/// The facts that must be unchanged when a run is resumed.
struct Facts {
  std::string experiment = {};                   ///< hash of the file without its analysis
  std::string seed = {};                         ///< "7"
  std::map<std::string, std::string> data = {};  ///< hashes by the name of the file
  std::string plugins = {};                      ///< "es 0.1.0, gho 0.1.0"
  std::string plugin_interface = {};             ///< TUNICA_PLUGIN_API
  bool thinned = false;                          ///< evaluations.csv holds improvements only, see thinning.hpp
  std::string vector_level = {};                 ///< "avx2": the last digits of every evaluation depend on it

  bool operator==(const Facts&) const = default;
};

/// checkpoint.json: the facts and the finished realisations. Finished realisations are not run again. The others are
/// replayed from the journal (journal.hpp); this needs only the evaluations themselves.
struct Checkpoint {
  Facts facts;
  std::vector<std::pair<std::size_t, RealisationResult>> finished;  ///< task, result
  std::vector<std::string> damages = {};  ///< of reading: entries that are left out, a sentence for each
};

Facts facts_of(const Plan& plan);

void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint);

/// The same in two steps, for repeated writing. An entry with its trace is long, so it is converted to text only once.
/// `entries` is by task.
std::string checkpoint_entry(std::size_t task, const RealisationResult& result);
void write_checkpoint(const std::filesystem::path& directory, const Facts& facts,
                      const std::map<std::size_t, std::string>& entries);

/// Throws InputError if the file is missing or unreadable, or if its facts were altered. A realisation whose entry has
/// a wrong checksum counts as unfinished.
Checkpoint read_checkpoint(const std::filesystem::path& directory);

/// Throws InputError if a fact has changed since the run began. The message says which one and what to do. `input_json`
/// is the experiment as it is now; changed keys are named by comparing it with input.json.
void refuse_changes(const std::filesystem::path& directory, const Facts& then, const Facts& now,
                    const std::string& input_json);

/// The vector level of the run in `directory`; empty if none is readable.
std::string vector_level_of(const std::filesystem::path& directory);
/// Throws InputError if searches that began at one vector level would continue at another.
void refuse_other_level(const std::filesystem::path& directory, const std::string& then, const std::string& now);

}  // namespace tunica::execution
