// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/next_experiment.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include "diagnosis/prospects/designs.hpp"
#include "diagnosis/prospects/undetermined.hpp"
#include "numerics/orthogonal.hpp"

namespace tunica::diagnosis {
namespace {

/// (2 · 1.645)²: at this squared distance the right one of two is preferred with 95 % probability.
constexpr double separated = 10.82;

/// What a rival predicts of a design, in its noise, and how that and what was measured follow its parameters: each by
/// the length of its column in the data.
struct Forecast {
  Eigen::VectorXd values;  ///< none where it cannot be simulated
  Eigen::MatrixXd J_new, J_old;
};

Forecast forecast(const Design& design, const Refit& rival) {
  std::vector<double> at, moved;
  if (!predict(design, rival, rival.fit.free, at)) return {};
  const Eigen::Map<const Eigen::ArrayXd> sd(design.sd.data(), static_cast<Eigen::Index>(design.sd.size()));
  const auto in_noise = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::ArrayXd>(values.data(), sd.size()) / sd;
  };
  const std::vector<Variable> variables = rival.extension->variables();
  const auto columns = static_cast<Eigen::Index>(variables.size());
  Forecast found{in_noise(at), Eigen::MatrixXd::Zero(sd.size(), columns), rival.fit.jacobian};
  for (Eigen::Index c = 0; c < columns; ++c) {
    const auto v = static_cast<std::size_t>(c);
    const double length = found.J_old.col(c).norm();
    if (rival.fit.at_bound[v] || !(length > 0)) {
      found.J_old.col(c).setZero();
      continue;
    }
    // A step of a tenth of its standard deviation, were it alone.
    const double step = 0.1 / length;
    std::vector<double> free = rival.fit.free;
    for (const std::size_t member : variables[v]) free[member] += step;
    if (!predict(design, rival, free, moved)) continue;
    found.J_new.col(c) = (in_noise(moved) - found.values) / (step * length);
    found.J_old.col(c) /= length;
  }
  return found;
}

/// min over the parameters of b of |f_a − f_b|² in the design, while the data hold them: with J of b,
///
///   min_x |Δ − J_new x|² + |J_old x|²,  Δ = (f_a − f_b)/σ.
double distance(const Forecast& a, const Forecast& b) {
  const Eigen::Index n = b.values.size();
  if (n == 0 || a.values.size() == 0) return 0;
  Eigen::MatrixXd J(n + b.J_old.rows(), b.J_old.cols());
  J << b.J_new, b.J_old;
  Eigen::VectorXd target = Eigen::VectorXd::Zero(J.rows());
  target.head(n) = a.values - b.values;
  const Eigen::VectorXd x = numerics::shortest_least_squares_solution(J, target);
  return (target - J * x).squaredNorm();
}

/// What switches mechanisms by themselves, of the first `most_listed` of them.
std::string isolating(const Inquiry& inquiry, const std::vector<std::string>& ids) {
  constexpr std::size_t most_listed = 3;
  std::vector<std::string> switches;
  for (const std::string& id : ids)
    if (switches.size() < most_listed) switches.push_back(fmt::format("{}: {}", id, inquiry.mechanism(id).isolated_by));
  if (ids.size() > most_listed) switches.emplace_back("for the others see `tunica describe`");
  return fmt::format("{}", fmt::join(switches, "; "));
}

/// With one cause.
NextExperiment confirming(const Inquiry& inquiry, const Evidence& evidence, const Claim& claim) {
  NextExperiment next;
  next.separates = claim.ambiguity_set;
  next.description = fmt::format("To confirm {}.", isolating(inquiry, claim.ambiguity_set));
  if (const auto more = determining_experiment(inquiry, evidence, claim.rivals.front())) {
    next.description += fmt::format(" {}", more->description);
    next.repeats = more->repeats;
  }
  return next;
}

/// The smallest distance between any two of the rivals in each design.
std::vector<double> smallest_distances(const Inquiry& inquiry, const std::vector<Design>& library,
                                       const std::vector<Refit>& rivals) {
  std::vector<double> smallest(library.size(), 0);
  const auto done = inquiry.steps("the next experiment", 0.9, 1, library.size() + 1);
  tbb::parallel_for(std::size_t{0}, library.size(), [&](std::size_t k) {
    std::vector<Forecast> forecasts;
    for (const Refit& rival : rivals) forecasts.push_back(forecast(library[k], rival));
    double least = INFINITY;
    for (std::size_t a = 0; a < rivals.size(); ++a)
      for (std::size_t b = 0; b < rivals.size(); ++b)
        if (a != b) least = std::min(least, distance(forecasts[a], forecasts[b]));
    smallest[k] = std::isfinite(least) ? least : 0;
    done();
  });
  return smallest;
}

/// With several.
NextExperiment separating(const Inquiry& inquiry, const Evidence& evidence, const Claim& claim) {
  NextExperiment next;
  next.separates = claim.ambiguity_set;
  const std::string switches = isolating(inquiry, claim.ambiguity_set);
  const std::vector<Design> library = designs(inquiry, evidence, claim.rivals.front());
  const std::vector<double> smallest = smallest_distances(inquiry, library, claim.rivals);
  const auto best = std::max_element(smallest.begin(), smallest.end());
  if (best == smallest.end() || *best * most_repeats < separated) {
    next.description = fmt::format(
        "No strip, sheet or inflation of the library tells them apart in {} repeats. A test that switches "
        "one of them alone does: {}.",
        most_repeats, switches);
    return next;
  }
  next.repeats = static_cast<std::size_t>(std::ceil(separated / *best));
  next.description =
      fmt::format("{}, {} (the rivals differ by {:.1f} σ there); or a test that switches one of them alone: {}.",
                  library[static_cast<std::size_t>(best - smallest.begin())].description,
                  *next.repeats == 1 ? "once" : fmt::format("{} times", *next.repeats), std::sqrt(*best), switches);
  return next;
}

}  // namespace

std::optional<NextExperiment> next_experiment(const Inquiry& inquiry, const Evidence& evidence,
                                              const Explanation& explanation) {
  const Claim& claim = explanation.claim;
  if (claim.rivals.size() > 1) return separating(inquiry, evidence, claim);
  if (claim.rivals.size() == 1) return confirming(inquiry, evidence, claim);
  if (explanation.verdict != Verdict::nothing_detected || !evidence.base) return std::nullopt;
  return determining_experiment(inquiry, evidence, bare_refit(inquiry, evidence));
}

}  // namespace tunica::diagnosis
