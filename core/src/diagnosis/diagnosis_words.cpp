// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "comparison/text.hpp"
#include "diagnosis/causes.hpp"
#include "diagnosis/outputs.hpp"

namespace tunica::diagnosis {
namespace {

std::string amount(double value, const std::string& unit) {
  return unit == "1" || unit.empty() ? fmt::format("{:.3g}", value) : fmt::format("{:.3g} {}", value, unit);
}

std::string p_text(double p) { return p < 1e-4 ? "p < 0.0001" : fmt::format("p = {:.2g}", p); }

std::string verdict_line(const Diagnosis& d) {
  switch (d.verdict) {
    case Verdict::nothing_detected:
      return "NOTHING DETECTED: the model describes these data to within their noise";
    case Verdict::named: {
      std::vector<std::string> ids;
      for (std::size_t k = 0; k < d.named; ++k) ids.push_back(d.causes[k].id);
      return fmt::format("NAMED: consistent with {}", fmt::join(ids, " and "));
    }
    case Verdict::indistinguishable:
      return fmt::format("INDISTINGUISHABLE: {} explain the misfit as well as each other",
                         fmt::join(d.ambiguity_set, ", "));
    case Verdict::suspect_data:
      return fmt::format("SUSPECT DATA: {}", fmt::join(d.reasons, "; "));
    case Verdict::unknown:
      break;
  }
  return fmt::format("UNKNOWN: {}", fmt::join(d.reasons, "; "));
}

/// The mechanisms that could still hide: least detectable amplitudes beyond what is plausible, or no trace at all.
std::string could_hide(const Diagnosis& d) {
  std::vector<std::string> large, invisible;
  for (std::size_t c = 0; c < d.detectable.size(); ++c) {
    const Detectable& one = d.detectable[c];
    const MechanismFactory& mechanism = *d.candidates[c].mechanism;
    const auto [low, high] = plausible_range(d, mechanism, one.target);
    const double reach = std::max(high - mechanism.null, mechanism.null - low);
    if (!one.absent.empty())
      invisible.push_back(one.id);
    else if (one.detectable > 0.3 * reach)
      large.push_back(fmt::format("{} below {}", one.id, amount(one.detectable, one.unit)));
  }
  std::string text;
  if (!large.empty()) text += fmt::format("{}", fmt::join(large, ", "));
  if (!invisible.empty())
    text += fmt::format("{}no trace in these data: {}", text.empty() ? "" : "; ", fmt::join(invisible, ", "));
  return text;
}

}  // namespace

std::string summary(const Diagnosis& d) {
  std::vector<std::string> lines;
  const auto line = [&lines](const char* lead, const std::string& text) {
    if (!text.empty()) lines.push_back(comparison::hanging(lead, text, 100));
  };
  line("Verdict:  ", verdict_line(d));
  line("Alarm:    ", fmt::format("{} that noise alone looks like this ({} rows, |r|² = {:.1f}, {} mechanisms)",
                                 p_text(d.p_refits.value_or(d.detection.p)), d.fit.residuals.size(), d.fit.chi2,
                                 d.candidates.size()));
  if (d.verdict != Verdict::nothing_detected) {
    std::vector<std::string> where;
    for (std::size_t k = 0; k < std::min<std::size_t>(d.misfit.size(), 2); ++k)
      where.push_back(fmt::format("{}, {}: {}", d.misfit[k].test, d.misfit[k].channel, d.misfit[k].where));
    line("Wrong:    ", fmt::format("{}", fmt::join(where, "; ")));
  }
  for (std::size_t k = 0; k < std::min(d.named, d.causes.size()); ++k) {
    const Cause& cause = d.causes[k];
    const std::string interval = std::isfinite(cause.amplitude.low)
                                     ? fmt::format(" ({:.3g} … {:.3g})", cause.amplitude.low, cause.amplitude.high)
                                     : std::string();
    line("Cause:    ",
         fmt::format("{} {}, {} = {}{}; probability {:.2f}", cause.id, cause.target.words(), cause.amplitude.name,
                     amount(cause.amplitude.value, cause.amplitude.unit), interval, cause.probability));
  }
  std::vector<std::string> rivals;
  for (std::size_t k = d.named; k < d.causes.size(); ++k)
    rivals.push_back(fmt::format("{} ({:.2f})", d.causes[k].id, d.causes[k].probability));
  for (const auto& [one, other] : d.alternatives) rivals.push_back(one + " with " + other);
  if (d.verdict != Verdict::nothing_detected && !d.causes.empty())
    line("Or else:  ", rivals.empty() ? "no other mechanism of the catalogue comes near"
                                      : fmt::format("{}", fmt::join(rivals, ", ")));
  if (d.extension && d.gain) {
    std::string text = fmt::format("|r|² {:.1f} → {:.1f} (by chance {:.1f} would go)", d.gain->before, d.gain->after,
                                   d.gain->expected_under_nothing);
    const auto best =
        std::max_element(d.gain->held_out.begin(), d.gain->held_out.end(),
                         [](const HeldOut& a, const HeldOut& b) { return a.before - a.after < b.before - b.after; });
    if (best != d.gain->held_out.end())
      text += fmt::format("; predicted without having seen it, {}: error {:.2f} → {:.2f} σ", best->block, best->before,
                          best->after);
    const auto worst =
        std::max_element(d.gain->held_out.begin(), d.gain->held_out.end(),
                         [](const HeldOut& a, const HeldOut& b) { return a.after - a.before < b.after - b.before; });
    constexpr double worse = 1.2;
    if (worst != d.gain->held_out.end() && worst->after > worse * worst->before)
      text += fmt::format(", but not {}: {:.2f} → {:.3g} σ", worst->block, worst->before, worst->after);
    if (!d.gain->best_wrong.empty())
      text += fmt::format("; the best wrong one, {}, leaves {:.1f}", d.gain->best_wrong, d.gain->best_wrong_after);
    line("Gain:     ", text);
  }
  if (d.admissibility.stable == false)
    line("Material: ", "the base fit loses " + d.admissibility.where +
                           (d.admissibility.remedy.empty() ? "" : "; " + d.admissibility.remedy + " mends it"));
  if (d.next) line("Next:     ", d.next->description);
  if (d.verdict == Verdict::nothing_detected) line("Could hide:", " " + could_hide(d));
  return fmt::format("{}\n", fmt::join(lines, "\n"));
}

}  // namespace tunica::diagnosis
