// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "discovery/output/outputs.hpp"
#include "discovery/output/parts.hpp"
#include "text/wrapping.hpp"

namespace tunica::discovery {
namespace {

using diagnosis::Verdict;

std::string amount(const diagnosis::Amplitude& parameter) {
  const std::string unit = parameter.unit == "1" ? "" : " " + parameter.unit;
  return fmt::format("{} = {:.4g}{} ({:.4g} … {:.4g}){}", parameter.name, parameter.value, unit, parameter.low,
                     parameter.high, parameter.at_bound ? ", at its bound" : "");
}

std::string term_line(const FoundTerm& term) {
  std::vector<std::string> parameters;
  for (const diagnosis::Amplitude& parameter : term.parameters)
    if (parameters.size() < 4) parameters.push_back(amount(parameter));
  return fmt::format("{}: {}; probability {:.2f}, of the invariant {:.2f}", words_of({term.kind}),
                     fmt::join(parameters, ", "), term.probability, term.invariant_probability);
}

std::string block_line(const diagnosis::HeldOut& block) {
  return fmt::format("{}: error {:.2f} → {:.2f} σ ({})", block.block, block.before, block.after,
                     block.verdict == diagnosis::BlockVerdict::predicted       ? "predicted"
                     : block.verdict == diagnosis::BlockVerdict::not_predicted ? "not predicted"
                                                                               : "inconclusive");
}

std::string line(const std::string& label, const std::string& words) {
  return text::hanging(fmt::format("{:<10}", label), words) + "\n";
}

}  // namespace

text::StyledText term_summary(const Discovery& d) {
  text::StyledText page;
  for (std::size_t k = 0; k < d.terms.size(); ++k) page += line(k == 0 ? "Terms:" : "", term_line(d.terms[k]));
  for (std::size_t k = 0; k < d.held_out.size(); ++k) page += line(k == 0 ? "Gain:" : "", block_line(d.held_out[k]));
  if (!d.next.empty()) page += line("Next:", d.next);
  return page;
}

text::StyledText summary(const Discovery& d) {
  text::StyledText page = verdict_words(d.judgement);
  if (!d.request.from_nothing)
    page += line("Alarm:",
                 fmt::format("noise alone would look like this with {} ({} values, |r|² = {:.1f})",
                             p_words(d.analysis.alarm.p()), d.analysis.evidence.fit.residuals.size(), d.chi2_before));
  if (d.judgement.name && !d.terms.empty())
    page += line("Name:", fmt::format("the catalogue's {} changes the energy too and leaves |r|² {:.1f}",
                                      d.judgement.name->id, d.judgement.name->chi2));
  if (d.judgement.verdict == Verdict::discovered) {
    const auto rig = std::find_if(d.rivals.begin(), d.rivals.end(), [](const Rival& r) { return !r.in_the_energy; });
    if (rig != d.rivals.end())
      page += line("Rig:", fmt::format("the best error of the rig, {}, leaves |r|² {:.1f}; the terms leave {:.1f}",
                                       rig->id, rig->chi2, d.chi2_after));
  }
  page += term_summary(d);
  return page;
}

}  // namespace tunica::discovery
