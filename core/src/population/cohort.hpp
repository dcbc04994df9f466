// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

/// Statistics of a cohort of specimens: nonlinear mixed effects, groups, power. It knows numbers only, no experiments.
namespace tunica::population {

/// A coordinate ξ_j of the search: log θ_j where `logarithmic`, else θ_j.
struct Parameter {
  std::string name;
  bool logarithmic = true;
  double scale = 1;  ///< what counts as a large difference of ξ_j; spreads are searched up to 20 of them
};

/// A property that sorts specimens into groups; the first level is the reference.
struct Factor {
  std::string name;
  std::vector<std::string> levels;  ///< two at least
};

struct Specimen {
  std::string name;  ///< unique; results do not depend on the order of specimens, because names sort them
  std::vector<std::size_t> levels;  ///< of each factor
  std::size_t animal = 0;           ///< into Cohort::animals; ignored where that is empty
};

/// Noise group of rows that share one variance φ_c, in units of the variance that the residuals were whitened by.
struct Channel {
  std::string name;
  bool estimated = true;  ///< false: φ_c = 1
};

/// Residuals r ≈ r₀ + J (ξ − ξ₀) of one channel of one specimen: r·r = s + 2 g·(ξ − ξ₀) + (ξ − ξ₀)·A (ξ − ξ₀).
struct Quadratic {
  Eigen::MatrixXd information;  ///< A = JᵀJ, may be singular
  Eigen::VectorXd score;        ///< g = Jᵀ r₀
  double squares = 0;           ///< s = r₀·r₀
  double rows = 0;
};

struct Expansion {
  Eigen::VectorXd point;            ///< ξ₀
  std::vector<Quadratic> channels;  ///< as Cohort::channels; zeros where the specimen has no such rows
  double normalisation = 0;  ///< Σ log(2πσ²) over the rows, σ as they were whitened; only −2 log L needs it
  Eigen::VectorXd pull =
      {};  ///< added to the score, and `bend` to the information: see integration.hpp; empty = nothing
  Eigen::MatrixXd bend = {};
};

/// ξ ~ N(mean, precision⁻¹), and the variance φ_c of every channel.
struct Prior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd precision;
  std::vector<double> variances;
};

/// The expansion of specimen i about its maximum a posteriori, argmin Σ_c |r_c(ξ)|²/φ_c + (ξ − mean)·precision (ξ −
/// mean). Called from several threads, once at a time for a specimen. Nothing where the search failed: the specimen
/// keeps its earlier expansion then.
using Expand = std::function<std::optional<Expansion>(std::size_t specimen, const Prior& prior)>;

/// Σ_c |r_c(ξ)|²/φ_c of specimen i for every column ξ of `points`; +∞ where it cannot be evaluated. Called like Expand.
using Misfits = std::function<Eigen::VectorXd(std::size_t specimen, const Eigen::MatrixXd& points,
                                              const std::vector<double>& variances)>;

struct Cohort {
  std::vector<Parameter> parameters;
  std::vector<Factor> factors;
  std::vector<Specimen> specimens;
  std::vector<std::string> animals;  ///< empty: specimens are not nested
  std::vector<Channel> channels;
  Eigen::VectorXd start;  ///< mean of the first, weak prior, one scale wide
  Expand expand;
  Misfits misfits;  ///< may be empty: then the linearised curves are all that counts, as in nlme
};

/// The cohort with its specimens sorted by name and its animals in the order of their first specimen, so that sums run
/// in an order that the table of specimens does not decide.
struct Sorted {
  Cohort cohort;
  std::vector<std::size_t> place;  ///< place[k]: where the caller has the sorted specimen k
};
/// Throws InputError where fewer than two specimens are left, where a factor has one level or a level no specimen,
/// or where a name is there twice.
Sorted sorted(const Cohort& cohort);

}  // namespace tunica::population
