// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/undetermined.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "diagnosis/prospects/designs.hpp"
#include "numerics/cholesky.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double of_logarithm = 0.25, of_box = 0.1;  ///< standard deviations of what counts as determined
constexpr double two_sided = 1.96;

/// A fitted parameter in the coordinate u of the header.
struct Coordinate {
  std::string name, unit;
  double value = 0, slope = 0;  ///< dp/du
  double prior_sd = 0, wanted_sd = 0;
  bool logarithmic = false;
};

std::vector<Coordinate> coordinates(const Refit& model) {
  std::vector<Coordinate> found;
  for (const Variable& variable : model.extension->variables()) {
    const auto& parameter = model.extension->assembly().layout().parameters[variable.front()];
    Coordinate u{parameter.name, parameter.unit, model.fit.free[variable.front()]};
    u.logarithmic = parameter.scale == Scale::log;
    u.slope = u.logarithmic ? u.value : parameter.max - parameter.min;
    u.prior_sd = (u.logarithmic ? std::log(parameter.max / parameter.min) : 1) / std::sqrt(12.0);
    u.wanted_sd = u.logarithmic ? of_logarithm : of_box;
    found.push_back(std::move(u));
  }
  return found;
}

/// DᵀD of a design, by differences; none where it cannot be simulated.
std::optional<Eigen::MatrixXd> information(const Design& design, const Refit& model, const std::vector<Coordinate>& u) {
  std::vector<double> at, moved;
  if (!predict(design, model.extension->assembly(), model.fit.free, at)) return std::nullopt;
  const std::vector<Variable> variables = model.extension->variables();
  const auto& parameters = model.extension->assembly().layout().parameters;
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(at.size()), static_cast<Eigen::Index>(u.size()));
  for (std::size_t k = 0; k < u.size(); ++k) {
    double step = 1e-3;  // of u
    std::vector<double> free = model.fit.free;
    if (free[variables[k].front()] + step * u[k].slope > parameters[variables[k].front()].max) step = -step;
    for (const std::size_t member : variables[k]) free[member] += step * u[k].slope;
    if (!predict(design, model.extension->assembly(), free, moved)) continue;
    for (std::size_t i = 0; i < at.size(); ++i)
      D(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = (moved[i] - at[i]) / design.sd[i] / step;
  }
  return D.transpose() * D;
}

double deviation(const Eigen::MatrixXd& precision, Eigen::Index which) {
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(precision.rows(), which);
  return std::sqrt(std::max(numerics::solve_symmetric(precision, unit)[which], 0.0));
}

/// "a factor of 2.31", "2 %", "± 12 deg": the 95 % interval.
std::string within(const Coordinate& u, double sd) {
  const double factor = std::exp(two_sided * sd);
  if (u.logarithmic && factor < 1.1) return fmt::format("{:.2g} %", 100 * (factor - 1));
  if (u.logarithmic)
    return "a factor of " + (factor < 100 ? fmt::format("{:.3g}", factor) : fmt::format("{:.0f}", factor));
  return fmt::format("± {:.2g}{}", two_sided * sd * u.slope, u.unit == "1" ? "" : " " + u.unit);
}

}  // namespace

Refit bare_refit(const Inquiry& inquiry, const Evidence& evidence) {
  auto extension =
      std::make_shared<const Extension>(evidence.experiment, evidence.run, std::vector<Addition>{}, inquiry.catalogue);
  return {{}, std::move(extension), evidence.fit};
}

std::optional<NextExperiment> determining_experiment(const Inquiry& inquiry, const Evidence& evidence,
                                                     const Refit& model) {
  const std::vector<Coordinate> u = coordinates(model);
  if (u.empty()) return std::nullopt;
  Eigen::MatrixXd J = model.fit.jacobian;
  Eigen::MatrixXd known = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const Coordinate& own = u[static_cast<std::size_t>(k)];
    J.col(k) *= own.slope;
    known(k, k) = 1 / (own.prior_sd * own.prior_sd);
  }
  known += J.transpose() * J;
  Eigen::Index worst = 0;
  double excess = 0, left = 0;
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const double sd = deviation(known, k), ratio = sd / u[static_cast<std::size_t>(k)].wanted_sd;
    if (!(ratio > excess)) continue;
    excess = ratio;
    worst = k;
    left = sd;
  }
  if (!(excess > 1)) return std::nullopt;
  const Coordinate& parameter = u[static_cast<std::size_t>(worst)];
  const std::vector<Design> library = designs(inquiry, evidence, model.extension->assembly(), model.fit.free);
  struct Outcome {
    std::size_t repeats = most_repeats + 1;
    double sd = INFINITY;
  };
  std::vector<Outcome> outcomes(library.size());
  tbb::parallel_for(std::size_t{0}, library.size(), [&](std::size_t k) {
    const auto more = information(library[k], model, u);
    if (!more || !more->allFinite()) return;
    for (std::size_t n = 1; n <= most_repeats; ++n) {
      outcomes[k].sd = deviation(known + static_cast<double>(n) * *more, worst);
      if (outcomes[k].sd > parameter.wanted_sd) continue;
      outcomes[k].repeats = n;
      return;
    }
  });
  const auto best = std::min_element(outcomes.begin(), outcomes.end(), [](const Outcome& a, const Outcome& b) {
    // Designs that symmetry makes equal differ by rounding: the first of them is taken.
    return a.repeats != b.repeats ? a.repeats < b.repeats : a.sd < b.sd * (1 - 1e-6);
  });
  NextExperiment next;
  next.separates = {parameter.name};
  constexpr double only_box = 0.9;  // of the standard deviation over the box
  const std::string known_to = left > only_box * parameter.prior_sd
                                   ? fmt::format("{} is fixed only by its bounds, not by these data", parameter.name)
                                   : fmt::format("{} is uncertain by {}", parameter.name, within(parameter, left));
  constexpr double worthwhile = 0.5;
  if (best == outcomes.end() || best->sd > worthwhile * left) {
    next.description = fmt::format("{}; no strip, sheet or inflation of the library determines it in {} repeats.",
                                   known_to, most_repeats);
    return next;
  }
  const std::string& design = library[static_cast<std::size_t>(best - outcomes.begin())].description;
  const std::size_t repeats = std::min(best->repeats, most_repeats);
  if (best->repeats <= most_repeats) next.repeats = best->repeats;
  next.description = fmt::format("{}; {}, {}, would reduce that to {}.", known_to, design,
                                 repeats == 1 ? "once" : fmt::format("{} times", repeats), within(parameter, best->sd));
  return next;
}

}  // namespace tunica::diagnosis
