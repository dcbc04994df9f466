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

/// What must be the same for a run to be resumed.
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

/// checkpoint.json: the facts, and the realisations that are finished. Those are not run again; the others are
/// replayed from the journal (journal.hpp), which needs nothing but the evaluations themselves.
struct Checkpoint {
  Facts facts;
  std::vector<std::pair<std::size_t, RealisationResult>> finished;  ///< task, result
  std::vector<std::string> damages = {};  ///< of reading: entries that are left out, a sentence for each
};

Facts facts_of(const Plan& plan);

void write_checkpoint(const std::filesystem::path& directory, const Checkpoint& checkpoint);

/// The same in two steps, for whoever writes again and again: with its trace an entry is long, and is put into text
/// once. `entries` by task.
std::string checkpoint_entry(std::size_t task, const RealisationResult& result);
void write_checkpoint(const std::filesystem::path& directory, const Facts& facts,
                      const std::map<std::size_t, std::string>& entries);

/// Throws InputError when there is none, or it cannot be understood, or its facts are not those that were written. An
/// entry whose checksum does not fit counts as not finished.
Checkpoint read_checkpoint(const std::filesystem::path& directory);

/// Throws InputError when something changed since the run began: what, and what to do. `input_json` is the
/// experiment as it is now; changed keys are named by comparing it with input.json.
void refuse_changes(const std::filesystem::path& directory, const Facts& then, const Facts& now,
                    const std::string& input_json);

/// The vector level of the run in `directory`; empty where there is none that can be understood.
std::string vector_level_of(const std::filesystem::path& directory);
/// Throws InputError where searches that were begun on one vector level would go on with another one.
void refuse_other_level(const std::filesystem::path& directory, const std::string& then, const std::string& now);

}  // namespace tunica::execution
