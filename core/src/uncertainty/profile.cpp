// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/profile.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "plugins/calls.hpp"
#include "tunica/random.hpp"
#include "uncertainty/identifiability.hpp"
#include "uncertainty/sandwich.hpp"

namespace tunica::uncertainty {
namespace {

constexpr double first_step = 0.02, largest_step = 0.1, smallest_step = 1e-7;  // of the unit box
constexpr double wanted_rise = 0.25, tolerated_rise = 0.45;                    // of the root of the threshold, a step
constexpr double precision = 1e-3;                                             // of that root, of a crossing
constexpr int most_points = 200;

/// One side of one profile, from the centre outwards.
class ProfileSide {
 public:
  ProfileSide(const assembly::Assembly& assembly, const Likelihood& likelihood, const LocalOptimizer& optimizer,
              std::size_t parameter, int side, double step, std::uint64_t seed)
      : assembly_(assembly),
        likelihood_(likelihood),
        optimizer_(optimizer),
        parameter_(parameter),
        side_(side),
        step_(step),
        seed_(seed),
        workspace_(assembly.evaluator().make_workspace()) {
    assembly.evaluator().measure(likelihood.measured, *workspace_);
  }

  void run(const std::function<bool()>& interrupted, plugins::Clock::time_point deadline);

  std::vector<Profile::Point> points;  ///< outwards, without the centre
  Profile::End end;
  std::uint64_t evaluations = 0, failures = 0;

 private:
  /// Fits the others with the parameter at unit coordinate x, from `start`; false when that fails.
  bool fit(double x, const std::vector<double>& start, Profile::Point& point);
  /// √(Δ/threshold): near the optimum it grows in proportion to the distance.
  [[nodiscard]] double rise(double delta) const { return std::sqrt(std::max(0.0, delta)) / likelihood_.quantile; }
  /// Finds the crossing between two points, the first below and the second above the threshold.
  void cross(double inside, Profile::Point below, double outside, Profile::Point above);

  const assembly::Assembly& assembly_;
  const Likelihood& likelihood_;
  const LocalOptimizer& optimizer_;
  const std::size_t parameter_;
  const int side_;
  double step_;
  const std::uint64_t seed_;
  assembly::WorkspacePointer workspace_;
};

bool ProfileSide::fit(double x, const std::vector<double>& start, Profile::Point& point) {
  std::vector<double> unit(start.size()), from = start, held(start.size());
  assembly_.box().to_unit(start, unit);
  unit[parameter_] = x;
  assembly_.box().from_unit(unit, held);
  from[parameter_] = held[parameter_];
  const Refit found = refit(assembly_, likelihood_.target, optimizer_, from, parameter_,
                            derive_seed(seed_, fmt::format("fit {}", evaluations)), *workspace_);
  evaluations += found.evaluations;
  if (!found.status.ok()) {
    ++failures;
    return false;
  }
  point = {held[parameter_], (found.objective - likelihood_.centre.objective) / likelihood_.scales[parameter_],
           found.free};
  return true;
}

void ProfileSide::cross(double inside, Profile::Point below, double outside, Profile::Point above) {
  double low = rise(below.delta), high = rise(above.delta);
  end.kind = Profile::End::Kind::crossed;
  for (int k = 0; k < 20 && std::abs(outside - inside) > smallest_step; ++k) {
    // The secant, kept off the ends so that the bracket shrinks from both.
    const double share = std::clamp((1 - low) / (high - low), 0.05, 0.95);
    const double x = inside + share * (outside - inside);
    Profile::Point middle;
    if (!fit(x, below.free, middle)) break;
    const double here = rise(middle.delta);
    (here < 1 ? below : above) = middle;
    (here < 1 ? inside : outside) = x;
    (here < 1 ? low : high) = here;
    if (std::abs(here - 1) < precision) break;
  }
  const double share = (1 - low) / (high - low);
  end.value = below.value + share * (above.value - below.value);
  points.push_back(std::move(below));
  points.push_back(std::move(above));
}

void ProfileSide::run(const std::function<bool()>& interrupted, plugins::Clock::time_point deadline) {
  const plugins::Call part{nullptr, "analysis", nullptr, nullptr, deadline};
  const plugins::CallScope scope(part);
  const std::vector<double>& centre = likelihood_.centre.free;
  std::vector<double> unit(centre.size());
  assembly_.box().to_unit(centre, unit);
  const double bound = side_ < 0 ? 0 : 1;
  double x = unit[parameter_];
  Profile::Point last{centre[parameter_], 0, centre};
  end = {Profile::End::Kind::open, last.value};
  for (int k = 0; x != bound && k < most_points; ++k) {
    if ((interrupted && interrupted()) || plugins::Clock::now() >= deadline) break;
    const double next = side_ < 0 ? std::max(0.0, x - step_) : std::min(1.0, x + step_);
    Profile::Point point;
    if (!fit(next, last.free, point)) {
      step_ /= 4;
      end = {Profile::End::Kind::failed, last.value};
      if (step_ < smallest_step) return;
      continue;
    }
    const double before = rise(last.delta), here = rise(point.delta);
    if (here - before > tolerated_rise && step_ > smallest_step) {
      step_ *= std::max(0.1, wanted_rise / (here - before));
      continue;
    }
    if (here >= 1) return cross(x, last, next, point);
    points.push_back(point);
    if (here - before < wanted_rise / 2) step_ = std::min(2 * step_, largest_step);
    last = std::move(point);
    x = next;
    end = {Profile::End::Kind::open, last.value};
  }
  if (x != bound) end.kind = Profile::End::Kind::failed;
}

}  // namespace

Likelihood likelihood_at(const assembly::Assembly& assembly, std::span<const double> best,
                         const LocalOptimizer& optimizer, std::uint64_t seed, std::span<const double> measured) {
  Likelihood result;
  const auto workspace = assembly.evaluator().make_workspace();
  std::vector<double> predictions(assembly.layout().prediction_count);
  result.centre.status = assembly.evaluator().predict(best, predictions, {}, *workspace);
  if (!result.centre.status.ok()) return result;
  result.whitening = assembly::whitening(assembly, predictions, measured);
  result.measured.assign(measured.begin(), measured.end());
  result.target.residual_count = assembly.layout().residual_count;
  result.target.blocks = assembly.layout().blocks;
  result.target.evaluate = [&assembly](std::span<const double> free, double& objective, std::span<double> residuals,
                                       std::span<double> jacobian, assembly::Workspace& own) {
    return assembly.evaluator().evaluate(free, objective, {}, residuals, jacobian, own);
  };
  assembly.evaluator().measure(measured, *workspace);
  double at_best = 0;
  result.centre.status = assembly.evaluator().evaluate(best, at_best, {}, {}, {}, *workspace);
  if (result.centre.status.kind() == Status::Kind::failed) return result;
  result.centre = refit(assembly, result.target, optimizer, best, {}, derive_seed(seed, "centre"), *workspace);
  if (!result.centre.status.ok()) return result;
  result.gain = at_best - result.centre.objective;
  const Status scaled = objective_scales(assembly, result.centre.free, result.whitening, measured, result.scales);
  if (!scaled.ok()) {
    result.centre.status = scaled;
    return result;
  }
  std::vector<double> unit(best.size());
  assembly.box().to_unit(result.centre.free, unit);
  const auto inside = std::count_if(unit.begin(), unit.end(), [](double x) { return x > 1e-6 && x < 1 - 1e-6; });
  result.quantile = result.whitening.quantile(static_cast<std::size_t>(inside));
  return result;
}

std::vector<Profile> profiles(const assembly::Assembly& assembly, const Likelihood& likelihood,
                              const LocalOptimizer& optimizer, const std::vector<std::size_t>& parameters,
                              std::uint64_t seed, const std::function<bool()>& interrupted) {
  std::vector<double> steps(parameters.size(), first_step);
  Identifiability linear;
  if (identify(assembly, likelihood.centre.free, linear).ok()) {
    std::vector<double> unit(likelihood.centre.free.size()), end = unit, x = unit;
    assembly.box().to_unit(likelihood.centre.free, x);
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      const auto& interval = linear.parameters[parameters[k]];
      if (!interval.identified) continue;
      std::vector<double> upper = likelihood.centre.free, lower = upper;
      upper[parameters[k]] = interval.upper;
      lower[parameters[k]] = interval.lower;
      assembly.box().to_unit(upper, unit);
      assembly.box().to_unit(lower, end);
      const double half = (unit[parameters[k]] - end[parameters[k]]) / 2;
      steps[k] = std::clamp(wanted_rise * half, 10 * smallest_step, largest_step);
    }
  }
  const plugins::Clock::time_point deadline = plugins::deadline_of_this_thread();
  std::vector<ProfileSide> sides;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    for (const int side : {-1, 1})
      sides.emplace_back(assembly, likelihood, optimizer, parameters[k], side, steps[k],
                         derive_seed(seed, fmt::format("profile {} {}", parameters[k], side)));
  tbb::parallel_for(
      std::size_t{0}, sides.size(), [&](std::size_t k) { sides[k].run(interrupted, deadline); },
      tbb::simple_partitioner());
  std::vector<Profile> result;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    ProfileSide &down = sides[2 * k], &up = sides[2 * k + 1];
    Profile& profile = result.emplace_back();
    profile.parameter = parameters[k];
    profile.threshold = likelihood.quantile * likelihood.quantile;
    profile.gain = likelihood.gain / likelihood.scales[parameters[k]];
    profile.lower = down.end;
    profile.upper = up.end;
    profile.evaluations = down.evaluations + up.evaluations;
    profile.failures = down.failures + up.failures;
    profile.points = std::move(down.points);
    profile.points.push_back({likelihood.centre.free[parameters[k]], 0, likelihood.centre.free});
    std::move(up.points.begin(), up.points.end(), std::back_inserter(profile.points));
    std::sort(profile.points.begin(), profile.points.end(),
              [](const auto& a, const auto& b) { return a.value < b.value; });
    for (const auto& point : profile.points) profile.lowest = std::min(profile.lowest, point.delta);
  }
  return result;
}

}  // namespace tunica::uncertainty
