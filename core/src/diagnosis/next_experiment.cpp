// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/next_experiment.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>
#include <Eigen/QR>

#include "diagnosis/designs.hpp"
#include "diagnosis/undetermined.hpp"

namespace tunica::diagnosis {
namespace {

/// (2 · 1.645)²: at this squared distance the right one of two is preferred with 95 % probability.
constexpr double separated = 10.82;
constexpr std::size_t most_separating_repeats = 20;

/// min over the parameters of b of |f_a − f_b|² in the design, while the data hold them: with J of b,
///
///   min_x |Δ − J_new x|² + |J_old x|²,  Δ = (f_a − f_b)/σ.
double distance(const Design& design, const Refitted& a, const Refitted& b) {
  std::vector<double> of_a, of_b, moved;
  if (!predict(design, a, a.fit.free, of_a) || !predict(design, b, b.fit.free, of_b)) return 0;
  const auto n = static_cast<Eigen::Index>(of_a.size());
  const std::vector<Variable> variables = b.extended->variables();
  const auto columns = static_cast<Eigen::Index>(variables.size());
  Eigen::VectorXd difference(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    difference[i] = (of_a[k] - of_b[k]) / design.sd[k];
  }
  Eigen::MatrixXd J_new = Eigen::MatrixXd::Zero(n, columns), J_old = b.fit.jacobian;
  for (Eigen::Index c = 0; c < columns; ++c) {
    const auto v = static_cast<std::size_t>(c);
    const double length = J_old.col(c).norm();
    if (b.fit.at_bound[v] || !(length > 0)) {
      J_old.col(c).setZero();
      continue;
    }
    // A step of a tenth of its standard deviation, were it alone.
    const double step = 0.1 / length;
    std::vector<double> free = b.fit.free;
    for (const std::size_t member : variables[v]) free[member] += step;
    if (!predict(design, b, free, moved)) continue;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      J_new(i, c) = (moved[k] - of_b[k]) / design.sd[k] / step / length;
    }
    J_old.col(c) /= length;
  }
  Eigen::MatrixXd J(n + J_old.rows(), columns);
  J << J_new, J_old;
  Eigen::VectorXd target = Eigen::VectorXd::Zero(J.rows());
  target.head(n) = difference;
  const Eigen::VectorXd x = J.completeOrthogonalDecomposition().solve(target);
  return (target - J * x).squaredNorm();
}

/// What switches mechanisms by themselves, of the first `most_told` of them.
std::string isolating(const plugins::Catalogue& catalogue, const std::vector<std::string>& ids) {
  constexpr std::size_t most_told = 3;
  std::vector<std::string> switches;
  for (const std::string& id : ids)
    if (switches.size() < most_told)
      switches.push_back(fmt::format("{}: {}", id, catalogue.mechanisms().at(id).factory.isolated_by));
  if (ids.size() > most_told) switches.push_back("and so on, see `tunica describe` of the others");
  return fmt::format("{}", fmt::join(switches, "; "));
}

}  // namespace

std::optional<NextExperiment> next_experiment(const Diagnosis& d, const plugins::Catalogue& catalogue) {
  if (d.rivals.empty()) {
    if (d.verdict != Verdict::nothing_detected || !d.base) return std::nullopt;
    return determining_experiment(d, bare(d, catalogue), catalogue);
  }
  NextExperiment next;
  next.separates = d.ambiguity_set;
  if (d.rivals.size() == 1) {
    next.description = fmt::format("To confirm {}.", isolating(catalogue, d.ambiguity_set));
    if (const auto more = determining_experiment(d, d.rivals.front(), catalogue))
      next.description += fmt::format(" {}", more->description), next.repeats = more->repeats;
    return next;
  }
  const std::vector<Design> library = designs(d, catalogue, d.rivals.front());
  std::vector<double> smallest(library.size(), 0);
  tbb::parallel_for(std::size_t{0}, library.size(), [&](std::size_t k) {
    double least = INFINITY;
    for (std::size_t a = 0; a < d.rivals.size(); ++a)
      for (std::size_t b = 0; b < d.rivals.size(); ++b)
        if (a != b) least = std::min(least, distance(library[k], d.rivals[a], d.rivals[b]));
    smallest[k] = std::isfinite(least) ? least : 0;
  });
  const auto best = std::max_element(smallest.begin(), smallest.end());
  if (best == smallest.end() || *best * most_separating_repeats < separated) {
    next.description = fmt::format(
        "No strip, sheet or inflation of the library tells them apart in {} repeats; what switches one of "
        "them by itself does: {}.",
        most_separating_repeats, isolating(catalogue, d.ambiguity_set));
    return next;
  }
  next.repeats = static_cast<std::size_t>(std::ceil(separated / *best));
  next.description =
      fmt::format("{}, {} (the rivals differ by {:.1f} σ there)",
                  library[static_cast<std::size_t>(best - smallest.begin())].description,
                  *next.repeats == 1 ? "once" : fmt::format("{} times", *next.repeats), std::sqrt(*best));
  next.description +=
      fmt::format("; or what switches one of them by itself: {}.", isolating(catalogue, d.ambiguity_set));
  return next;
}

}  // namespace tunica::diagnosis
