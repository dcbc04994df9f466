// SPDX-License-Identifier: Apache-2.0
#include "discovery/curves.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include <tbb/parallel_for.h>

#include "discovery/term_slope.hpp"
#include "numerics/orthogonal.hpp"

namespace tunica::discovery {
namespace {

constexpr std::size_t points = 61;
constexpr double two_sided = 1.96;

/// Fits a set kind by kind.
std::optional<SetFit> assembled(const Fitter& fitter, const std::vector<KindPointer>& kinds) {
  SetFit fit = fitter.root();
  for (const KindPointer& kind : kinds) {
    auto larger = fitter.grown(fit, kind, -INFINITY);
    if (!larger) return std::nullopt;
    fit = std::move(*larger);
  }
  return fit;
}

}  // namespace

Eigen::MatrixXd covariance(const diagnosis::Fit& fit) {
  Eigen::MatrixXd J = fit.jacobian;
  Eigen::VectorXd lengths = Eigen::VectorXd::Zero(J.cols());
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    if (fit.at_bound[static_cast<std::size_t>(k)]) J.col(k).setZero();
    lengths[k] = J.col(k).norm();
    if (lengths[k] > 0) J.col(k) /= lengths[k];
  }
  const Eigen::MatrixXd inverse = numerics::pseudo_inverse(J);
  Eigen::MatrixXd C = inverse * inverse.transpose();
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const double scale = lengths[k] > 0 ? 1 / lengths[k] : 0;
    C.row(k) *= scale;
    C.col(k) *= scale;
  }
  return C;
}

TermCurve curve_of_term(const Subject& subject, const SetFit& fit, std::size_t which) {
  const Kind& kind = *fit.kinds[which];
  const std::vector<std::size_t> indices = parameters_of(fit.set->terms()[which]);
  std::vector<double> own;
  for (const std::size_t j : indices) own.push_back(fit.fit.free[j]);
  const auto n = static_cast<Eigen::Index>(points), m = static_cast<Eigen::Index>(own.size());
  TermCurve curve;
  curve.x.resize(points);
  curve.slope.resize(points);
  Eigen::MatrixXd by_parameters = Eigen::MatrixXd::Zero(n, m);
  if (kind.invariant == "stretches") {
    // ψ = μ/α λ^α:  ψ' = μ λ^(α−1),  ∂ψ'/∂μ = λ^(α−1),  ∂ψ'/∂α = μ λ^(α−1) ln λ
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(points - 1);
      const double lambda = std::exp(kind.reach.low + t * (kind.reach.high - kind.reach.low));
      const double power = std::pow(lambda, own[1] - 1);
      curve.x[static_cast<std::size_t>(i)] = lambda;
      curve.slope[static_cast<std::size_t>(i)] = own[0] * power;
      by_parameters(i, 0) = power;
      by_parameters(i, 1) = own[0] * power * std::log(lambda);
    }
  } else {
    for (std::size_t i = 0; i < points; ++i)
      curve.x[i] =
          kind.least() + (kind.reach.high - kind.least()) * static_cast<double>(i) / static_cast<double>(points - 1);
    std::vector<double> by;
    curve.slope = term_slopes(subject, kind, own, curve.x, &by);
    for (std::size_t j = 0; j < by.size() / points; ++j)
      for (std::size_t i = 0; i < points; ++i)
        by_parameters(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = by[j * points + i];
  }
  const Eigen::MatrixXd all = covariance(fit.fit);
  Eigen::MatrixXd C(m, m);
  for (Eigen::Index a = 0; a < m; ++a)
    for (Eigen::Index b = 0; b < m; ++b)
      C(a, b) = all(static_cast<Eigen::Index>(indices[static_cast<std::size_t>(a)]),
                    static_cast<Eigen::Index>(indices[static_cast<std::size_t>(b)]));
  for (std::size_t i = 0; i < points; ++i) {
    const Eigen::VectorXd g = by_parameters.row(static_cast<Eigen::Index>(i)).transpose();
    const double half = two_sided * std::sqrt(std::max(g.dot(C * g), 0.0));
    curve.low.push_back(curve.slope[i] - half);
    curve.high.push_back(curve.slope[i] + half);
  }
  return curve;
}

TermCurve mixed_curve(const Subject& subject, const std::vector<SetFit>& sets, std::size_t which) {
  constexpr double least_weight = 0.01;
  const SetFit& best = sets.front();
  const auto invariants = [](const SetFit& set) {
    std::vector<std::string> words;
    for (const KindPointer& kind : set.kinds) words.push_back(kind->invariant_words());
    std::sort(words.begin(), words.end());
    return words;
  };
  TermCurve curve = curve_of_term(subject, best, which);
  std::vector<double> variance(curve.x.size());
  const auto own = [&](const TermCurve& of, std::size_t i) { return (of.high[i] - of.slope[i]) / two_sided; };
  for (std::size_t i = 0; i < variance.size(); ++i) variance[i] = own(curve, i) * own(curve, i);
  double weights = 1;
  const std::string words = best.kinds[which]->invariant_words();
  const auto wanted = invariants(best);
  if (std::count(wanted.begin(), wanted.end(), words) != 1 || words == "stretches") return curve;
  for (std::size_t s = 1; s < sets.size(); ++s) {
    const double weight = std::exp(sets[s].log_evidence - best.log_evidence);
    if (weight < least_weight || invariants(sets[s]) != wanted) continue;
    std::size_t at = 0;
    while (sets[s].kinds[at]->invariant_words() != words) ++at;
    const TermCurve other = curve_of_term(subject, sets[s], at);
    weights += weight;
    for (std::size_t i = 0; i < variance.size(); ++i) {
      const double off = other.slope[i] - curve.slope[i];
      variance[i] += weight * (own(other, i) * own(other, i) + off * off);
    }
  }
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const double half = two_sided * std::sqrt(variance[i] / weights);
    curve.low[i] = curve.slope[i] - half;
    curve.high[i] = curve.slope[i] + half;
  }
  return curve;
}

std::vector<SetFit> with_curves(const Fitter& fitter, const SetFit& best, const std::vector<KindPointer>& kinds,
                                bool beside) {
  struct Job {
    std::vector<KindPointer> rest;
    KindPointer curve;
  };
  std::map<std::string, KindPointer> invariants;
  for (const KindPointer& kind : kinds)
    if (kind->may_be_a_curve()) invariants.emplace(kind->invariant_words(), kind);
  std::vector<Job> jobs;
  for (const auto& [words, kind] : invariants) {
    std::vector<KindPointer> rest;
    for (const KindPointer& one : best.kinds)
      if (one->invariant_words() != words) rest.push_back(one);
    const bool replaces = rest.size() < best.kinds.size();
    if (!replaces && !beside) continue;
    for (const std::size_t pieces : {3, 5, 8}) {
      Kind curve = discovery::curve_of(*kind, pieces);
      curve.largest = fitter.largest_amplitude(curve);
      if (curve.largest == 0) continue;
      jobs.push_back({replaces ? rest : best.kinds, std::make_shared<const Kind>(std::move(curve))});
    }
  }
  std::vector<std::optional<SetFit>> results(jobs.size());
  tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t k) {
    if (const auto rest = assembled(fitter, jobs[k].rest)) results[k] = fitter.grown(*rest, jobs[k].curve, -INFINITY);
  });
  std::vector<SetFit> found;
  for (auto& result : results)
    if (result) found.push_back(std::move(*result));
  std::stable_sort(found.begin(), found.end(),
                   [](const SetFit& a, const SetFit& b) { return a.log_evidence > b.log_evidence; });
  return found;
}

}  // namespace tunica::discovery
