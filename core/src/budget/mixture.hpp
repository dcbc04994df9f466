// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/naming/refits.hpp"
#include "discovery/bound_set.hpp"
#include "discovery/judgement.hpp"
#include "discovery/set_fit.hpp"

/// How much each cause takes of a misfit, and how much is left: mechanisms and terms of the energy in one search.
namespace tunica::budget {

/// A mechanism, or a term of the energy.
struct Member {
  std::optional<diagnosis::Addition> mechanism;
  discovery::KindPointer term;  ///< null where it is a mechanism

  /// The id of the mechanism, or "I2 (linear)".
  [[nodiscard]] std::string words() const;
  /// What counts as the same cause: the id of the mechanism, or the name of the kind.
  [[nodiscard]] const std::string& key() const { return term ? term->name : mechanism->id; }
};

/// Members fitted together, beside all parameters of the base.
struct Mixture {
  std::vector<Member> members;
  std::shared_ptr<const diagnosis::Extension> extension;  ///< null: the base alone
  std::vector<std::string> names;                         ///< of the parameters of its assembly
  diagnosis::Fit fit;                                     ///< Jacobian by the variables of the extension
  /// Of each member the parameters that it brings, its amplitude first.
  std::vector<std::vector<diagnosis::Variable>> own;
};

/// What a member would show at the base fit, and where a fit with it begins.
struct Lead {
  Member member;
  Eigen::VectorXd signature;  ///< ∂ whitened prediction/∂ amplitude
  MechanismFactory::Side side = MechanismFactory::Side::both;
  double sign = 1;             ///< of the amplitude where the score is positive
  std::vector<double> shapes;  ///< of a term
  double log_prior = 0;
};

/// Binds and fits members to the data of an analysis.
class Mixer {
 public:
  /// `subject`: the model that terms are added to; null where terms cannot be added.
  Mixer(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis, const discovery::Subject* subject)
      : inquiry_(inquiry), analysis_(analysis), subject_(subject) {}

  /// The base alone.
  [[nodiscard]] Mixture base() const;
  /// A refit of the diagnosis, its nuisance parameters fitted.
  [[nodiscard]] Mixture mixture_of(const diagnosis::Refit& refit) const;
  /// The terms that a discovery found; none where they cannot be bound.
  [[nodiscard]] std::optional<Mixture> mixture_of(const discovery::SetFit& found) const;
  /// The same members in the tests of this analysis, fitted from where those of another one ended.
  [[nodiscard]] std::optional<Mixture> again(const Mixture& other) const;
  /// A mixture with one member more, which begins at what the score of its lead promises; none where it cannot be
  /// bound or evaluated.
  [[nodiscard]] std::optional<Mixture> grown(const Mixture& from, const Lead& lead) const;
  /// Some of the members, fitted again from where all of them ended.
  [[nodiscard]] std::optional<Mixture> reduced(const Mixture& from, const std::vector<bool>& kept) const;

 private:
  [[nodiscard]] std::optional<Mixture> bound(std::vector<Member> members) const;
  void fit(Mixture& mixture, const std::vector<double>& start) const;

  const diagnosis::Inquiry& inquiry_;
  const diagnosis::Analysis& analysis_;
  const discovery::Subject* subject_;
};

}  // namespace tunica::budget
