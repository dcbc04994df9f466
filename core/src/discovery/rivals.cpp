// SPDX-License-Identifier: Apache-2.0
#include "discovery/rivals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/memory.hpp"
#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "diagnosis/naming/remainder.hpp"
#include "diagnosis/naming/singles.hpp"
#include "numerics/eigenpairs.hpp"

namespace tunica::discovery {
namespace {

/// Laplace's approximation as for terms (set_fit.hpp): amplitudes are uniform over their plausible range, all other
/// parameters over their box.
double log_evidence(const diagnosis::Inquiry& inquiry, const diagnosis::Refit& refit) {
  const double of_uniform = 1 / std::sqrt(2 * std::numbers::pi);
  const auto& extension = *refit.extension;
  const auto& parameters = extension.assembly().layout().parameters;
  const std::vector<diagnosis::Variable> variables = extension.variables();
  Eigen::MatrixXd J = refit.fit.jacobian;
  for (std::size_t k = 0; k < variables.size(); ++k) {
    const std::size_t j = variables[k].front();
    auto column = J.col(static_cast<Eigen::Index>(k));
    if (refit.fit.at_bound[k]) {
      column.setZero();
      continue;
    }
    double wide = parameters[j].max - parameters[j].min;
    if (parameters[j].scale == Scale::log) wide = refit.fit.free[j] * std::log(parameters[j].max / parameters[j].min);
    for (std::size_t a = 0; a < extension.parts().size(); ++a)
      if (extension.parts()[a].amplitude == variables[k]) {
        const auto range = diagnosis::range_of(inquiry.mechanism(refit.additions[a].id), refit.additions[a]);
        wide = range.plausible_max - range.plausible_min;
      }
    column *= wide * of_uniform;
  }
  Eigen::MatrixXd H = J.transpose() * J;
  H.diagonal().array() += 1;
  return -refit.fit.chi2 / 2 - 0.5 * numerics::eigenpairs(H).values.array().max(1.0).log().sum();
}

}  // namespace

std::vector<Rival> rivals_of(const diagnosis::Inquiry& inquiry, const diagnosis::Analysis& analysis) {
  std::vector<Rival> rivals;
  const std::vector<diagnosis::Single> singles = diagnosis::fit_singles(inquiry, analysis);
  std::size_t of_rig = 0;
  for (const diagnosis::Single& single : singles) {
    const auto& candidate = analysis.hypotheses.candidates[single.candidate];
    const bool rig = diagnosis::group_of(*candidate.mechanism) == diagnosis::CauseGroup::rig;
    of_rig += rig ? 1 : 0;
    if (!single.best) continue;
    Rival rival{candidate.id, single.best->additions.front().place};
    rival.remembers = assembly::has_memory(*candidate.mechanism);
    rival.in_the_energy = !rig && !rival.remembers;
    rival.chi2 = single.best->fit.chi2;
    rival.clean = diagnosis::is_clean(diagnosis::p_of_remainder(analysis, *single.best));
    rival.log_evidence = log_evidence(inquiry, *single.best);
    const auto range = diagnosis::range_of(*candidate.mechanism, single.best->additions.front());
    const double amplitude = single.best->fit.free[single.best->extension->parts().front().amplitude.front()];
    rival.plausible = amplitude >= range.plausible_min && amplitude <= range.plausible_max;
    rivals.push_back(std::move(rival));
  }
  for (Rival& rival : rivals) {
    rival.log_prior = -std::log(static_cast<double>(std::max<std::size_t>(of_rig, 1)));
    rival.log_evidence += rival.log_prior;
  }
  std::stable_sort(rivals.begin(), rivals.end(),
                   [](const Rival& a, const Rival& b) { return a.log_evidence > b.log_evidence; });
  return rivals;
}

}  // namespace tunica::discovery
