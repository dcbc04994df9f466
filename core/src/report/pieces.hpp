// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/chart.hpp"
#include "results/keys.hpp"
#include "results/reading.hpp"

/// The same numbers in words everywhere, and the order of runs.
namespace tunica::report {

namespace key = results::key;
using results::entry;
using results::list;
using results::member;
using results::number;
using results::word;
using results::words;

/// Four digits, or "–" for a missing number.
std::string figure(double value);
/// A probability; below 0.0001 it only says so.
std::string share(double p);
/// "3.2 kPa"; nothing after numbers of unit 1.
std::string amount(double value, const std::string& unit);
/// "p = 0.03", "p < 0.0001"; "p ≤ 0.0005" of an upper bound.
std::string chance(double p, bool bound = false);
/// "one run", "3 runs".
std::string count_of(std::size_t count, const std::string& one, const std::string& many);

/// The runs of result.json in the order of the ranking, those without rank last; the place is the run's colour in
/// every chart of the report.
class Order {
 public:
  explicit Order(const Json& result);
  struct Run {
    std::string label, model, optimizer, group;
    const Json* run;  ///< in result.json
    int rank;         ///< within the group; 0 = none
  };
  [[nodiscard]] const std::vector<Run>& runs() const { return runs_; }
  /// The place of a label, also of "label model" as tables of layered walls have it; the count where there is none.
  [[nodiscard]] std::size_t place(const std::string& label) const;
  [[nodiscard]] std::vector<std::string> groups() const;
  /// "least_squares on in_vivo (6 tests held out)": a group without the tests that its runs only predict.
  [[nodiscard]] std::string title(const std::string& group) const;
  /// Whether a chart of all runs shows this one from the start: the best of every group, about shown_runs in all.
  [[nodiscard]] bool shown(std::size_t place) const;
  /// What to say of those it does not show; "" where it shows all.
  [[nodiscard]] std::string note() const;

 private:
  std::vector<Run> runs_;
};

/// How many runs a chart shows before the reader switches on others.
constexpr std::size_t shown_runs = 5;
/// What to say of the others; "" where all are shown.
std::string hidden_note(std::size_t count);

}  // namespace tunica::report
