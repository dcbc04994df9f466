// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/output/outputs.hpp"
#include "text/lists.hpp"
#include "text/wrapping.hpp"

namespace tunica::diagnosis {
namespace {

std::string amount(double value, const std::string& unit) {
  return unit == "1" || unit.empty() ? fmt::format("{:.3g}", value) : fmt::format("{:.3g} {}", value, unit);
}

/// Rivals that a summary lists.
constexpr std::size_t most_rivals = 4;

/// Factors are looked for up to twenty.
std::string factor_words(double factor) { return factor < 19 ? fmt::format("{:.3g}", factor) : "more than 19"; }

std::string p_words(const Alarm& alarm) {
  const double p = alarm.p();
  return p < 1e-4 ? "p < 0.0001" : fmt::format("p {} {:.2g}", alarm.p_is_bound() ? "≤" : "=", p);
}

std::string joined_reasons(const Explanation& explanation) {
  std::vector<std::string> all;
  for (const Reason& reason : explanation.reasons) all.push_back(reason.text);
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string verdict_line(const Diagnosis& d) {
  const Explanation& explanation = d.explanation;
  const Claim& claim = explanation.claim;
  switch (explanation.verdict) {
    case Verdict::nothing_detected:
      for (const Reason& reason : explanation.reasons)
        if (reason.kind == ReasonKind::rows_miss_the_model) return "NOTHING DETECTED: " + reason.text;
      return "NOTHING DETECTED: the model describes these data to within their noise";
    case Verdict::named: {
      std::vector<std::string> ids;
      for (std::size_t k = 0; k < claim.named; ++k) {
        const std::string& id = claim.causes[k].id;
        const auto same = [&](const Cause& cause) { return cause.id == id; };
        const auto named = claim.causes.begin() + static_cast<std::ptrdiff_t>(claim.named);
        const auto count = std::count_if(claim.causes.begin(), named, same);
        if (std::find_if(claim.causes.begin(), named, same) - claim.causes.begin() == static_cast<std::ptrdiff_t>(k))
          ids.push_back(count > 1 ? fmt::format("{} ({} times)", id, count) : id);
      }
      for (const Cause& row : explanation.left_out) ids.push_back(fmt::format("{} {}", row.id, row.place.words()));
      if (!explanation.admissibility.remedy.empty() && d.analysis.alarm.p() > d.request.alpha)
        return fmt::format("NAMED: {} restores the stability that the base fit loses; the curves raise no alarm",
                           fmt::join(ids, " and "));
      return fmt::format("NAMED: consistent with {}", fmt::join(ids, " and "));
    }
    case Verdict::indistinguishable:
      if (claim.ambiguity_set.empty()) return "INDISTINGUISHABLE: " + joined_reasons(explanation);
      if (explanation.file.standing == FileStanding::near)
        return fmt::format("INDISTINGUISHABLE: what the file says may not be so, or it is {}",
                           fmt::join(explanations(claim), ", or "));
      if (explanation.unlisted && claim.ambiguity_set.size() == claim.named)
        return fmt::format("INDISTINGUISHABLE: {} together, or one effect that the catalogue does not list",
                           fmt::join(claim.ambiguity_set, " and "));
      if (!explanation.reasons.empty() && explanation.reasons.front().kind == ReasonKind::several_lead)
        return "INDISTINGUISHABLE: " + joined_reasons(explanation);
      return rivalry(explanations(claim)) + (explanation.unlisted || explanation.reasons.empty() ? "" : "; ") +
             (explanation.unlisted ? "" : joined_reasons(explanation));
    case Verdict::suspect_data:
      return "SUSPECT DATA: " + joined_reasons(explanation);
    case Verdict::discovered:
      return "DISCOVERED: " + joined_reasons(explanation);
    case Verdict::leading:
      return "LEADING: " + joined_reasons(explanation);
    case Verdict::unknown:
      break;
  }
  return "UNKNOWN: " + joined_reasons(explanation);
}

std::string alarm_line(const Analysis& analysis) {
  const Alarm& alarm = analysis.alarm;
  std::string text = fmt::format("noise alone would look like this with {} ({} values, |r|² = {:.1f}, {} mechanisms)",
                                 p_words(alarm), analysis.evidence.fit.residuals.size(), analysis.evidence.fit.chi2,
                                 analysis.hypotheses.candidates.size());
  if (alarm.factor) text += fmt::format("; the alarm holds even with {} times the noise", factor_words(*alarm.factor));
  return text;
}

/// The two worst curves.
std::string misfit_line(const std::vector<Misfit>& misfits) {
  std::vector<std::string> where;
  for (std::size_t k = 0; k < std::min<std::size_t>(misfits.size(), 2); ++k)
    where.push_back(fmt::format("{}, {}: {}", misfits[k].test, misfits[k].channel, misfits[k].where));
  return fmt::format("{}", fmt::join(where, "; "));
}

/// "probability 0.93" if it is meaningful; else a statement of the situation.
std::string standing_words(const Cause& cause, const Explanation& explanation) {
  switch (standing_of(cause, explanation)) {
    case Standing::probable:
      // A probability compares mechanisms, and means nothing if the file may be the cause.
      if (explanation.file.standing == FileStanding::near) return "likeliest of the catalogue, if the file is right";
      return fmt::format("probability {:.2f}", cause.probability);
    case Standing::at_bound:
      return "likeliest of the catalogue, but at its bound";
    case Standing::implausible:
      if (explanation.verdict == Verdict::leading) return "with all steps of the budget; beyond what is plausible";
      return "likeliest of the catalogue, but beyond what is plausible";
    case Standing::rest_is_left:
      if (explanation.verdict == Verdict::leading) return "with all steps of the budget; what is left is not noise";
      break;
  }
  return "likeliest of the catalogue, but what is left is not noise";
}

/// Of a cause that does not act on the model, whose it is.
const char* owner_words(const Cause& cause) {
  if (cause.place.tests.empty()) return "";
  return cause.group == CauseGroup::material ? " (of the specimen)" : " (of the rig)";
}

/// "tau = 12 s (10 … 14)"
std::string amplitude_words(const Amplitude& one) {
  std::string text = fmt::format("{} = {}", one.name, amount(one.value, one.unit));
  if (std::isfinite(one.low) && std::isfinite(one.high)) text += fmt::format(" ({:.3g} … {:.3g})", one.low, one.high);
  return text;
}

std::string cause_line(const Cause& cause, const Explanation& explanation) {
  std::string text = fmt::format("{} {}{}, ", cause.id, cause.place.words(), owner_words(cause));
  text += amplitude_words(cause.amplitude);
  for (const Amplitude& one : cause.nuisance) text += ", " + amplitude_words(one);
  return text + "; " + standing_words(cause, explanation);
}

/// "a (0.12)", "b (at its bound)", "c".
std::string rival_words(const Cause& cause, const Explanation& explanation) {
  switch (standing_of(cause, explanation)) {
    case Standing::probable:
      return fmt::format("{} ({:.2f})", cause.id, cause.probability);
    case Standing::at_bound:
      return cause.id + " (at its bound)";
    case Standing::implausible:
      return cause.id + " (beyond what is plausible)";
    case Standing::rest_is_left:
      break;
  }
  return cause.id;
}

/// Single mechanisms that rival the one that is named, those in the material before those in the rig.
std::string single_rivals(const Explanation& explanation) {
  const Claim& claim = explanation.claim;
  std::string text;
  const std::size_t last = std::min(claim.causes.size(), claim.named + most_rivals);
  for (const CauseGroup group : {CauseGroup::material, CauseGroup::rig}) {
    std::vector<std::string> rivals;
    for (std::size_t k = claim.named; k < last; ++k)
      if (claim.causes[k].group == group) rivals.push_back(rival_words(claim.causes[k], explanation));
    if (rivals.empty()) continue;
    text += fmt::format("{}in the {}: {}", text.empty() ? "" : "; ", code_of(group), fmt::join(rivals, ", "));
  }
  if (last < claim.causes.size()) text += fmt::format("; and {} more", claim.causes.size() - last);
  return text;
}

std::string rivals_line(const Explanation& explanation) {
  const Claim& claim = explanation.claim;
  std::vector<std::string> rivals;
  if (claim.named > 1) {
    const std::vector<std::string> all = explanations(claim);
    rivals.assign(all.begin() + 1, all.end());
    if (const std::size_t count = rivals.size(); count > most_rivals) {
      rivals.resize(most_rivals);
      rivals.push_back(fmt::format("and {} more", count - most_rivals));
    }
  } else if (claim.causes.size() > claim.named) {
    rivals.push_back(single_rivals(explanation));
  }
  if (explanation.unlisted)
    rivals.push_back("an effect that the catalogue does not list: " + explanation.reasons.back().text);
  return rivals.empty() ? "no other mechanism of the catalogue comes close"
                        : fmt::format("{}", fmt::join(rivals, ", "));
}

/// "0.82", "82.9", "1241": root mean squares for sentences.
std::string size_of(double sigmas) {
  return sigmas < 10 ? fmt::format("{:.2f}", sigmas) : fmt::format("{:.{}f}", sigmas, sigmas < 100 ? 1 : 0);
}

std::string error_words(const HeldOut& block) {
  return fmt::format("{} → {} σ", size_of(block.before), size_of(block.after));
}

/// How the extension predicts unseen blocks: the predicted block with the largest improvement, and the block that it
/// fails to predict with the largest error.
std::string held_out_words(const Gain& gain) {
  const HeldOut *best = nullptr, *worst = nullptr;
  for (const HeldOut& block : gain.held_out) {
    if (block.verdict == BlockVerdict::predicted &&
        (best == nullptr || block.before - block.after > best->before - best->after))
      best = &block;
    if (block.verdict == BlockVerdict::not_predicted && (worst == nullptr || block.after > worst->after))
      worst = &block;
  }
  std::string text;
  if (best != nullptr)
    text += fmt::format("; predicts {}, which it has not seen: error {}", best->block, error_words(*best));
  if (worst != nullptr) text += fmt::format("; does not predict {}: error {}", worst->block, error_words(*worst));
  return text;
}

std::string gain_line(const Gain& gain, bool several) {
  std::string text =
      fmt::format("|r|² {:.1f} → {:.1f} (fitted to noise, {} would lower it by about {:.1f})", gain.before, gain.after,
                  several ? "one mechanism" : "it", gain.expected_under_nothing);
  text += held_out_words(gain);
  if (gain.best_rejected)
    text += fmt::format("; the best rejected alternative, {}, leaves {:.1f}", gain.best_rejected->id,
                        gain.best_rejected->after);
  return text;
}

std::string material_line(const Admissibility& admissibility) {
  if (admissibility.stable != false) return "";
  return "the base fit loses " + admissibility.where +
         (admissibility.remedy.empty() ? "" : "; " + admissibility.remedy + " restores it");
}

/// The amplitudes that would not be found, around the null; not beyond what is plausible.
std::string undetected(const Detectable& one) {
  if (one.detectable >= one.reach) return one.id + " at any plausible amplitude";
  if (one.null == 0)
    return fmt::format("{} {} {}", one.id, one.one_sided ? "below" : "within ±", amount(one.detectable, one.unit));
  if (one.one_sided)
    return fmt::format("{} from {:.3g} to {}", one.id, one.null, amount(one.null + one.detectable, one.unit));
  return fmt::format("{} within {:.3g} ± {}", one.id, one.null, amount(one.detectable, one.unit));
}

/// The mechanisms that could still be hidden: those with a large least detectable amplitude, or without a trace.
/// Inapplicable mechanisms are not listed.
std::string could_hide(const std::vector<Detectable>& detectable) {
  std::vector<std::string> large, invisible;
  for (const Detectable& one : detectable) {
    if (!can_hide(one.absence)) continue;
    if (!one.absent.empty())
      invisible.push_back(one.id);
    else if (one.detectable > 0.3 * one.reach)
      large.push_back(undetected(one));
  }
  std::string text;
  if (!large.empty()) text += fmt::format("{}", fmt::join(large, ", "));
  if (!invisible.empty())
    text += fmt::format("{}no trace in these data: {}", text.empty() ? "" : "; ", fmt::join(invisible, ", "));
  return text;
}

/// A possible mistake in the file, as a question with a remedy, together with its mirror images.
std::string file_line(const FileFindings& file) {
  if (file.standing != FileStanding::near && file.standing != FileStanding::ahead) return "";
  const FileCause& first = file.causes.front();
  std::string text =
      fmt::format("is it so that {}? Then the base model leaves |r|² = {:.1f} (p = {:.2g}). To try it, write {}",
                  first.sentence, first.squares, first.p_after, first.mend);
  std::vector<std::string> others;
  for (const FileCause& cause : file.causes)
    if (&cause != &first && cause.near) others.push_back(cause.sentence);
  if (!others.empty()) text += fmt::format(". Or as well: {}", fmt::join(others, "; "));
  return text;
}

/// What shows without a fit; warnings have the texts.
std::string inspected_line(const FileFindings& file) {
  if (file.suspect.empty()) return "";
  std::string text = file.suspect.front().text;
  if (file.suspect.size() > 1) text += fmt::format("; and {} more in \"file\" of result.json", file.suspect.size() - 1);
  return text;
}

/// Mistakes that nothing in the data would show.
std::string untellable_line(const FileFindings& file) {
  return file.untellable.empty() ? ""
                                 : fmt::format(
                                       "{} would leave no trace in these data: compare the parameters with "
                                       "published ones",
                                       text::joined(file.untellable));
}

/// Mechanisms that the base has: a second one of the same kind is no hypothesis of a diagnosis.
std::string not_tried(const std::vector<Detectable>& detectable) {
  std::vector<std::string> ids;
  for (const Detectable& one : detectable)
    if (one.absence == Absence::already_there) ids.push_back("a second " + one.id);
  return ids.empty() ? ""
                     : fmt::format("{} beside that of the base; give the base one more with \"as\" and run both",
                                   fmt::join(ids, ", "));
}

/// After an explanation of the set that stays in it and is not believed.
const char* doubt_of(const Claim& claim, const std::vector<std::string>& ids) {
  return claim.doubted.contains(ids) ? " (beyond belief)" : "";
}

}  // namespace

std::string rivalry(const std::vector<std::string>& all) {
  return fmt::format("INDISTINGUISHABLE: {} {}", fmt::join(all, ", "),
                     all.size() == 1 ? "explains the misfit" : "explain the misfit about equally well");
}

std::vector<std::string> explanations(const Claim& claim) {
  if (!claim.in_words.empty()) return claim.in_words;
  std::vector<std::string> all;
  for (const auto& alike : claim.look_alikes) {
    all.push_back(alike.front() + doubt_of(claim, {alike.front()}));
    std::vector<std::string> others;
    for (std::size_t k = 1; k < alike.size(); ++k) others.push_back(alike[k] + doubt_of(claim, {alike[k]}));
    if (!others.empty()) all.back() += fmt::format(" (or {}, much the same here)", fmt::join(others, ", "));
  }
  if (claim.named > 1) {
    std::vector<std::string> together;
    for (std::size_t k = 0; k < claim.named; ++k) together.push_back(claim.causes[k].id);
    all.push_back(fmt::format("{}{}", fmt::join(together, " with "), doubt_of(claim, together)));
    for (const auto& ids : claim.alternatives)
      all.push_back((ids.size() == 1 ? ids.front() + " alone" : fmt::format("{}", fmt::join(ids, " with "))) +
                    doubt_of(claim, ids));
  }
  return all.empty() ? claim.ambiguity_set : all;
}

text::StyledText summary(const Diagnosis& d, const text::StyledText& below_verdict) {
  const Explanation& explanation = d.explanation;
  const Claim& claim = explanation.claim;
  const bool wrong = explanation.verdict != Verdict::nothing_detected;
  text::StyledText lines;
  lines.add(text::hanging("Verdict:  ", verdict_line(d)), text::Emphasis::heading);
  lines += "\n";
  lines += below_verdict;
  const auto line = [&lines](const char* lead, const std::string& text) {
    if (!text.empty()) lines += text::hanging(lead, text) + '\n';
  };
  line("Alarm:    ", alarm_line(d.analysis));
  line("Suspect:  ", inspected_line(explanation.file));
  line("File:     ", file_line(explanation.file));
  if (const assembly::Misfit misfit = stated_misfit(d.analysis.evidence); wrong && misfit.judged())
    line("Misfit:   ", assembly::in_words(misfit, "stated"));
  if (wrong) line("Wrong:    ", misfit_line(explanation.misfit));
  for (std::size_t k = 0; k < std::min(claim.named, claim.causes.size()); ++k)
    line("Cause:    ", cause_line(claim.causes[k], explanation));
  for (const Cause& row : explanation.left_out) line("Cause:    ", cause_line(row, explanation));
  // The budget lists the effects besides the leading cause.
  const bool leads = explanation.verdict == Verdict::leading;
  if (wrong && !leads && !claim.causes.empty()) line("Or else:  ", rivals_line(explanation));
  if (wrong) line("Left out: ", not_tried(d.prospects.detectable));
  if (d.prospects.gain) line("Gain:     ", gain_line(*d.prospects.gain, claim.named > 1));
  line("Material: ", material_line(explanation.admissibility));
  if (d.prospects.next) line("Next:     ", d.prospects.next->description);
  if (!wrong) line("May hide: ", could_hide(d.prospects.detectable));
  line("Untold:   ", untellable_line(explanation.file));
  return lines;
}

}  // namespace tunica::diagnosis
