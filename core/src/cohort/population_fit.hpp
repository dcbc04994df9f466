// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "cohort/design.hpp"
#include "cohort/mode.hpp"
#include "population/mixed_model.hpp"

namespace tunica::cohort {

/// The likelihoods of the specimens of a design, for one run. Up to a number they are kept; beyond that they are made
/// again each time, so that memory does not grow with the cohort.
class Likelihoods {
 public:
  using Make = std::function<std::unique_ptr<SpecimenLikelihood>(std::size_t specimen)>;
  Likelihoods(std::size_t count, Make make);

  [[nodiscard]] std::size_t count() const { return count_; }
  /// Calls with each specimen, several at a time; throws what making or calling throws.
  void for_each(const std::function<void(std::size_t specimen, SpecimenLikelihood&)>& call);
  /// One of them, for what all have in common.
  std::unique_ptr<SpecimenLikelihood> make(std::size_t specimen) const { return make_(specimen); }

 private:
  static constexpr std::size_t most_kept = 500;
  std::size_t count_;
  Make make_;
  std::vector<std::unique_ptr<SpecimenLikelihood>> kept_;
};

struct PopulationSettings {
  SpreadStructure spread = SpreadStructure::automatic;
  NoisePool noise = NoisePool::specimen;
};

/// The nonlinear mixed model of one run: specimens expanded about their most likely ξ given the population, in turn
/// with the linear mixed model, until neither moves (M. J. Lindstrom, D. M. Bates, Biometrics 46:673, 1990).
struct PopulationFit {
  population::Structure structure;
  std::vector<population::Individual> individuals;  ///< by specimen of the design
  std::vector<Eigen::VectorXd> animal;              ///< deviation of the specimen's animal
  std::vector<double> noise;                        ///< factor on σ by channel, over the cohort; ones otherwise
  population::Estimates estimates;
  std::size_t rounds = 0;
  bool converged = false;
  std::vector<std::pair<std::size_t, std::string>> failures;  ///< specimens that could not be evaluated, and why

  /// ξ of a specimen given its data and the population.
  [[nodiscard]] population::Gaussian shrunken(std::size_t specimen) const;
};

/// Whether Ω can have covariances: with p parameters and n specimens, where 2 p(p + 1)/2 + 10 ≤ n.
bool carries_covariances(Eigen::Index parameters, std::size_t specimens);

PopulationFit fit_population(Likelihoods& likelihoods, const Design& design, const PopulationSettings& settings);

}  // namespace tunica::cohort
