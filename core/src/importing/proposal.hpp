// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "experiment/json_document.hpp"
#include "plugins/catalogue.hpp"

/// A first experiment from files as a testing machine wrote them.
namespace tunica::importing {

using experiment::Json;
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The user's answers; empty = to be found or asked.
struct Answers {
  std::vector<std::filesystem::path> files;
  std::filesystem::path table;         ///< of specimens
  std::string test, model;             ///< types
  std::string direction;               ///< of every strip
  Pairs directions;                    ///< test → direction
  Pairs options;                       ///< of the test, "outer_radius" → "2.3 mm"
  Pairs columns, units, where;         ///< as in "data"
  std::string each;                    ///< a column: one test for each of its values
  std::string cycle, branch, preload;  ///< as in "data"; "none" = leave out
  std::string width, thickness, height, gauge_length, area, diameter, stress_measure;
  std::string strain_measure;                        ///< "engineering", "true" or "green"
  std::string compression;                           ///< "positive" or "negative", of all columns
  Pairs compressions;                                ///< column → "positive" or "negative"
  std::string delimiter, decimal, skip_lines, rows;  ///< as in "data"
  bool together = false;                             ///< the files are tests of one specimen
};

/// Something that no file says. `option` is what gives it on the command line.
struct Question {
  std::string text;     ///< "Width of the specimen across the force, with its unit"
  std::string option;   ///< "--width"
  std::string example;  ///< "10 mm"
  bool length = false;  ///< the answer is a length
  bool likely = false;  ///< the example is the likely answer, which no answer at all takes
};

/// Answers a question.
using Ask = std::function<std::string(const Question&)>;

struct Proposal {
  Json experiment;
  std::vector<std::string> notes;  ///< what was understood, in sentences
};

/// Reads the files, and proposes a test (with its data block) for each, a model and a run for each. Relative names in
/// it begin at `folder`. Throws InputError on a file that is no table, and on columns that make no test.
Proposal propose(const Answers& answers, const std::filesystem::path& folder, const plugins::Catalogue& catalogue,
                 const Ask& ask);

}  // namespace tunica::importing
