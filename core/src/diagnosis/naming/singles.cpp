// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/singles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>

#include "diagnosis/hypotheses/amplitude_range.hpp"

namespace tunica::diagnosis {
namespace {

using Side = MechanismFactory::Side;

constexpr std::size_t quick_refits = 10;           ///< candidates
constexpr std::size_t singles_searched_again = 6;  ///< refits, the best
constexpr double quick_reach = 9;                  ///< of ln w, beyond the first four

double log_side(Side side, double T) {
  return side == Side::both ? 0 : std::log(std::erfc(-std::sqrt(std::max(T, 0.0) / 2)));
}

class SingleSearch {
 public:
  SingleSearch(const Inquiry& inquiry, const Analysis& analysis)
      : inquiry_(inquiry), analysis_(analysis), fit_(analysis.evidence.fit), hypotheses_(analysis.hypotheses) {
    for (const Direction& direction : hypotheses_.directions) scores_.push_back(score(direction, -fit_.residuals));
    of_.resize(hypotheses_.candidates.size());
    for (std::size_t k = 0; k < hypotheses_.directions.size(); ++k)
      of_[hypotheses_.directions[k].candidate].push_back(k);
  }

  std::vector<Single> run() {
    const std::size_t C = hypotheses_.candidates.size();
    std::vector<Single> singles;
    for (std::size_t c = 0; c < C; ++c)
      if (!of_[c].empty())
        singles.push_back(
            {c, weight(c, {}), *likeliest_direction(hypotheses_.directions, -fit_.residuals, c), std::nullopt});
    const auto by_weight = [](const Single& a, const Single& b) { return a.log_weight > b.log_weight; };
    std::stable_sort(singles.begin(), singles.end(), by_weight);

    std::vector<Job> jobs;
    for (std::size_t place = 0; place < singles.size(); ++place) {
      const bool far = singles[place].log_weight < singles.front().log_weight - quick_reach;
      if (inquiry_.request.quick && (place >= quick_refits || (place >= 4 && far))) break;
      for (const std::size_t k : likeliest(of_[singles[place].candidate])) jobs.push_back({place, k});
    }
    for (std::size_t place = 0; place < singles.size(); ++place)
      for (const std::size_t k : far_ones(of_[singles[place].candidate])) jobs.push_back({place, k, far_amplitude(k)});
    const auto done = inquiry_.steps("fitting the mechanisms", 0.4, 0.55, jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t j) {
      jobs[j].refit = fit_with(inquiry_, analysis_, {hypotheses_.hypothesis(jobs[j].direction).addition},
                               std::array{jobs[j].amplitude.value_or(start_amplitude(jobs[j].direction))});
      done();
    });
    std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) {
      const auto left = [](const Job& job) { return job.refit ? job.refit->fit.chi2 : INFINITY; };
      return left(a) < left(b);
    });
    tbb::parallel_for(std::size_t{0}, std::min(jobs.size(), singles_searched_again), [&](std::size_t j) {
      if (jobs[j].refit) jobs[j].refit = searched_again(inquiry_, analysis_, std::move(*jobs[j].refit));
    });
    std::map<std::size_t, std::map<std::size_t, double>> gains;  // single → direction → gain
    for (Job& job : jobs) {
      if (!job.refit) continue;
      double& gain = gains[job.single][job.direction];
      gain = std::max(gain, fit_.chi2 - job.refit->fit.chi2);
      Single& single = singles[job.single];
      if (!single.best || job.refit->fit.chi2 < single.best->fit.chi2) {
        single.best = std::move(job.refit);
        single.direction = job.direction;
      }
    }
    for (const auto& [place, gain] : gains) singles[place].log_weight = weight(singles[place].candidate, gain);
    std::stable_sort(singles.begin(), singles.end(), by_weight);
    std::stable_partition(singles.begin(), singles.end(), [](const Single& single) { return single.best.has_value(); });
    return singles;
  }

 private:
  struct Job {
    std::size_t single, direction;
    std::optional<double> amplitude = {};  ///< to begin at; none: what the score says
    std::optional<Refit> refit = {};
  };

  /// ln w, with gains at finite amplitude in place of T where they are known; what was not fitted again is taken to
  /// gain no larger part of its score than the best one that was.
  [[nodiscard]] double weight(std::size_t candidate, const std::map<std::size_t, double>& gains) const {
    double largest = 0, part = 1;
    for (const auto& [k, gain] : gains)
      if (scores_[k].T > largest) {
        largest = scores_[k].T;
        part = std::clamp(gain / largest, 0.0, 1.0);
      }
    std::vector<double> logs;
    for (const std::size_t k : of_[candidate]) {
      const auto found = gains.find(k);
      const double T = found == gains.end() ? part * scores_[k].T : std::max(found->second, 0.0);
      logs.push_back(T / 2 + std::log(hypotheses_.directions[k].share) + log_side(hypotheses_.directions[k].side, T));
    }
    return log_sum(logs);
  }

  /// The best hypothesis of a candidate, and of other places those nearly as good.
  [[nodiscard]] std::vector<std::size_t> likeliest(const std::vector<std::size_t>& of) const {
    std::vector<std::size_t> sorted = of, chosen;
    std::stable_sort(sorted.begin(), sorted.end(), [&](auto a, auto b) { return scores_[a].T > scores_[b].T; });
    std::vector<Place> seen;
    for (const std::size_t k : sorted) {
      const Place& place = hypotheses_.hypothesis(k).addition.place;
      if (std::find(seen.begin(), seen.end(), place) != seen.end()) continue;
      if (!chosen.empty() && scores_[k].T < scores_[chosen.front()].T - 6) break;
      if (chosen.size() >= (inquiry_.request.quick ? 2u : 4u)) break;
      seen.push_back(place);
      chosen.push_back(k);
    }
    return chosen;
  }

  /// Hypotheses whose shape changes with the amplitude, in all their tests at once where there are such: their optimum
  /// may lie where no linearisation at the null looks, with other parameters (fibres taken up late, and stiffer).
  [[nodiscard]] std::vector<std::size_t> far_ones(const std::vector<std::size_t>& of) const {
    std::vector<std::size_t> common, single;
    for (const std::size_t k : of) {
      const Hypothesis& one = hypotheses_.hypothesis(k);
      if (one.at_large && one.mechanism->stage != Stage::history)
        (one.addition.place.tests.size() == 1 ? single : common).push_back(k);
    }
    std::vector<std::size_t>& chosen = common.empty() ? single : common;
    std::stable_sort(chosen.begin(), chosen.end(), [&](auto a, auto b) { return scores_[a].T > scores_[b].T; });
    if (chosen.size() > 2) chosen.erase(chosen.begin() + 2, chosen.end());
    return chosen;
  }
  [[nodiscard]] double far_amplitude(std::size_t direction) const {
    const Hypothesis& one = hypotheses_.hypothesis(direction);
    const AmplitudeRange range = range_of(*one.mechanism, one.addition);
    return 0.5 * ((one.sign > 0 ? range.plausible_max : range.plausible_min) - one.mechanism->null);
  }

  /// Where the linearisation sees nothing on the admissible side, a tenth of a standard error of it.
  [[nodiscard]] double start_amplitude(std::size_t direction) const {
    const Direction& chosen = hypotheses_.directions[direction];
    return scores_[direction].T > 0 ? scores_[direction].amplitude : chosen.sign * 0.1 / chosen.length;
  }

  const Inquiry& inquiry_;
  const Analysis& analysis_;
  const Fit& fit_;
  const Hypotheses& hypotheses_;
  std::vector<Score> scores_;                 ///< of each direction
  std::vector<std::vector<std::size_t>> of_;  ///< directions of each candidate
};

}  // namespace

double log_sum(const std::vector<double>& logs) {
  if (logs.empty()) return -INFINITY;
  const double largest = *std::max_element(logs.begin(), logs.end());
  if (!std::isfinite(largest)) return largest;
  double sum = 0;
  for (const double value : logs) sum += std::exp(value - largest);
  return largest + std::log(sum);
}

std::vector<Single> fit_singles(const Inquiry& inquiry, const Analysis& analysis) {
  return SingleSearch(inquiry, analysis).run();
}

}  // namespace tunica::diagnosis
