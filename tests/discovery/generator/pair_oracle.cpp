// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <map>
#include <stdexcept>

#include "oracle.hpp"

namespace blind {
namespace {

constexpr double one_and_the_same = 0.02;  ///< 1 − c² of two directions that no data tell apart

/// All pairs of directions of two effects.
struct PairScore {
  double sum = 0, count = 0;
  double best = -1;
  std::pair<std::size_t, std::size_t> where;
};

}  // namespace

// Two unit directions with scores a, b and correlation c: amplitudes x = (a − c b)/(1 − c²), y = (b − c a)/(1 − c²), of
// which a x + b y goes off |r|². As with single effects the mean of exp(gain/2) over the places, a side that there is
// counting twice.
std::pair<std::size_t, std::size_t> likeliest_pair(const std::vector<Signature>& all, const Eigen::MatrixXd& shapes,
                                                   const Eigen::VectorXd& r) {
  const Eigen::VectorXd z = shapes.transpose() * r;
  const Eigen::MatrixXd correlation = shapes.transpose() * shapes;
  const double whole = r.squaredNorm();  // no pair gains more; against overflow
  std::map<std::pair<const Effect*, const Effect*>, PairScore> pairs;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].effect == all[j].effect) continue;
      const auto m = static_cast<Eigen::Index>(i), n = static_cast<Eigen::Index>(j);
      const double a = z[m], b = z[n], c = correlation(m, n), left = 1 - c * c;
      if (left < one_and_the_same) continue;
      PairScore& both = pairs[std::minmax(all[i].effect, all[j].effect)];
      both.count += 1;
      const double x = (a - c * b) / left, y = (b - c * a) / left, gain = a * x + b * y;
      if ((all[i].one_sided && x <= 0) || (all[j].one_sided && y <= 0)) continue;
      both.sum += std::exp((gain - whole) / 2) * (all[i].one_sided ? 2 : 1) * (all[j].one_sided ? 2 : 1);
      if (gain > both.best) {
        both.best = gain;
        both.where = {i, j};
      }
    }
  const PairScore* best = nullptr;
  for (const auto& [effects, both] : pairs)
    if (both.best >= 0 && (!best || both.sum / both.count > best->sum / best->count)) best = &both;
  if (!best) throw std::logic_error("no two effects of the catalogue act on these data together");
  return best->where;
}

}  // namespace blind
