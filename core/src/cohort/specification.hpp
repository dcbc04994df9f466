// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "text/codes.hpp"

/// Many specimens of one tissue: each a run of the same experiment, then all of them together. docs/cohort.md.
namespace tunica::cohort {

/// A value of the experiment that differs between specimens: "/tests/strip/data/file" ← "{Specimen}.csv".
struct Binding {
  std::string pointer;  ///< into the experiment
  std::string pattern;  ///< text in which {column} stands for the specimen's cell
  std::string place;    ///< in the cohort file, for messages
};

/// A column that sorts the specimens into groups.
struct FactorEntry {
  std::string column;
  std::optional<std::string> reference;  ///< the level that the others are compared with; absent = the first
  std::string place;
};

enum class ReadingKind { value, slope, integral };
inline constexpr text::Codes<ReadingKind, 3> reading_codes{
    {{ReadingKind::value, "at"}, {ReadingKind::slope, "slope"}, {ReadingKind::integral, "integral"}}};

/// A number that people read off a fitted curve: a stress at a stretch, a slope, an energy.
struct ReadingEntry {
  std::string name, test, channel;
  ReadingKind kind = ReadingKind::value;
  std::vector<std::string> at;  ///< one abscissa, or two; a number in the base unit or text with a unit
  std::string place;
};

/// How spreads of parameters between specimens may go together.
enum class SpreadStructure { automatic, diagonal, full };
inline constexpr text::Codes<SpreadStructure, 3> spread_codes{{{SpreadStructure::automatic, "automatic"},
                                                               {SpreadStructure::diagonal, "diagonal"},
                                                               {SpreadStructure::full, "full"}}};

/// Whose residuals the noise of a channel comes from.
enum class NoisePool { specimen, cohort };
inline constexpr text::Codes<NoisePool, 2> noise_pool_codes{
    {{NoisePool::specimen, "specimen"}, {NoisePool::cohort, "cohort"}}};

/// What is asked of the diagnosis of a cohort. What is looked for in a specimen stands in "diagnosis" of the
/// experiment.
struct DiagnosisEntry {
  bool quick = true;    ///< of each specimen; the others make up for what a quick one does not see
  double alpha = 0.05;  ///< false alarms that are accepted, of the cohort as a whole
};

/// The cohort file as typed values.
struct Specification {
  std::string name;
  std::filesystem::path file;
  std::uint64_t seed = 1;
  std::filesystem::path experiment;
  std::filesystem::path table;
  std::string table_place;
  std::string id_column;                                   ///< empty = the first
  std::vector<std::pair<std::string, std::string>> where;  ///< column → value; one of the values given for a column
  std::vector<Binding> bindings;
  std::vector<FactorEntry> factors;
  std::string nested_in, nested_place;  ///< column of the animal; empty = each specimen is one
  std::vector<ReadingEntry> readings;
  SpreadStructure spread = SpreadStructure::automatic;
  NoisePool noise = NoisePool::specimen;
  std::size_t permutations = 9999;
  std::optional<DiagnosisEntry> diagnosis;  ///< none: the cohort is not diagnosed
  std::string text;                         ///< the file as it stands, for the results folder
};

/// Throws InputError with the found text, its place and the expected form.
Specification read_specification(const std::filesystem::path& file);

}  // namespace tunica::cohort
