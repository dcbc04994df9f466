// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/calibrated_fits.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/uniform_real_distribution.hpp>
#include <tbb/parallel_for.h>

#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/extension.hpp"
#include "numerics/orthogonal.hpp"
#include "tunica/error.hpp"
#include "tunica/random.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t most_fits = 12;  ///< corrections with the largest score
constexpr double least_seen = 6;       ///< of |r|², at the null
constexpr std::size_t full_search = 60, short_search = 30;
constexpr std::size_t calibration_starts = 3;
constexpr std::size_t quick_again_calibrated = 3;  ///< that are begun again at random points, those that take most
constexpr double smallest_gain = 2;                ///< of |r|²: less is no explanation

/// A correction at its null, and its score on the residuals.
struct Seen {
  const Correction* correction = nullptr;
  std::shared_ptr<const Extension> extension;
  Eigen::VectorXd amplitudes;  ///< that the linearisation promises
  double squares = 0;          ///< of |r|², that it takes
};

class Calibrating {
 public:
  Calibrating(const Inquiry& inquiry, const Analysis& analysis, const Record& record)
      : inquiry_(inquiry), evidence_(analysis.evidence), projection_(analysis.hypotheses.projection), record_(record) {}

  [[nodiscard]] std::optional<Seen> seen(const Correction& correction) const {
    Seen found;
    found.correction = &correction;
    try {
      found.extension = extended(correction.additions);
    } catch (const InputError&) {
      return std::nullopt;
    }
    const assembly::Assembly& assembly = found.extension->assembly();
    if (assembly.layout().residual_count != static_cast<std::size_t>(evidence_.fit.residuals.size()))
      return std::nullopt;
    Eigen::VectorXd residuals;
    Eigen::MatrixXd jacobian;
    if (!whitened(assembly, found.extension->at_null(evidence_.fit.free), *assembly.evaluator().make_workspace(),
                  residuals, &jacobian)
             .ok())
      return std::nullopt;
    const auto& parts = found.extension->parts();
    Eigen::MatrixXd signatures = Eigen::MatrixXd::Zero(jacobian.rows(), static_cast<Eigen::Index>(parts.size()));
    for (std::size_t k = 0; k < parts.size(); ++k)
      for (const std::size_t member : parts[k].amplitude)
        signatures.col(static_cast<Eigen::Index>(k)) += jacobian.col(static_cast<Eigen::Index>(member));
    signatures = projection_.off(signatures);
    if (!signatures.allFinite()) return std::nullopt;
    found.amplitudes = numerics::least_squares_solution(signatures, -evidence_.fit.residuals, 1e-6);
    found.squares = evidence_.fit.chi2 - (evidence_.fit.residuals + signatures * found.amplitudes).squaredNorm();
    return found;
  }

  /// From what the linearisation promises and from a third of it, at the base optimum and at the initial values.
  [[nodiscard]] CorrectedFit fitted(const Seen& seen) const {
    CorrectedFit corrected{seen.correction, {seen.extension, &seen.extension->assembly()}, {}, 0};
    for (const double share : {1.0, 0.3})
      try_from(seen, evidence_.fit.free, share * seen.amplitudes, full_search, corrected);
    const assembly::UnitBox& box = evidence_.base->box();
    std::vector<double> point(evidence_.fit.free.size());
    box.from_unit(box.initial(), point);
    try_from(seen, point, amplitudes_of(seen, corrected), full_search, corrected);
    return corrected;
  }

  /// From random points of the base, which may have gone far to make up for the mistake.
  void search_again(const Seen& seen, CorrectedFit& corrected) const {
    boost::random::mt19937_64 generator(derive_seed(inquiry_.request.seed, seen.correction->mend));
    boost::random::uniform_real_distribution<double> uniform(0.02, 0.98);
    std::vector<double> point(evidence_.fit.free.size()), unit(point.size());
    for (std::size_t k = 0; k < calibration_starts; ++k) {
      for (double& x : unit) x = uniform(generator);
      evidence_.base->box().from_unit(unit, point);
      try_from(seen, point, amplitudes_of(seen, corrected), short_search, corrected);
    }
  }

  /// With its amplitudes and its weight; none if it explains nothing or is implausible.
  [[nodiscard]] std::optional<CorrectedFit> weighed(const Seen& seen, CorrectedFit corrected) const {
    if (corrected.fit.residuals.size() == 0 || !(corrected.fit.chi2 < evidence_.fit.chi2 - smallest_gain))
      return std::nullopt;
    const Eigen::VectorXd values = amplitudes_of(seen, corrected);
    for (std::size_t k = 0; k < seen.extension->parts().size(); ++k) {
      const MechanismFactory& factory = mechanism(k, seen);
      const AmplitudeRange range = range_of(factory, seen.extension->additions()[k]);
      Amplitude amplitude{factory.parameters.front().name, factory.parameters.front().unit};
      amplitude.value = values[static_cast<Eigen::Index>(k)];
      amplitude.low = amplitude.high = NAN;
      if (!(amplitude.value >= range.plausible_min && amplitude.value <= range.plausible_max)) return std::nullopt;
      corrected.amplitudes.push_back(std::move(amplitude));
    }
    const auto rows = static_cast<double>(corrected.fit.residuals.size());
    corrected.log_weight = seen.correction->log_prior - corrected.fit.chi2 / 2 -
                           static_cast<double>(corrected.amplitudes.size()) * std::log(rows) / 2;
    return corrected;
  }

 private:
  /// Of the fit so far, else what the linearisation promises.
  [[nodiscard]] static Eigen::VectorXd amplitudes_of(const Seen& seen, const CorrectedFit& corrected) {
    Eigen::VectorXd values = seen.amplitudes;
    if (corrected.fit.residuals.size() > 0)
      for (Eigen::Index k = 0; k < values.size(); ++k)
        values[k] = corrected.fit.free[seen.extension->parts()[static_cast<std::size_t>(k)].amplitude.front()];
    return values;
  }

  void try_from(const Seen& seen, const std::vector<double>& base, const Eigen::VectorXd& amplitudes, std::size_t steps,
                CorrectedFit& corrected) const {
    const Extension& extension = *seen.extension;
    std::vector<double> start = extension.at_null(base);
    for (std::size_t k = 0; k < extension.parts().size(); ++k) {
      const AmplitudeRange range = range_of(mechanism(k, seen), extension.additions()[k]);
      const double amplitude =
          std::clamp(amplitudes[static_cast<Eigen::Index>(k)], range.plausible_min, range.plausible_max);
      for (const std::size_t member : extension.parts()[k].amplitude) start[member] = amplitude;
    }
    const bool first = corrected.fit.residuals.size() == 0;
    const auto workspace = extension.assembly().evaluator().make_workspace();
    Fit fit = least_squares(extension.assembly(), extension.variables(), start, *workspace, steps,
                            {.wanted = first ? evidence_.fit.chi2 : std::min(evidence_.fit.chi2, corrected.fit.chi2),
                             .negligible = says_nothing});
    if (!fit.status.ok() || !std::isfinite(fit.chi2)) return;
    if (first || fit.chi2 < corrected.fit.chi2) corrected.fit = std::move(fit);
  }

  [[nodiscard]] const MechanismFactory& mechanism(std::size_t part, const Seen& seen) const {
    return inquiry_.mechanism(seen.extension->additions()[part].id);
  }

  /// With the amplitudes that the data allow.
  [[nodiscard]] std::shared_ptr<const Extension> extended(std::vector<Addition> additions) const {
    const auto with = [&](std::vector<Addition> all) {
      return std::make_shared<const Extension>(record_.experiment(), evidence_.run, std::move(all), inquiry_.catalogue);
    };
    auto declared = with(additions);
    const MechanismFactory& factory = inquiry_.mechanism(additions.front().id);
    if (!(factory.plausible_effect > 0) || additions.size() > 1) return declared;
    Addition by_effect = declared->additions().front();
    const auto range =
        range_from_data(*declared, factory, {MechanismFactory::Setting{}}, declared->at_null(evidence_.fit.free),
                        *declared->assembly().evaluator().make_workspace());
    if (!range) return declared;
    by_effect.range = range;
    return with({by_effect});
  }

  const Inquiry& inquiry_;
  const Evidence& evidence_;
  const Projection& projection_;
  const Record& record_;
};

}  // namespace

std::vector<CorrectedFit> calibrated_fits(const Inquiry& inquiry, const Analysis& analysis, const Record& record,
                                          const Corrections& corrections) {
  const Calibrating calibrating(inquiry, analysis, record);
  std::vector<const Correction*> with_amplitude;
  for (const Correction& one : corrections)
    if (!one.additions.empty()) with_amplitude.push_back(&one);
  std::vector<std::optional<Seen>> tried(with_amplitude.size());
  tbb::parallel_for(std::size_t{0}, tried.size(),
                    [&](std::size_t k) { tried[k] = calibrating.seen(*with_amplitude[k]); });
  std::vector<Seen> seen;
  for (auto& one : tried)
    if (one && one->squares > least_seen) seen.push_back(std::move(*one));
  std::stable_sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) { return a.squares > b.squares; });
  seen.resize(std::min(seen.size(), most_fits));
  std::vector<CorrectedFit> fits(seen.size());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t k) { fits[k] = calibrating.fitted(seen[k]); });
  std::vector<std::size_t> order(fits.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto squares = [&](std::size_t k) { return fits[k].fit.residuals.size() > 0 ? fits[k].fit.chi2 : INFINITY; };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return squares(a) < squares(b); });
  if (inquiry.request.quick) order.resize(std::min(order.size(), quick_again_calibrated));
  tbb::parallel_for(std::size_t{0}, order.size(),
                    [&](std::size_t k) { calibrating.search_again(seen[order[k]], fits[order[k]]); });
  std::vector<CorrectedFit> all;
  for (std::size_t k = 0; k < fits.size(); ++k)
    if (auto fit = calibrating.weighed(seen[k], std::move(fits[k]))) all.push_back(std::move(*fit));
  return all;
}

}  // namespace tunica::diagnosis
