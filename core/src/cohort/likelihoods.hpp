// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "cohort/likelihood.hpp"
#include "population/cohort.hpp"

namespace tunica::cohort {

/// The likelihoods of many specimens, for one run. Up to a number they are kept; beyond that they are made again each
/// time, so that memory does not grow with the cohort.
class Likelihoods {
 public:
  using Make = std::function<std::unique_ptr<SpecimenLikelihood>(std::size_t specimen)>;
  Likelihoods(std::size_t count, Make make);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Calls with one specimen; several at a time, each once at a time. Throws what making or calling throws.
  void with(std::size_t specimen, const std::function<void(SpecimenLikelihood&)>& call);
  /// Calls with each specimen, several at a time.
  void for_each(const std::function<void(std::size_t specimen, SpecimenLikelihood&)>& call);
  /// One of them, for what all have in common.
  [[nodiscard]] std::unique_ptr<SpecimenLikelihood> make(std::size_t specimen) const { return make_(specimen); }

 private:
  static constexpr std::size_t most_kept = 2000;
  std::size_t count_;
  Make make_;
  std::vector<std::unique_ptr<SpecimenLikelihood>> kept_;
};

/// Adds parameters, channels, start and expansions to a cohort of specimens: what their likelihoods say. With noise of
/// the cohort, σ of a channel that nobody stated is one number for all specimens, and estimated with the population.
/// Where a test is costly, the means are not corrected by sampling (population/integration.hpp).
/// Refers to `likelihoods`.
void add_expansions(Likelihoods& likelihoods, NoisePool noise, population::Cohort& cohort);

}  // namespace tunica::cohort
