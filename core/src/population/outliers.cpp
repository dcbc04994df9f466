// SPDX-License-Identifier: Apache-2.0
#include "population/outliers.hpp"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

#include "numerics/distributions.hpp"
#include "numerics/eigenpairs.hpp"
#include "population/multiplicity.hpp"

namespace tunica::population {
namespace {

constexpr std::size_t hides = 60;  // one specimen of more moves a variance by little, and is left out of β alone

struct Distance {
  double squared = 0;
  std::size_t rank = 0;
};

/// v·V⁺v in directions that the data see, in scales so that units do not decide.
Distance distance(const Cohort& cohort, Eigen::VectorXd v, Eigen::MatrixXd V) {
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    const double scale = cohort.parameters[static_cast<std::size_t>(j)].scale;
    v[j] *= scale;
    V.row(j) *= scale;
    V.col(j) *= scale;
  }
  const numerics::Eigenpairs pairs = numerics::eigenpairs(V);
  Distance result;
  for (Eigen::Index j = 0; j < v.size(); ++j) {
    if (!(pairs.values[j] > 1e-9 * pairs.values[v.size() - 1])) continue;
    const double along = pairs.vectors.col(j).dot(v);
    result.squared += along * along / pairs.values[j];
    ++result.rank;
  }
  return result;
}

/// The cohort with one specimen that has measured nothing.
std::vector<Expansion> without(std::vector<Expansion> expansions, std::size_t k) {
  for (Quadratic& channel : expansions[k].channels) channel.rows = 0;
  return expansions;
}

double chance_of(const Standing& standing, Shape shape) {
  const double r = static_cast<double>(standing.rank), squared = standing.distance * standing.distance;
  const double below = standing.freedom - r + 1;
  if (shape == Shape::diagonal || below < 1) return numerics::f_above(squared / r, r, standing.freedom);
  return numerics::f_above(squared * below / (r * standing.freedom), r, below);
}

}  // namespace

std::vector<Standing> outliers(const Cohort& given, const Population& population) {
  const Sorted sorted = population::sorted(given);
  const Cohort& cohort = sorted.cohort;
  const Alternation& fit = population.alternation;
  const std::size_t n = cohort.specimens.size();
  const double freedom = static_cast<double>(n) - 1 - static_cast<double>(population.design.size());
  if (freedom < 1) return {};
  std::optional<Shape> between;
  if (population.between) between = population.between->shape;
  const Coordinates coordinates(cohort, population.within.shape, between);
  std::vector<std::optional<Standing>> found(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t k) {
    const std::vector<Expansion> others = without(fit.expansions, k);
    const LinearModel model(cohort, population.design, others, Likelihood::restricted);
    Variances variances = fit.variances;
    if (!model.means(variances, false).fixed) return;
    if (n <= hides) variances = coordinates.variances(maximise(model, coordinates, fit.maximum.x).x);
    const Means means = model.means(variances, true);
    if (!means.fixed) return;
    const Marginal own = integrate_specimens({fit.expansions[k]}, variances).front();
    const Eigen::VectorXd v = own.w + own.W * (means.of_specimen[k] - own.point);
    const Eigen::MatrixXd V = own.W + own.W * means.of_specimen_covariance[k] * own.W;
    const Distance d = distance(cohort, v, V);
    if (d.rank == 0) return;
    Standing standing{sorted.place[k], std::sqrt(d.squared), d.rank, freedom};
    standing.p_value = chance_of(standing, population.within.shape);
    double farthest = -1;
    for (Eigen::Index j = 0; j < v.size(); ++j) {
      const double spread = std::sqrt(population.omega(j, j));
      const double away = spread > 0 ? std::abs(population.individuals[sorted.place[k]].effect[j]) / spread : 0;
      if (away <= farthest) continue;
      farthest = away;
      standing.farthest = static_cast<std::size_t>(j);
    }
    found[k] = standing;
  });
  std::vector<Standing> result;
  std::vector<double> p_values;
  for (const auto& standing : found) {
    if (!standing) continue;
    result.push_back(*standing);
    p_values.push_back(standing->p_value);
  }
  const std::vector<double> adjusted = holm(p_values);
  for (std::size_t k = 0; k < result.size(); ++k) {
    result[k].holm = adjusted[k];
    result[k].outlying = adjusted[k] < 0.05;
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Standing& a, const Standing& b) { return a.p_value < b.p_value; });
  return result;
}

}  // namespace tunica::population
