// SPDX-License-Identifier: Apache-2.0
#include "simulation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace tunica::fe {
namespace {

constexpr std::size_t first_points = 15, most_points = 29;
constexpr double hopeless = 200;  ///< times the tolerated error: twice as many points would hardly be enough

/// Where fibres switch along the line coefficients a_m fall like m^−p alone. The last ones
/// before and after the number of points was doubled tell p. Left out is Σ_{m>n} a_m ≈ a_n n/(p − 1), of which the
/// estimate has 3 a_n.
double slowness(double before, double now, std::size_t points) {
  const double power = std::log2(before / now);
  return power > 1 ? std::max(1., static_cast<double>(points) / (3 * (power - 1))) : static_cast<double>(points);
}

/// Non-finite values stay.
double largest_of(const std::array<double, 3>& errors) {
  double largest = 0;
  for (const double error : errors)
    if (std::isfinite(largest) && !(error <= largest)) largest = error;
  return largest;
}

}  // namespace

Mesh mesh_of(const Tube& tube) {
  return {tube.order,      tube.radial,  tube.axial, tube.inner,     tube.outer,
          tube.length / 2, tube.grading, tube.ends,  tube.interfaces};
}

Support support_of(const Solver& solver, const State& free, double slope) {
  const Mesh& mesh = solver.mesh();
  Support support{slope, {}};
  for (std::size_t k = 0; k < mesh.planes(); ++k) support.free.push_back(free.x[2 * mesh.node(mesh.across() - 1, k)]);
  return support;
}

Simulation::Simulation(const Tube& tube) : tube_(tube), solver_(mesh_of(tube)), sensitivity_(solver_) {}

Status Simulation::take(Path& path, const Load& load, Sample& sample) {
  if (Status status = path.go(load, derivatives_ ? Aim::weights : Aim::state); !status.ok()) return status;
  ++solutions_;
  if (derivatives_) return sensitivity_.sample(path, sample);
  sample.value = path.observed();
  return {};
}

Status Simulation::run(const Material& material, std::span<const Load> loads, const Wanted& derivatives,
                       std::vector<Sample>& samples, std::size_t& failed_at, double support) {
  samples.resize(loads.size());
  wanted_ = derivatives;
  derivatives_ = std::ranges::count(derivatives, true) > 0;
  solutions_ = 0;
  failed_at = 0;
  // Lines by axial stretch, those beyond 1 in ascending, those below in descending order.
  std::map<double, std::vector<std::size_t>> lines;
  for (std::size_t i = 0; i < loads.size(); ++i) lines[loads[i].stretch].push_back(i);
  std::vector<double> order;
  for (const auto& [stretch, rows] : lines)
    if (stretch >= 1) order.push_back(stretch);
  for (auto at = lines.rbegin(); at != lines.rend(); ++at)
    if (at->first < 1) order.push_back(at->first);

  failed_at = lines[order.front()].front();
  solver_.set_time_limit(tube_.time_limit);
  solver_.assembly().support = {};
  if (Status status = solver_.begin(material); !status.ok()) return status;
  sensitivity_.begin(material, wanted_);
  Path path(solver_, {tube_.steps});
  if (Status status = path.begin(); !status.ok()) return status;
  const Path::Mark rest = path.mark();
  Path::Mark trunk = rest;
  const bool hold_later = tube_.ends == Ends::clamped_after_stretch;
  for (const double stretch : order) {
    failed_at = lines[stretch].front();
    if (trunk.load.stretch > 1 && stretch < 1) trunk = rest;
    solver_.hold_ends(tube_.ends == Ends::clamped);
    solver_.assembly().support = {};
    if (path.load().stretch != trunk.load.stretch || path.load().pressure != 0 || hold_later || support != 0)
      if (Status status = path.return_to(trunk); !status.ok()) return status;
    if (Status status = path.go({stretch, 0}, hold_later || support != 0 ? Aim::factor : Aim::state); !status.ok())
      return status;
    trunk = path.mark();
    Support free;
    if (support != 0 || derivatives_) {
      free = support_of(solver_, path.state(), support);
      if (support != 0 && derivatives_)
        if (Status status = sensitivity_.support(path); !status.ok()) return status;
    }
    if (hold_later) {
      if (derivatives_)
        if (Status status = sensitivity_.hold(path); !status.ok()) return status;
      solver_.hold_at(path.state());
      solver_.hold_ends(true);
    }
    solver_.assembly().support = free;
    if (hold_later || support != 0)
      if (Status status = path.return_to(trunk); !status.ok()) return status;
    if (Status status = line(path, trunk, loads, lines[stretch], samples, failed_at); !status.ok()) return status;
    if (hold_later || support != 0) sensitivity_.begin(material, wanted_);
  }
  last_ = path.state();
  return {};
}

Status Simulation::line(Path& path, const Path::Mark& trunk, std::span<const Load> loads,
                        std::span<const std::size_t> rows, std::vector<Sample>& samples, std::size_t& failed_at) {
  std::set<double> pressures;
  for (const std::size_t i : rows) pressures.insert(loads[i].pressure);
  // Worth it where it saves three rows in ten. Every second one of twice as many points is solved already.
  std::vector<Sample> nodes;
  std::array<double, 3> errors = {};
  for (std::size_t points = first_points; points <= most_points; points = 2 * points - 1) {
    if (10 * (nodes.empty() ? points : points - nodes.size()) >= 7 * pressures.size()) break;
    Status status = interpolated(path, trunk, loads, rows, points, nodes, samples, failed_at, errors);
    const double error = largest_of(errors);
    if (!status.ok() || error <= 1) return status;
    if (Status back = path.return_to(trunk); !back.ok()) return back;
    if (!(error <= hopeless)) break;
  }
  // Row by row, away from zero in both directions.
  std::vector<std::size_t> order(rows.begin(), rows.end());
  const auto pressure = [&](std::size_t i) { return loads[i].pressure; };
  std::ranges::stable_sort(order, [&](std::size_t i, std::size_t j) {
    const bool below = pressure(i) < 0, other = pressure(j) < 0;
    return below != other ? !below : std::abs(pressure(i)) < std::abs(pressure(j));
  });
  for (std::size_t k = 0; k < order.size(); ++k) {
    failed_at = order[k];
    if (k > 0 && pressure(order[k]) == pressure(order[k - 1])) {
      samples[order[k]] = samples[order[k - 1]];
      continue;
    }
    if (pressure(order[k]) < 0 && (k == 0 || pressure(order[k - 1]) >= 0))
      if (Status status = path.return_to(trunk); !status.ok()) return status;
    if (Status status = take(path, loads[order[k]], samples[order[k]]); !status.ok()) return status;
  }
  return {};
}

/// `nodes` of half as many points become those of all; `errors` of the observables at those become those at all,
/// estimates over what is tolerated.
Status Simulation::interpolated(Path& path, const Path::Mark& trunk, std::span<const Load> loads,
                                std::span<const std::size_t> rows, std::size_t points, std::vector<Sample>& nodes,
                                std::vector<Sample>& samples, std::size_t& failed_at, std::array<double, 3>& errors) {
  const auto [low, high] = std::ranges::minmax_element(
      rows, [&](std::size_t i, std::size_t j) { return loads[i].pressure < loads[j].pressure; });
  const Chebyshev curve(loads[*low].pressure, loads[*high].pressure, points);
  const std::span<const double> at = curve.points();
  const std::vector<Sample> known = std::move(nodes);
  nodes.assign(points, {});
  for (std::size_t k = 0; k < known.size(); ++k) nodes[2 * k] = known[k];
  const auto solve = [&](std::size_t k) {
    if (!known.empty() && k % 2 == 0) return Status();
    Status status = take(path, {trunk.load.stretch, at[k]}, nodes[k]);
    if (status.ok()) return status;
    // The next row on this side of zero that was not reached.
    const auto beyond = [&](std::size_t i) {
      const double pressure = loads[i].pressure, reached = path.load().pressure;
      return at[k] < 0 ? pressure < std::min(reached, 0.0) : pressure > std::max(reached, 0.0) || pressure == at[k];
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (const std::size_t i : rows)
      if (beyond(i) && std::abs(loads[i].pressure) < nearest) {
        nearest = std::abs(loads[i].pressure);
        failed_at = i;
      }
    return status;
  };
  const std::size_t zero =
      static_cast<std::size_t>(std::lower_bound(at.begin(), at.end(), 0.0) - at.begin());  // first one not below 0
  for (std::size_t k = zero; k < points; ++k)
    if (Status status = solve(k); !status.ok()) return status;
  if (zero > 0)
    if (Status status = path.return_to(trunk); !status.ok()) return status;
  for (std::size_t k = zero; k-- > 0;)
    if (Status status = solve(k); !status.ok()) return status;

  std::vector<double> values(points);
  for (std::size_t c = 0; c < 3; ++c) {
    double largest = 0;
    for (std::size_t k = 0; k < points; ++k) {
      values[k] = nodes[k].value[c];
      largest = std::max(largest, std::abs(values[k]));
    }
    // Where fibres switch along the line the coefficients fall slowly: what is left out is some times the last ones.
    const double left = 3 * curve.tail(values), allowed = tube_.tolerance * (c < 2 ? tube_.outer : 10 * largest);
    const double now = left == 0 ? 0 : left / allowed;
    errors[c] = known.empty() || now == 0 ? now : now * slowness(errors[c], now, points);
  }
  if (!(largest_of(errors) <= 1)) return {};
  for (const std::size_t i : rows) {
    curve.weights(loads[i].pressure, values);
    Sample& sample = samples[i];
    sample.value = {};
    sample.by.assign(nodes.front().by.size(), {});
    for (std::size_t k = 0; k < points; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        sample.value[c] += values[k] * nodes[k].value[c];
        for (std::size_t j = 0; j < sample.by.size(); ++j) sample.by[j][c] += values[k] * nodes[k].by[j][c];
      }
  }
  return {};
}

}  // namespace tunica::fe
