// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "budget/mixture.hpp"
#include "budget/unlisted.hpp"
#include "diagnosis/evidence/misfit_size.hpp"

namespace tunica::budget {

using diagnosis::MisfitSize;
using diagnosis::Size;

/// The inputs of a search over mechanisms and terms.
struct Field {
  const diagnosis::Inquiry& inquiry;
  const diagnosis::Analysis& analysis;
  const Mixer& mixer;
  const MisfitSize& size;
  std::vector<Lead> leads;
  std::span<const diagnosis::Refit> known = {};         ///< fits of the diagnosis, which searched more
  std::shared_ptr<const UnlistedMisfit> unlisted = {};  ///< entrants_of() makes it
};

/// Signatures of mechanisms and of terms at the base fit. Mechanisms together weigh as much as terms together. Whole
/// curves of `outliers` take no part: those are offsets.
std::vector<Lead> leads_of(const diagnosis::Analysis& analysis, const discovery::Subject* subject,
                           const std::vector<discovery::KindPointer>& kinds);

/// The leads that explain most of what a fit leaves, best first: of each key one, and of each invariant so many laws.
/// `second_places`: then also the next place of a mechanism that explains a quarter of that. The scores are those of a
/// straight line, by which the right place need not be the first.
std::vector<const Lead*> promising(const Field& field, const Mixture& mixture, std::size_t count, std::size_t laws,
                                   bool second_places = false);

/// The columns of a fit that evidence integrates over: of the base, and of what was added, scaled by its prior width.
struct Columns {
  Eigen::MatrixXd base, added;
};
Columns columns_of(const Field& field, const Mixture& mixture);

/// ln p of the data given the members, beside an unlisted misfit.
double log_evidence(const Field& field, const Mixture& mixture);

/// How believable a member is at the amplitude that a fit gives it.
enum class Belief { plausible, flagged, beyond };  ///< flagged: beyond what is plausible by up to half as much again
Belief belief_of(const Field& field, const Mixture& mixture, std::size_t member);

/// One cause as the only explanation.
struct Entrant {
  std::string id;    ///< of the mechanism, "another_state", or "I2 (linear)"
  std::string sort;  ///< of what is the same but for its form: the invariant of a term and of what acts like it; or id
  diagnosis::Place place;
  diagnosis::CauseGroup group = diagnosis::CauseGroup::material;
  bool term = false, in_the_energy = false;
  double share = 0;  ///< of the misfit beyond noise
  double log_evidence = 0, probability = 0;
  Size rest;
  Belief belief = Belief::plausible;
  std::optional<Mixture> mixture;  ///< none: another state
  Eigen::VectorXd residuals;       ///< whitened
  Columns columns;
  double log_prior = 0;

  /// A term in the principal stretches, which may be written in other invariants.
  [[nodiscard]] bool powers() const { return term && kind().invariant == "stretches"; }
  [[nodiscard]] bool fibres() const { return term && !kind().isotropic(); }
  [[nodiscard]] bool diagonal() const { return term && kind().family == "diagonal"; }

 private:
  [[nodiscard]] const discovery::Kind& kind() const { return *mixture->members.front().term; }
};

/// Every cause that could be fitted, the largest share first; probabilities with "no listed cause" among them, which is
/// `unlisted_probability`.
struct Entrants {
  std::vector<Entrant> all;
  double unlisted_probability = 1;
  bool rough = false;  ///< what the best of them leaves is rougher than an unlisted misfit may be
};

/// Fits the entrants; then sets the unlisted misfit of the field, with shapes of the least degree that leaves nothing
/// rougher than noise behind the best of them, and weighs them beside it.
Entrants entrants_of(Field& field);

}  // namespace tunica::budget
