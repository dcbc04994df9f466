// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/file/calibrated_fits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
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

constexpr std::size_t most_fits = 12;  ///< corrections, those that see most
constexpr double least_seen = 6;       ///< of |r|², at the null
constexpr std::size_t full_search = 60, short_search = 30;
constexpr std::size_t calibration_starts = 3;
constexpr double smallest_gain = 2;  ///< of |r|²: less is no explanation

/// A correction at its null, and what it sees of the residuals.
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

  /// From what the linearisation promises and from a third of it, at the base optimum and at the initial values; then
  /// from random points of the base. The base may have gone far to make up for the mistake.
  [[nodiscard]] std::optional<CorrectedFit> fitted(const Seen& seen) const {
    const Extension& extension = *seen.extension;
    const assembly::Assembly& assembly = extension.assembly();
    const auto workspace = assembly.evaluator().make_workspace();
    CorrectedFit corrected{seen.correction, {seen.extension, &assembly}, {}, 0};
    std::vector<double> amplitudes(seen.amplitudes.data(), seen.amplitudes.data() + seen.amplitudes.size());
    const auto try_from = [&](const std::vector<double>& base, double share, std::size_t steps) {
      std::vector<double> start = extension.at_null(base);
      for (std::size_t k = 0; k < amplitudes.size(); ++k) {
        const AmplitudeRange range = range_of(mechanism(k, seen), extension.additions()[k]);
        const double amplitude = std::clamp(share * amplitudes[k], range.plausible_min, range.plausible_max);
        for (const std::size_t member : extension.parts()[k].amplitude) start[member] = amplitude;
      }
      Fit fit = least_squares(assembly, extension.variables(), start, *workspace, steps,
                              {.wanted = std::min(evidence_.fit.chi2, corrected.fit.residuals.size() > 0
                                                                          ? corrected.fit.chi2
                                                                          : std::numeric_limits<double>::infinity()),
                               .negligible = says_nothing});
      if (!fit.status.ok() || !std::isfinite(fit.chi2)) return;
      if (corrected.fit.residuals.size() > 0 && !(fit.chi2 < corrected.fit.chi2)) return;
      for (std::size_t k = 0; k < amplitudes.size(); ++k)
        amplitudes[k] = fit.free[extension.parts()[k].amplitude.front()];
      corrected.fit = std::move(fit);
    };
    const assembly::UnitBox& box = evidence_.base->box();
    std::vector<double> point(evidence_.fit.free.size()), unit(point.size());
    box.from_unit(box.initial(), point);
    for (const double share : {1.0, 0.3}) try_from(evidence_.fit.free, share, full_search);
    try_from(point, 1, full_search);
    boost::random::mt19937_64 generator(derive_seed(inquiry_.request.seed, seen.correction->mend));
    boost::random::uniform_real_distribution<double> uniform(0.02, 0.98);
    for (std::size_t k = 0; k < calibration_starts; ++k) {
      for (double& x : unit) x = uniform(generator);
      box.from_unit(unit, point);
      try_from(point, 1, short_search);
    }
    if (corrected.fit.residuals.size() == 0 || !(corrected.fit.chi2 < evidence_.fit.chi2 - smallest_gain))
      return std::nullopt;
    for (std::size_t k = 0; k < extension.parts().size(); ++k) {
      const MechanismFactory& factory = mechanism(k, seen);
      const AmplitudeRange range = range_of(factory, extension.additions()[k]);
      Amplitude amplitude{factory.parameters.front().name, factory.parameters.front().unit};
      amplitude.value = corrected.fit.free[extension.parts()[k].amplitude.front()];
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
  std::vector<std::optional<CorrectedFit>> fits(seen.size());
  tbb::parallel_for(std::size_t{0}, seen.size(), [&](std::size_t k) { fits[k] = calibrating.fitted(seen[k]); });
  std::vector<CorrectedFit> all;
  for (auto& fit : fits)
    if (fit) all.push_back(std::move(*fit));
  return all;
}

}  // namespace tunica::diagnosis
