// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "discovery/common/common_fit.hpp"
#include "discovery/discovery.hpp"

/// Which terms the energy of a tissue lacks, from several specimens: the terms are common, their parameters are each
/// specimen's own. docs/discovery.md.
namespace tunica::discovery {

struct Member {
  std::string id;
  experiment::Experiment experiment;
};

/// A specimen that takes part.
struct SpecimenOutcome {
  std::string id;
  diagnosis::Analysis analysis;
  std::shared_ptr<const Subject> subject;
  double chi2_before = 0, chi2_after = 0, p_after = 1;
  double gain = 0;     ///< ln of the evidence of the terms over the base, from this specimen alone
  bool needed = true;  ///< without it the others choose other invariants
};

struct CommonTerm {
  std::string name;
  KindPointer kind;
  double probability = 0;                           ///< of the invariant and the law, among all sets
  double invariant_probability = 0;                 ///< of the invariant with any law
  std::vector<std::optional<FoundTerm>> specimens;  ///< none where it is too weak to see

  [[nodiscard]] std::size_t seen() const;
};

/// A specimen that cannot take part.
struct LeftOut {
  std::string id, reason;
};

struct CommonDiscovery {
  Request request;
  std::vector<SpecimenOutcome> specimens = {};
  std::vector<LeftOut> left_out = {};
  Judgement judgement = {};
  std::optional<CommonFit> best = {};
  std::vector<CommonTerm> terms = {};
  std::vector<Rival> rivals = {};
  PathDependence paths = {};
  double p_before = 1, chi2_before = 0, chi2_after = 0, p_after = 1;
  std::size_t rows = 0, sets_tried = 0;
  std::vector<diagnosis::Warning> warnings = {};
};

/// One search over all specimens. Deterministic given the seed, for any number of threads. A specimen that cannot be
/// read or fitted is left out with its reason. Throws InputError where none is left, or names do not fit.
CommonDiscovery discover_together(const std::vector<Member>& members, const Request& request,
                                  const plugins::Catalogue& catalogue, const diagnosis::Progress& progress = {});

/// P-value of the rests of several specimens: as many that are not noise, each at 1 in 20, or more.
double p_of_rests(const std::vector<double>& p_values);

}  // namespace tunica::discovery
