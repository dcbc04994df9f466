// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/naming/causes.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/hypotheses/amplitude_range.hpp"
#include "diagnosis/hypotheses/places.hpp"
#include "numerics/distributions.hpp"
#include "numerics/orthogonal.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double inseparable = 1e-6;  ///< share of a variable that the data do not see

/// Standard deviations of the variables, those at a bound held: the diagonal of (JᵀJ)⁻¹. Not a number for those held,
/// infinite for those that the data cannot tell from others.
std::vector<double> deviations(const Fit& fit) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (!fit.at_bound[static_cast<std::size_t>(k)] && fit.jacobian.col(k).norm() > 0) free.push_back(k);
  std::vector<double> sd(static_cast<std::size_t>(fit.jacobian.cols()), NAN);
  if (free.empty()) return sd;
  Eigen::MatrixXd J = fit.jacobian(Eigen::all, free);
  const Eigen::VectorXd lengths = J.colwise().norm().transpose();
  for (Eigen::Index k = 0; k < J.cols(); ++k) J.col(k) /= lengths[k];
  const Eigen::MatrixXd information = J.transpose() * J, covariance = numerics::pseudo_inverse(information);
  const Eigen::MatrixXd seen = covariance * information;  // onto the directions that the data see
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    sd[static_cast<std::size_t>(free[k])] =
        seen(i, i) < 1 - inseparable ? INFINITY : std::sqrt(std::max(covariance(i, i), 0.0)) / lengths[i];
  }
  return sd;
}

/// "0.12", "340 kPa": three digits for sentences.
std::string three_digits(double value, const std::string& unit = "1") {
  return unit == "1" ? fmt::format("{:.3g}", value) : fmt::format("{:.3g} {}", value, unit);
}

/// One parameter of addition `which`, the first being its amplitude, with the interval that its deviation says.
Amplitude estimate(const Refit& refit, std::size_t variable, const std::string& name, double sd) {
  const double quantile = numerics::normal_quantile(0.975);
  const std::size_t index = refit.extension->variables()[variable].front();
  const double value = refit.fit.free[index], half = quantile * sd;
  return {name,         refit.extension->assembly().layout().parameters[index].unit,
          value,        value - half,
          value + half, refit.fit.at_bound[variable]};
}

/// Whether it is plausible, and the interval no further than the parameter may go; a mechanism of one side not beyond
/// its null.
Amplitude bounded(Amplitude amplitude, const MechanismFactory& mechanism, const assembly::FreeParameter& parameter,
                  const AmplitudeRange& range) {
  // A bound at the null is harmless. An amplitude beyond its plausible range by more than its uncertainty is not.
  amplitude.at_bound = amplitude.at_bound && amplitude.value != mechanism.null;
  const bool known = !std::isnan(amplitude.low);
  amplitude.plausible = (known ? amplitude.high : amplitude.value) >= range.plausible_min &&
                        (known ? amplitude.low : amplitude.value) <= range.plausible_max;
  amplitude.low = std::max(amplitude.low, parameter.min);
  amplitude.high = std::min(amplitude.high, parameter.max);
  const bool upwards = mechanism.plausible_max > mechanism.null;
  if (mechanism.side != MechanismFactory::Side::positive) return amplitude;
  if (upwards)
    amplitude.low = std::max(amplitude.low, mechanism.null);
  else
    amplitude.high = std::min(amplitude.high, mechanism.null);
  return amplitude;
}

}  // namespace

std::string explanation_of(const Cause& cause, const MechanismFactory& mechanism) {
  std::string text =
      fmt::format("The misfit is consistent with {} {}: {} Here {} = {}", cause.id, cause.place.words(),
                  mechanism.cause, cause.amplitude.name, three_digits(cause.amplitude.value, cause.amplitude.unit));
  if (std::isfinite(cause.amplitude.low) && std::isfinite(cause.amplitude.high))
    text += fmt::format(" ({} … {})", three_digits(cause.amplitude.low), three_digits(cause.amplitude.high));
  for (const Amplitude& nuisance : cause.nuisance)
    text += fmt::format(", {} = {}", nuisance.name, three_digits(nuisance.value, nuisance.unit));
  text += '.';
  const std::vector<std::string>& alike = mechanism.look_alikes;
  if (alike.empty()) return text;
  text += " Beyond the range of these data it resembles ";
  for (std::size_t k = 0; k < alike.size(); ++k)
    text += (k == 0 ? "" : k + 1 == alike.size() ? " and " : ", ") + alike[k];
  return text + '.';
}

Cause cause_of(const Inquiry& inquiry, const Analysis& analysis, const Refit& refit, std::size_t which,
               const Direction& direction) {
  const Evidence& evidence = analysis.evidence;
  const Addition& addition = refit.additions[which];
  const MechanismFactory& mechanism = inquiry.mechanism(addition.id);
  const Extension& extension = *refit.extension;
  const std::vector<double> sd = deviations(refit.fit);
  std::size_t at = extension.base().size();
  for (std::size_t k = 0; k < which; ++k) at += 1 + extension.parts()[k].nuisance.size();
  const auto& parameter = extension.assembly().layout().parameters[extension.variables()[at].front()];

  Cause cause;
  cause.id = addition.id;
  cause.place = addition.place;
  cause.group = group_of(mechanism);
  cause.retained = direction.retained;
  cause.gain = evidence.fit.chi2 - refit.fit.chi2;
  cause.amplitude = bounded(estimate(refit, at, mechanism.parameters.front().name, sd[at]), mechanism, parameter,
                            range_of(mechanism, addition));
  for (std::size_t k = 1; k <= extension.parts()[which].nuisance.size(); ++k)
    cause.nuisance.push_back(estimate(refit, at + k, mechanism.parameters[k].name, sd[at + k]));
  for (std::size_t j = 0; j < extension.base().size(); ++j) {
    const auto& own = evidence.base->layout().parameters[j];
    cause.shifts.push_back({own.name, own.unit, evidence.fit.free[j], refit.fit.free[extension.base()[j]]});
  }
  cause.explanation = explanation_of(cause, mechanism);
  return cause;
}

std::optional<std::string> carried_by_one_test(const Analysis& analysis, const Direction& direction) {
  const std::vector<Curve>& curves = analysis.evidence.curves;
  const Hypothesis& hypothesis = analysis.hypotheses.hypothesis(direction);
  if (hypothesis.addition.place.tests.size() == 1) return std::nullopt;
  const Eigen::VectorXd residuals = -analysis.evidence.fit.residuals;
  const Eigen::MatrixXd J = interior(analysis.evidence.fit);
  const double all = direction.unit.dot(residuals) / direction.length, se = 1 / direction.length;
  std::vector<std::string> tests;
  for (const Curve& curve : curves)
    if (std::find(tests.begin(), tests.end(), curve.test) == tests.end()) tests.push_back(curve.test);
  if (tests.size() < 2) return std::nullopt;
  for (const std::string& test : tests) {
    Eigen::MatrixXd J_left = J;
    Eigen::VectorXd s = hypothesis.signature, r = residuals;
    for (const Curve& curve : curves) {
      if (curve.test != test) continue;
      J_left.middleRows(curve.first, curve.count).setZero();
      s.segment(curve.first, curve.count).setZero();
      r.segment(curve.first, curve.count).setZero();
    }
    const Eigen::VectorXd left = Projection(J_left).off(s);
    if (!(left.norm() > 0.2 * direction.length)) continue;  // the others hardly see it
    const double without = left.dot(r) / left.squaredNorm(), se_without = 1 / left.norm();
    const double spread = std::sqrt(std::max(se_without * se_without - se * se, 1e-12 * se * se));
    const bool gone = std::abs(without) < 1.96 * se_without;
    const bool expected = std::abs(all) > 3.5 * se_without;
    if (std::abs(without - all) > 3.5 * spread && gone && expected)
      return fmt::format("without the test '{}' the rest shows {} = {} ± {}, but {} was expected", test,
                         hypothesis.addition.id, three_digits(without), three_digits(1.96 * se_without),
                         three_digits(all));
  }
  return std::nullopt;
}

}  // namespace tunica::diagnosis
