// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/refit.hpp"

#include <algorithm>
#include <new>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "search/calibration_problem.hpp"
#include "tunica/random.hpp"

namespace tunica::uncertainty {
namespace {

/// The optimiser's view: the unit box, without the coordinate that is held.
class RefitProblem final : public Problem {
 public:
  RefitProblem(const assembly::Assembly& assembly, const RefitObjective& target, std::span<const double> start,
               std::optional<std::size_t> held, std::uint64_t seed, assembly::Workspace& workspace)
      : assembly_(assembly),
        target_(target),
        workspace_(workspace),
        seed_(seed),
        unit_(start.size()),
        free_(start.begin(), start.end()),
        held_value_(held ? start[*held] : 0),
        held_(held) {
    assembly.box().to_unit(start, unit_);
    for (std::size_t j = 0; j < unit_.size(); ++j)
      if (j != held) {
        moving_.push_back(j);
        start_.push_back(unit_[j]);
      }
  }

  [[nodiscard]] const search::Best& best() const { return best_; }

  [[nodiscard]] std::size_t dimension() const override { return moving_.size(); }
  [[nodiscard]] std::span<const double> start() const override { return start_; }
  [[nodiscard]] std::span<const ResidualBlock> blocks() const override { return target_.blocks; }
  [[nodiscard]] std::size_t residual_count() const override { return target_.residual_count; }
  [[nodiscard]] std::size_t constraint_count() const override { return assembly_.constraints().count(); }
  Status evaluate(std::span<const double> x, double& objective) override { return at(x, objective, {}, {}); }
  void evaluate_batch(std::span<const double> xs, std::span<double> objectives, std::span<Status> statuses) override {
    for (std::size_t k = 0; k < statuses.size(); ++k)
      statuses[k] = at(xs.subspan(k * dimension(), dimension()), objectives[k], {}, {});
  }
  Status linearise(std::span<const double> x, double& objective, std::span<double> residuals,
                   std::span<double> jacobian) override {
    if (jacobian.empty()) return at(x, objective, residuals, {});
    by_free_.resize(target_.residual_count * free_.size());
    Status status = at(x, objective, residuals, by_free_);
    if (status.kind() != Status::Kind::failed) reduce(by_free_, jacobian);
    return status;
  }
  Status constraints(std::span<const double> x, std::span<double> values, std::span<double> jacobian) override {
    move_to(x);
    if (jacobian.empty()) return assembly_.constraints().evaluate(free_, values, {});
    by_free_.resize(values.size() * free_.size());
    Status status = assembly_.constraints().evaluate(free_, values, by_free_);
    if (status.ok()) reduce(by_free_, jacobian);
    return status;
  }
  /// Sequential, because the refits themselves run in parallel.
  std::size_t for_each_start(std::size_t count, const std::function<void(std::size_t, Problem&)>& body) override {
    std::size_t k = 0;
    for (; k < count && !should_stop(); ++k) body(k, *this);
    return k;
  }
  [[nodiscard]] bool should_stop() const override { return evaluations_ >= refit_evaluations; }
  [[nodiscard]] std::uint64_t evaluations() const override { return evaluations_; }
  [[nodiscard]] std::uint64_t budget() const override {
    return refit_evaluations - std::min(refit_evaluations, evaluations_);
  }
  [[nodiscard]] std::uint64_t seed(std::string_view purpose) const override { return derive_seed(seed_, purpose); }

 private:
  void move_to(std::span<const double> x) {
    for (std::size_t k = 0; k < moving_.size(); ++k) unit_[moving_[k]] = std::clamp(x[k], 0.0, 1.0);
    assembly_.box().from_unit(unit_, free_);
    if (held_) free_[*held_] = held_value_;  // to the last bit
  }

  /// From all free parameters to the coordinates that move.
  void reduce(std::span<double> by_free, std::span<double> jacobian) {
    assembly_.box().jacobian_to_unit(free_, by_free);
    const std::size_t n = free_.size(), m = moving_.size();
    for (std::size_t i = 0; i * n < by_free.size(); ++i)
      for (std::size_t k = 0; k < m; ++k) jacobian[i * m + k] = by_free[i * n + moving_[k]];
  }

  Status at(std::span<const double> x, double& objective, std::span<double> residuals, std::span<double> jacobian) {
    if (should_stop()) return Status::failed("stopped: max_evaluations");
    ++evaluations_;
    move_to(x);
    Status status = target_.evaluate(free_, objective, residuals, jacobian, workspace_);
    if (status.kind() == Status::Kind::failed) return status;
    const search::Best found{free_, objective, evaluations_ - 1, status.violation()};
    if (found.better_than(best_)) best_ = found;
    return status;
  }

  const assembly::Assembly& assembly_;
  const RefitObjective& target_;
  assembly::Workspace& workspace_;
  const std::uint64_t seed_;
  std::vector<double> unit_, free_, start_, by_free_;
  const double held_value_;
  const std::optional<std::size_t> held_;
  std::vector<std::size_t> moving_;
  std::uint64_t evaluations_ = 0;
  search::Best best_;
};

}  // namespace

Refit refit(const assembly::Assembly& assembly, const RefitObjective& target, const LocalOptimizer& optimizer,
            std::span<const double> start, std::optional<std::size_t> held, std::uint64_t seed,
            assembly::Workspace& workspace) {
  RefitProblem problem(assembly, target, start, held, seed, workspace);
  Refit result;
  try {
    if (problem.dimension() == 0) {
      double objective = 0;
      result.status = problem.evaluate({}, objective);
      result.converged = true;
    } else {
      const auto solver = plugins::create(*optimizer.plugin, optimizer.options);
      result.converged = plugins::guarded(
                             optimizer.plugin->plugin, "minimise", [&] { return solver->minimise(problem); }, seed)
                             .converged;
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& broken) {
    result.status = Status::failed(broken.what());
    return result;
  }
  const search::Best& best = problem.best();
  result.evaluations = problem.evaluations();
  if (!best.found()) {
    result.status = Status::failed("no point near the optimum could be evaluated");
    return result;
  }
  result.free = best.parameters;
  result.objective = best.objective;
  result.status =
      best.feasible() ? Status() : Status::infeasible("no point that keeps the constraints was found", best.violation);
  return result;
}

}  // namespace tunica::uncertainty
