// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/outputs.hpp"
#include "text/wrapping.hpp"

namespace tunica::diagnosis {
namespace {

std::string amount(double value, const std::string& unit) {
  return unit == "1" || unit.empty() ? fmt::format("{:.3g}", value) : fmt::format("{:.3g} {}", value, unit);
}

/// Rivals that a summary lists.
constexpr std::size_t most_told = 4;

/// Factors are looked for up to twenty.
std::string factor_words(double factor) { return factor < 19 ? fmt::format("{:.3g}", factor) : "19 and more"; }

std::string p_text(const Diagnosis& d) {
  const double p = d.p_refits.value_or(d.detection.p);
  // So many refits cannot tell smaller ones apart.
  if (d.p_refits && d.detection.p < p && p >= 1e-4 && p < 0.001) return fmt::format("p ≤ {:.2g}", p);
  return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p);
}

std::string verdict_line(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::nothing_detected:
      return "NOTHING DETECTED: the model describes these data to within their noise";
    case Verdict::named: {
      std::vector<std::string> ids;
      for (std::size_t k = 0; k < d.named; ++k) ids.push_back(d.causes[k].id);
      for (const Cause& row : d.left_out) ids.push_back(fmt::format("{} {}", row.id, row.target.words()));
      if (!d.admissibility.remedy.empty() && d.p_refits.value_or(d.detection.p) > d.settings.alpha)
        return fmt::format("NAMED: {} mends the stability that the base fit loses; the curves raise no alarm",
                           fmt::join(ids, " and "));
      return fmt::format("NAMED: consistent with {}", fmt::join(ids, " and "));
    }
    case Verdict::indistinguishable:
      if (d.unlisted && d.ambiguity_set.size() == d.named)
        return fmt::format("INDISTINGUISHABLE: {} together, or one effect that the catalogue does not list",
                           fmt::join(d.ambiguity_set, " and "));
      return fmt::format("INDISTINGUISHABLE: {} explain the misfit about as well as each other",
                         fmt::join(explanations(d), ", "));
    case Verdict::suspect_data:
      return fmt::format("SUSPECT DATA: {}", fmt::join(d.reasons, "; "));
    case Verdict::unknown:
      break;
  }
  return fmt::format("UNKNOWN: {}", fmt::join(d.reasons, "; "));
}

/// The amplitudes that would not be found, around the null; not beyond what is plausible.
std::string undetected(const Detectable& one, const MechanismFactory& mechanism) {
  if (one.detectable >= one.reach) return one.id + " at any plausible amplitude";
  const bool one_sided = mechanism.side == MechanismFactory::Side::positive;
  if (one.null == 0)
    return fmt::format("{} {} {}", one.id, one_sided ? "below" : "within ±", amount(one.detectable, one.unit));
  if (one_sided)
    return fmt::format("{} from {:.3g} to {}", one.id, one.null, amount(one.null + one.detectable, one.unit));
  return fmt::format("{} within {:.3g} ± {}", one.id, one.null, amount(one.detectable, one.unit));
}

/// The mechanisms that could still hide: least detectable amplitudes that are large, or no trace at all.
std::string could_hide(const Diagnosis& d) {
  std::vector<std::string> large, invisible;
  for (std::size_t c = 0; c < d.detectable.size(); ++c) {
    const Detectable& one = d.detectable[c];
    const MechanismFactory& mechanism = *d.candidates[c].mechanism;
    if (!one.absent.empty())
      invisible.push_back(one.id);
    else if (one.detectable > 0.3 * one.reach)
      large.push_back(undetected(one, mechanism));
  }
  std::string text;
  if (!large.empty()) text += fmt::format("{}", fmt::join(large, ", "));
  if (!invisible.empty())
    text += fmt::format("{}no trace in these data: {}", text.empty() ? "" : "; ", fmt::join(invisible, ", "));
  return text;
}

/// What speaks against an amplitude, to stand behind it.
std::string doubt(const Amplitude& amplitude) {
  return !amplitude.plausible ? ", beyond what is plausible" : amplitude.at_bound ? ", at its bound" : "";
}

/// "0.82", "82.9", "1241": root mean squares for sentences.
std::string size_of(double sigmas) {
  return sigmas < 10 ? fmt::format("{:.2f}", sigmas) : fmt::format("{:.{}f}", sigmas, sigmas < 100 ? 1 : 0);
}

/// What the extension makes of blocks that it has not seen: the one that it does most for among those that it
/// predicts, and the one that it is furthest from.
std::string predicted(const Gain& gain) {
  constexpr double near = 2, better = 0.98, worse = 1.2;  // of σ, of the error without the extension
  constexpr double contradicts = 0.05;
  const HeldOut *best = nullptr, *worst = nullptr;
  for (const HeldOut& block : gain.held_out) {
    if (block.after < near && block.after < better * block.before &&
        (best == nullptr || block.before - block.after > best->before - best->after))
      best = &block;
    // Far off is no contradiction where the other rows leave the parameters open: the p-value knows of that.
    const bool off = block.after >= near || block.after > worse * block.before;
    if (off && block.p_value < contradicts && (worst == nullptr || block.after > worst->after)) worst = &block;
  }
  std::string text;
  if (best != nullptr)
    text += fmt::format("; predicted without having seen it, {}: error {} → {} σ", best->block, size_of(best->before),
                        size_of(best->after));
  if (worst != nullptr)
    text += fmt::format("{} {}: {} → {} σ", best != nullptr ? ", but not" : "; not predicted,", worst->block,
                        size_of(worst->before), size_of(worst->after));
  return text;
}

}  // namespace

std::vector<std::string> explanations(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const auto& alike : d.look_alikes) {
    all.push_back(alike.front());
    if (alike.size() > 1)
      all.back() += fmt::format(" (or {}, much the same here)", fmt::join(alike.begin() + 1, alike.end(), ", "));
  }
  if (d.named > 1) {
    std::vector<std::string> together;
    for (std::size_t k = 0; k < d.named; ++k) together.push_back(d.causes[k].id);
    all.push_back(fmt::format("{}", fmt::join(together, " with ")));
    for (const auto& ids : d.alternatives)
      all.push_back(ids.size() == 1 ? ids.front() + " alone" : fmt::format("{}", fmt::join(ids, " with ")));
  }
  return all.empty() ? d.ambiguity_set : all;
}

std::string summary(const Diagnosis& d) {
  std::vector<std::string> lines;
  const auto line = [&lines](const char* lead, const std::string& text) {
    if (!text.empty()) lines.push_back(text::hanging(lead, text));
  };
  line("Verdict:  ", verdict_line(d));
  line("Alarm:    ",
       fmt::format("{} that noise alone looks like this ({} values, |r|² = {:.1f}, {} mechanisms){}", p_text(d),
                   d.fit.residuals.size(), d.fit.chi2, d.candidates.size(),
                   d.alarm_factor ? fmt::format("; it stands up to {} times this noise", factor_words(*d.alarm_factor))
                                  : std::string()));
  if (d.verdict != Verdict::nothing_detected) {
    std::vector<std::string> where;
    for (std::size_t k = 0; k < std::min<std::size_t>(d.misfit.size(), 2); ++k)
      where.push_back(fmt::format("{}, {}: {}", d.misfit[k].test, d.misfit[k].channel, d.misfit[k].where));
    line("Wrong:    ", fmt::format("{}", fmt::join(where, "; ")));
  }
  std::vector<Cause> together(d.causes.begin(),
                              d.causes.begin() + static_cast<std::ptrdiff_t>(std::min(d.named, d.causes.size())));
  together.insert(together.end(), d.left_out.begin(), d.left_out.end());
  for (const Cause& cause : together) {
    const std::string interval = std::isfinite(cause.amplitude.low)
                                     ? fmt::format(" ({:.3g} … {:.3g})", cause.amplitude.low, cause.amplitude.high)
                                     : std::string();
    line("Cause:    ", fmt::format("{} {}, {} = {}{}{}; probability {:.2f}", cause.id, cause.target.words(),
                                   cause.amplitude.name, amount(cause.amplitude.value, cause.amplitude.unit), interval,
                                   doubt(cause.amplitude), cause.probability));
  }
  std::vector<std::string> rivals;
  if (d.named > 1) {
    const std::vector<std::string> all = explanations(d);
    rivals.assign(all.begin() + 1, all.end());
  } else {
    for (std::size_t k = d.named; k < d.causes.size(); ++k)
      rivals.push_back(
          fmt::format("{} ({:.2f}{})", d.causes[k].id, d.causes[k].probability, doubt(d.causes[k].amplitude)));
  }
  if (const std::size_t count = rivals.size(); count > most_told) {
    rivals.resize(most_told);
    rivals.push_back(fmt::format("and {} more", count - most_told));
  }
  if (d.unlisted) rivals.push_back("an effect that the catalogue does not list: " + d.reasons.back());
  if (d.verdict != Verdict::nothing_detected && !d.causes.empty())
    line("Or else:  ", rivals.empty() ? "no other mechanism of the catalogue comes near"
                                      : fmt::format("{}", fmt::join(rivals, ", ")));
  if (d.extension && d.gain) {
    std::string text = fmt::format("|r|² {:.1f} → {:.1f} (by chance {:.1f} would go{})", d.gain->before, d.gain->after,
                                   d.gain->expected_under_nothing, d.named > 1 ? " with one mechanism" : "");
    text += predicted(*d.gain);
    if (!d.gain->best_wrong.empty())
      text += fmt::format("; the best wrong one, {}, leaves {:.1f}", d.gain->best_wrong, d.gain->best_wrong_after);
    line("Gain:     ", text);
  }
  if (d.admissibility.stable == false)
    line("Material: ", "the base fit loses " + d.admissibility.where +
                           (d.admissibility.remedy.empty() ? "" : "; " + d.admissibility.remedy + " mends it"));
  if (d.next) line("Next:     ", d.next->description);
  if (d.verdict == Verdict::nothing_detected) line("May hide: ", could_hide(d));
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace tunica::diagnosis
