// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/separation.hpp"

#include <algorithm>
#include <cmath>

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

Forecast forecast(const Design& design, const FittedRival& rival) {
  std::vector<double> at, moved;
  if (!predict(design, rival.assembly, rival.fit.free, at)) return {};
  const Eigen::Map<const Eigen::ArrayXd> sd(design.sd.data(), static_cast<Eigen::Index>(design.sd.size()));
  const auto in_noise = [&](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::ArrayXd>(values.data(), sd.size()) / sd;
  };
  const std::vector<Variable>& variables = rival.variables;
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
    if (!predict(design, rival.assembly, free, moved)) continue;
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

/// The smallest distance between any two of the rivals in each design.
std::vector<double> smallest_distances(const Inquiry& inquiry, const std::vector<Design>& library,
                                       const std::vector<FittedRival>& rivals) {
  std::vector<double> smallest(library.size(), 0);
  const auto done = inquiry.steps("the next experiment", 0.9, 1, library.size() + 1);
  tbb::parallel_for(std::size_t{0}, library.size(), [&](std::size_t k) {
    std::vector<Forecast> forecasts;
    for (const FittedRival& rival : rivals) forecasts.push_back(forecast(library[k], rival));
    double least = INFINITY;
    for (std::size_t a = 0; a < rivals.size(); ++a)
      for (std::size_t b = 0; b < rivals.size(); ++b)
        if (a != b) least = std::min(least, distance(forecasts[a], forecasts[b]));
    smallest[k] = std::isfinite(least) ? least : 0;
    done();
  });
  return smallest;
}

}  // namespace

std::optional<Separation> separating_design(const Inquiry& inquiry, const Evidence& evidence,
                                            const std::vector<FittedRival>& rivals) {
  const std::vector<Design> library = designs(inquiry, evidence, rivals.front().assembly, rivals.front().fit.free);
  const std::vector<double> smallest = smallest_distances(inquiry, library, rivals);
  const double largest = smallest.empty() ? 0 : *std::max_element(smallest.begin(), smallest.end());
  if (largest * most_repeats < separated) return std::nullopt;
  // Mirror images of one design differ by rounding: the first of them.
  const auto best =
      std::find_if(smallest.begin(), smallest.end(), [&](double one) { return one >= (1 - 1e-9) * largest; });
  return Separation{library[static_cast<std::size_t>(best - smallest.begin())].description, std::sqrt(*best),
                    static_cast<std::size_t>(std::ceil(separated / *best))};
}

}  // namespace tunica::diagnosis
