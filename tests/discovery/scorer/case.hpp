// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

/// The judge of the blind benchmark: verdicts beside the truths that were sealed when the data were written.
namespace blind::score {

/// Wrong input: what was found, where, what to do.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Where an effect sits; empty: the material, all tubes, every channel, all rows.
struct Target {
  std::string test, channel;
  std::optional<std::size_t> row = {};
  /// A verdict's target is this one: it may say a channel where the truth needs none.
  [[nodiscard]] bool met_by(const Target& found) const {
    return test == found.test && (channel.empty() || channel == found.channel) && row == found.row;
  }
};

struct TrueEffect {
  std::string id;
  Target target;
  double amplitude = 0, null = 0;
  bool even = false, reached = true;
  bool nuisance = false;  ///< another unknown comes with it, and trades with the amplitude
};

struct Truth {
  std::string set;  ///< nulls, singles, pairs, outside
  std::string noise;
  double asked = 0;           ///< Λ of each effect alone
  bool contaminated = false;  ///< there are gross errors in the data beside what is hidden
  std::vector<TrueEffect> effects;
  std::string look_alike, nearest;  ///< of effects outside the catalogue: declared, and by the data
  double remainder = 0;             ///< Λ that the catalogue's best leaves
  std::string base = "hgo", protocol = "artery";
  bool noise_stated = true, order_recorded = true;
  std::string twin = {};  ///< of a case whose noise is not stated: the same data with it stated
  /// Arteries of `hgo` whose noise and order of rows are known: what the main table counts.
  [[nodiscard]] bool plain() const { return base == "hgo" && protocol == "artery" && noise_stated && order_recorded; }
};

struct Cause {
  std::string id;
  Target target;
  std::optional<double> probability, amplitude, low, high;
  bool hedged = false;  ///< claimed as "consistent_with"
};

struct Verdict {
  std::string verdict;
  std::vector<Cause> causes;                                         ///< the best first
  std::vector<std::string> ambiguity_set;                            ///< ids
  std::vector<std::vector<std::string>> alternatives = {};           ///< pairs that are rivals of the best
  std::map<std::pair<std::string, std::string>, double> confusable;  ///< projected correlations, either order
  std::vector<double> held_out;                                      ///< predictive p-values of blocks
  /// How many causes make up the best explanation, the rest are its rivals; none = all.
  std::optional<std::size_t> together = {};
  [[nodiscard]] bool detected() const { return verdict != "nothing_detected"; }
};

/// Same data, true noise and true base parameters.
struct Oracle {
  bool detected = false;
  std::string first;
  std::map<std::string, double> likeness = {};  ///< of others to the first
  struct Member {
    std::string id;
    std::map<std::string, double> likeness = {};
  };
  std::vector<Member> pair = {};  ///< of cases with two effects: the likeliest two
};

struct Case {
  std::string name;
  Truth truth;
  Verdict verdict;
  std::optional<Oracle> oracle;
  std::optional<double> seconds = {};  ///< that the diagnosis took
};

/// `results`/<case>/result.json for every case of `cases`, and only then the truths of `cases`/sealed, each against
/// `cases`/<case>/truth.sha256. A case without a verdict is an error, or where `partial` it stays sealed and is
/// counted.
struct OpenedCases {
  std::vector<Case> cases;
  std::size_t sealed = 0;
};
OpenedCases open_cases(const std::filesystem::path& cases, const std::filesystem::path& results, bool partial);

/// Adds the seconds of {case: seconds} to the cases that have some.
void add_seconds(std::vector<Case>& cases, const std::filesystem::path& file);

/// Declared look-alikes: {id: [ids]}.
using LookAlikes = std::map<std::string, std::vector<std::string>>;
LookAlikes read_look_alikes(const std::filesystem::path& file);

}  // namespace blind::score
