// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace tunica::cohort_diagnosis {
namespace {

/// Profiles of one specimen by place.
using ByPlace = std::map<std::string, std::vector<const Profile*>>;

double distance_of(const Profile& a, const Profile& b) {
  double sum = 0;
  for (const auto& [name, value] : a.setting)
    for (const auto& [other, theirs] : b.setting)
      if (name == other) sum += value > 0 && theirs > 0 ? std::abs(std::log(value / theirs)) : value != theirs;
  return sum;
}

const Profile* nearest(const ByPlace& places, const Profile& like) {
  const auto found = places.find(like.key_of_place());
  if (found == places.end()) return nullptr;
  const Profile* best = nullptr;
  if (like.setting.empty()) {  // of a mechanism that has settings: each specimen has its own
    for (const Profile* one : found->second)
      if (!best || one->gain() > best->gain()) best = one;
    return best;
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Profile* one : found->second)
    if (one->setting.empty())
      continue;
    else if (const double far = distance_of(like, *one); far < least) {
      least = far;
      best = one;
    }
  return best;
}

/// A row of which the specimen says nothing: as the whole curve is there, it scored too little to be listed.
std::optional<Profile> silent_row(const ByPlace& places, const Profile& like) {
  if (!like.place.row) return std::nullopt;
  Profile whole = like;
  whole.place.row.reset();
  if (!places.contains(whole.key_of_place())) return std::nullopt;
  Profile silent = like;
  for (std::optional<Half>* half : {&silent.up, &silent.down})
    if (*half) (*half)->t = (*half)->shown = 0;
  return silent;
}

void weigh(Hypothesis& hypothesis) {
  Extent scale;
  double squares = 0, count = 0;
  for (std::size_t s = 0; s < hypothesis.sees.size(); ++s) {
    if (!hypothesis.sees[s]) continue;
    const Profile& profile = hypothesis.seen[s];
    scale.up = scale.up || profile.up;
    scale.down = scale.down || profile.down;
    scale.largest_score = std::max(scale.largest_score, profile.active().t);
    squares += std::pow(profile.active().length, 2);
    count += 1;
  }
  scale.unit = 1 / std::sqrt(squares / count);
  hypothesis.populations = populations(scale);
  hypothesis.log_likelihood = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(hypothesis.sees.size()),
                                                    static_cast<Eigen::Index>(hypothesis.populations.size()));
  for (std::size_t s = 0; s < hypothesis.sees.size(); ++s)
    for (std::size_t g = 0; hypothesis.sees[s] && g < hypothesis.populations.size(); ++g)
      hypothesis.log_likelihood(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(g)) =
          log_with_strangers(log_marginal(hypothesis.seen[s], hypothesis.populations[g]));
}

/// A row that is gross in one specimen is a matter of that specimen. It is a cause of a cohort where it is listed by a
/// quarter of the specimens, and by two at least.
void leave_out_rows_of_few(std::vector<Hypothesis>& all, std::size_t specimens) {
  if (specimens < 2) return;
  std::erase_if(all, [&](const Hypothesis& one) {
    if (!one.like().place.row) return false;
    std::size_t listed = 0;
    for (std::size_t s = 0; s < specimens; ++s) listed += one.sees[s] && one.seen[s].active().t != 0;
    return listed < 2 || 4 * listed < specimens;
  });
}

/// Places and settings of a mechanism share its weight alike; single rows and whole curves are two kinds of equal
/// weight, and unlisted rows have their share too.
void share_out(std::vector<Hypothesis>& all, const Specimens& specimens) {
  std::size_t most_rows = 1;
  for (const SpecimenEvidence* specimen : specimens) most_rows = std::max(most_rows, specimen->rows);
  std::map<std::string, std::size_t> curves;
  for (const Hypothesis& one : all) curves[one.id()] += !one.like().place.row;
  std::map<std::string, bool> has_rows;
  for (const Hypothesis& one : all) has_rows[one.id()] = has_rows[one.id()] || one.like().place.row;
  for (Hypothesis& one : all) {
    const double kinds = has_rows[one.id()] && curves[one.id()] > 0 ? 2 : 1;
    const std::size_t alike = one.like().place.row ? most_rows : curves[one.id()];
    one.log_share = -std::log(kinds * static_cast<double>(alike));
  }
}

}  // namespace

double log_sum_exp(std::span<const double> logs) {
  if (logs.empty()) return -std::numeric_limits<double>::infinity();
  const double most = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(most)) return most;
  double sum = 0;
  for (const double value : logs) sum += std::exp(value - most);
  return most + std::log(sum);
}

Specimens in_order(std::span<const SpecimenEvidence> specimens) {
  Specimens sorted;
  for (const SpecimenEvidence& one : specimens) sorted.push_back(&one);
  std::sort(sorted.begin(), sorted.end(), [](const auto* a, const auto* b) { return a->id < b->id; });
  return sorted;
}

const Profile& Hypothesis::like() const {
  for (std::size_t s = 0; s < sees.size(); ++s)
    if (sees[s]) return seen[s];
  return seen.front();
}

double Hypothesis::log_evidence(const std::vector<bool>& counts) const {
  std::vector<double> sums(populations.size(), 0);
  for (std::size_t g = 0; g < sums.size(); ++g)
    for (std::size_t s = 0; s < sees.size(); ++s)
      if (counts[s]) sums[g] += log_likelihood(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(g));
  return log_sum_exp(sums) - std::log(static_cast<double>(sums.size()));
}

const Population& Hypothesis::likeliest(const std::vector<bool>& counts) const {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t g = 0; g < populations.size(); ++g) {
    double sum = 0;
    for (std::size_t s = 0; s < sees.size(); ++s)
      if (counts[s]) sum += log_likelihood(static_cast<Eigen::Index>(s), static_cast<Eigen::Index>(g));
    if (sum > most) {
      most = sum;
      best = g;
    }
  }
  return populations[best];
}

std::vector<Hypothesis> hypotheses_of(const Specimens& specimens) {
  std::vector<ByPlace> places(specimens.size());
  std::map<std::string, const Profile*> keys;
  for (std::size_t s = 0; s < specimens.size(); ++s)
    for (const Profile& profile : specimens[s]->profiles) {
      places[s][profile.key_of_place()].push_back(&profile);
      keys.try_emplace(profile.key(), &profile);
    }
  std::vector<Hypothesis> all(keys.size());
  std::vector<const Profile*> likes;
  for (const auto& [key, like] : keys) likes.push_back(like);
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    Hypothesis& one = all[k];
    one.seen.resize(specimens.size());
    one.sees.assign(specimens.size(), false);
    for (std::size_t s = 0; s < specimens.size(); ++s) {
      if (const Profile* profile = nearest(places[s], *likes[k]))
        one.seen[s] = *profile;
      else if (auto silent = silent_row(places[s], *likes[k]))
        one.seen[s] = std::move(*silent);
      else
        continue;
      one.sees[s] = true;
    }
    weigh(one);
  });
  leave_out_rows_of_few(all, specimens.size());
  share_out(all, specimens);
  return all;
}

}  // namespace tunica::cohort_diagnosis
