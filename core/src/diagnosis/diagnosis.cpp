// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/admissibility.hpp"
#include "diagnosis/base_fit.hpp"
#include "diagnosis/causes.hpp"
#include "diagnosis/detectable.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/gross_rows.hpp"
#include "diagnosis/groups.hpp"
#include "diagnosis/large_noise.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/naming.hpp"
#include "diagnosis/next_experiment.hpp"
#include "diagnosis/outputs.hpp"
#include "diagnosis/refit_draws.hpp"
#include "diagnosis/rest.hpp"
#include "diagnosis/squares.hpp"
#include "diagnosis/vanishing_noise.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t linear_draws = 10000, quick_draws = 4000, refits = 199;

void report(const Diagnosis& d, const std::string& what, double share) {
  if (d.settings.progress) d.settings.progress(what, share);
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::nothing_detected:
      return "nothing_detected";
    case Verdict::named:
      return "named";
    case Verdict::indistinguishable:
      return "indistinguishable";
    case Verdict::suspect_data:
      return "suspect_data";
    case Verdict::unknown:
      break;
  }
  return "unknown";
}

namespace {

/// Everything that judges the base fit, and whether it raises the alarm.
struct Judgement {
  Shapes shapes;
  Eigen::MatrixXf draws;
  std::unique_ptr<Detection> detection;
  bool alarm = false;
};

/// How much larger than it is taken to be the noise could be, and the alarm would stand.
std::optional<double> alarm_factor(const Diagnosis& d, const Detection& detection) {
  constexpr double step = 1.05, most = 20;
  double factor = 1;
  while (factor * step < most && detection.judge(-d.fit.residuals / (factor * step)).p <= d.settings.alpha)
    factor *= step;
  return factor > 1 ? std::optional(factor) : std::nullopt;
}

Judgement judge(Diagnosis& d, const plugins::Catalogue& catalogue) {
  Judgement judgement;
  report(d, "fitting the base model", 0.05);
  fit_base(d, catalogue);
  settle_noise(d, catalogue);
  d.warnings.insert(d.warnings.end(), d.base->layout().warnings.begin(), d.base->layout().warnings.end());
  report(d, "signatures of the mechanisms", 0.1);
  const Projection projection(interior(d.fit));
  d.candidates = candidates(d.experiment, d.run, d.settings, *d.base, d.fit.free, projection, catalogue);
  d.directions = directions(d.candidates, projection);
  judgement.shapes = smooth_shapes(d.curves, d.fit.residuals.size());
  judgement.draws =
      noise_draws(d.curves, d.fit.residuals.size(), d.settings.quick ? quick_draws : linear_draws, d.settings.seed);
  judgement.detection =
      std::make_unique<Detection>(projection, d.directions, d.candidates.size(), judgement.shapes, judgement.draws);
  d.detection = judgement.detection->judge(-d.fit.residuals);
  const double p_squares = p_of_squares(d, d.fit);
  if (!d.settings.quick) {
    report(d, "refits of simulated data", 0.2);
    d.p_refits = p_from_refits(d, *judgement.detection, refits);
    // Below what so many refits can tell apart, the linear draws go on where none of the refits was worse.
    if (*d.p_refits * (refits + 1) < 1.5) d.p_refits = std::min(*d.p_refits, std::max(d.detection.p, 0.1 / refits));
    d.p_refits = std::min(*d.p_refits, p_squares);
  }
  d.detection.p = std::min(d.detection.p, p_squares);
  judgement.alarm = d.p_refits.value_or(d.detection.p) <= d.settings.alpha;
  return judgement;
}

/// The diagnosis without these rows, as far as whether the base fit raises the alarm.
std::pair<Diagnosis, Judgement> without(const std::vector<GrossRow>& rows, const experiment::Experiment& experiment,
                                        const Settings& settings, const plugins::Catalogue& catalogue) {
  Diagnosis d;
  d.settings = settings;
  prepare(d, experiment, catalogue, rows);
  if (!rows.empty()) leave_out(d, rows, catalogue);
  Judgement judgement = judge(d, catalogue);
  return {std::move(d), std::move(judgement)};
}

/// What the alarm is about, and what explains it. `gross`: rows that are the only thing wrong.
void explain(Diagnosis& d, const Judgement& judgement, const std::vector<GrossRow>& gross,
             const plugins::Catalogue& catalogue) {
  if (judgement.alarm) d.alarm_factor = alarm_factor(d, *judgement.detection);
  for (std::size_t c = 0; c < d.candidates.size(); ++c) d.best_direction.push_back(likeliest_direction(d, c));
  d.detectable = detectable(d, *judgement.detection);
  judge_admissibility(d);

  // What is no material is wrong however well it fits, where the user asks for it.
  const bool inadmissible = d.settings.admissibility && d.admissibility.stable == false;
  const bool alarm = judgement.alarm;
  if (alarm || inadmissible) report(d, "fitting the mechanisms", 0.4);
  if (inadmissible) name_admissible_extension(d, catalogue);
  if (d.extension) {
    d.p_after = p_of_rest(d, *d.extension, judgement.shapes, judgement.draws);
    if (alarm && d.p_after <= second_alpha) not_clean(d, *judgement.detection, judgement.draws, judgement.shapes);
  } else if (alarm && !gross.empty()) {
    name_gross_rows(d, gross, catalogue);
    if (d.extension) d.p_after = p_of_rest(d, *d.extension, judgement.shapes, judgement.draws);
  } else if (alarm) {
    name_causes(d, *judgement.detection, judgement.draws, judgement.shapes, catalogue);
    // Whatever explains the curves: a cause under which the material stays unstable is not the whole of it.
    if (inadmissible && d.verdict == Verdict::named) d.verdict = Verdict::unknown;
  }
  d.misfit = misfits(d);
  if (!alarm && !inadmissible)
    d.reasons.push_back(
        fmt::format("what is left over could be noise (p = {:.2g})", d.p_refits.value_or(d.detection.p)));
  d.left_out = causes_of_rows(d, catalogue);
}

}  // namespace

Diagnosis diagnose(const experiment::Experiment& experiment, const Settings& settings,
                   const plugins::Catalogue& catalogue) {
  auto [d, judgement] = without({}, experiment, settings, catalogue);
  std::vector<GrossRow> gross;
  if (judgement.alarm) gross = gross_rows(d);
  if (!gross.empty()) {
    auto [clean, rest] = without(gross, experiment, settings, catalogue);
    // Where something is wrong with the other rows too, the gross ones would only be in its way.
    if (rest.alarm) d = std::move(clean), judgement = std::move(rest), gross.clear();
  }
  explain(d, judgement, gross, catalogue);
  // Rows that the causes explain were no gross errors.
  if (const auto rows = still_gross(d); rows.size() < d.gross.size()) {
    std::tie(d, judgement) = without(rows, experiment, settings, catalogue);
    explain(d, judgement, {}, catalogue);
  }
  if (d.extension) {
    report(d, "gain on rows that were not fitted", 0.7);
    measure_gain(d);
    d.gain->expected_under_nothing = judgement.detection->gain_of_nothing();
    if (!settings.quick) refine_intervals(d, catalogue);
    warn_of_run(d, gross, catalogue);
  }
  warn_of_large_noise(d, d.extension ? d.extension->fit : d.fit);
  if (d.verdict != Verdict::nothing_detected) warn_of_vanishing_noise(d);
  report(d, "the next experiment", 0.9);
  d.next = next_experiment(d, catalogue);
  report(d, "done", 1);
  return std::move(d);
}

}  // namespace tunica::diagnosis
