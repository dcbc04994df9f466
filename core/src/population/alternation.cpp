// SPDX-License-Identifier: Apache-2.0
#include "population/alternation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "numerics/eigenpairs.hpp"
#include "tunica/error.hpp"

namespace tunica::population {
namespace {

constexpr std::size_t most_rounds = 80;
constexpr double agreed = 1e-4;
constexpr std::size_t patient = 5;  // rounds before a slow approach counts as a cycle
constexpr double slow = 0.7, damping = 0.7, least_part = 0.1;
constexpr double narrowest = 1e-3;  // of a prior, in scales

bool finite(const Expansion& expansion) {
  for (const Quadratic& channel : expansion.channels)
    if (channel.rows > 0 &&
        !(channel.information.allFinite() && channel.score.allFinite() && std::isfinite(channel.squares)))
      return false;
  return expansion.point.allFinite();
}

void expand(const Cohort& cohort, const std::vector<Prior>& priors, Alternation& state) {
  const std::size_t n = cohort.specimens.size();
  std::vector<std::optional<Expansion>> fresh(n);
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t i) { fresh[i] = cohort.expand(i, priors[i]); });
  state.failures.clear();
  const bool first = state.expansions.empty();
  if (first) state.expansions.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (fresh[i] && finite(*fresh[i])) {
      state.expansions[i] = std::move(*fresh[i]);
      continue;
    }
    if (first)
      throw InputError(
          fmt::format("specimen '{}' cannot be evaluated near the mean of the cohort; leave it out or fit it "
                      "alone to see why",
                      cohort.specimens[i].name));
    state.failures.push_back(i);
  }
}

/// The weakest direction of the total information, in scales: a cohort cannot determine what no specimen determines.
void check_information(const Cohort& cohort, const std::vector<Expansion>& expansions) {
  const auto p = static_cast<Eigen::Index>(cohort.parameters.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p);
  for (const Expansion& expansion : expansions)
    for (const Quadratic& channel : expansion.channels)
      if (channel.rows > 0) sum += channel.information;
  for (Eigen::Index j = 0; j < p; ++j) {
    const double scale = cohort.parameters[static_cast<std::size_t>(j)].scale;
    sum.row(j) *= scale;
    sum.col(j) *= scale;
  }
  const numerics::Eigenpairs pairs = numerics::eigenpairs(sum);
  if (pairs.values[0] > 1e-12 * pairs.values[p - 1]) return;
  Eigen::Index worst = 0;
  pairs.vectors.col(0).cwiseAbs().maxCoeff(&worst);
  throw InputError(
      fmt::format("the data of all {} specimens together do not fix '{}'; fix it or measure what it acts on",
                  expansions.size(), cohort.parameters[static_cast<std::size_t>(worst)].name));
}

/// Noise of the rows about the expansions, for a start.
std::vector<double> noise(const Cohort& cohort, const std::vector<Expansion>& expansions) {
  std::vector<double> result(cohort.channels.size(), 1.0);
  for (std::size_t c = 0; c < result.size(); ++c) {
    double squares = 0, rows = 0;
    for (const Expansion& expansion : expansions) {
      squares += expansion.channels[c].squares;
      rows += expansion.channels[c].rows;
    }
    if (cohort.channels[c].estimated && rows > 0) result[c] = std::max(squares / rows, 1e-10);
  }
  return result;
}

void solve(const Cohort& cohort, const Form& form, const Coordinates& coordinates, std::vector<double> x,
           Alternation& state) {
  const LinearModel model(cohort, form.design, state.expansions, form.likelihood);
  state.maximum = maximise(model, coordinates, std::move(x));
  state.variances = coordinates.variances(state.maximum.x);
  state.means = model.means(state.variances, true);
  if (!state.means.fixed)
    throw InputError(fmt::format("the data of the {} specimens do not fix the means of all groups; leave a factor out",
                                 cohort.specimens.size()));
}

/// What the priors are made of: coordinates of the variances, and the mean of every specimen.
struct Belief {
  std::vector<double> x;
  std::vector<Eigen::VectorXd> means;
};

/// The largest difference from the estimates, in tolerances.
double disagreement(const Belief& belief, const Alternation& state) {
  double worst = 0;
  for (std::size_t k = 0; k < belief.x.size(); ++k)
    worst = std::max(worst, std::abs(state.maximum.x[k] - belief.x[k]) / agreed);
  const Eigen::Index p = belief.means.front().size();
  const Eigen::ArrayXd error = state.means.covariance.diagonal().head(p).array().sqrt();
  for (std::size_t i = 0; i < belief.means.size(); ++i)
    worst =
        std::max(worst, ((state.means.of_specimen[i] - belief.means[i]).array().abs() / (agreed * error)).maxCoeff());
  return worst;
}

/// Moves the belief a `part` of the way to the estimates, within what the points of expansion allow.
void follow(const Cohort& cohort, const Coordinates& coordinates, const Alternation& state, double part,
            Belief& belief) {
  Eigen::ArrayXd low = state.expansions.front().point, high = low;
  for (const Expansion& expansion : state.expansions) {
    low = low.min(expansion.point.array());
    high = high.max(expansion.point.array());
  }
  Eigen::ArrayXd scale(low.size());
  for (Eigen::Index j = 0; j < scale.size(); ++j) scale[j] = cohort.parameters[static_cast<std::size_t>(j)].scale;
  for (std::size_t i = 0; i < belief.means.size(); ++i)
    belief.means[i] = (belief.means[i] + part * (state.means.of_specimen[i] - belief.means[i]))
                          .array()
                          .max(low - scale)
                          .min(high + scale);
  for (std::size_t k = 0; k < belief.x.size(); ++k) belief.x[k] += part * (state.maximum.x[k] - belief.x[k]);
  for (const Coordinates::Spread& spread : coordinates.spreads()) {
    const auto j = static_cast<Eigen::Index>(spread.parameter);
    double& value = belief.x[spread.coordinate];
    value = std::min(value, 0.5 + 2 * (high[j] - low[j]) / scale[j]);
  }
}

}  // namespace

Eigen::MatrixXd prior_precision(const Cohort& cohort, const Variances& variances) {
  Eigen::MatrixXd covariance = variances.within * variances.within.transpose();
  for (std::size_t j = 0; j < cohort.parameters.size(); ++j) {
    const double least = narrowest * cohort.parameters[j].scale;
    covariance(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(j)) += least * least;
  }
  const numerics::Eigenpairs pairs = numerics::eigenpairs(covariance);
  return pairs.vectors * pairs.values.cwiseInverse().asDiagonal() * pairs.vectors.transpose();
}

Alternation alternate(const Cohort& cohort, const Form& form, const Alternation* from) {
  const Coordinates coordinates(cohort, form.within, form.between);
  const std::size_t n = cohort.specimens.size();
  Alternation state;
  if (from == nullptr) {
    Eigen::VectorXd wide(cohort.start.size());
    for (Eigen::Index j = 0; j < wide.size(); ++j)
      wide[j] = std::pow(cohort.parameters[static_cast<std::size_t>(j)].scale, -2);
    const Prior prior{cohort.start, wide.asDiagonal(), std::vector<double>(cohort.channels.size(), 1.0)};
    expand(cohort, std::vector<Prior>(n, prior), state);
  } else {
    state.expansions = from->expansions;
  }
  check_information(cohort, state.expansions);
  solve(cohort, form, coordinates, coordinates.start(noise(cohort, state.expansions)), state);
  Belief belief{state.maximum.x, state.means.of_specimen};
  follow(cohort, coordinates, state, 1, belief);
  double part = 1, before = HUGE_VAL;
  while (!state.converged && state.rounds < most_rounds) {
    ++state.rounds;
    const Variances variances = coordinates.variances(belief.x);
    const Eigen::MatrixXd sharpness = prior_precision(cohort, variances);
    std::vector<Prior> priors;
    for (std::size_t i = 0; i < n; ++i) priors.push_back({belief.means[i], sharpness, variances.noise});
    expand(cohort, priors, state);
    solve(cohort, form, coordinates, state.maximum.x, state);
    const double now = disagreement(belief, state);
    state.converged = now < 1;
    if (state.rounds > patient && now > slow * before) part = std::max(part * damping, least_part);
    before = now;
    follow(cohort, coordinates, state, part, belief);
  }
  return state;
}

Alternation refitted(const Cohort& cohort, const Form& form, const Alternation& from) {
  const Coordinates coordinates(cohort, form.within, form.between);
  Alternation state;
  state.expansions = from.expansions;
  solve(cohort, form, coordinates, coordinates.start(from.variances.noise), state);
  state.converged = state.maximum.converged;
  return state;
}

double deviance(const Alternation& alternation, Likelihood likelihood) {
  double value = alternation.maximum.value;
  for (const Expansion& expansion : alternation.expansions) value += expansion.normalisation;
  if (likelihood == Likelihood::restricted)
    value -= static_cast<double>(alternation.means.beta.size()) * std::log(2 * std::numbers::pi);
  return value;
}

}  // namespace tunica::population
