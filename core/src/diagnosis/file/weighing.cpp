// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/weighing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/file/corrected_fits.hpp"
#include "diagnosis/file/inspection.hpp"
#include "diagnosis/hypotheses/extension.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/naming/singles.hpp"

namespace tunica::diagnosis {
namespace {

/// Margins in units of BIC, calibrated on wrong files and on correct files with a real effect.
constexpr double ahead_by = 6, near_within = 6;
/// A mistake that explains nearly all of the misfit, and far more than any cause, becomes a question even if it leaves
/// slightly more than noise. Noise is rarely stated to within a per cent.
constexpr double nearly_clean = 1e-4, nearly_all = 0.95, far_ahead = 20;
/// The penalty of a cause whose amplitude is implausible or at its bound. A factor of two is such an amplitude for
/// a gain.
constexpr double unbelievable = 20;
constexpr std::size_t most_causes = 6;  ///< that are tested and listed

/// S of the claim, with a penalty if it is implausible; infinite without a claim.
double score_of_claim(const Inquiry& inquiry, const Analysis& analysis, const Explanation& explanation) {
  const Claim& claim = explanation.claim;
  if (!claim.best) return INFINITY;
  const double rows = static_cast<double>(analysis.evidence.fit.residuals.size());
  const auto effects = static_cast<double>(claim.best->additions.size());
  const double share =
      (1 - inquiry.request.wrong_files) / static_cast<double>(std::max<std::size_t>(explanation.ranking.size(), 1));
  const bool believable =
      std::all_of(claim.causes.begin(),
                  claim.causes.begin() + static_cast<std::ptrdiff_t>(std::min(claim.named, claim.causes.size())),
                  [](const Cause& cause) { return cause.amplitude.plausible && !cause.amplitude.at_bound; });
  return claim.best->fit.chi2 + effects * (std::log(rows) - 2 * std::log(share)) + (believable ? 0 : unbelievable);
}

double score_of(const Inquiry& inquiry, const CorrectedFit& corrected) {
  return -2 * (corrected.log_weight + std::log(inquiry.request.wrong_files));
}

/// One factor on all stresses is seen where a parameter of the base lies at the end of its declared range.
bool scale_is_seen(const Analysis& analysis) {
  const auto& parameters = analysis.evidence.base->layout().parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    if (analysis.evidence.fit.at_bound[j] && parameters[j].unit == "kPa") return true;
  return false;
}

std::vector<std::string> untellable(const Analysis& analysis, bool scale_seen) {
  std::vector<std::string> all;
  const Evidence& evidence = analysis.evidence;
  const bool stresses_only =
      std::all_of(evidence.base->layout().channels.begin(), evidence.base->layout().channels.end(),
                  [](const assembly::MeasuredChannel& one) { return one.unit == "kPa"; });
  if (stresses_only && !scale_seen) all.emplace_back("one factor on all stresses");
  if (std::any_of(evidence.base->layout().parameters.begin(), evidence.base->layout().parameters.end(),
                  [](const assembly::FreeParameter& one) { return one.unit == "s"; }))
    all.emplace_back("the unit of all times");
  return all;
}

/// Other measures of the stresses, of all tests that have another one, with which the base leaves noise as well.
std::vector<std::string> measures_as_good(const Inquiry& inquiry, const Analysis& analysis, const Record& record) {
  Corrections readings;
  add_stress_measures(record, fitted_tests(record, analysis.evidence.run), readings);
  std::vector<std::string> all;
  for (const Correction& one : readings)
    if (one.common && leaves_noise(inquiry, analysis, record, one))
      all.push_back(fmt::format("another measure of stress ({})", one.sentence));
  return all;
}

FileCause cause_of(const CorrectedFit& corrected, double p_after, const plugins::Catalogue& catalogue) {
  const Correction& correction = *corrected.correction;
  FileCause cause{
      correction.kind, correction.tests, correction.sentence, correction.mend, corrected.fit.chi2, p_after, 0, false};
  cause.changes = correction.changes;
  if (correction.additions.empty()) return cause;
  cause.mechanism = correction.additions.front().id;
  cause.amplitudes = corrected.amplitudes;
  cause.sentence = calibration_words(correction, corrected.amplitudes, catalogue);
  return cause;
}

/// The experiment as the correction reads it, or with its mechanisms.
std::shared_ptr<const experiment::Experiment> mended(const Inquiry& inquiry, const Record& record,
                                                     const experiment::RunEntry& run, const Correction& correction) {
  if (!correction.additions.empty()) {
    const Extension extension(record.experiment(), run, correction.additions, inquiry.catalogue);
    return std::make_shared<const experiment::Experiment>(with_shares(extension, inquiry.catalogue));
  }
  Record read = record;
  if (!correction.apply(read)) return nullptr;
  return std::make_shared<const experiment::Experiment>(std::move(read.experiment()));
}

}  // namespace

Explanation weighed_with_file(const Inquiry& inquiry, const Analysis& analysis, Explanation explanation) {
  FileFindings& file = explanation.file;
  const Evidence& evidence = analysis.evidence;
  // A request that names mechanisms concerns only these.
  const bool asked = inquiry.request.considers("file") && inquiry.request.mechanisms.empty();
  if (!asked || evidence.base->layout().has_costly_tests) return explanation;
  file.wrong_files = inquiry.request.wrong_files;
  const bool scale_seen = scale_is_seen(analysis);
  file.untellable = untellable(analysis, scale_seen);
  file.suspect = inspected(evidence);
  if (!explanation.gross.empty()) return explanation;
  const Record record(evidence.experiment, evidence.run.tests, inquiry.catalogue);
  if (!analysis.alarm.raised) {
    for (std::string& reading : measures_as_good(inquiry, analysis, record))
      file.untellable.push_back(std::move(reading));
    return explanation;
  }
  inquiry.report("what the file may say and is not so", 0.75);
  const Corrections corrections = corrections_of(inquiry, record, evidence.run, scale_seen);
  const std::vector<CorrectedFit> fits = corrected_fits(inquiry, analysis, record, corrections);
  file.tried = corrections.size();
  file.standing = FileStanding::far;
  std::vector<double> logs;
  for (const CorrectedFit& one : fits) logs.push_back(one.log_weight);
  const double together = log_sum(logs);
  bool clean = false;
  for (std::size_t k = 0; k < std::min(fits.size(), most_causes); ++k) {
    FileCause cause = cause_of(fits[k], p_of_corrected(analysis, fits[k]), inquiry.catalogue);
    cause.probability = std::exp(fits[k].log_weight - together);
    cause.near = 2 * (fits.front().log_weight - fits[k].log_weight) < near_within;
    clean = clean || (k == 0 && is_clean(cause.p_after));
    file.causes.push_back(std::move(cause));
  }
  if (fits.empty()) return explanation;
  const double claimed = score_of_claim(inquiry, analysis, explanation);
  const double lead = claimed - score_of(inquiry, fits.front());
  if (std::isfinite(lead)) file.lead = lead;
  const double misfit = evidence.fit.chi2 - static_cast<double>(evidence.fit.residuals.size());
  const double share = (evidence.fit.chi2 - file.causes.front().squares) / std::max(misfit, 1.0);
  const bool nearly = file.causes.front().p_after > nearly_clean && share > nearly_all && lead > far_ahead;
  if (!clean && !nearly) return explanation;

  const FileCause& first = file.causes.front();
  if (clean && lead > ahead_by) {
    file.standing = FileStanding::ahead;
    explanation.verdict = Verdict::suspect_data;
    explanation.reasons = {{ReasonKind::file_suspected,
                            fmt::format("{}: with that mended the base model leaves noise, |r|² {:.1f} → {:.1f}, and "
                                        "needs no other cause. Write {}",
                                        first.sentence, evidence.fit.chi2, first.squares, first.mend)}};
    explanation.claim = {};
    explanation.left_out.clear();
    explanation.unlisted = false;
    explanation.p_after = first.p_after;
  } else if (lead > -near_within) {
    file.standing = FileStanding::near;
    if (explanation.verdict == Verdict::named || explanation.verdict == Verdict::unknown ||
        explanation.verdict == Verdict::suspect_data)
      explanation.verdict = Verdict::indistinguishable;
    explanation.reasons.insert(
        explanation.reasons.begin(),
        {ReasonKind::file_as_likely, fmt::format("it may be that {}; with that mended the base model leaves noise too, "
                                                 "|r|² {:.1f} → {:.1f}",
                                                 first.sentence, evidence.fit.chi2, first.squares)});
  }
  if (file.standing != FileStanding::far) {
    explanation.mended = mended(inquiry, record, evidence.run, *fits.front().correction);
  }
  return explanation;
}

}  // namespace tunica::diagnosis
