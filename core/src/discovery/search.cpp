// SPDX-License-Identifier: Apache-2.0
#include "discovery/search.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

namespace tunica::discovery {
namespace {

constexpr std::size_t at_once = 16;  ///< fits between two looks at what is still worth one
constexpr double tolerance = 10;     ///< of the evidence, behind the best so far
constexpr double far = 100;          ///< of |r|² of noise

using Key = std::vector<std::string>;

Key key_of(const std::vector<KindPointer>& kinds) {
  Key key;
  for (const KindPointer& kind : kinds) key.push_back(kind->name);
  return key;
}

Key key_with(const std::vector<KindPointer>& kinds, const Kind& more) {
  Key key = key_of(kinds);
  key.insert(std::upper_bound(key.begin(), key.end(), more.name), more.name);
  return key;
}

/// That the terms have together.
std::size_t parameters_of(const std::vector<KindPointer>& kinds) {
  std::size_t count = 0;
  for (const KindPointer& kind : kinds) count += 1 + kind->heights.size() + kind->shapes.size();
  return count;
}

bool likelier(const CommonFit& a, const CommonFit& b) { return a.log_evidence > b.log_evidence; }

/// The sets that were tried, and their results.
class Ledger {
 public:
  Ledger(const CommonFitter& fitter, const Search& request) : fitter_(fitter), request_(request) {
    if (request.before)
      for (const CommonFit& set : *request.before) before_.emplace(key_of(set.kinds), &set);
  }

  /// Every set grown by every kind that suits it, if it is new; those that could be fitted, likeliest first. What
  /// promises most is fitted first. What cannot come near the best of the smaller sets is not fitted, nor what can
  /// neither be among the `kept` best of these nor come near the best of them.
  std::vector<CommonFit> grow(const std::vector<CommonFit>& from, std::size_t kept, bool every_law = true) {
    std::vector<Job> jobs = jobs_of(from, every_law);
    const double smaller = all_.empty() ? -INFINITY : sorted().front().log_evidence;
    double best_so_far = smaller;
    std::map<Key, CommonFit> best;
    for (std::size_t first = 0; first < jobs.size(); first += at_once) {
      const std::size_t last = std::min(first + at_once, jobs.size());
      const double worth = std::max(smaller - tolerance, std::min(best_so_far - tolerance, lowest_of(best, kept)));
      std::vector<std::optional<CommonFit>> results(last - first);
      tbb::parallel_for(first, last, [&](std::size_t k) {
        if (jobs[k].most >= worth) results[k - first] = fitted(jobs[k], worth);
      });
      for (std::size_t k = first; k < last; ++k) {
        auto& result = results[k - first];
        if (!result) continue;
        best_so_far = std::max(best_so_far, result->log_evidence);
        best.emplace(jobs[k].key, std::move(*result));
      }
    }
    std::vector<CommonFit> grown;
    for (auto& [key, fit] : best) grown.push_back(fit);
    std::stable_sort(grown.begin(), grown.end(), likelier);
    for (auto& [key, fit] : best) keep(key, std::move(fit));
    return grown;
  }

  /// The best sets with each of their terms taken out, where that set was fitted.
  [[nodiscard]] std::vector<CommonFit> with_room() const {
    std::vector<CommonFit> smaller;
    std::set<Key> seen;
    std::vector<CommonFit> best = sorted();
    if (best.size() > request_.exchanged) best.resize(request_.exchanged);
    for (const CommonFit& fit : best)
      for (std::size_t out = 0; out < fit.kinds.size() && fit.kinds.size() > 1; ++out) {
        std::vector<KindPointer> rest = fit.kinds;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(out));
        const auto found = all_.find(key_of(rest));
        if (found != all_.end() && seen.insert(found->first).second) smaller.push_back(found->second);
      }
    return smaller;
  }

  /// The best sets with a power of the stretches as the linear law of I1 or I2 that it may stand for. Without it fibres
  /// may hold nothing together, so that no smaller set leads there.
  void try_linear_laws() {
    std::vector<CommonFit> best = sorted();
    if (best.size() > request_.exchanged) best.resize(request_.exchanged);
    for (const CommonFit& fit : best)
      for (std::size_t k = 0; k < fit.kinds.size(); ++k) {
        if (fit.kinds[k]->invariant != "stretches") continue;
        const std::string name = fit.kinds[k]->negative ? "I2_linear" : "I1_linear";
        const auto linear = std::find_if(fitter_.kinds().begin(), fitter_.kinds().end(),
                                         [&](const KindPointer& kind) { return kind->name == name; });
        if (linear == fitter_.kinds().end() || !suits(fit, **linear)) continue;
        std::vector<KindPointer> kinds = fit.kinds;
        kinds.erase(kinds.begin() + static_cast<std::ptrdiff_t>(k));
        Key key = key_with(kinds, **linear);
        if (!tried_.insert(key).second) continue;
        if (auto simpler = fitter_.with_linear(fit, k, *linear)) keep(key, std::move(*simpler));
      }
  }

  /// The best sets with one law in the place of all terms of an invariant. Two laws may add up to a third, and no
  /// smaller set leads from one to the other. Whether anything was new.
  bool try_single_laws() {
    struct Substitute {
      CommonFit from;
      KindPointer law;
      Key key;
    };
    std::vector<Substitute> jobs;
    std::vector<CommonFit> best = sorted();
    const double worth = best.empty() ? -INFINITY : best.front().log_evidence - tolerance;
    if (best.size() > request_.exchanged) best.resize(request_.exchanged);
    for (const CommonFit& fit : best)
      for (const KindPointer& law : fitter_.kinds()) {
        const auto same = [&](const KindPointer& kind) { return kind->invariant_words() == law->invariant_words(); };
        if (law->invariant == "stretches" || std::none_of(fit.kinds.begin(), fit.kinds.end(), same)) continue;
        std::vector<KindPointer> kinds = fit.kinds;
        std::erase_if(kinds, same);
        Key key = key_with(kinds, *law);
        if (all_.contains(key) || !distilled_.insert(key).second) continue;
        jobs.push_back({fit, law, std::move(key)});
      }
    std::vector<std::optional<CommonFit>> results(jobs.size());
    tbb::parallel_for(std::size_t{0}, jobs.size(),
                      [&](std::size_t k) { results[k] = fitter_.distilled(jobs[k].from, jobs[k].law, worth); });
    bool found = false;
    for (std::size_t k = 0; k < jobs.size(); ++k)
      if (results[k]) found = keep(jobs[k].key, std::move(*results[k])) || found;
    return found;
  }

  /// The first terms of a material that changes its volume, and the best sets without one of their terms: these are no
  /// sets that others grew from.
  void begin_with(const CommonFit& root) { keep(key_of(root.kinds), root); }
  void try_smaller() {
    std::vector<CommonFit> best = sorted();
    const double worth = best.empty() ? -INFINITY : best.front().log_evidence - tolerance;
    if (best.size() > request_.exchanged) best.resize(request_.exchanged);
    for (const CommonFit& fit : best)
      for (std::size_t out = 0; out < fit.kinds.size(); ++out) {
        Key key = key_of(fit.kinds);
        key.erase(key.begin() + static_cast<std::ptrdiff_t>(out));
        const auto with_volume = [&](bool is) {
          return std::count_if(fit.kinds.begin(), fit.kinds.end(),
                               [is](const KindPointer& kind) { return kind->of_volume() == is; });
        };
        if (with_volume(fit.kinds[out]->of_volume()) < 2 || all_.contains(key) || !tried_.insert(key).second) continue;
        if (auto smaller = fitter_.without(fit, out, worth)) keep(key, std::move(*smaller));
      }
  }

  /// In the best sets each term makes room for every other kind.
  void exchange() {
    for (int round = 0; round < 2; ++round) {
      if (!fitter_.root().kinds.empty()) try_smaller();
      try_linear_laws();
      const bool simpler = try_single_laws();
      if (grow(with_room(), 0).empty() && !simpler) break;
    }
  }

  /// The best sets of an earlier search with another noise, from where they ended: likeliest first.
  std::vector<CommonFit> earlier() {
    if (!request_.before) return {};
    std::vector<std::optional<CommonFit>> results(std::min(request_.before->size(), request_.exchanged));
    tbb::parallel_for(std::size_t{0}, results.size(),
                      [&](std::size_t k) { results[k] = fitter_.refitted((*request_.before)[k]); });
    std::vector<CommonFit> sets;
    for (auto& result : results)
      if (result) sets.push_back(again_.emplace(key_of(result->kinds), *result).first->second);
    std::stable_sort(sets.begin(), sets.end(), likelier);
    return sets;
  }

  [[nodiscard]] std::vector<CommonFit> sorted() const {
    std::vector<CommonFit> sets;
    for (const auto& [key, fit] : all_) sets.push_back(fit);
    std::stable_sort(sets.begin(), sets.end(), likelier);
    return sets;
  }

 private:
  struct Job {
    const CommonFit* from;
    const KindPointer* kind;
    Key key;
    double most;  ///< that the evidence can come to
    std::optional<Growth> growth = {};
  };

  /// From where an earlier search with another noise ended, if it knew the set and the fit holds with this noise.
  [[nodiscard]] std::optional<CommonFit> fitted(Job& job, double worth) const {
    if (const auto again = again_.find(job.key); again != again_.end()) return again->second;
    if (const auto known = before_.find(job.key); known != before_.end())
      if (auto again = fitter_.refitted(*known->second, worth)) return again;
    if (!job.growth) return fitter_.grown(*job.from, *job.kind, worth);
    Growth growth = std::move(*job.growth);
    job.growth.reset();
    return fitter_.grown(*job.from, *job.kind, std::move(growth), worth);
  }

  /// The likelier of what is known of a set and what comes now; whether that is new.
  bool keep(const Key& key, CommonFit fit) {
    const auto [known, is_new] = all_.try_emplace(key, fit);
    if (is_new) return true;
    if (!likelier(fit, known->second)) return false;
    known->second = std::move(fit);
    return true;
  }

  /// One for each new set, from the likeliest of the smaller ones, which come first; largest promise first.
  std::vector<Job> jobs_of(const std::vector<CommonFit>& from, bool every_law) {
    std::vector<Job> jobs;
    for (const CommonFit& smaller : from)
      for (const KindPointer& kind : fitter_.kinds()) {
        if (!suits(smaller, *kind) || !(every_law || kind->is_linear())) continue;
        Key key = key_with(smaller.kinds, *kind);
        if (tried_.insert(key).second) jobs.push_back({&smaller, &kind, std::move(key), INFINITY});
      }
    tbb::parallel_for(std::size_t{0}, jobs.size(), [&](std::size_t k) {
      Job& job = jobs[k];
      if (fitter_.of_several()) return;
      job.growth = fitter_.growth(*job.from, *job.kind);
      job.most = job.growth ? job.growth->most : -INFINITY;
    });
    std::erase_if(jobs, [](const Job& job) { return job.most == -INFINITY; });
    std::stable_sort(jobs.begin(), jobs.end(), [](const Job& a, const Job& b) { return a.most > b.most; });
    return jobs;
  }

  /// The evidence of the last of the `kept` best; −∞: there are fewer.
  static double lowest_of(const std::map<Key, CommonFit>& sets, std::size_t kept) {
    if (sets.size() < kept) return -INFINITY;
    if (kept == 0) return INFINITY;
    std::vector<double> values;
    for (const auto& [key, fit] : sets) values.push_back(fit.log_evidence);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(kept - 1), values.end(),
                     std::greater<>());
    return values[kept - 1];
  }

  /// Fibres alone hold nothing together. A second term of the same kind says something for powers of the stretches
  /// only.
  [[nodiscard]] bool suits(const CommonFit& from, const Kind& kind) const {
    if (from.lacks_a_term() && !kind.isotropic()) return false;
    if (request_.most_parameters > 0 && parameters_of(from.kinds) + 1 + kind.shapes.size() > request_.most_parameters)
      return false;
    if (kind.invariant == "stretches") return true;
    return std::none_of(from.kinds.begin(), from.kinds.end(),
                        [&](const KindPointer& k) { return k->name == kind.name; });
  }

  const CommonFitter& fitter_;
  const Search& request_;
  std::set<Key> tried_, distilled_;
  std::map<Key, CommonFit> all_;
  std::map<Key, const CommonFit*> before_;
  std::map<Key, CommonFit> again_;  ///< of these, fitted with this noise
};

}  // namespace

bool is_far(const CommonFit& fit) {
  Eigen::Index rows = 0;
  for (const SetFit& one : fit.specimens) rows += one.fit.residuals.size();
  return fit.chi2() > far * static_cast<double>(rows);
}

std::vector<CommonFit> search(const CommonFitter& fitter, const Search& request, const IsClean& is_clean) {
  constexpr std::size_t pairs = 2;
  Ledger ledger(fitter, request);
  if (request.ends_where_far)
    if (std::vector<CommonFit> earlier = ledger.earlier(); !earlier.empty() && is_far(earlier.front())) return earlier;
  std::vector<CommonFit> level{fitter.root()};
  const std::size_t first = fitter.root().kinds.size();
  if (first > 0) ledger.begin_with(fitter.root());
  for (std::size_t size = first + 1; size <= request.most_terms && !level.empty(); ++size) {
    const std::size_t most = size < first + pairs ? std::numeric_limits<std::size_t>::max() : request.beam;
    std::vector<CommonFit> grown = ledger.grow(level, most, !request.linear_first);
    if (grown.empty()) break;
    const CommonFit best = ledger.sorted().front();
    // Nothing is left to explain, and one term more was not worth its price.
    if (size >= pairs && best.kinds.size() < size && is_clean(best)) break;
    grown.resize(std::min(grown.size(), most));
    level = std::move(grown);
  }
  ledger.exchange();
  return ledger.sorted();
}

}  // namespace tunica::discovery
