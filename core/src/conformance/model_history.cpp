// SPDX-License-Identifier: Apache-2.0
// Models with memory.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

constexpr std::size_t points = 20;

struct StepResult {
  std::vector<double> stress, state;
};
StepResult step(const Model& model, const Batch& batch) {
  return {answers(model, batch, {false, true, false, false, false}),
          answers(model, batch, {false, false, false, false, true})};
}

/// The stresses against each other, relative to the largest.
void see(Meter& meter, const Model& model, const Batch& batch, const std::vector<double>& one,
         const std::vector<double>& other, const std::string& words) {
  for (std::size_t i = 0; i < one.size(); ++i)
    meter.see(std::abs(one[i] - other[i]) / scale_of(one), [&] {
      return fmt::format("S is {:.10g} {} {:.10g},", one[i], words, other[i]) +
             where(model, batch.point(i % batch.count));
    });
}

Batch at_states(const Model& model, std::uint64_t seed) {
  Sampler sampler(seed);
  Batch batch = Batch::draw(model, sampler, points);
  batch.state.clear();
  batch.time_step.clear();
  return batch;
}

}  // namespace

Verdict history_begins_at_rest(const Model& model, std::uint64_t seed) {
  Meter meter("S from no state with S from the state that is left at rest", 1e-9);
  if (model.describe().history_size == 0) return not_checked(meter.verdict().compared, "the model has no history");
  Batch batch = at_states(model, seed);
  Batch rest = batch;
  for (std::size_t i = 0; i < rest.C.size(); ++i) rest.C[i] = i < 3 * points ? 1 : 0;
  const std::vector<double> state = step(model, rest).state;
  if (!std::all_of(state.begin(), state.end(), [](double x) { return std::isfinite(x); }))
    return broken(meter.verdict().compared,
                  fmt::format("of history_size = {} numbers a point some are not written, or no numbers",
                              model.describe().history_size));
  for (const double dt : {-1., 0., 1e-3, 1., 1e3}) {
    batch.time_step.assign(dt < 0 ? 0 : points, dt);
    batch.state.clear();
    const std::vector<double> from_nothing = step(model, batch).stress;
    batch.state = state;
    see(meter, model, batch, from_nothing, step(model, batch).stress,
        "without an old state, and from what C = 1 leaves behind");
  }
  return meter.verdict();
}

Verdict history_tangent_is_the_derivative_of_the_step(const Model& model, std::uint64_t seed) {
  Meter meter("2 dS/dC of a step from an old state with differences of S of that step", 1e-6);
  if (model.describe().history_size == 0) return not_checked(meter.verdict().compared, "the model has no history");
  Sampler sampler(seed);
  std::size_t settled = 0, all = 0;
  for (const double dt : {-1., 1e-2, 1., 1e2}) {
    Batch batch = Batch::draw(model, sampler, points);
    batch.time_step.assign(dt < 0 ? 0 : points, dt);
    const std::vector<double> tangent = answers(model, batch, {false, false, true, false, false});
    for (std::size_t b = 0; b < 6; ++b) {
      const auto slope = differentiate(
          [&](double t) {
            Batch moved = batch;
            for (std::size_t i = 0; i < points; ++i) moved.C[b * points + i] += t;
            return answers(model, moved, {false, true, false, false, false});
          },
          1e-2);
      const double factor = b < 3 ? 2 : 1;  // an off-diagonal entry stands for two
      for (std::size_t i = 0; i < points; ++i) {
        double scale = 1e-300, unsure = 0;
        for (std::size_t a = 0; a < 6; ++a) {
          scale = std::max(
              {scale, std::abs(tangent[(6 * a + b) * points + i]), std::abs(factor * slope[a * points + i].value)});
          unsure = std::max(unsure, factor * slope[a * points + i].uncertainty);
        }
        ++all;
        if (!(unsure <= 0.25 * meter.tolerance() * scale)) continue;  // a kink: where loading turns, for example
        ++settled;
        for (std::size_t a = 0; a < 6; ++a) {
          const double given = tangent[(6 * a + b) * points + i], expected = factor * slope[a * points + i].value;
          meter.see(std::abs(given - expected) / scale, [&] {
            return fmt::format("2 dS_{}/dC_{} = {:.10g}, differences of S from the same old state give {:.10g}, {}",
                               component_names[a], component_names[b], given, expected,
                               dt < 0 ? std::string("no clock") : fmt::format("a step of {:g} s", dt)) +
                   where(model, batch.point(i));
          });
        }
      }
    }
  }
  if (settled < all / 4)
    return broken(meter.verdict().compared,
                  fmt::format("at {} of {} states and components differences do not settle: S jumps or has noise",
                              all - settled, all));
  if (settled < all)
    meter.note(fmt::format("{} of {} columns left out, where differences do not settle", all - settled, all));
  return meter.verdict();
}

Verdict history_stands_still_without_time(const Model& model, std::uint64_t seed) {
  Meter meter("S with S of the same C again, no time later", 1e-9);
  if (model.describe().history_size == 0) return not_checked(meter.verdict().compared, "the model has no history");
  Batch batch = at_states(model, seed);
  for (const double dt : {0., 1e-2, 1., 1e2}) {
    batch.time_step.assign(points, dt);
    batch.state.clear();
    const StepResult first = step(model, batch);
    const auto bad =
        std::find_if_not(first.state.begin(), first.state.end(), [](double x) { return std::isfinite(x); });
    if (bad != first.state.end())
      return broken(meter.verdict().compared,
                    fmt::format("number {} of {} of the state is {} after a step of {:g} s,",
                                static_cast<std::size_t>(bad - first.state.begin()) / points + 1,
                                model.describe().history_size, *bad, dt) +
                        where(model, batch.point(static_cast<std::size_t>(bad - first.state.begin()) % points)));
    if (!std::all_of(first.stress.begin(), first.stress.end(), [](double x) { return std::isfinite(x); }))
      return broken(meter.verdict().compared, fmt::format("S is no number after a step of {:g} s", dt));
    batch.state = first.state;
    batch.time_step.assign(points, 0);
    see(meter, model, batch, first.stress, step(model, batch).stress, "and after a second step of 0 s at the same C");
  }
  return meter.verdict();
}

}  // namespace tunica::conformance
