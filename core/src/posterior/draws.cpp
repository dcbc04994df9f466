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

Vector vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
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
            const std::function<bool()>& is_over, const std::vector<Step>& known,
            const std::function<void(std::size_t, const Step&)>& keep) {
  constexpr double first_size = 0.7, largest_size = 0.95, wanted_acceptance = 0.5;
  Target target(question, from.metric);
  CounterRandom random(key);
  Chain made;
  made.parameters = question.assembly.layout().parameters.size();
  made.size = first_size;
  std::vector<Vector> past;
  const auto take = [&](std::size_t k, const Vector& z, double log_density, double acceptance) {
    if (k < warm_up) {
      if (2 * k >= warm_up) past.push_back(z);
      return;
    }
    made.acceptance.push_back(acceptance);
    const std::vector<double> values = target.free(z);
    made.free.insert(made.free.end(), values.begin(), values.end());
    made.log_density.push_back(log_density);
  };
  const std::size_t all = warm_up + draws;
  std::size_t k = std::min(known.size(), all);
  Point here;
  if (k > 0 && target.evaluate(vector_of(known[k - 1].z), here) && here.log_density == known[k - 1].log_density) {
    for (std::size_t i = 0; i < k; ++i) take(i, vector_of(known[i].z), known[i].log_density, known[i].acceptance);
    const Step& last = known[k - 1];
    random = CounterRandom(last.random);
    made.size = last.size;
    target.evaluations = last.evaluations;
    target.failures = last.failures;
  } else {
    k = 0;
    target.evaluations = target.failures = 0;
    here = start_of(target, from.point, random);
  }
  for (; k < all && !is_over(); ++k) {
    const double acceptance = make_tangent_move(target, here, made.size, random);
    if (k < warm_up) {
      made.size *= std::exp(std::pow(static_cast<double>(k + 1), -0.6) * (acceptance - wanted_acceptance));
      made.size = std::min(made.size, largest_size);
    } else {
      for (int j = 0; j < difference_moves; ++j) make_difference_move(target, here, past, random);
    }
    take(k, here.z, here.log_density, acceptance);
    if (keep)
      keep(k, {{here.z.begin(), here.z.end()},
               here.log_density,
               acceptance,
               made.size,
               random.state(),
               target.evaluations,
               target.failures});
  }
  made.evaluations = target.evaluations;
  made.failures = target.failures;
  return made;
}

}  // namespace tunica::posterior
