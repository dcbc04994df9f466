// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/extended_run.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/memory.hpp"
#include "diagnosis/hypotheses/places.hpp"

namespace tunica::diagnosis {
namespace {

/// A run takes relative noise of the measured values.
std::optional<Warning> noise_difference(const Inquiry& inquiry, const Evidence& evidence, const Refit& best) {
  experiment::Experiment experiment = best.extension->experiment();
  for (auto& test : experiment.tests)
    for (auto& [channel, noise] : test.data.noise) noise.level.clear();
  const assembly::Assembly assembly(experiment, evidence.run, inquiry.catalogue);
  Eigen::VectorXd residuals;
  if (!whitened(assembly, best.fit.free, *assembly.evaluator().make_workspace(), residuals, nullptr).ok())
    return std::nullopt;
  constexpr double alike = 1e-3;
  const double run = residuals.squaredNorm();
  if (!(std::abs(run - best.fit.chi2) > alike * best.fit.chi2)) return std::nullopt;
  return Warning{WarningKind::run_differs_in_noise,
                 fmt::format("a run of extended.json takes relative noise as a share of the measured values; the "
                             "diagnosis takes it as a share of the smoothed fit. |r|² of the same fit is {:.5g} in the "
                             "run and {:.5g} here",
                             run, best.fit.chi2)};
}

/// One gross row of a test is taken out by a mechanism.
std::optional<Warning> kept_gross_rows(const Evidence& evidence, const Explanation& explanation) {
  const auto& added = explanation.claim.best->additions;
  const auto& left_out = explanation.left_out;
  std::vector<std::string> kept;
  for (const GrossRow& row : explanation.gross.empty() ? evidence.gross : explanation.gross) {
    const auto is_it = [&](const auto& one) { return one.place == Place{{row.test}, row.channel, row.row}; };
    if (std::none_of(added.begin(), added.end(), is_it) && std::none_of(left_out.begin(), left_out.end(), is_it))
      kept.push_back(fmt::format("row {} of {}, {}", row.file_row, row.test, row.channel));
  }
  if (kept.empty()) return std::nullopt;
  constexpr std::size_t most_listed = 12;
  if (kept.size() > most_listed) {
    const std::size_t others = kept.size() - most_listed;
    kept.resize(most_listed);
    kept.push_back(fmt::format("{} others (\"left_out\" in result.json)", others));
  }
  return Warning{WarningKind::run_keeps_gross_rows,
                 fmt::format("extended.json takes out one gross row of a test; a run counts the others like any row: "
                             "{}. Remove them from the data file",
                             fmt::join(kept, "; "))};
}

/// Rows of unknown order are a first loading here.
std::optional<Warning> assumed_first_loading(const Inquiry& inquiry, const Evidence& evidence, const Refit& best) {
  const bool remembers = std::any_of(best.additions.begin(), best.additions.end(), [&](const Addition& one) {
    return one.place.tests.empty() && assembly::has_memory(inquiry.mechanism(one.id));
  });
  std::optional<double> pace;
  for (const Addition& one : best.extension->additions())
    if (one.pace) pace = one.pace;
  std::vector<assembly::TestPast> pasts;
  if (remembers) pasts = assembly::unknown_pasts(evidence.experiment, evidence.run, inquiry.catalogue);
  if (pasts.empty()) return std::nullopt;
  const auto pace_words = [&] {
    if (!pace) return std::string();
    if (*pace < clock_of(evidence.experiment, evidence.run, inquiry.catalogue).shortest)
      return std::string(", too fast to relax");
    return fmt::format(", {:.3g} s from row to row", *pace);
  };
  return Warning{WarningKind::run_takes_file_order,
                 fmt::format("the rows of some tests are taken as a first loading, by rising load{}; a run of "
                             "extended.json takes them in the order of their file{}: {}",
                             pace_words(), pace ? " and without time" : "", assembly::words_of(pasts))};
}

}  // namespace

std::vector<Warning> extended_run_warnings(const Inquiry& inquiry, const Evidence& evidence,
                                           const Explanation& explanation) {
  std::vector<Warning> warnings;
  if (auto warning = noise_difference(inquiry, evidence, *explanation.claim.best))
    warnings.push_back(std::move(*warning));
  if (auto warning = assumed_first_loading(inquiry, evidence, *explanation.claim.best))
    warnings.push_back(std::move(*warning));
  if (auto warning = kept_gross_rows(evidence, explanation)) warnings.push_back(std::move(*warning));
  return warnings;
}

}  // namespace tunica::diagnosis
