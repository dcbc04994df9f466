// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "assembly/whitening.hpp"
#include "numerics/orthogonal.hpp"
#include "plugins/calls.hpp"
#include "tunica/random.hpp"

namespace tunica::uncertainty {
namespace {

constexpr std::size_t fewest_draws = 40;  // a 2.5 % point of fewer is their smallest

/// The best fit, and what is drawn from: z of the header, row by row.
struct Pool {
  std::vector<double> predictions;
  assembly::Whitening whitening;
  std::vector<double> z;
  std::vector<std::size_t> blocks;
  std::vector<double> correlation;
};

/// Diagonal of the hat matrix of the rows, by a rank-revealing factorisation: directions that the data do not see take
/// nothing away.
Eigen::VectorXd leverages(const Eigen::MatrixXd& rows) {
  return numerics::orthonormal_basis(rows).rowwise().squaredNorm();
}

bool fill(const assembly::Assembly& assembly, std::span<const double> best, Pool& pool) {
  const std::size_t n = best.size();
  const auto workspace = assembly.evaluator().make_workspace();
  pool.predictions.resize(assembly.layout().prediction_count);
  std::vector<double> by_free(pool.predictions.size() * n);
  if (!assembly.evaluator().predict(best, pool.predictions, by_free, *workspace).ok()) return false;
  pool.whitening = assembly::whitening(assembly, pool.predictions);
  const assembly::Whitening& noise = pool.whitening;
  std::vector<double> jacobian(noise.count() * n);
  assembly::whitened_residuals(noise, best, pool.predictions, by_free, {}, jacobian);
  assembly.box().jacobian_to_unit(best, jacobian);
  const Eigen::MatrixXd rows = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      jacobian.data(), static_cast<Eigen::Index>(noise.count()), static_cast<Eigen::Index>(n));
  const Eigen::VectorXd h = leverages(rows);
  for (std::size_t k = 0; k < noise.rows.size(); ++k) {
    const auto& row = noise.rows[k];
    const double left = std::max(1 - h[static_cast<Eigen::Index>(k)], 1e-6);
    pool.z.push_back((row.measured - pool.predictions[row.prediction]) / (row.sd * std::sqrt(left)));
  }
  for (std::size_t c = 0; c < noise.channels(); ++c) {
    const std::size_t first = noise.first[c], count = noise.first[c + 1] - first;
    const std::span<double> z = std::span(pool.z).subspan(first, count);
    double mean = 0, squares = 0, products = 0;
    for (const double value : z) mean += value / static_cast<double>(count);
    for (double& value : z) {
      value -= mean;
      squares += value * value;
    }
    for (std::size_t i = 1; i < count; ++i) products += z[i] * z[i - 1];
    const double phi = squares > 0 ? products / squares : 0, size = static_cast<double>(count);
    const double length = std::pow(std::sqrt(6.0) * std::abs(phi) / (1 - phi * phi), 2.0 / 3) * std::cbrt(size);
    const bool correlated = std::abs(phi) > 2 / std::sqrt(size);
    pool.correlation.push_back(phi);
    pool.blocks.push_back(
        correlated ? static_cast<std::size_t>(std::clamp(std::round(length), 1.0, std::max(1.0, size / 3))) : 1);
  }
  return true;
}

std::vector<double> drawn(const Pool& pool, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<double> values = pool.predictions;
  const assembly::Whitening& noise = pool.whitening;
  for (std::size_t c = 0; c < noise.channels(); ++c) {
    const std::size_t first = noise.first[c], count = noise.first[c + 1] - first;
    std::size_t from = 0;
    for (std::size_t i = 0; i < count; ++i, ++from) {
      // Not std::uniform_int_distribution: its outcome is the library's choice.
      if (i % pool.blocks[c] == 0)
        from = static_cast<std::size_t>(static_cast<double>(generator() >> 11) * 0x1p-53 * static_cast<double>(count));
      const auto& row = noise.rows[first + i];
      values[row.prediction] += row.sd * pool.z[first + from % count];
    }
  }
  return values;
}

double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Bootstrap bootstrap(const assembly::Assembly& assembly, std::span<const double> best, const LocalOptimizer& optimizer,
                    std::size_t draws, std::uint64_t seed, const std::function<bool()>& interrupted) {
  Bootstrap result;
  result.ci95.resize(best.size());
  Pool pool;
  if (!fill(assembly, best, pool)) return result;
  result.blocks = pool.blocks;
  result.correlation = pool.correlation;
  RefitObjective target;
  target.blocks = assembly.layout().blocks;
  target.residual_count = assembly.layout().residual_count;
  target.evaluate = [&assembly](std::span<const double> free, double& objective, std::span<double> residuals,
                                std::span<double> jacobian, assembly::Workspace& workspace) {
    return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, workspace);
  };
  result.draws.resize(draws);
  std::vector<char> left_out(draws, 0);  // for want of time
  const plugins::Clock::time_point deadline = plugins::deadline_of_this_thread();
  tbb::parallel_for(std::size_t{0}, draws, [&](std::size_t k) {
    Bootstrap::Draw& draw = result.draws[k];
    const plugins::Call part{nullptr, "analysis", nullptr, nullptr, deadline};
    const plugins::CallScope scope(part);
    const auto is_over = [deadline] { return plugins::Clock::now() >= deadline; };
    if (is_over()) return void(left_out[k] = 1);
    if (interrupted && interrupted()) {
      draw.status = Status::failed("interrupted");
      return;
    }
    const std::uint64_t own = derive_seed(seed, fmt::format("bootstrap draw {}", k + 1));
    const auto workspace = assembly.evaluator().make_workspace();
    assembly.evaluator().measure(drawn(pool, own), *workspace);
    Refit found = refit(assembly, target, optimizer, best, {}, own, *workspace);
    draw = {std::move(found.status), std::move(found.free), found.objective, found.converged};
    left_out[k] = !draw.status.ok() && is_over() ? 1 : 0;
  });
  std::size_t next = 0;
  std::erase_if(result.draws, [&](const Bootstrap::Draw&) { return left_out[next++] != 0; });
  for (std::size_t j = 0; j < best.size(); ++j) {
    std::vector<double> sample;
    for (const auto& draw : result.draws)
      if (draw.status.ok()) sample.push_back(draw.free[j]);
    result.failures = result.draws.size() - sample.size();
    if (sample.size() < fewest_draws) continue;
    std::sort(sample.begin(), sample.end());
    result.ci95[j] = {quantile(sample, 0.025), quantile(sample, 0.975)};
  }
  return result;
}

}  // namespace tunica::uncertainty
