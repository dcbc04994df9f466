// SPDX-License-Identifier: Apache-2.0
#include "search/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "numerics/eigenpairs.hpp"
#include "plugins/limited_work.hpp"
#include "search/early_end.hpp"

namespace tunica::search {
namespace {

using Matrix = Eigen::MatrixXd;

struct Direction {
  std::string name;
  std::vector<double> v;  ///< unit length
};

struct Neighbour {
  const Direction* direction;
  double step;
  std::vector<double> free;
  Status status;
  double objective = 0;
  bool left_out = false;  ///< because time was over
  bool simulated = true;  ///< false: the objective is a lower bound, and another neighbour is lower
};

/// Eigenvectors of JᵀJ; none if the Jacobian is not available.
void add_principal_directions(const assembly::Assembly& assembly, std::span<const double> free,
                              std::vector<Direction>& directions) {
  const std::size_t n = free.size(), m = assembly.layout().residual_count;
  std::vector<double> residuals(m), jacobian(m * n);
  const auto workspace = assembly.evaluator().make_workspace();
  double objective = 0;
  if (assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, *workspace).kind() ==
      Status::Kind::failed)
    return;
  assembly.box().jacobian_to_unit(free, jacobian);
  Matrix normal = Matrix::Zero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  for (const ResidualBlock& block : assembly.layout().blocks) {
    double squares = 0;
    for (std::size_t k = 0; k < block.size; ++k) squares += std::pow(residuals[block.offset + k], 2);
    // The Gauss–Newton matrix of w ρ(‖r‖²) is 2 w ρ' JᵀJ, ρ' = 1/(2√(s + ε²)) for the root.
    const double slope = block.loss == ResidualBlock::Loss::quadratic
                             ? 1
                             : 0.5 / std::hypot(std::sqrt(squares), Problem::root_smoothing);
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> J(jacobian.data() + block.offset * n, static_cast<Eigen::Index>(block.size),
                                   static_cast<Eigen::Index>(n));
    normal += block.weight * slope * J.transpose() * J;
  }
  if (!normal.allFinite()) return;
  const Matrix vectors = numerics::eigenpairs(normal).vectors;
  for (Eigen::Index k = 0; k < normal.rows(); ++k) {
    const Eigen::VectorXd v = vectors.col(k);
    directions.push_back({fmt::format("direction {} of the residuals' curvature", k + 1), {v.begin(), v.end()}});
  }
}

std::vector<Neighbour> neighbours_of(const assembly::Assembly& assembly, std::span<const double> free,
                                     const std::vector<Direction>& directions) {
  const std::size_t n = free.size();
  std::vector<double> x(n), moved(n);
  assembly.box().to_unit(free, x);
  std::vector<Neighbour> found;
  for (const Direction& direction : directions)
    for (const double length : neighbour_steps)
      for (const double step : {-length, length}) {
        for (std::size_t j = 0; j < n; ++j) moved[j] = std::clamp(x[j] + step * direction.v[j], 0.0, 1.0);
        if (std::equal(moved.begin(), moved.end(), x.begin())) continue;  // out of the bounds
        Neighbour neighbour{&direction, step, std::vector<double>(n), {}, 0};
        assembly.box().from_unit(moved, neighbour.free);
        found.push_back(std::move(neighbour));
      }
  return found;
}

/// Neighbours are evaluated in parallel. Only the lowest counts. Costly tests are therefore left out for an infeasible
/// neighbour, and for one whose cheap tests alone cost more than another neighbour in all.
void evaluate_neighbours(const assembly::Assembly& assembly, std::vector<Neighbour>& neighbours,
                         plugins::Clock::time_point deadline) {
  const auto evaluate = [&](Neighbour& neighbour, assembly::CostlyTests costly) {
    const plugins::LimitedWork work("neighbours", deadline);
    neighbour.left_out = work.is_over();
    if (neighbour.left_out) return;
    const auto own = assembly.evaluator().make_workspace();
    neighbour.status = assembly.evaluator().evaluate(neighbour.free, neighbour.objective, {}, {}, {}, *own, costly);
    neighbour.left_out = !neighbour.status.ok() && work.is_over();  // it was not waited for
  };
  const bool costly = assembly.layout().has_costly_tests;
  tbb::parallel_for(std::size_t{0}, neighbours.size(), [&](std::size_t k) {
    evaluate(neighbours[k], costly ? assembly::CostlyTests::nowhere : assembly::CostlyTests::everywhere);
    neighbours[k].simulated = !costly;
  });
  if (!costly) return;
  EarlyEnd early;
  for (std::size_t k = 0; k < neighbours.size(); ++k)
    if (neighbours[k].status.ok() && !neighbours[k].left_out) early.add(k, neighbours[k].objective);
  early.begin(1);
  const auto workers = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_for(std::size_t{0}, std::min(workers, early.size()), [&](std::size_t) {
    while (const auto taken = early.take()) {
      Neighbour& neighbour = neighbours[taken->point];
      evaluate(neighbour, assembly::CostlyTests::everywhere);
      neighbour.simulated = true;
      early.found(*taken,
                  neighbour.status.ok() && !neighbour.left_out ? std::optional(neighbour.objective) : std::nullopt);
    }
  });
  for (const std::size_t k : early.left()) {  // taken needlessly or not at all: it is not the lowest
    neighbours[k].simulated = false;
    neighbours[k].status = {};  // as its cheap tests are
  }
}

}  // namespace

bool same_objective(double a, double b) { return std::abs(a - b) <= 1e-9 * std::abs(b) + 1e-12; }

Neighbourhood probe_neighbourhood(const assembly::Assembly& assembly, std::span<const double> free,
                                  plugins::Clock::time_point deadline) {
  const std::size_t n = free.size();
  Neighbourhood result;
  const auto workspace = assembly.evaluator().make_workspace();
  result.status = assembly.evaluator().evaluate(free, result.objective, {}, {}, {}, *workspace);
  if (result.status.kind() == Status::Kind::failed) return result;
  result.constraints = assembly.constraints().count();
  std::vector<double> values(result.constraints);
  if (result.constraints > 0 && assembly.constraints().evaluate(free, values, {}).ok())
    result.active_constraints = static_cast<std::size_t>(
        std::count_if(values.begin(), values.end(), [](double value) { return value > -active_margin; }));

  std::vector<Direction> directions;
  for (std::size_t j = 0; j < n; ++j) {
    directions.push_back({assembly.layout().parameters[j].name, std::vector<double>(n, 0.0)});
    directions.back().v[j] = 1;
  }
  if (n > 1 && plugins::Clock::now() < deadline) {
    const plugins::LimitedWork work("neighbours", deadline);
    add_principal_directions(assembly, free, directions);
  }
  auto neighbours = neighbours_of(assembly, free, directions);
  evaluate_neighbours(assembly, neighbours, deadline);
  for (auto& neighbour : neighbours) {
    if (neighbour.left_out) {
      ++result.left_out;
      continue;
    }
    ++result.evaluated;
    result.simulated += neighbour.simulated;
    result.infeasible += neighbour.status.kind() == Status::Kind::infeasible;
    result.failed += neighbour.status.kind() == Status::Kind::failed;
    if (!neighbour.simulated || !neighbour.status.ok() ||
        (result.lowest && neighbour.objective >= result.lowest->objective))
      continue;
    result.lowest = {neighbour.objective, neighbour.step, neighbour.direction->name, std::move(neighbour.free)};
  }
  result.better = result.lowest && result.lowest->objective < result.objective &&
                  !same_objective(result.lowest->objective, result.objective);
  return result;
}

}  // namespace tunica::search
