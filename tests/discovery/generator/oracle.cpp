// SPDX-License-Identifier: Apache-2.0
#include "oracle.hpp"

#include <algorithm>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/special_functions/legendre.hpp>

namespace blind {
namespace {

constexpr int draws = 4000;
constexpr double alpha = 0.05;

/// Legendre columns of degree 0 to 2 of every curve over what is prescribed, whitened, without what the base model's
/// parameters absorb; orthonormal.
Eigen::MatrixXd smooth_columns(const Protocol& protocol, const Noise& noise, const Eigen::MatrixXd& jacobian) {
  const auto layout = channels(protocol);
  const auto n = noise.sd.size();
  Eigen::MatrixXd all(n, 3 * static_cast<Eigen::Index>(layout.size()));
  for (std::size_t k = 0; k < layout.size(); ++k) {
    const auto& path = *layout[k].path;
    const auto [low, high] = std::minmax_element(path.begin(), path.end());
    for (int degree = 0; degree <= 2; ++degree) {
      std::vector<double> column(static_cast<std::size_t>(n), 0.0);
      for (std::size_t i = 0; i < layout[k].count; ++i) {
        const std::size_t at = layout[k].first + i;
        column[at] = noise.sd[static_cast<Eigen::Index>(at)] *
                     boost::math::legendre_p(degree, 2 * (path[i] - *low) / std::max(*high - *low, 1e-9) - 1);
      }
      all.col(3 * static_cast<Eigen::Index>(k) + degree) = projected(jacobian, whiten(protocol, noise, column));
    }
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(all);
  qr.setThreshold(1e-6);
  return qr.householderQ() * Eigen::MatrixXd::Identity(n, qr.rank());
}

/// The largest one- or two-sided score of every effect in every column of r: effects × columns.
Eigen::MatrixXd largest_scores(const std::vector<Signature>& all, const Eigen::MatrixXd& shapes,
                               const Eigen::MatrixXd& r) {
  const Eigen::MatrixXd z = shapes.transpose() * r;
  Eigen::MatrixXd score = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(catalogue().size()), r.cols());
  for (Eigen::Index m = 0; m < z.rows(); ++m) {
    const Signature& one = all[static_cast<std::size_t>(m)];
    auto best = score.row(one.effect - catalogue().data());
    best = best.cwiseMax(one.one_sided ? Eigen::RowVectorXd(z.row(m)) : Eigen::RowVectorXd(z.row(m).cwiseAbs()));
  }
  return score;
}

/// The effect with the largest marginal likelihood, all its places to sit being equally likely beforehand: the mean of
/// exp(z²/2) over its directions; of one-sided ones only the side that they have, which is then twice as likely.
std::string most_likely(const std::vector<Signature>& all, const Eigen::VectorXd& z) {
  std::map<const Effect*, std::pair<double, double>> sums;
  const double largest = z.squaredNorm() > 0 ? z.cwiseAbs2().maxCoeff() : 0;  // against overflow
  for (std::size_t m = 0; m < all.size(); ++m) {
    const double c = z[static_cast<Eigen::Index>(m)];
    auto& [sum, count] = sums[all[m].effect];
    const double likelihood = std::exp((c * c - largest) / 2);
    sum += !all[m].one_sided ? likelihood : c > 0 ? 2 * likelihood : 0;
    count += 1;
  }
  const auto best = std::max_element(sums.begin(), sums.end(), [](const auto& a, const auto& b) {
    return a.second.first / a.second.second < b.second.first / b.second.second;
  });
  return best->first->id;
}

/// Share of the sorted values that are at least as large.
double upper_share(const std::vector<double>& sorted, double value) {
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value);
  return (1 + static_cast<double>(above)) / (1 + static_cast<double>(sorted.size()));
}

}  // namespace

OracleVerdict ask_oracle(const SealedCase& made) {
  const Protocol& protocol = made.specimen.protocol;
  const Noise noise = made.noise.about(protocol, made.truth);
  const Tissue& base = made.specimen.tissue;
  // The Jacobian at the truth: that of a fit to what the truth predicts.
  const auto bare = observe(protocol, {base});
  const Eigen::MatrixXd jacobian = refit(protocol, noise, bare, base).jacobian;
  const auto all = signatures(made.specimen, base, noise, jacobian);
  Eigen::MatrixXd shapes(noise.sd.size(), static_cast<Eigen::Index>(all.size()));
  for (std::size_t m = 0; m < all.size(); ++m) shapes.col(static_cast<Eigen::Index>(m)) = all[m].shape;
  const Eigen::MatrixXd smooth = smooth_columns(protocol, noise, jacobian);

  std::vector<double> error(bare.size());
  for (std::size_t i = 0; i < bare.size(); ++i) {
    double mean = 0;
    for (const auto& replicate : made.records.replicates) mean += replicate[i];
    error[i] = mean / static_cast<double>(made.records.replicates.size()) - bare[i];
  }
  const Eigen::VectorXd r = projected(jacobian, whiten(protocol, noise, error));

  // Column 0: the data; the others: nothing but noise.
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd columns(r.size(), 1 + draws);
  columns.col(0) = r;
  for (Eigen::Index d = 1; d <= draws; ++d)
    for (Eigen::Index i = 0; i < r.size(); ++i) columns(i, d) = normal(random);
  const Eigen::MatrixXd score = largest_scores(all, shapes, columns);  // shapes are projected already
  const Eigen::VectorXd omnibus = (smooth.transpose() * columns).colwise().squaredNorm();
  const boost::math::chi_squared chi(static_cast<double>(smooth.cols()));
  // Every effect by its own distribution, so that one with many places to sit does not drown the others.
  std::vector<double> smallest(1 + draws);
  for (Eigen::Index d = 0; d <= draws; ++d)
    smallest[static_cast<std::size_t>(d)] = boost::math::cdf(boost::math::complement(chi, omnibus[d]));
  for (Eigen::Index e = 0; e < score.rows(); ++e) {
    std::vector<double> sorted;
    for (Eigen::Index d = 1; d <= draws; ++d) sorted.push_back(score(e, d));
    std::sort(sorted.begin(), sorted.end());
    for (Eigen::Index d = 0; d <= draws; ++d) {
      double& p = smallest[static_cast<std::size_t>(d)];
      p = std::min(p, upper_share(sorted, score(e, d)));
    }
  }
  const auto as_small = std::count_if(smallest.begin() + 1, smallest.end(), [&](double p) { return p <= smallest[0]; });
  OracleVerdict verdict;
  verdict.p_value = (1.0 + static_cast<double>(as_small)) / (1.0 + draws);
  verdict.detected = verdict.p_value <= alpha;
  verdict.first = most_likely(all, shapes.transpose() * r);
  // The direction that scored, against every direction of the others.
  std::size_t scored = 0;
  double best = -1;
  for (std::size_t m = 0; m < all.size(); ++m) {
    const double c = all[m].shape.dot(r), size = all[m].one_sided ? c : std::abs(c);
    if (all[m].effect->id == verdict.first && size > best) {
      best = size;
      scored = m;
    }
  }
  verdict.likeness = likeness_to(all, shapes, scored);
  if (made.hidden.size() < 2) return verdict;
  const auto [one, other] = likeliest_pair(all, shapes, r);
  verdict.pair = {all[one].effect->id, all[other].effect->id};
  verdict.pair_likeness = {likeness_to(all, shapes, one), likeness_to(all, shapes, other)};
  return verdict;
}

std::map<std::string, double> likeness_to(const std::vector<Signature>& all, const Eigen::MatrixXd& shapes,
                                          std::size_t direction) {
  constexpr double worth_telling = 0.9;
  const Eigen::VectorXd alike = (shapes.transpose() * shapes.col(static_cast<Eigen::Index>(direction))).cwiseAbs();
  std::map<std::string, double> likeness;
  for (std::size_t m = 0; m < all.size(); ++m) {
    double& known = likeness[all[m].effect->id];
    known = std::max(known, alike[static_cast<Eigen::Index>(m)]);
  }
  std::erase_if(likeness,
                [&](const auto& one) { return one.second <= worth_telling || one.first == all[direction].effect->id; });
  return likeness;
}

}  // namespace blind
