// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "rows.hpp"

namespace blind::score {

void outside_rows(const Cases& cases, std::vector<Figure>& table) {
  Share honest, hedged, unmarked, detected;
  for (const Case& one : cases) {
    if (one.truth.set != "outside" || !one.truth.effects.front().reached) continue;
    const Verdict verdict = judged(one);
    detected.add(verdict.detected());
    if (!verdict.detected()) continue;
    const auto set = claimed(verdict);
    // What is named together is one answer, not a set of rivals; the rival may be what the catalogue does not list.
    const bool open = verdict.verdict == "unknown" || verdict.verdict == "indistinguishable" ||
                      set.size() > std::max<std::size_t>(1, together(verdict));
    if (one.truth.remainder >= 25) {
      honest.add(open);
      continue;
    }
    const auto has = [&set](const std::string& id) {
      return !id.empty() && std::find(set.begin(), set.end(), id) != set.end();
    };
    const bool with_look_alike = set.size() > 1 && (has(one.truth.look_alike) || has(one.truth.nearest));
    const bool marked =
        std::any_of(verdict.causes.begin(), verdict.causes.end(), [](const Cause& c) { return c.hedged; });
    hedged.add(verdict.verdict == "unknown" || with_look_alike || marked);
    unmarked.add(verdict.verdict == "unknown" || with_look_alike);
  }
  table.push_back(share("outside the catalogue, remainder ≥ 25: unknown or a set", honest, at_least(0.90),
                        at_least(0.95), "of those detected"));
  table.push_back(share("outside, remainder below: in a set with its look-alike, or \"consistent with\"", hedged,
                        at_least(0.90), at_least(0.95),
                        fmt::format("of those detected; every name is marked so, and without the mark {:.3f}",
                                    unmarked.total == 0 ? 0.0 : unmarked.value())));
  table.push_back(share("outside, detected", detected, {}, {}));
}

}  // namespace blind::score
