// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/finding.hpp"
#include "text/codes.hpp"

namespace tunica::execution {

/// The kind of a warning. Scripts and the report use it, so the sentences may change.
enum class WarningKind {
  misfit_out_of_scale,
  no_misfit,
  noise_contradicted,
  search_fell_short,
  noise_too_large,
  mesh_biases_parameters,
  small_misfit,
  no_result,
  no_feasible_point,
  not_repeatable,
  not_evaluated_again,
  not_linearised,
  predicts_worse,
  unstable,
  ellipticity_lost,
  drucker_lost,
  free_faces_unstable,
  inadmissible_parameters,
  at_bound,
  stopped_at_default_bound,
  bound_in_comparison,
  not_fixed_by_data,
  failed_evaluations,
  optimizer_failure,
  same_course,
  given_up,
  depends_on_time,
  prior,
  held_out,
  not_comparable,
  other_model_preferred,
  certificate_failed,
  objective_differs,
  not_an_optimum,
  differenced_derivatives,
  equal_realisations,
  plugin_refused,
  order_assumed,
  record_broken,
  record_softening,
  record_jump,
  record_repeated,
  record_coarse,
  record_sign,
  record_time,
  record_short,
  record_percent,
  record_size,
  record_angle,
  record_noise,
  header_measure,
  header_strain,
  posterior_not_converged,
  posterior_disagrees,
  posterior_noise_assumed,
  set_up,
};

inline constexpr text::Codes<WarningKind, 56> warning_codes{
    {{WarningKind::misfit_out_of_scale, "misfit_out_of_scale"},
     {WarningKind::no_misfit, "no_misfit"},
     {WarningKind::noise_contradicted, "noise_contradicted"},
     {WarningKind::search_fell_short, "search_fell_short"},
     {WarningKind::noise_too_large, "noise_too_large"},
     {WarningKind::mesh_biases_parameters, "mesh_biases_parameters"},
     {WarningKind::small_misfit, "small_misfit"},
     {WarningKind::no_result, "no_result"},
     {WarningKind::no_feasible_point, "no_feasible_point"},
     {WarningKind::not_repeatable, "not_repeatable"},
     {WarningKind::not_evaluated_again, "not_evaluated_again"},
     {WarningKind::not_linearised, "not_linearised"},
     {WarningKind::predicts_worse, "predicts_worse"},
     {WarningKind::unstable, "unstable"},
     {WarningKind::ellipticity_lost, "ellipticity_lost"},
     {WarningKind::drucker_lost, "drucker_lost"},
     {WarningKind::free_faces_unstable, "free_faces_unstable"},
     {WarningKind::inadmissible_parameters, "inadmissible_parameters"},
     {WarningKind::at_bound, "at_bound"},
     {WarningKind::stopped_at_default_bound, "stopped_at_default_bound"},
     {WarningKind::bound_in_comparison, "bound_in_comparison"},
     {WarningKind::not_fixed_by_data, "not_fixed_by_data"},
     {WarningKind::failed_evaluations, "failed_evaluations"},
     {WarningKind::optimizer_failure, "optimizer_failure"},
     {WarningKind::same_course, "same_course"},
     {WarningKind::given_up, "given_up"},
     {WarningKind::depends_on_time, "depends_on_time"},
     {WarningKind::prior, "prior"},
     {WarningKind::held_out, "held_out"},
     {WarningKind::not_comparable, "not_comparable"},
     {WarningKind::other_model_preferred, "other_model_preferred"},
     {WarningKind::certificate_failed, "certificate_failed"},
     {WarningKind::objective_differs, "objective_differs"},
     {WarningKind::not_an_optimum, "not_an_optimum"},
     {WarningKind::differenced_derivatives, "differenced_derivatives"},
     {WarningKind::equal_realisations, "equal_realisations"},
     {WarningKind::plugin_refused, "plugin_refused"},
     {WarningKind::order_assumed, "order_assumed"},
     {WarningKind::record_broken, "record_broken"},
     {WarningKind::record_softening, "record_softening"},
     {WarningKind::record_jump, "record_jump"},
     {WarningKind::record_repeated, "record_repeated"},
     {WarningKind::record_coarse, "record_coarse"},
     {WarningKind::record_sign, "record_sign"},
     {WarningKind::record_time, "record_time"},
     {WarningKind::record_short, "record_short"},
     {WarningKind::record_percent, "record_percent"},
     {WarningKind::record_size, "record_size"},
     {WarningKind::record_angle, "record_angle"},
     {WarningKind::record_noise, "record_noise"},
     {WarningKind::header_measure, "header_measure"},
     {WarningKind::header_strain, "header_strain"},
     {WarningKind::posterior_not_converged, "posterior_not_converged"},
     {WarningKind::posterior_disagrees, "posterior_disagrees"},
     {WarningKind::posterior_noise_assumed, "posterior_noise_assumed"},
     {WarningKind::set_up, "set_up"}}};

static_assert(static_cast<std::size_t>(WarningKind::set_up) + 1 == warning_codes.size());

std::string_view code(WarningKind kind);

struct Warning {
  WarningKind kind;
  std::string sentence;                    ///< without the run
  std::string run = {};                    ///< its label; empty = of the whole experiment
  std::vector<std::string> subjects = {};  ///< parameters, models, channels, tests; empty = the whole run

  /// "gho/es: mu lies at …".
  [[nodiscard]] std::string text() const;
};

/// The codes of a finding are kinds of a warning.
Warning warning_of(const data::Finding& finding);

}  // namespace tunica::execution
