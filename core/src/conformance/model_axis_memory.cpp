// SPDX-License-Identifier: Apache-2.0
// Memory in principal axes: remember() along a path, against evaluate() step by step.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "conformance/axes_answers.hpp"
#include "conformance/differences.hpp"
#include "conformance/handout.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/model_properties.hpp"
#include "tunica/axis_step.hpp"

namespace tunica::conformance {
namespace {

constexpr std::size_t path_rows = 6;
constexpr std::size_t path_draws = 10;

/// Squared stretches of each row, the way there and half way back, and the time from row to row; empty = no clock.
struct AxisTrip {
  std::vector<std::array<double, 3>> c;
  std::vector<double> time_step;
  std::vector<double> p;
};

AxisTrip trip(const Model& model, Sampler& sampler, bool timed) {
  const Point end = sampler.diagonal_point(model);
  AxisTrip trip{{}, {}, end.p};
  for (const double part : {0.3, 0.6, 1.0, 0.8, 0.5, 0.9}) {
    std::array<double, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) c[a] = 1 + part * (end.C[a] - 1);
    trip.c.push_back(c);
    if (timed) trip.time_step.push_back(trip.time_step.empty() ? 0 : 0.7);
  }
  return trip;
}

/// g_a of every row, a row of 1 + (parameters) numbers each: its value, then its derivatives by the parameters.
std::vector<double> remembered(const Model& model, const AxisTrip& trip) {
  const std::size_t elastic = model.elastic().describe().parameters.size(), all = trip.p.size(), width = 1 + all,
                    count = path_rows + 1;
  std::vector<double> c(3 * count, 1), state(model.describe().axis_history_size * width);
  for (std::size_t i = 0; i < path_rows; ++i)
    for (std::size_t a = 0; a < 3; ++a) c[a * count + i] = trip.c[i][a];
  const AxesAnswers bare = axes_answers(model.elastic(), c, std::span(trip.p).first(elastic));
  std::vector<double> found;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = k == 0 ? path_rows : k - 1;  // first at rest
    std::vector<double> c_rows(3 * width), energy(width), gradient(3 * width);
    energy[0] = bare.energy[i];
    for (std::size_t j = 0; j < elastic && !bare.energy_dp.empty(); ++j) energy[1 + j] = bare.energy_dp[j * count + i];
    for (std::size_t a = 0; a < 3; ++a) {
      c_rows[a * width] = c[a * count + i];
      gradient[a * width] = bare.gradient[a * count + i];
      for (std::size_t j = 0; j < elastic && !bare.gradient_dp.empty(); ++j)
        gradient[a * width + 1 + j] = bare.gradient_dp[(3 * j + a) * count + i];
    }
    Handout handout("the model, in remember(),");
    const auto g = handout.in_place("gradient", gradient), s = handout.in_place("state", state);
    AxisStep step;
    step.width = width;
    step.parameter_place = 1;
    step.parameters = handout.input("parameters", trip.p);
    step.timed = !trip.time_step.empty();
    step.time_step = k == 0 || !step.timed ? 0 : trip.time_step[k - 1];
    step.at_rest = k == 0;
    step.first = k <= 1;
    step.c = handout.input("c", c_rows).data();
    step.energy = handout.input("energy", energy).data();
    step.gradient = g.data();
    step.state = s.data();
    model.remember(step);
    handout.verify();
    state.assign(s.begin(), s.end());
    if (k > 0) found.insert(found.end(), g.begin(), g.end());
  }
  return found;
}

/// S_aa of every row, from evaluate() with its own state.
std::vector<double> stepped(const Model& model, const AxisTrip& trip) {
  Batch batch;
  batch.count = 1;
  batch.p = trip.p;
  std::vector<double> found;
  for (std::size_t i = 0; i < path_rows; ++i) {
    batch.C = {trip.c[i][0], trip.c[i][1], trip.c[i][2], 0, 0, 0};
    if (!trip.time_step.empty()) batch.time_step = {trip.time_step[i]};
    const std::vector<double> S = answers(model, batch, {false, true, false, false, false});
    found.insert(found.end(), S.begin(), S.begin() + 3);
    batch.state = answers(model, batch, {false, false, false, false, true});
  }
  return found;
}

}  // namespace

Verdict axes_memory_agrees_with_tensors(const Model& model, std::uint64_t seed) {
  Meter meter("remember() along a path with evaluate() step by step, and its derivatives with differences", 1e-6);
  if (model.describe().axis_history_size == 0)
    return not_checked(meter.verdict().compared, "the model does not remember in principal axes");
  Sampler sampler(seed);
  for (std::size_t draw = 0; draw < path_draws; ++draw) {
    const bool timed = draw % 2 == 0;
    const AxisTrip path = trip(model, sampler, timed);
    const std::vector<double> rows = remembered(model, path), S = stepped(model, path);
    const std::size_t width = 1 + path.p.size();
    const auto place = [&](std::size_t k) {
      return fmt::format("of axis {} in row {} of {}{}", k % 3, k / 3 + 1, path_rows, timed ? ", 0.7 s a row" : "") +
             where(model, {{path.c[k / 3][0], path.c[k / 3][1], path.c[k / 3][2], 0, 0, 0}, path.p});
    };
    for (std::size_t k = 0; k < S.size(); ++k)
      meter.see(std::abs(2 * rows[k * width] - S[k]) / scale_of(S), [&] {
        return fmt::format("S is {:.12g} from remember(), {:.12g} from evaluate(), ", 2 * rows[k * width], S[k]) +
               place(k);
      });
    for (std::size_t j = 0; j < path.p.size(); ++j) {
      const Parameter& declared = model.describe().parameters[j];
      const double value = path.p[j], size = declared.scale == Scale::log ? value : declared.max - declared.min;
      const auto slope = differentiate(
          [&](double t) {
            AxisTrip moved = path;
            moved.p[j] += t;
            return remembered(model, moved);
          },
          std::min(1e-2 * size, 0.5 * std::min(value - declared.min, declared.max - value)));
      double scale = 1e-6 * scale_of(S) / size;
      for (std::size_t k = 0; k < S.size(); ++k)
        scale = std::max({scale, std::abs(rows[k * width + 1 + j]), std::abs(slope[k * width].value)});
      for (std::size_t k = 0; k < S.size(); ++k) {
        const Difference& expected = slope[k * width];
        if (!(expected.uncertainty <= 0.25 * meter.tolerance() * scale)) continue;
        const double given = rows[k * width + 1 + j];
        meter.see(std::abs(given - expected.value) / scale, [&] {
          return fmt::format("dg/d{} is {:.10g}, differences of the path give {:.10g}, ", declared.name, given,
                             expected.value) +
                 place(k);
        });
      }
    }
  }
  meter.note(sampler.drawn_again());
  return meter.verdict();
}

}  // namespace tunica::conformance
