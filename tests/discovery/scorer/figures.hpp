// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "case.hpp"

namespace blind::score {

/// hits of total, with Wilson's 95 % interval (Wilson, J. Am. Stat. Assoc. 22:209, 1927).
struct Share {
  std::size_t hits = 0, total = 0;
  void add(bool hit) {
    hits += hit;
    ++total;
  }
  [[nodiscard]] double value() const { return static_cast<double>(hits) / static_cast<double>(total); }
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;
};

/// What a figure has to be: within [low, high].
struct Bar {
  double low = 0, high = 1;
  [[nodiscard]] bool holds(double value) const { return value >= low - 1e-12 && value <= high + 1e-12; }
};

/// One figure of the table.
struct Figure {
  std::string name;
  std::size_t cases = 0;                ///< what it is made of; 0: not measured
  double value = 0, low = 0, high = 0;  ///< with its 95 % interval where there is one; else low = high = value
  std::optional<Bar> pass, stretch;     ///< none: told, not judged
  std::string remark = {};
  [[nodiscard]] bool missed() const { return pass && cases > 0 && !pass->holds(value); }
  /// Missed by more than chance: the whole interval is outside.
  [[nodiscard]] bool surely_missed() const { return pass && cases > 0 && (high < pass->low || low > pass->high); }
};

/// What became of one effect of the catalogue.
struct EffectRow {
  std::string id;
  double lambda = 0;
  std::size_t unreached = 0;  ///< cases in which no plausible amplitude shows that much: in no other column
  Share detected, named, named_or_look_alike;
  double mean_set = 0;  ///< of detected ones
  std::vector<std::pair<std::string, std::size_t>> confused_with;
};

/// What became of the cases of one class that hide one effect at one Λ: every case is in one column.
struct MistakeRow {
  std::string name;  ///< of the class
  double lambda = 0;
  std::size_t cases = 0;
  std::size_t right = 0;       ///< named, or a look-alike that counts for it, and nothing else
  std::size_t wrong = 0;       ///< something else is named
  std::size_t over_named = 0;  ///< among several that are said to act together
  std::size_t unknown = 0;     ///< detected, not named
  std::size_t missed = 0;      ///< not detected
  std::size_t oracle_cases = 0, oracle_right = 0, oracle_wrong = 0, oracle_missed = 0;
};

/// Base × protocol, and what the files leave out.
std::string class_of(const Truth& truth);
/// Rows of every class but the plain one; of its twins where the noise is not stated; and of the time it took.
std::vector<Figure> class_figures(const std::vector<Case>& cases, const LookAlikes& look_alikes);
std::vector<Figure> time_figures(const std::vector<Case>& cases);
std::vector<MistakeRow> mistakes(const std::vector<Case>& cases, const LookAlikes& look_alikes);

/// Every row of the table of the plain class; and effect by effect.
std::vector<Figure> figures(const std::vector<Case>& cases, const LookAlikes& look_alikes);
std::vector<EffectRow> effects(const std::vector<Case>& cases, const LookAlikes& look_alikes);
/// Effects that at Λ = 60 neither they themselves nor look-alikes are named for in half of their cases, in words.
std::vector<std::string> unnamed(const std::vector<EffectRow>& rows);

// What the figures are made of, one case at a time.

/// The verdict of a case whose data hold gross errors: naming `outliers` is right there, and no part of the judgement.
Verdict judged(const Case& one);
/// The set that the verdict claims: the ambiguity set and the first cause.
std::vector<std::string> claimed(const Verdict& verdict);
/// Causes that are said to be at work together: rivals of what is named are no discoveries, and "unknown" names
/// nothing.
std::size_t together(const Verdict& verdict);
bool named_first(const Verdict& verdict, const std::string& truth);
/// Whether a name counts for what was hidden: it is it, or its declared look-alike that the verdict does not tell
/// apart.
bool stands_for(const Verdict& verdict, const std::string& named, const std::string& truth,
                const LookAlikes& look_alikes);
/// First, or sharing the set with a first whose declared look-alike it is, correlation above 0.9 on these data.
bool named_with_look_alike(const Verdict& verdict, const std::string& truth, const LookAlikes& look_alikes);
/// The oracle's first, or so alike to it on these data and declared.
bool oracle_named(const Oracle& oracle, const std::string& truth, const LookAlikes& look_alikes);
bool stands_for(const Oracle::Member& named, const std::string& truth, const LookAlikes& look_alikes);

}  // namespace blind::score
