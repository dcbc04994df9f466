// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/corrected_fits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <tbb/parallel_for.h>

#include "diagnosis/detection/squares.hpp"
#include "diagnosis/evidence/projection.hpp"
#include "diagnosis/file/calibrated_fits.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t first_steps = 30, full_steps = 60;
constexpr std::size_t quick_again = 4, full_again = 8;  ///< corrections that are searched for again, the likeliest
constexpr std::size_t starts_again = 4;
constexpr double gain_of_note = 2;  ///< of |r|²: less is no explanation
constexpr double same_rung = 1;     ///< of |r|²: a rung that is worse by more ends the ladder

class Fitting {
 public:
  Fitting(const Inquiry& inquiry, const Analysis& analysis, const Record& record)
      : inquiry_(inquiry), evidence_(analysis.evidence), record_(record) {}

  /// From the base optimum and the initial values; none where the data cannot be read so. `gives_up`: ends
  /// early where it will be no better than the base fit.
  [[nodiscard]] std::optional<CorrectedFit> fitted(const Correction& correction, bool gives_up) const {
    Record read = record_;
    if (!correction.apply(read)) return std::nullopt;
    CorrectedFit corrected{&correction, nullptr, {}, 0};
    try {
      corrected.assembly =
          std::make_shared<const assembly::Assembly>(read.experiment(), evidence_.run, inquiry_.catalogue);
    } catch (const InputError&) {
      return std::nullopt;
    }
    const auto& parameters = corrected.assembly->layout().parameters;
    if (parameters.size() != evidence_.fit.free.size()) return std::nullopt;
    std::vector<double> initial(parameters.size());
    corrected.assembly->box().from_unit(corrected.assembly->box().initial(), initial);
    for (const std::vector<double>& start : {evidence_.fit.free, initial})
      try_from(corrected, start, first_steps, gives_up);
    if (!corrected.fit.status.ok() || corrected.fit.residuals.size() != evidence_.fit.residuals.size())
      return std::nullopt;
    corrected.log_weight = correction.log_prior - corrected.fit.chi2 / 2;
    return corrected;
  }

  void search_again(CorrectedFit& corrected) const {
    const assembly::Assembly& assembly = *corrected.assembly;
    boost::random::mt19937_64 generator(derive_seed(inquiry_.request.seed, corrected.correction->sentence));
    boost::random::uniform_real_distribution<double> uniform(0.02, 0.98);
    try_from(corrected, corrected.fit.free, full_steps, false);
    for (std::size_t k = 0; k < starts_again; ++k) {
      std::vector<double> unit(assembly.layout().parameters.size()), free(unit.size());
      for (double& x : unit) x = uniform(generator);
      assembly.box().from_unit(unit, free);
      try_from(corrected, free, first_steps, false);
    }
    try_from(corrected, corrected.fit.free, full_steps, false);
    corrected.log_weight = corrected.correction->log_prior - corrected.fit.chi2 / 2;
  }

  /// One that is noticeably better than the base fit.
  [[nodiscard]] bool helps(const CorrectedFit& corrected) const {
    return corrected.fit.chi2 < evidence_.fit.chi2 - gain_of_note;
  }

 private:
  void try_from(CorrectedFit& corrected, const std::vector<double>& start, std::size_t evaluations,
                bool gives_up) const {
    const auto workspace = corrected.assembly->evaluator().make_workspace();
    const DataVariant variant{nullptr, nullptr, gives_up ? evidence_.fit.chi2 : std::numeric_limits<double>::infinity(),
                              says_nothing};
    Fit fit =
        least_squares(*corrected.assembly, all_variables(*corrected.assembly), start, *workspace, evaluations, variant);
    if (!fit.status.ok() || !std::isfinite(fit.chi2)) return;
    if (corrected.fit.residuals.size() == 0 || fit.chi2 < corrected.fit.chi2) corrected.fit = std::move(fit);
  }

  const Inquiry& inquiry_;
  const Evidence& evidence_;
  const Record& record_;
};

/// Corrections that are fitted in order: one side of a ladder from the smallest factor, or a single correction.
using Climb = std::vector<const Correction*>;

std::vector<Climb> climbs_of(const Corrections& corrections) {
  std::vector<Climb> climbs;
  std::map<std::pair<std::string, bool>, std::size_t> sides;
  for (const Correction& one : corrections) {
    if (!one.additions.empty()) continue;
    if (one.ladder.empty()) {
      climbs.push_back({&one});
      continue;
    }
    const auto [side, added] = sides.try_emplace({one.ladder, one.rung > 0}, climbs.size());
    if (added) climbs.emplace_back();
    climbs[side->second].push_back(&one);
  }
  for (Climb& climb : climbs)
    std::stable_sort(climb.begin(), climb.end(),
                     [](const Correction* a, const Correction* b) { return std::abs(a->rung) < std::abs(b->rung); });
  return climbs;
}

}  // namespace

std::vector<CorrectedFit> corrected_fits(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                                         const Corrections& corrections) {
  const Fitting fitting(inquiry, analysis, record);
  const std::vector<Climb> climbs = climbs_of(corrections);
  std::vector<std::vector<CorrectedFit>> fits(climbs.size());
  tbb::parallel_for(std::size_t{0}, climbs.size(), [&](std::size_t k) {
    double before = analysis.evidence.fit.chi2;
    for (const Correction* const correction : climbs[k]) {
      auto corrected = fitting.fitted(*correction, true);
      const double now = corrected ? corrected->fit.chi2 : INFINITY;
      if (corrected && fitting.helps(*corrected)) fits[k].push_back(std::move(*corrected));
      if (!(now < before + same_rung)) break;
      before = std::min(before, now);
    }
  });
  std::vector<CorrectedFit> all = calibrated_fits(inquiry, analysis, record, corrections);
  for (auto& climb : fits) std::move(climb.begin(), climb.end(), std::back_inserter(all));
  const auto by_weight = [](const CorrectedFit& a, const CorrectedFit& b) { return a.log_weight > b.log_weight; };
  std::stable_sort(all.begin(), all.end(), by_weight);
  std::vector<std::size_t> exact;
  for (std::size_t k = 0; k < all.size() && exact.size() < (inquiry.request.quick ? quick_again : full_again); ++k)
    if (all[k].amplitudes.empty()) exact.push_back(k);
  tbb::parallel_for(std::size_t{0}, exact.size(), [&](std::size_t k) { fitting.search_again(all[exact[k]]); });
  std::stable_sort(all.begin(), all.end(), by_weight);
  return all;
}

bool leaves_noise(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                  const Correction& correction) {
  const auto corrected = Fitting(inquiry, analysis, record).fitted(correction, false);
  return corrected && is_clean(p_of_corrected(analysis, *corrected));
}

double p_of_corrected(const Analysis& analysis, const CorrectedFit& corrected) {
  const Projection projection(interior(corrected.fit));
  const std::vector<Candidate>& candidates = analysis.hypotheses.candidates;
  const Detector detector(projection, directions(candidates, projection), candidates.size(), analysis.alarm.shapes,
                          analysis.alarm.draws);
  return std::min(detector.test(-corrected.fit.residuals).p, p_of_squares(analysis.evidence, corrected.fit));
}

}  // namespace tunica::diagnosis
