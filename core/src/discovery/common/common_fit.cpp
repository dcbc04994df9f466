// SPDX-License-Identifier: Apache-2.0
#include "discovery/common/common_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace tunica::discovery {
namespace {

std::size_t count_of(const std::vector<KindPointer>& kinds, const std::string& name) {
  return static_cast<std::size_t>(
      std::count_if(kinds.begin(), kinds.end(), [&](const KindPointer& kind) { return kind->name == name; }));
}

/// Whether each term is seen in half of the specimens at least: others are no property of the tissue.
bool is_common(const CommonFit& fit) {
  return std::all_of(fit.kinds.begin(), fit.kinds.end(), [&](const KindPointer& kind) {
    const std::size_t wanted = count_of(fit.kinds, kind->name);
    const auto seen = std::count_if(fit.specimens.begin(), fit.specimens.end(),
                                    [&](const SetFit& one) { return count_of(one.kinds, kind->name) >= wanted; });
    return 2 * static_cast<std::size_t>(seen) >= fit.specimens.size();
  });
}

/// Of the copy of a kind that comes after so many others; none where there are fewer.
std::optional<std::size_t> place_of(const std::vector<KindPointer>& kinds, const std::string& name,
                                    std::size_t copies_before) {
  for (std::size_t k = 0; k < kinds.size(); ++k)
    if (kinds[k]->name == name && copies_before-- == 0) return k;
  return std::nullopt;
}

void sort_by_name(std::vector<KindPointer>& kinds) {
  std::stable_sort(kinds.begin(), kinds.end(), [](const auto& a, const auto& b) { return a->name < b->name; });
}

}  // namespace

double CommonFit::chi2() const {
  return std::accumulate(specimens.begin(), specimens.end(), 0.0,
                         [](double sum, const SetFit& one) { return sum + one.chi2(); });
}

std::size_t CommonFit::parameter_count() const {
  std::size_t count = 0;
  for (const SetFit& one : specimens) count += one.parameter_count();
  return count;
}

bool CommonFit::lacks_a_term() const {
  return std::any_of(specimens.begin(), specimens.end(), [](const SetFit& one) { return !one.set; });
}

double data_evidence(const SetFit& fit, bool from_nothing) {
  return fit.log_evidence - log_prior(fit.kinds, from_nothing);
}

CommonFitter::CommonFitter(std::vector<const Fitter*> fitters, const std::vector<std::vector<KindPointer>>& kinds,
                           bool from_nothing)
    : fitters_(std::move(fitters)), own_(fitters_.size()), from_nothing_(from_nothing) {
  std::map<std::string, std::size_t> seen;
  for (std::size_t s = 0; s < fitters_.size(); ++s)
    for (const KindPointer& kind : kinds[s]) {
      own_[s].emplace(kind->name, kind);
      if (++seen[kind->name] == 1) kinds_.push_back(kind);
    }
  std::erase_if(kinds_, [&](const KindPointer& kind) { return 2 * seen[kind->name] < fitters_.size(); });
  for (const Fitter* fitter : fitters_) root_.specimens.push_back(fitter->root());
  root_.kinds = fitters_.front()->root().kinds;
  std::vector<std::size_t> all(fitters_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  root_.log_evidence = log_evidence(root_, all);
}

double CommonFitter::log_evidence(const CommonFit& fit, const std::vector<std::size_t>& specimens) const {
  if (fitters_.size() == 1) return fit.specimens.front().log_evidence;
  double sum = log_prior(fit.kinds, from_nothing_);
  for (const std::size_t s : specimens)
    sum += data_evidence(fit.specimens[s], from_nothing_) - static_cast<double>(fit.kinds.size()) * std::numbers::ln2;
  return sum;
}

KindPointer CommonFitter::own(std::size_t specimen, const Kind& kind) const {
  const auto found = own_[specimen].find(kind.name);
  return found == own_[specimen].end() ? nullptr : found->second;
}

std::optional<CommonFit> CommonFitter::weighed(CommonFit fit) const {
  sort_by_name(fit.kinds);
  if (!is_common(fit)) return std::nullopt;
  std::vector<std::size_t> all(fitters_.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  fit.log_evidence = log_evidence(fit, all);
  return fit;
}

std::optional<Growth> CommonFitter::growth(const CommonFit& from, const KindPointer& kind) const {
  if (of_several()) return std::nullopt;
  const KindPointer of_specimen = own(0, *kind);
  return of_specimen ? fitters_.front()->growth(from.specimens.front(), of_specimen) : std::nullopt;
}

std::optional<CommonFit> CommonFitter::grown(const CommonFit& from, const KindPointer& kind, Growth growth,
                                             double worth) const {
  auto fit = fitters_.front()->grown(from.specimens.front(), std::move(growth), worth);
  if (!fit) return std::nullopt;
  CommonFit larger{from.kinds, {std::move(*fit)}};
  larger.kinds.push_back(kind);
  return weighed(std::move(larger));
}

std::optional<CommonFit> CommonFitter::grown(const CommonFit& from, const KindPointer& kind, double worth) const {
  const bool alone = !of_several();
  CommonFit larger{from.kinds, {}};
  larger.kinds.push_back(kind);
  for (std::size_t s = 0; s < fitters_.size(); ++s) {
    const SetFit& smaller = from.specimens[s];
    std::optional<SetFit> fit;
    if (const KindPointer of_specimen = own(s, *kind))
      fit = fitters_[s]->grown(smaller, of_specimen, alone ? worth : -INFINITY);
    if (alone && !fit) return std::nullopt;
    const bool shows = fit && (alone || data_evidence(*fit, from_nothing_) > data_evidence(smaller, from_nothing_));
    if (shows)
      larger.specimens.push_back(std::move(*fit));
    else
      larger.specimens.push_back(smaller);
  }
  return weighed(std::move(larger));
}

std::optional<CommonFit> CommonFitter::refitted(const CommonFit& before, double worth) const {
  CommonFit again;
  for (const KindPointer& kind : before.kinds) {
    const auto here =
        std::find_if(kinds_.begin(), kinds_.end(), [&](const KindPointer& one) { return one->name == kind->name; });
    if (here == kinds_.end()) return std::nullopt;
    again.kinds.push_back(*here);
  }
  for (std::size_t s = 0; s < fitters_.size(); ++s) {
    std::vector<KindPointer> kinds;
    for (const KindPointer& kind : before.specimens[s].kinds) {
      kinds.push_back(own(s, *kind));
      if (!kinds.back()) return std::nullopt;
    }
    auto fit = fitters_[s]->refitted(before.specimens[s], kinds, of_several() ? -INFINITY : worth);
    if (!fit) return std::nullopt;
    again.specimens.push_back(std::move(*fit));
  }
  return weighed(std::move(again));
}

std::optional<CommonFit> CommonFitter::with_linear(const CommonFit& from, std::size_t out,
                                                   const KindPointer& linear) const {
  CommonFit simpler{from.kinds, {}};
  simpler.kinds[out] = linear;
  const auto copies_before = static_cast<std::size_t>(
      std::count_if(from.kinds.begin(), from.kinds.begin() + static_cast<std::ptrdiff_t>(out),
                    [&](const KindPointer& kind) { return kind->name == from.kinds[out]->name; }));
  for (std::size_t s = 0; s < fitters_.size(); ++s) {
    const SetFit& fit = from.specimens[s];
    const auto power = place_of(fit.kinds, from.kinds[out]->name, copies_before);
    if (!power) {
      simpler.specimens.push_back(fit);
      continue;
    }
    const KindPointer of_specimen = own(s, *linear);
    if (!of_specimen) return std::nullopt;
    auto with = fitters_[s]->with_linear(fit, *power, of_specimen);
    if (!with) return std::nullopt;
    simpler.specimens.push_back(std::move(*with));
  }
  return weighed(std::move(simpler));
}

std::optional<CommonFit> CommonFitter::without(const CommonFit& from, std::size_t out, double worth) const {
  if (fitters_.size() > 1) return std::nullopt;
  auto fit = fitters_.front()->without(from.specimens.front(), out, worth);
  if (!fit) return std::nullopt;
  CommonFit smaller{fit->kinds, {*fit}};
  return weighed(std::move(smaller));
}

std::optional<CommonFit> CommonFitter::distilled(const CommonFit& from, const KindPointer& law, double worth) const {
  const auto same = [&](const KindPointer& kind) { return kind->invariant_words() == law->invariant_words(); };
  CommonFit simpler{from.kinds, {}};
  std::erase_if(simpler.kinds, same);
  simpler.kinds.push_back(law);
  for (std::size_t s = 0; s < fitters_.size(); ++s) {
    const SetFit& fit = from.specimens[s];
    if (std::none_of(fit.kinds.begin(), fit.kinds.end(), same)) {
      simpler.specimens.push_back(fit);
      continue;
    }
    const KindPointer of_specimen = own(s, *law);
    if (!of_specimen) return std::nullopt;
    auto with = fitters_[s]->distilled(fit, of_specimen, fitters_.size() == 1 ? worth : -INFINITY);
    if (!with) return std::nullopt;
    simpler.specimens.push_back(std::move(*with));
  }
  return weighed(std::move(simpler));
}

}  // namespace tunica::discovery
