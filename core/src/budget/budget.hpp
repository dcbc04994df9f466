// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "budget/proposed_state.hpp"
#include "budget/steps.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/evidence/tolerance.hpp"
#include "discovery/discovery.hpp"

namespace tunica::budget {

using diagnosis::ChannelSize;
using diagnosis::Tolerance;

/// A cause as the only explanation, without its fit.
struct Contender {
  std::string id, sort;
  diagnosis::Place place;
  diagnosis::CauseGroup group = diagnosis::CauseGroup::material;
  bool term = false, in_the_energy = false;
  double share = 0, probability = 0;
  Size rest;
  Belief belief = Belief::plausible;
  std::size_t parameters = 1;  ///< that it adds

  /// One test with its own parameters.
  [[nodiscard]] bool is_state() const { return id == "another_state"; }
  /// What it says of the specimen or the rig, whatever the form of a law is.
  [[nodiscard]] std::string answer() const { return sort + ' ' + place.words(); }
};

/// The misfit of the base, the effects that explain it, and the rest.
struct Budget {
  Tolerance tolerance;
  Size base;
  std::vector<ChannelSize> base_channels, rest_channels;  ///< rest: after the last step
  std::vector<Step> steps;
  std::vector<Contender> contenders;  ///< largest share first; empty where the causes leave noise
  double unlisted_probability = 0;    ///< of "no listed cause, only a smooth misfit"; of meaning with contenders
  bool rough = false;                 ///< what is left is rougher than an unlisted misfit may be: no name is given
  std::optional<Contender> lead;      ///< with_verdict_of() sets it where one cause leads
  /// The correction of the file that explains most of the misfit; share 0: none.
  struct {
    std::string sentence, mend;
    double share = 0;
    double worth = 0;  ///< the share, less what an amplitude of its own has to be ahead of a cause by
  } of_file;
  bool adequate = false;               ///< the bound of the rest is within the tolerance
  std::string anisotropy;              ///< what the data say of directions that the base lacks; empty: nothing
  std::string same_model;              ///< the registered model that the base with its causes is; empty: none
  std::vector<std::string> same_with;  ///< those causes
  /// What the data lack for a mechanism to be tried.
  enum class Lack {
    clock,    ///< there is no time
    order,    ///< the order in which the rows were measured is unknown
    loading,  ///< the first rows lie far from rest
    volume,   ///< neither a lateral stretch nor a volume was measured
    size,     ///< the file does not say how large the specimen is
    time,     ///< a test is costly, and the search would take hours
    group     ///< nothing: the request leaves its group out
  };
  struct Untried {
    std::string id;
    Lack lack;
  };
  std::string lopsided;  ///< which channels an estimated noise lets the fit follow, and which not; empty: none
  std::vector<Untried> not_looked_for;  ///< mechanisms, or terms, that could be the cause
  /// The tests in whose place a cheaper method weighed the causes, and the share of the misfit that all steps take with
  /// the tests themselves; none where they were not fitted.
  struct Cheaper {
    std::vector<std::string> tests;
    std::optional<double> own_share;
  };
  std::optional<Cheaper> cheaper;
  std::shared_ptr<const Mixture> fitted;  ///< all steps; null where there are none
  /// What differs in the test that another state leads in; with_verdict_of() sets it.
  std::shared_ptr<const ProposedState> state;

  [[nodiscard]] Size rest() const { return steps.empty() ? base : steps.back().rest; }
};

/// The budget of a diagnosis. Where the rest is not noise, all causes and terms compete beside a smooth misfit that
/// nobody lists; where it is, the steps are those of its verdict.
Budget budget_of(const diagnosis::Diagnosis& diagnosis, const discovery::Discovery* search,
                 const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                 const diagnosis::Progress& progress = {});

/// The diagnosis with the verdict that the budget allows where its causes leave more than noise: `leading`,
/// `indistinguishable`, or `unknown` with what is the case.
diagnosis::Diagnosis with_verdict_of(Budget& budget, const experiment::Experiment& experiment,
                                     const plugins::Catalogue& catalogue, diagnosis::Diagnosis diagnosis);

}  // namespace tunica::budget
