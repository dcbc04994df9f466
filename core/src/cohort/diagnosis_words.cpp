// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "budget/output/outputs.hpp"
#include "cohort/diagnosis_study.hpp"
#include "diagnosis/output/outputs.hpp"
#include "text/lists.hpp"
#include "text/misfit_words.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::cohort {

namespace {

using cohort_diagnosis::CohortVerdict;
using cohort_diagnosis::CommonAmplitude;
using diagnosis::Verdict;

std::string reasons_of(const CohortVerdict& verdict) {
  std::vector<std::string> all;
  for (const auto& reason : verdict.reasons) all.push_back(reason.text);
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string verdict_sentence(const CohortVerdict& verdict) {
  switch (verdict.verdict) {
    case Verdict::nothing_detected:
      return "NOTHING DETECTED: the model describes all specimens to within their noise";
    case Verdict::named:
      return fmt::format("NAMED: consistent with {}", fmt::join(verdict.explanations.front().ids, " and "));
    case Verdict::indistinguishable: {
      std::vector<std::string> all;
      for (const auto& group : verdict.look_alikes) all.insert(all.end(), group.begin(), group.end());
      return diagnosis::rivalry(all);
    }
    case Verdict::suspect_data:
      return "SUSPECT DATA: " + reasons_of(verdict);
    case Verdict::leading:     // of a budget only
    case Verdict::discovered:  // terms are looked for by a discovery only
    case Verdict::unknown:
      break;
  }
  return "UNKNOWN: " + reasons_of(verdict);
}

std::string alarm_sentence(const DiagnosisStudy& study) {
  const CohortVerdict& verdict = study.verdict;
  const auto alone =
      std::count_if(verdict.p_values.begin(), verdict.p_values.end(), [&](double p) { return p <= study.alpha; });
  return fmt::format("Noise alone would look like this with p {}. {} of {} {} an alarm alone",
                     verdict.p_value < 1e-4 ? "< 0.0001" : fmt::format("= {:.2g}", verdict.p_value), alone,
                     text::counted(verdict.specimens.size(), "specimen", "specimens"),
                     text::agreeing(static_cast<std::size_t>(alone), "raises", "raise"));
}

std::string size_sentence(const CohortVerdict& verdict) {
  const cohort_diagnosis::CohortSize& size = verdict.size;
  return fmt::format("The model {} over all specimens; tolerance {} ({}): reached in {} of {}",
                     text::misses_by(size.rms), text::percent(size.tolerance.share),
                     budget::origin_words(size.tolerance), size.within, verdict.specimens.size());
}

std::string amplitude_sentence(const cohort_diagnosis::Explanation& best, std::size_t k, const CommonAmplitude& one) {
  return fmt::format("{} {}: {}{} is {:.3g}{} on average ({:.3g} … {:.3g}), and differs between specimens by {:.2g}",
                     best.ids[k], best.places[k].words(), one.squared ? "the square of " : "", one.name, one.mean,
                     one.squared ? "" : text::unit_suffix(one.unit), one.low, one.high, one.spread);
}

std::string group_sentence(const cohort_diagnosis::FactorEvidence& factor) {
  if (factor.only_in)
    return fmt::format("Only specimens with {} = {} show it (probability {:.2f})", factor.factor, *factor.only_in,
                       factor.probability_only);
  return fmt::format(
      "Specimens of every {} show it, or it cannot be told apart (probability {:.2f} that one group "
      "alone does)",
      factor.factor, factor.probability_only);
}

std::string gain_sentence(const std::vector<cohort_diagnosis::LeftOut>& all) {
  double rows = 0, without = 0, own = 0, foretold = 0;
  std::size_t better = 0;
  for (const auto& one : all) {
    rows += static_cast<double>(one.rows);
    without += one.without;
    own += one.own;
    foretold += one.foretold;
    better += one.foretold < one.without ? 1 : 0;
  }
  return fmt::format(
      "With the cause, |r|² of {:.0f} values falls from {:.4g} to {:.4g}. With the mean amplitude of the "
      "other specimens it falls to {:.4g}, in {} of {}",
      rows, without, own, foretold, better, text::counted(all.size(), "specimen", "specimens"));
}

void add_lines(const std::vector<std::string>& lines, std::string& words) {
  constexpr std::size_t most = 10;
  for (std::size_t k = 0; k < std::min(lines.size(), most); ++k) words += text::hanging("  ! ", lines[k]) + "\n";
  if (lines.size() > most) words += fmt::format("  ! and {} more; result.json lists them\n", lines.size() - most);
}

}  // namespace

std::vector<std::string> diagnosis_sentences(const DiagnosisStudy& study) {
  if (!study.none.empty()) return {"NO VERDICT: " + study.none};
  const CohortVerdict& verdict = study.verdict;
  std::vector<std::string> all{verdict_sentence(verdict), alarm_sentence(study), size_sentence(verdict)};
  if (verdict.explanations.empty()) return all;
  const auto& best = verdict.explanations.front();
  if (verdict.verdict == Verdict::unknown)
    all.push_back(fmt::format("Of what was tried, {} {} closest", fmt::join(best.ids, " and "),
                              text::agreeing(best.ids.size(), "comes", "come")));
  for (std::size_t k = 0; k < verdict.amplitudes.size(); ++k)
    all.push_back(amplitude_sentence(best, k, verdict.amplitudes[k]));
  for (const auto& factor : verdict.factors) all.push_back(group_sentence(factor));
  if (!verdict.left_out.empty()) all.push_back(gain_sentence(verdict.left_out));
  return all;
}

std::string diagnosis_words(const SpecimenTable& table, const DiagnosisStudy& study) {
  std::string words = "\nwhat the model gets wrong\n";
  for (const std::string& sentence : diagnosis_sentences(study)) words += text::hanging("  ", sentence) + "\n";
  std::vector<std::string> apart, without;
  for (const auto& one : study.verdict.contradictions) apart.push_back(fmt::format("{}: {}", one.specimen, one.text));
  for (const NotDiagnosed& one : study.problems)
    if (!one.unreadable)
      without.push_back(fmt::format("{} was not diagnosed: {}", table.specimens[one.position].id, one.reason));
  // Where most go against it, the verdict has said so.
  if (2 * apart.size() > study.verdict.specimens.size())
    words += text::hanging("  ! ", fmt::format("{} of {} specimens do not go with it; result.json says why",
                                               apart.size(), study.verdict.specimens.size())) +
             "\n";
  else
    add_lines(apart, words);
  add_lines(without, words);
  return words;
}

}  // namespace tunica::cohort
