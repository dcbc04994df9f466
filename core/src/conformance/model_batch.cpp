// SPDX-License-Identifier: Apache-2.0
#include "conformance/model_batch.hpp"

#include <stdexcept>

#include "conformance/handout.hpp"

namespace tunica::conformance {
Batch Batch::draw(const Model& model, Sampler& sampler, std::size_t n) {
  Batch batch;
  batch.count = n;
  batch.C.resize(6 * n);
  const auto place = [&](std::size_t i, const Tensor& at) {
    for (std::size_t c = 0; c < 6; ++c) batch.C[c * n + i] = at[c];
  };
  Point first = sampler.point(model);
  batch.p = first.p;
  place(0, first.C);
  for (std::size_t i = 1; i < n; ++i) {
    Tensor C = sampler.right_cauchy_green();
    for (int tries = 0; tries < 100 && !evaluate(model, C, batch.p).finite(); ++tries) C = sampler.right_cauchy_green();
    place(i, C);
  }
  const std::size_t history = model.describe().history_size;
  if (history == 0) return batch;
  // An old state as the model itself leaves it, after a first step.
  batch.time_step.assign(n, 0.3);
  const std::vector<double> all = answers(model, batch, {false, false, false, false, true});
  batch.state.assign(all.begin(), all.end());
  for (std::size_t i = 0; i < n; ++i) place(i, sampler.right_cauchy_green());
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
  Handout handout("the model");
  const MaterialPoints points{n, handout.input("C", batch.C), handout.input("parameters", batch.p),
                              handout.input("time_step", batch.time_step), handout.input("state", batch.state)};
  const std::size_t derivatives = description.parameter_derivatives ? 6 * n * batch.p.size() : 0;
  const MaterialResponse response{handout.output("energy", wanted.energy ? n : 0),
                                  handout.output("stress", wanted.stress ? 6 * n : 0),
                                  handout.output("tangent", wanted.tangent ? 36 * n : 0),
                                  handout.output("stress_dp", wanted.stress_dp ? derivatives : 0),
                                  handout.output("state", wanted.state ? description.history_size * n : 0)};
  const Status status = model.evaluate(points, response);
  handout.verify(status.ok());
  if (!status.ok()) throw std::runtime_error("the model answers '" + status.reason() + "'");
  std::vector<double> all;
  for (const auto output : {response.energy, response.stress, response.tangent, response.stress_dp, response.state})
    all.insert(all.end(), output.begin(), output.end());
  return all;
}

}  // namespace tunica::conformance
