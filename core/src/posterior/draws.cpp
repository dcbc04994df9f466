// SPDX-License-Identifier: Apache-2.0
#include "posterior/draws.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "posterior/difference_move.hpp"
#include "posterior/tangent_move.hpp"

namespace tunica::posterior {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// A draw of the Laplace approximation, nearer to its centre where the density is zero.
Point start_of(Target& target, const Point& centre, CounterRandom& random) {
  const Matrix curvature = centre.slopes.transpose() * centre.slopes;
  const Vector step = curvature.llt().matrixU().solve(random.normals(centre.z.size()));
  Point start;
  for (double share = 1; share > 1e-3; share /= 2)
    if (target.evaluate(centre.z + share * step, start) && std::isfinite(start.log_density)) return start;
  return centre;
}

/// Newton's method with −∂² ln p ≈ (∂H/∂z)ᵀ ∂H/∂z, positive definite.
void climb(Target& target, Point& point) {
  constexpr int most_steps = 100;
  constexpr double small_gain = 1e-8, largest_step = 2, smallest_share = 1e-4;
  Point next;
  for (int k = 0; k < most_steps; ++k) {
    const Matrix curvature = point.slopes.transpose() * point.slopes;
    Vector step = curvature.llt().solve(point.gradient);
    if (const double size = step.cwiseAbs().maxCoeff(); size > largest_step) step *= largest_step / size;
    const double expected = point.gradient.dot(step);
    double share = 1;
    while (share > smallest_share &&
           !(target.evaluate(point.z + share * step, next) && next.log_density > point.log_density))
      share /= 2;
    if (share <= smallest_share) return;
    std::swap(point, next);
    if (expected < small_gain) return;
  }
}

}  // namespace

Centre centre(const Question& question, std::span<const double> best) {
  Centre found;
  Target rough(question, 1);
  Point& point = found.point;
  // A point at a bound is pulled to where x still has a slope by z.
  const Vector at_best = rough.coordinates(best), nearer = at_best.cwiseMax(-3).cwiseMin(3);
  if (!(rough.evaluate(nearer, point) && std::isfinite(point.log_density)) &&
      !(rough.evaluate(at_best, point) && std::isfinite(point.log_density))) {
    found.status = Status::failed("the best point cannot be simulated, or breaks a constraint");
    return found;
  }
  // The metric is that of the centre, which is found again with it. With a discrepancy plain residuals would climb in
  // steps that are far too small.
  if (!question.discrepancy) climb(rough, point);
  found.evaluations = rough.evaluations;
  for (int pass = 0; pass < (question.discrepancy ? 2 : 1); ++pass) {
    found.metric = rough.metric_at(point);
    Target target(question, found.metric);
    const Vector z = point.z;
    static_cast<void>(target.evaluate(z, point));
    climb(target, point);
    found.evaluations += target.evaluations;
  }
  return found;
}

Chain chain(const Question& question, const Centre& from, std::size_t draws, std::uint64_t key,
            const std::function<bool()>& is_over) {
  Target target(question, from.metric);
  CounterRandom random(key);
  Chain made;
  made.parameters = question.assembly.layout().parameters.size();
  Point here = start_of(target, from.point, random);
  constexpr double first_size = 0.7, largest_size = 0.95, wanted_acceptance = 0.5;
  double size = first_size;
  std::vector<Vector> past;
  for (std::size_t k = 1; k <= warm_up && !is_over(); ++k) {
    const double acceptance = make_tangent_move(target, here, size, random);
    size *= std::exp(std::pow(static_cast<double>(k), -0.6) * (acceptance - wanted_acceptance));
    size = std::min(size, largest_size);
    if (2 * k > warm_up) past.push_back(here.z);
  }
  made.size = size;
  for (std::size_t k = 0; k < draws && !is_over(); ++k) {
    made.acceptance.push_back(make_tangent_move(target, here, size, random));
    for (int j = 0; j < difference_moves; ++j) make_difference_move(target, here, past, random);
    const std::vector<double> values = target.free(here.z);
    made.free.insert(made.free.end(), values.begin(), values.end());
    made.log_density.push_back(here.log_density);
  }
  made.evaluations = target.evaluations;
  made.failures = target.failures;
  return made;
}

}  // namespace tunica::posterior
