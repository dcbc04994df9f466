// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cohort/analysis.hpp"
#include "cohort/diagnosis_study.hpp"
#include "cohort/remarks.hpp"

namespace tunica::cohort {

/// A specimen that is unlike the others.
struct Outlier {
  std::size_t specimen = 0;  ///< position in the table
  double p = 1;              ///< of one so far from what the others predict, for all specimens together (Holm)
  std::string farthest;      ///< the parameter that it is farthest in
};

/// One specimen with the help of the others.
struct ShrunkenParameter {
  Estimated estimate;
  double borrowed = 0;  ///< weight of the population's mean: 0 = its own data say all
};

/// The curve of the mean material, and where that of a new specimen will be with 95 % probability.
struct Band {
  std::string test, channel, unit, over, over_unit, group;
  std::vector<double> abscissa, mean, lower, upper;
};

/// One reading of the specimens.
struct ReadingStudy {
  ReadingEntry entry;
  std::vector<std::size_t> specimens;  ///< positions in the table, of those that have it
  std::vector<Estimated> values;
  std::vector<std::pair<std::size_t, std::string>> missing;  ///< and those that do not, with the reason
};

/// All readings, and their statistics over all specimens.
struct ReadingsStudy {
  std::vector<ReadingStudy> readings;
  std::optional<Analysis> analysis;  ///< of those that two specimens have at least
  std::string problem;               ///< why there is no analysis
};

/// What one run of the experiment says of all specimens together.
struct PopulationStudy {
  std::string run, model;
  Members members;
  bool full = false, nested = false, converged = false;
  std::size_t rounds = 0;
  Analysis parameters;
  std::vector<std::vector<ShrunkenParameter>> shrunken;  ///< by member, and parameter
  std::vector<Outlier> outliers;                         ///< p < 0.05 only
  ReadingsStudy readings;
  std::vector<Band> bands;
  std::vector<std::pair<std::string, double>>
      noise;  ///< σ by channel over what the specimens' own fits say, with noise of the cohort
  double neg2_likelihood = 0, aic = 0, bic = 0;
  std::string problem;  ///< why there is no population; empty = there is
};

/// A whole cohort.
struct Study {
  std::vector<PopulationStudy> populations;  ///< one a run
  std::vector<Remark> remarks;
  std::optional<DiagnosisStudy> diagnosis;  ///< where the cohort file asks for it
};

/// Draws of new specimens for the bands.
constexpr std::size_t band_draws = 1000;

/// Everything that is said of all specimens together, from their records and the evidence in `results`. Deterministic,
/// for any number of threads.
Study study(const Specification& cohort, const SpecimenTable& table, const Template& pattern, const Collection& found,
            const plugins::Catalogue& catalogue, const std::filesystem::path& results,
            const std::function<void(const std::string& stage, double share)>& told = {});

}  // namespace tunica::cohort
