// SPDX-License-Identifier: Apache-2.0
#include "discovery/common/common_rivals.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <string>

namespace tunica::discovery {
namespace {

struct Tally {
  Rival rival;
  std::size_t seen = 0, plausible = 0, clean = 0;
};

}  // namespace

std::vector<Rival> common_rivals(const std::vector<std::vector<Rival>>& of_specimens, const CommonFit& base) {
  std::map<std::string, Rival> known;
  for (const auto& rivals : of_specimens)
    for (const Rival& rival : rivals) known.emplace(rival.id, rival);
  std::vector<Rival> common;
  for (auto& [id, first] : known) {
    Tally tally{first};
    tally.rival.log_evidence = first.log_prior;
    tally.rival.chi2 = 0;
    for (std::size_t s = 0; s < of_specimens.size(); ++s) {
      const SetFit& root = base.specimens[s];
      double evidence = data_evidence(root, false), chi2 = root.chi2();
      const auto own = std::find_if(of_specimens[s].begin(), of_specimens[s].end(),
                                    [&first = first](const Rival& rival) { return rival.id == first.id; });
      const bool shows = own != of_specimens[s].end() && own->log_evidence - own->log_prior > evidence;
      if (shows) {
        evidence = own->log_evidence - own->log_prior;
        chi2 = own->chi2;
        ++tally.seen;
        tally.plausible += own->plausible ? 1 : 0;
      }
      tally.clean += (own != of_specimens[s].end() && own->clean) ? 1 : 0;
      tally.rival.log_evidence += evidence - std::numbers::ln2;
      tally.rival.chi2 += chi2;
    }
    tally.rival.plausible = 2 * tally.plausible >= tally.seen;
    tally.rival.clean = 10 * tally.clean >= 9 * of_specimens.size();
    common.push_back(std::move(tally.rival));
  }
  std::stable_sort(common.begin(), common.end(),
                   [](const Rival& a, const Rival& b) { return a.log_evidence > b.log_evidence; });
  return common;
}

}  // namespace tunica::discovery
