// SPDX-License-Identifier: Apache-2.0
#include "conformance/model_batch.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>

namespace tunica::conformance {
namespace {

/// Numbers around every output that nobody may touch.
constexpr std::size_t fence = 8;
constexpr double post = -7.0e77;

struct Fenced {
  explicit Fenced(std::size_t count) : memory(count == 0 ? 0 : count + 2 * fence, post), size(count) {
    // What is not written shows as no number.
    std::fill_n(memory.begin() + (count == 0 ? 0 : fence), count, std::numeric_limits<double>::quiet_NaN());
  }
  std::span<double> inside() { return size == 0 ? std::span<double>() : std::span(memory).subspan(fence, size); }
  [[nodiscard]] bool intact() const {
    return size == 0 || (std::all_of(memory.begin(), memory.begin() + fence, [](double x) { return x == post; }) &&
                         std::all_of(memory.end() - fence, memory.end(), [](double x) { return x == post; }));
  }
  std::vector<double> memory;
  std::size_t size;
};

}  // namespace

Batch Batch::draw(const Model& model, Sampler& sampler, std::size_t count) {
  Batch batch;
  batch.count = count;
  batch.C.resize(6 * count);
  const auto place = [&](std::size_t i, const Tensor& C) {
    for (std::size_t c = 0; c < 6; ++c) batch.C[c * count + i] = C[c];
  };
  Point first = sampler.point(model);
  batch.p = first.p;
  place(0, first.C);
  for (std::size_t i = 1; i < count; ++i) {
    Tensor C = sampler.right_cauchy_green();
    for (int tries = 0; tries < 100 && !evaluate(model, C, batch.p).finite(); ++tries) C = sampler.right_cauchy_green();
    place(i, C);
  }
  const std::size_t history = model.describe().history_size;
  if (history == 0) return batch;
  // An old state as the model itself leaves it, after a first step.
  batch.time_step.assign(count, 0.3);
  const std::vector<double> all = answers(model, batch, {false, false, false, false, true});
  batch.state.assign(all.begin(), all.end());
  for (std::size_t i = 0; i < count; ++i) place(i, sampler.right_cauchy_green());
  return batch;
}

Point Batch::point(std::size_t i) const {
  Point point{{}, p};
  for (std::size_t c = 0; c < 6; ++c) point.C[c] = C[c * count + i];
  return point;
}

std::vector<double> answers(const Model& model, const Batch& batch, const OutputSelection& wanted) {
  const std::size_t n = batch.count;
  const ModelDescription& description = model.describe();
  std::array outputs{Fenced(wanted.energy ? n : 0), Fenced(wanted.stress ? 6 * n : 0),
                     Fenced(wanted.tangent ? 36 * n : 0),
                     Fenced(wanted.stress_dp && description.parameter_derivatives ? 6 * n * batch.p.size() : 0),
                     Fenced(wanted.state ? description.history_size * n : 0)};
  const Batch before = batch;
  const Status status = model.evaluate(batch.points(), {outputs[0].inside(), outputs[1].inside(), outputs[2].inside(),
                                                        outputs[3].inside(), outputs[4].inside()});
  if (!status.ok()) throw std::runtime_error("the model answers '" + status.reason() + "'");
  if (before.state != batch.state || before.C != batch.C || before.p != batch.p)
    throw std::runtime_error("the model writes to its input: the old state, C or the parameters");
  constexpr std::array names{"energy", "stress", "tangent", "stress_dp", "state"};
  std::vector<double> all;
  for (std::size_t k = 0; k < outputs.size(); ++k) {
    if (!outputs[k].intact())
      throw std::runtime_error(std::string("the model writes beyond the memory of the output '") + names[k] + "'");
    const auto inside = outputs[k].inside();
    all.insert(all.end(), inside.begin(), inside.end());
  }
  return all;
}

}  // namespace tunica::conformance
