// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/causes.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/QR>
#include <boost/math/distributions/normal.hpp>

namespace tunica::diagnosis {
namespace {

/// Standard deviations of the variables, those at a bound held: the diagonal of (JᵀJ)⁻¹.
std::vector<double> deviations(const Fit& fit) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (!fit.at_bound[static_cast<std::size_t>(k)] && fit.jacobian.col(k).norm() > 0) free.push_back(k);
  std::vector<double> sd(static_cast<std::size_t>(fit.jacobian.cols()), NAN);
  if (free.empty()) return sd;
  Eigen::MatrixXd J = fit.jacobian(Eigen::all, free);
  const Eigen::VectorXd lengths = J.colwise().norm().transpose();
  for (Eigen::Index k = 0; k < J.cols(); ++k) J.col(k) /= lengths[k];
  const Eigen::MatrixXd covariance = (J.transpose() * J).completeOrthogonalDecomposition().pseudoInverse();
  for (std::size_t k = 0; k < free.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    sd[static_cast<std::size_t>(free[k])] = std::sqrt(std::max(covariance(i, i), 0.0)) / lengths[i];
  }
  return sd;
}

/// "0.12", "340": three digits for sentences.
std::string number(double value) { return fmt::format("{:.3g}", value); }

std::string with_unit(double value, const std::string& unit) {
  return unit == "1" ? number(value) : number(value) + ' ' + unit;
}

}  // namespace

Eigen::MatrixXd interior(const Fit& fit) {
  std::vector<Eigen::Index> free;
  for (Eigen::Index k = 0; k < fit.jacobian.cols(); ++k)
    if (!fit.at_bound[static_cast<std::size_t>(k)]) free.push_back(k);
  return fit.jacobian(Eigen::all, free);
}

std::pair<double, double> plausible_range(const Diagnosis& diagnosis, const MechanismFactory& mechanism,
                                          const Target& target) {
  if (target.channel.empty()) return {mechanism.plausible_min, mechanism.plausible_max};
  for (const assembly::MeasuredChannel& view : diagnosis.base->layout().channels)
    if (view.test == target.tests.front() && view.observable == target.channel) {
      const auto [low, high] = std::minmax_element(view.measured.begin(), view.measured.end());
      return {*low - *high, *high - *low};
    }
  return {-INFINITY, INFINITY};
}

void explain(Cause& cause, const MechanismFactory& mechanism) {
  cause.explanation =
      fmt::format("The misfit is consistent with {} {}: {} Here {} = {}", cause.id, cause.target.words(),
                  mechanism.cause, cause.amplitude.name, with_unit(cause.amplitude.value, cause.amplitude.unit));
  if (std::isfinite(cause.amplitude.low) && std::isfinite(cause.amplitude.high))
    cause.explanation += fmt::format(" ({} … {})", number(cause.amplitude.low), number(cause.amplitude.high));
  for (const Amplitude& nuisance : cause.nuisance)
    cause.explanation += fmt::format(", {} = {}", nuisance.name, with_unit(nuisance.value, nuisance.unit));
  cause.explanation += '.';
  if (!mechanism.look_alikes.empty()) {
    cause.explanation += " Outside the reach of these data it resembles ";
    for (std::size_t k = 0; k < mechanism.look_alikes.size(); ++k)
      cause.explanation += (k == 0                                  ? ""
                            : k + 1 == mechanism.look_alikes.size() ? " and "
                                                                    : ", ") +
                           mechanism.look_alikes[k];
    cause.explanation += '.';
  }
}

Cause cause_of(const Diagnosis& diagnosis, const Refitted& refitted, std::size_t which, const Direction& direction,
               const plugins::Catalogue& catalogue) {
  const Addition& addition = refitted.additions[which];
  const MechanismFactory& mechanism = catalogue.mechanisms().at(addition.id).factory;
  const auto& parameters = refitted.extended->assembly().layout().parameters;
  const std::vector<Variable> variables = refitted.extended->variables();
  const std::vector<double> sd = deviations(refitted.fit);
  const double quantile = boost::math::quantile(boost::math::normal(), 0.975);

  Cause cause;
  cause.id = addition.id, cause.target = addition.target, cause.retained = direction.retained;
  cause.gain = diagnosis.fit.chi2 - refitted.fit.chi2;
  std::size_t at = refitted.extended->base().size();
  for (std::size_t k = 0; k < which; ++k) at += 1 + refitted.extended->parts()[k].nuisance.size();
  for (std::size_t k = 0; k <= refitted.extended->parts()[which].nuisance.size(); ++k) {
    const auto& parameter = parameters[variables[at + k].front()];
    Amplitude amplitude;
    amplitude.name = mechanism.parameters[k].name, amplitude.unit = parameter.unit;
    amplitude.value = refitted.fit.free[variables[at + k].front()];
    amplitude.at_bound = refitted.fit.at_bound[at + k];
    const double half = quantile * sd[at + k];
    amplitude.low = amplitude.value - half, amplitude.high = amplitude.value + half;
    if (k == 0) {
      // An amplitude at its null is no bound to worry about; beyond what is plausible by more than its uncertainty is.
      amplitude.at_bound = amplitude.at_bound && amplitude.value != mechanism.null;
      const auto [lowest, highest] = plausible_range(diagnosis, mechanism, addition.target);
      amplitude.plausible = amplitude.high >= lowest && amplitude.low <= highest;
      // No further than the parameter may go; a mechanism of one side not beyond its null.
      amplitude.low = std::max(amplitude.low, parameter.min), amplitude.high = std::min(amplitude.high, parameter.max);
      const bool upwards = mechanism.plausible_max > mechanism.null;
      if (mechanism.side == MechanismFactory::Side::positive && upwards)
        amplitude.low = std::max(amplitude.low, mechanism.null);
      if (mechanism.side == MechanismFactory::Side::positive && !upwards)
        amplitude.high = std::min(amplitude.high, mechanism.null);
      cause.amplitude = amplitude;
    } else {
      cause.nuisance.push_back(amplitude);
    }
  }
  for (std::size_t j = 0; j < refitted.extended->base().size(); ++j) {
    const auto& parameter = diagnosis.base->layout().parameters[j];
    cause.shifts.push_back(
        {parameter.name, parameter.unit, diagnosis.fit.free[j], refitted.fit.free[refitted.extended->base()[j]]});
  }
  explain(cause, mechanism);
  return cause;
}

std::string carrier(const Diagnosis& diagnosis, const Direction& direction, const Eigen::VectorXd& residuals) {
  const Hypothesis& hypothesis = diagnosis.candidates[direction.candidate].hypotheses[direction.hypothesis];
  if (hypothesis.addition.target.tests.size() == 1) return {};
  const Eigen::MatrixXd J = interior(diagnosis.fit);
  const double all = direction.unit.dot(residuals) / direction.length, se = 1 / direction.length;
  std::vector<std::string> tests;
  for (const Curve& curve : diagnosis.curves)
    if (std::find(tests.begin(), tests.end(), curve.test) == tests.end()) tests.push_back(curve.test);
  if (tests.size() < 2) return {};
  for (const std::string& test : tests) {
    Eigen::MatrixXd J_left = J;
    Eigen::VectorXd s = hypothesis.signature, r = residuals;
    for (const Curve& curve : diagnosis.curves)
      if (curve.test == test) {
        J_left.middleRows(curve.first, curve.count).setZero();
        s.segment(curve.first, curve.count).setZero(), r.segment(curve.first, curve.count).setZero();
      }
    const Eigen::VectorXd left = Projection(J_left).off(s);
    if (!(left.norm() > 0.2 * direction.length)) continue;  // the others hardly see it
    const double without = left.dot(r) / left.squaredNorm(), se_without = 1 / left.norm();
    const double spread = std::sqrt(std::max(se_without * se_without - se * se, 1e-12 * se * se));
    const bool gone = std::abs(without)<1.96 * se_without, expected = std::abs(all)> 3.5 * se_without;
    if (std::abs(without - all) > 3.5 * spread && gone && expected)
      return fmt::format("without the test '{}' the rest shows {} = {} ± {} where {} was expected", test,
                         hypothesis.addition.id, number(without), number(1.96 * se_without), number(all));
  }
  return {};
}

}  // namespace tunica::diagnosis
