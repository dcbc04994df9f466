// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/diagnosis.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/admissibility.hpp"
#include "diagnosis/base_fit.hpp"
#include "diagnosis/causes.hpp"
#include "diagnosis/detectable.hpp"
#include "diagnosis/gain.hpp"
#include "diagnosis/misfit.hpp"
#include "diagnosis/naming.hpp"
#include "diagnosis/next_experiment.hpp"
#include "diagnosis/refit_draws.hpp"

namespace tunica::diagnosis {
namespace {

constexpr std::size_t linear_draws = 10000, quick_draws = 4000;

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

Diagnosis diagnose(const experiment::Experiment& experiment, const Settings& settings,
                   const plugins::Catalogue& catalogue) {
  Diagnosis d;
  d.settings = settings;
  prepare(d, experiment, catalogue);
  report(d, "fitting the base model", 0.05);
  fit_base(d, catalogue);
  settle_noise(d, catalogue);
  report(d, "signatures of the mechanisms", 0.1);
  const Projection projection(interior(d.fit));
  d.candidates = candidates(d.experiment, d.run, settings, *d.base, d.fit.free, projection, catalogue);
  d.directions = directions(d.candidates, projection);
  const Shapes shapes = smooth_shapes(d.curves, d.fit.residuals.size());
  const Eigen::MatrixXf draws =
      noise_draws(d.curves, d.fit.residuals.size(), settings.quick ? quick_draws : linear_draws, settings.seed);
  const Detection detection(projection, d.directions, d.candidates.size(), shapes, draws);
  d.detection = detection.judge(-d.fit.residuals);
  d.misfit = misfits(d);
  d.detectable = detectable(d, detection);
  judge_admissibility(d, catalogue);

  bool alarm = d.detection.p <= settings.alpha;
  if (!settings.quick) {
    report(d, "refits of simulated data", 0.2);
    d.p_refits = p_from_refits(d, detection, 199);
    alarm = *d.p_refits <= settings.alpha;
  }
  // What is no material is wrong however well it fits, where the user asks for it.
  const bool inadmissible = settings.admissibility && d.admissibility.stable == false;
  if (alarm || inadmissible) report(d, "fitting the mechanisms", 0.4);
  if (inadmissible) name_admissible_extension(d, catalogue);
  if (alarm && !d.extension) name_causes(d, detection, draws, shapes, catalogue);
  if (!alarm && !inadmissible)
    d.reasons.push_back(
        fmt::format("what is left over could be noise (p = {:.2g})", d.p_refits.value_or(d.detection.p)));
  if (d.extension) {
    report(d, "gain on rows that were not fitted", 0.7);
    measure_gain(d, catalogue);
    d.gain->expected_under_nothing = detection.gain_of_nothing();
    if (!settings.quick) refine_intervals(d, catalogue);
  }
  report(d, "the next experiment", 0.9);
  d.next = next_experiment(d, catalogue);
  report(d, "done", 1);
  return d;
}

}  // namespace tunica::diagnosis
