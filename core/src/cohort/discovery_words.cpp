// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cohort/discovery_study.hpp"
#include "discovery/output/parts.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::cohort {

namespace {

using discovery::CommonTerm;

std::string line(const std::string& label, const std::string& words) {
  return text::hanging(fmt::format("{:<10}", label), words) + "\n";
}

/// "mu 12.1 … 40.3 kPa"
std::string ranges(const CommonTerm& term) {
  std::vector<std::string> all;
  for (const auto& first : term.specimens) {
    if (!first || !all.empty()) continue;
    for (std::size_t p = 0; p < first->parameters.size(); ++p) {
      double low = first->parameters[p].value, high = low;
      for (const auto& one : term.specimens)
        if (one) {
          low = std::min(low, one->parameters[p].value);
          high = std::max(high, one->parameters[p].value);
        }
      all.push_back(fmt::format("{} {:.4g} … {:.4g}{}", first->parameters[p].name, low, high,
                                text::unit_suffix(first->parameters[p].unit)));
    }
  }
  return fmt::format("{}", fmt::join(all, ", "));
}

}  // namespace

text::StyledText discovery_words(const DiscoveryStudy& study) {
  const discovery::CommonDiscovery& found = study.found;
  text::StyledText page = discovery::verdict_words(found.judgement);
  if (!found.request.from_nothing)
    page += line("Alarm:", fmt::format("noise alone would look like this with {} ({} specimens, {} values)",
                                       discovery::p_words(found.p_before), found.specimens.size(), found.rows));
  if (found.judgement.name && !found.terms.empty())
    page += line("Name:", fmt::format("the catalogue's {} changes the energy too and leaves |r|² {:.1f}",
                                      found.judgement.name->id, found.judgement.name->chi2));
  for (std::size_t k = 0; k < found.terms.size(); ++k) {
    const CommonTerm& term = found.terms[k];
    page += line(k == 0 ? "Terms:" : "",
                 fmt::format("{}: {}; in {} of {} specimens; probability {:.2f}, of the invariant {:.2f}",
                             discovery::words_of({term.kind}), ranges(term), term.seen(), found.specimens.size(),
                             term.probability, term.invariant_probability));
  }
  for (std::size_t k = 0; k < found.left_out.size(); ++k)
    page += line(k == 0 ? "Left out:" : "", fmt::format("{}: {}", found.left_out[k].id, found.left_out[k].reason));
  if (!study.not_extended.empty()) page += line("Note:", "there is no extended.json: " + study.not_extended);
  return page;
}

}  // namespace tunica::cohort
