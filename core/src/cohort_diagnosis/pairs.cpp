// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

namespace tunica::cohort_diagnosis {
namespace {

constexpr double too_alike = 0.95;         ///< of |c|: one amplitude cannot be told from the other
constexpr std::size_t most_pairs = 60;     ///< of which ℓ is integrated
constexpr std::size_t places_of_each = 3;  ///< of two mechanisms

/// Gain of both at their best admissible amplitudes; of one where the other is better left out.
double joint_gain(const Leg& a, const Leg& b, double c) {
  const double ta = a.u / a.length, tb = b.u / b.length;
  const auto alone = [](const Leg& leg, double t) { return leg.cut * t < 0 ? 0 : t * t; };
  const double best_alone = std::max(alone(a, ta), alone(b, tb));
  if (std::abs(c) > too_alike) return best_alone;
  const double xa = (ta - c * tb) / (1 - c * c), xb = (tb - c * ta) / (1 - c * c);
  if (a.cut * xa < 0 || b.cut * xb < 0) return best_alone;
  return ta * xa + tb * xb;
}

/// ln of the evidence of one hypothesis on the coarse populations of pairs.
double evidence_alone(const std::vector<Leg>& legs, const std::vector<bool>& sees,
                      const std::vector<Population>& populations) {
  std::vector<double> sums(populations.size(), 0);
  for (std::size_t g = 0; g < populations.size(); ++g)
    for (std::size_t s = 0; s < legs.size(); ++s)
      if (sees[s]) sums[g] += log_with_strangers(log_marginal(legs[s], Leg{}, 0, populations[g], {0, 1}));
  return log_sum_exp(sums) - std::log(static_cast<double>(sums.size()));
}

/// Legs and cosines of a pair over the specimens.
struct Together {
  std::vector<Leg> a, b;
  std::vector<double> c;
  std::vector<bool> sees_a, sees_b;
};

Together together(const Specimens& specimens, const Hypothesis& a, const Hypothesis& b) {
  Together all{std::vector<Leg>(specimens.size()), std::vector<Leg>(specimens.size()),
               std::vector<double>(specimens.size(), 0), a.sees, b.sees};
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    if (a.sees[s]) all.a[s] = leg_of(a.seen[s]);
    if (b.sees[s]) all.b[s] = leg_of(b.seen[s]);
    if (a.sees[s] && b.sees[s]) all.c[s] = cosine_of(*specimens[s], a.seen[s], b.seen[s]);
  }
  return all;
}

std::vector<Population> coarse(const std::vector<Leg>& legs, const Hypothesis& hypothesis) {
  const Profile& like = hypothesis.like();
  Extent scale{1, 0, like.up.has_value(), like.down.has_value()};
  double squares = 0, count = 0;
  for (std::size_t s = 0; s < legs.size(); ++s)
    if (hypothesis.sees[s]) {
      squares += legs[s].length * legs[s].length;
      scale.largest_score = std::max(scale.largest_score, std::abs(legs[s].u) / legs[s].length);
      count += 1;
    }
  scale.unit = 1 / std::sqrt(squares / count);
  return populations(scale, true);
}

/// The scores of `other` as they are beside the leader: with w what the leader leaves along the vector of the other (of
/// its fit at finite amplitude where there is one), t = w + c t_leader. The vectors are those at the base fit, which
/// the leader moves: w is not known better than to a share of t_leader.
void correct(const Specimens& specimens, const Hypothesis& leader, const std::vector<Leg>& leader_legs,
             const Hypothesis& other, const std::vector<double>& cosines, std::vector<Leg>& legs) {
  constexpr double crooked = 0.05;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    if (!leader.sees[s] || !other.sees[s]) continue;
    const Half &first = leader.seen[s].active(), &second = other.seen[s].active();
    const double t = leader_legs[s].u / leader_legs[s].length;
    double left = legs[s].u / legs[s].length - cosines[s] * t;
    if (first.left && second.shown != 0 && !second.apart)
      left = second.sign * other.seen[s].side() * SpecimenEvidence::left_unit *
             specimens[s]->left[*first.left][second.vector];
    const double blur = std::sqrt(1 + std::pow(crooked * t, 2));
    legs[s].length /= blur;
    legs[s].u = (left / blur + cosines[s] * t) * legs[s].length;
  }
}

void integrate(const Specimens& specimens, const std::vector<Hypothesis>& hypotheses, Pair& pair) {
  const Hypothesis &a = hypotheses[pair.a], &b = hypotheses[pair.b];
  const std::vector<bool> everyone(specimens.size(), true);
  Together all = together(specimens, a, b);
  const bool a_leads = a.log_evidence(everyone) > b.log_evidence(everyone);
  if (a_leads)
    correct(specimens, a, all.a, b, all.c, all.b);
  else
    correct(specimens, b, all.b, a, all.c, all.a);
  const std::vector<Population> of_a = coarse(all.a, a), of_b = coarse(all.b, b);
  std::vector<double> sums;
  sums.reserve(of_a.size() * of_b.size());
  for (const Population& first : of_a)
    for (const Population& second : of_b) {
      double sum = 0;
      for (std::size_t s = 0; s < specimens.size(); ++s)
        if (all.sees_a[s] || all.sees_b[s])
          sum += log_with_strangers(log_marginal(all.a[s], all.b[s], all.c[s], first, second));
      sums.push_back(sum);
    }
  const double both = log_sum_exp(sums) - std::log(static_cast<double>(sums.size()));
  const double one = a_leads ? evidence_alone(all.a, all.sees_a, of_a) : evidence_alone(all.b, all.sees_b, of_b);
  pair.needed = both - one;
  pair.log_evidence = pair.needed + (a_leads ? a : b).log_evidence(everyone);
}

}  // namespace

Leg leg_of(const Profile& profile) {
  const Half& half = profile.active();
  const double side = profile.side();
  return {side * half.shown * half.length, half.length, profile.up && profile.down ? 0.0 : side};
}

double cosine_of(const SpecimenEvidence& specimen, const Profile& a, const Profile& b) {
  const Half &first = a.active(), &second = b.active();
  if (first.shown == 0 && first.t == 0 && a.place.row) return 0;  // a row that is not listed has no vector
  if (second.shown == 0 && second.t == 0 && b.place.row) return 0;
  return specimen.likeness(first.vector, second.vector) * first.sign * second.sign * a.side() * b.side();
}

double log_marginal(const Leg& a, const Leg& b, double cosine, const Population& of_a, const Population& of_b) {
  // y = (x, y)ᵀ ~ N(m, T), A the information, u the score:
  // ln ∫ = −½ ln |1 + T A| + ½ (u − A m)ᵀ (T⁻¹ + A)⁻¹ (u − A m) + uᵀm − ½ mᵀ A m
  const double A00 = a.length * a.length, A11 = b.length * b.length, A01 = cosine * a.length * b.length;
  const double T0 = of_a.sd * of_a.sd, T1 = of_b.sd * of_b.sd, m0 = of_a.mean, m1 = of_b.mean;
  const double P00 = A00 + 1 / T0, P11 = A11 + 1 / T1, P01 = A01;
  const double determinant = P00 * P11 - P01 * P01;
  const double g0 = a.u - A00 * m0 - A01 * m1, g1 = b.u - A01 * m0 - A11 * m1;
  const double d0 = (P11 * g0 - P01 * g1) / determinant, d1 = (P00 * g1 - P01 * g0) / determinant;
  double value = -0.5 * std::log(determinant * T0 * T1) + 0.5 * (g0 * d0 + g1 * d1) + a.u * m0 + b.u * m1 -
                 0.5 * (A00 * m0 * m0 + 2 * A01 * m0 * m1 + A11 * m1 * m1);
  // What is cut off: each amplitude by itself, as the two are nearly independent where a pair is worth a look.
  if (a.cut != 0)
    value +=
        log_normal_below(a.cut * (m0 + d0) / std::sqrt(P11 / determinant)) - log_normal_below(a.cut * m0 / of_a.sd);
  if (b.cut != 0)
    value +=
        log_normal_below(b.cut * (m1 + d1) / std::sqrt(P00 / determinant)) - log_normal_below(b.cut * m1 / of_b.sd);
  return value;
}

std::vector<Pair> pairs_of(const Specimens& specimens, const std::vector<Hypothesis>& hypotheses) {
  struct Drawn {
    double gain;
    std::size_t a, b;
  };
  std::vector<std::vector<Drawn>> by_first(hypotheses.size());
  tbb::parallel_for(std::size_t{0}, hypotheses.size(), [&](std::size_t i) {
    for (std::size_t j = i + 1; j < hypotheses.size(); ++j) {
      const Hypothesis &a = hypotheses[i], &b = hypotheses[j];
      if (a.id() == b.id()) continue;
      const Together all = together(specimens, a, b);
      double gain = 2 * (a.log_share + b.log_share);
      for (std::size_t s = 0; s < specimens.size(); ++s) {
        if (all.sees_a[s] && all.sees_b[s])
          gain += joint_gain(all.a[s], all.b[s], all.c[s]);
        else if (all.sees_a[s] || all.sees_b[s])
          gain += (all.sees_a[s] ? a : b).seen[s].gain();
      }
      by_first[i].push_back({gain, i, j});
    }
  });
  std::vector<Drawn> drawn;
  for (const auto& some : by_first) drawn.insert(drawn.end(), some.begin(), some.end());
  std::stable_sort(drawn.begin(), drawn.end(), [](const Drawn& a, const Drawn& b) { return a.gain > b.gain; });
  std::map<std::pair<std::string, std::string>, std::size_t> seen;
  std::erase_if(drawn, [&](const Drawn& one) {
    return ++seen[{hypotheses[one.a].id(), hypotheses[one.b].id()}] > places_of_each;
  });
  drawn.resize(std::min(drawn.size(), most_pairs));
  std::vector<Pair> pairs;
  for (const Drawn& one : drawn) pairs.push_back({one.a, one.b});
  tbb::parallel_for(std::size_t{0}, pairs.size(), [&](std::size_t k) { integrate(specimens, hypotheses, pairs[k]); });
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.log_evidence > b.log_evidence; });
  return pairs;
}

}  // namespace tunica::cohort_diagnosis
