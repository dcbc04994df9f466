// SPDX-License-Identifier: Apache-2.0
// What one call of a model may have to do with another: nothing.
#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "conformance/concurrency.hpp"
#include "conformance/differences.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

std::vector<Batch> draw_batches(const Model& model, std::uint64_t seed, std::initializer_list<std::size_t> sizes) {
  Sampler sampler(seed);
  std::vector<Batch> batches;
  for (const std::size_t count : sizes) batches.push_back(Batch::draw(model, sampler, count));
  return batches;
}

std::string first_difference(const std::vector<double>& a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (!same(a[i], b[i])) return fmt::format("{:.17g} became {:.17g}", a[i], b[i]);
  return "the number of answers changed";
}
double error(const std::vector<double>& a, const std::vector<double>& b) {
  if (same(a, b)) return 0;
  double largest = 1e-17;  // bits that differ are never nothing
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    if (!same(a[i], b[i])) largest = std::max(largest, std::abs(a[i] - b[i]) / std::max(1e-300, std::abs(a[i])));
  return largest;
}

}  // namespace

Verdict batch_equals_single_points(const Model& model, std::uint64_t seed) {
  Meter meter("points of a batch of 131 with the same points alone", 0);
  const Batch batch = draw_batches(model, seed, {131})[0];  // odd, and more than kernels work on at once
  const std::size_t n = batch.count, history = model.describe().history_size;
  const std::vector<double> together = answers(model, batch);
  for (std::size_t i = 0; i < n; ++i) {
    const Point point = batch.point(i);
    Batch single{1, {point.C.begin(), point.C.end()}, batch.p, {}, {}};
    if (!batch.time_step.empty()) single.time_step = {batch.time_step[i]};
    for (std::size_t k = 0; k < history && !batch.state.empty(); ++k) single.state.push_back(batch.state[k * n + i]);
    const std::vector<double> alone = answers(model, single);
    std::vector<double> picked(alone.size());
    for (std::size_t k = 0; k < alone.size(); ++k) picked[k] = together[k * n + i];
    meter.see(error(alone, picked), [&] {
      return fmt::format("point {} of {}: {} in the batch,", i, n, first_difference(alone, picked)) +
             where(model, point);
    });
  }
  return meter.verdict();
}

Verdict unwanted_outputs_change_nothing(const Model& model, std::uint64_t seed) {
  Meter meter("each output alone with all of them together", 1e-12);
  for (const Batch& batch : draw_batches(model, seed, {1, 7, 131})) {
    const std::vector<double> together = answers(model, batch);
    std::size_t begin = 0;
    constexpr const char* names[] = {"energy", "stress", "tangent", "stress_dp", "state"};
    for (std::size_t k = 0; k < 5; ++k) {
      const std::vector<double> alone = answers(model, batch, {k == 0, k == 1, k == 2, k == 3, k == 4});
      const std::span<const double> all = std::span(together).subspan(begin, alone.size());
      const double scale = scale_of(all);
      for (std::size_t i = 0; i < alone.size(); ++i)
        if (!same(alone[i], all[i]))
          meter.see(std::abs(alone[i] - all[i]) / scale, [&] {
            return fmt::format("'{}' is {:.15g} where nothing else is wanted, {:.15g} beside the other outputs,",
                               names[k], alone[i], all[i]) +
                   where(model, batch.point(i % batch.count));
          });
      begin += alone.size();
    }
    static_cast<void>(answers(model, batch, {false, false, false, false, false}));  // asking for nothing is no error
  }
  return meter.verdict();
}

Verdict calls_leave_nothing_behind(const Model& model, std::uint64_t seed) {
  Meter meter("answers with the same call's later, among others, in other orders", 0);
  const std::vector<Batch> batches = draw_batches(model, seed, {1, 1, 2, 3, 17, 64, 131, 1, 5, 33});
  std::vector<std::vector<double>> reference;
  for (const Batch& batch : batches) reference.push_back(answers(model, batch));
  const auto again = [&](std::size_t k, const std::string& when) {
    const std::vector<double> now = answers(model, batches[k]);
    meter.see(error(reference[k], now), [&] {
      return fmt::format("{} {}: a call with {} points,", first_difference(reference[k], now), when, batches[k].count) +
             where(model, batches[k].point(0));
    });
  };
  for (std::size_t k = 0; k < batches.size(); ++k) {
    again(k, "when called again");
    again(k, "when called twice");
  }
  for (std::size_t k = batches.size(); k-- > 0;) again(k, "after calls in reverse order");
  std::vector<std::size_t> order(batches.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  Sampler sampler(seed + 1);
  for (int round = 0; round < 10; ++round) {
    std::shuffle(order.begin(), order.end(), sampler.engine());
    for (const std::size_t k : order) {
      // In between: a single point far away, and parts of the answers only.
      const Batch between{1, {4, 3, 1. / 12, 0.2, 0.1, 0}, batches[k].p, {}, {}};
      static_cast<void>(model.evaluate(between.points(), {}));
      static_cast<void>(answers(model, batches[order[0]], {round % 2 == 0, round % 3 == 0, round % 5 == 0, false}));
      again(k, "after other calls");
    }
  }
  return meter.verdict();
}

Verdict concurrent_calls_agree(const Model& model, std::uint64_t seed) {
  Meter meter("answers of many threads with those of one", 0);
  const std::vector<Batch> batches = draw_batches(model, seed, {1, 300, 2, 64, 131, 17});
  // Few outputs at a time as well: the shorter a call, the larger the part of it in which scratch is in use.
  const std::vector<OutputSelection> kinds{{}, {true, false, false, false, false}, {false, true, false, false, false}};
  struct Call {
    const Batch& batch;
    const OutputSelection& wanted;
    std::vector<double> reference;
  };
  std::vector<Call> calls;
  for (const Batch& batch : batches)
    for (const OutputSelection& wanted : kinds) calls.push_back({batch, wanted, answers(model, batch, wanted)});
  const auto agrees = [&](std::size_t k) {
    return same(calls[k].reference, answers(model, calls[k].batch, calls[k].wanted));
  };
  for (std::size_t k = 0; k < calls.size(); ++k)
    if (!agrees(k)) return not_checked(meter.verdict().compared, "one thread alone gets no two answers alike");
  const Race race = race_threads(calls.size(), agrees);
  if (race.lost)
    meter.see(1, [&] {
      const Batch& batch = calls[race.input].batch;
      return fmt::format("after {} calls by {} threads a call with {} points answered otherwise than alone,",
                         race.calls, race.threads, batch.count) +
             where(model, batch.point(0));
    });
  meter.note(fmt::format("{} calls by {} threads", race.calls, race.threads));
  return meter.verdict();
}

}  // namespace tunica::conformance
