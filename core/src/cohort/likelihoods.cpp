// SPDX-License-Identifier: Apache-2.0
#include "cohort/likelihoods.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <tbb/parallel_for.h>

#include "cohort/index.hpp"
#include "cohort/mode.hpp"
#include "numerics/eigenpairs.hpp"

namespace tunica::cohort {

namespace {

/// The shared state of the expansions; each specimen writes only its own entries.
struct Shared {
  std::map<std::string, std::size_t> channel;  ///< number of each name
  std::size_t count = 0;                       ///< channels, priors the last
  std::vector<double> common;                  ///< σ of a channel for all specimens; 0 = its own
  std::vector<Eigen::VectorXd> last;           ///< where each specimen's search ended
};

Eigen::MatrixXd root_of_inverse(const Eigen::MatrixXd& precision) {
  const numerics::Eigenpairs pairs = numerics::eigenpairs(precision);
  return pairs.vectors * pairs.values.cwiseInverse().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// The likelihood may have been made anew, with the noise of its own fit.
void set_noise(const Shared& shared, SpecimenLikelihood& one) {
  for (std::size_t c = 0; c < one.channels().size(); ++c)
    if (const double common = shared.common[shared.channel.at(one.channels()[c])];
        common > 0 && !one.noise_is_stated(c))
      one.scale_noise(c, common / one.noise(c));
}

std::optional<population::Expansion> expansion_of(const population::Prior& prior, const Shared& shared,
                                                  const Eigen::VectorXd& start, SpecimenLikelihood& one) {
  std::vector<double> noise;
  for (const std::string& name : one.channels()) noise.push_back(std::sqrt(prior.variances[shared.channel.at(name)]));
  Mode mode = most_likely(one, prior.mean, root_of_inverse(prior.precision), noise, start);
  if (!mode.status.ok()) return {};
  const Eigen::Index p = mode.at.size();
  const population::Quadratic nothing{Eigen::MatrixXd::Zero(p, p), Eigen::VectorXd::Zero(p), 0, 0};
  population::Expansion expansion{mode.at, std::vector<population::Quadratic>(shared.count, nothing), 0};
  for (std::size_t c = 0; c < mode.channels.size(); ++c) {
    ChannelSquares& squares = mode.channels[c];
    if (squares.rows == 0) continue;
    const bool prior_rows = c == one.channels().size();
    expansion.channels[prior_rows ? shared.count - 1 : shared.channel.at(one.channels()[c])] = {
        std::move(squares.information), std::move(squares.gradient), squares.squares,
        static_cast<double>(squares.rows)};
  }
  expansion.normalisation = one.log_noise() + static_cast<double>(one.rows()) * std::log(2 * std::numbers::pi);
  return expansion;
}

/// Σ_c |r_c|²/φ_c at every point, priors included; +∞ where it cannot be evaluated.
Eigen::VectorXd misfits_of(const Shared& shared, const Eigen::MatrixXd& points, const std::vector<double>& variances,
                           SpecimenLikelihood& one) {
  Eigen::VectorXd misfits(points.cols()), r;
  for (Eigen::Index s = 0; s < points.cols(); ++s) {
    misfits[s] = HUGE_VAL;
    if (!one.residuals(points.col(s), r, nullptr).ok()) continue;
    misfits[s] = r.tail(r.size() - static_cast<Eigen::Index>(one.first().back())).squaredNorm();
    for (std::size_t c = 0; c < one.channels().size(); ++c) {
      const auto first = static_cast<Eigen::Index>(one.first()[c]),
                 last = static_cast<Eigen::Index>(one.first()[c + 1]);
      misfits[s] += r.segment(first, last - first).squaredNorm() / variances[shared.channel.at(one.channels()[c])];
    }
  }
  return misfits;
}

/// σ of each channel that is not stated, quadratic mean over the specimens.
void share_noise(Likelihoods& likelihoods, Shared& shared) {
  std::vector<std::vector<double>> sigma(likelihoods.count());
  likelihoods.for_each([&](std::size_t i, SpecimenLikelihood& one) {
    sigma[i].assign(shared.count, 0);
    for (std::size_t c = 0; c < one.channels().size(); ++c)
      if (!one.noise_is_stated(c)) sigma[i][shared.channel.at(one.channels()[c])] = one.noise(c);
  });
  for (std::size_t c = 0; c + 1 < shared.count; ++c) {
    double squares = 0, count = 0;
    for (const auto& of_specimen : sigma) {
      squares += of_specimen[c] * of_specimen[c];
      count += of_specimen[c] > 0 ? 1 : 0;
    }
    if (count > 0) shared.common[c] = std::sqrt(squares / count);
  }
}

}  // namespace

Likelihoods::Likelihoods(std::size_t count, Make make) : count_(count), make_(std::move(make)) {
  if (count <= most_kept) kept_.resize(count);
}

void Likelihoods::with(std::size_t specimen, const std::function<void(SpecimenLikelihood&)>& call) {
  if (kept_.empty()) {
    const auto once = make_(specimen);
    return call(*once);
  }
  if (!kept_[specimen]) kept_[specimen] = make_(specimen);
  call(*kept_[specimen]);
}

void Likelihoods::for_each(const std::function<void(std::size_t, SpecimenLikelihood&)>& call) {
  tbb::parallel_for(std::size_t{0}, count_,
                    [&](std::size_t k) { with(k, [&](SpecimenLikelihood& one) { call(k, one); }); });
}

void add_expansions(Likelihoods& likelihoods, NoisePool noise, population::Cohort& cohort) {
  const auto shared = std::make_shared<Shared>();
  shared->last.resize(likelihoods.count());
  std::vector<std::vector<std::string>> names(likelihoods.count());
  likelihoods.for_each([&](std::size_t i, SpecimenLikelihood& one) {
    names[i] = one.channels();
    shared->last[i] = one.best();
  });
  for (const auto& of_specimen : names)
    for (const std::string& name : of_specimen)
      if (shared->channel.try_emplace(name, shared->channel.size()).second)
        cohort.channels.push_back({name, noise == NoisePool::cohort});
  cohort.channels.push_back({"priors", false});
  shared->count = cohort.channels.size();
  shared->common.assign(shared->count, 0);
  if (noise == NoisePool::cohort) share_noise(likelihoods, *shared);
  bool costly = false;
  likelihoods.with(0, [&](SpecimenLikelihood& one) {
    costly = one.layout().has_costly_tests;
    for (const assembly::FreeParameter& parameter : one.layout().parameters)
      cohort.parameters.push_back({parameter.name, parameter.scale == Scale::log,
                                   parameter.scale == Scale::log ? 1 : 0.25 * (parameter.max - parameter.min)});
  });
  cohort.start = Eigen::VectorXd::Zero(shared->last.front().size());
  for (const Eigen::VectorXd& one : shared->last) cohort.start += one / static_cast<double>(shared->last.size());
  cohort.expand = [&likelihoods, shared](std::size_t i, const population::Prior& prior) {
    std::optional<population::Expansion> found;
    likelihoods.with(i, [&](SpecimenLikelihood& one) {
      set_noise(*shared, one);
      found = expansion_of(prior, *shared, shared->last[i], one);
      if (found) shared->last[i] = found->point;
    });
    return found;
  };
  // The correction of means needs hundreds of points per specimen: too many if a simulation takes seconds.
  if (costly) return;
  cohort.misfits = [&likelihoods, shared](std::size_t i, const Eigen::MatrixXd& points,
                                          const std::vector<double>& variances) {
    Eigen::VectorXd misfits;
    likelihoods.with(i, [&](SpecimenLikelihood& one) {
      set_noise(*shared, one);
      misfits = misfits_of(*shared, points, variances, one);
    });
    return misfits;
  };
}

}  // namespace tunica::cohort
