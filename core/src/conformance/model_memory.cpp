// SPDX-License-Identifier: Apache-2.0
// The effects of a model on the memory of its caller.
#include <array>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

#include "conformance/axes_answers.hpp"
#include "conformance/handout.hpp"
#include "conformance/model_batch.hpp"
#include "conformance/model_properties.hpp"

namespace tunica::conformance {
namespace {

/// Every set of five outputs.
constexpr unsigned selections = 32;
constexpr std::array<std::size_t, 5> batch_sizes{1, 2, 7, 64, 131};
bool has(unsigned selection, unsigned output) { return (selection >> output & 1U) != 0; }

void tensors(const Model& model, Sampler& sampler, std::size_t count) {
  Batch batch = Batch::draw(model, sampler, count);
  const auto ask_for_all = [&] {
    for (unsigned k = 0; k < selections; ++k)
      static_cast<void>(answers(model, batch, {has(k, 0), has(k, 1), has(k, 2), has(k, 3), has(k, 4)}));
  };
  ask_for_all();
  if (batch.state.empty()) {
    batch.time_step.assign(count, 0.3);  // a clock, though nothing is remembered
    return ask_for_all();
  }
  for (const bool timed : {true, false})
    for (const bool begun : {true, false}) {
      Batch step = batch;
      if (!timed) step.time_step.clear();
      if (!begun) step.state.clear();
      std::swap(step, batch);
      ask_for_all();
      std::swap(step, batch);
    }
}

void axes(const Model& model, Sampler& sampler, std::size_t count) {
  const Point first = sampler.diagonal_point(model);
  std::vector<double> c(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    const Tensor C = i == 0 ? first.C : sampler.right_cauchy_green();
    for (std::size_t a = 0; a < 3; ++a) c[a * count + i] = C[a];
  }
  for (unsigned k = 0; k < selections; ++k) {
    if (has(k, 4) && !has(k, 3)) continue;  // energy_dp comes with gradient_dp only
    static_cast<void>(axes_answers(model, c, first.p, {has(k, 0), has(k, 1), has(k, 2), has(k, 3), has(k, 4)}));
  }
}

void respond(const EnergyPart& part, std::span<const double> p, std::size_t count) {
  const auto& description = part.describe();
  const std::size_t derivatives = count * description.response_parameters.size();
  const std::vector<double> x(count, 0.1);
  for (unsigned k = 0; k < selections; ++k) {
    Handout handout(fmt::format("respond() of the part '{}'", description.name));
    ResponseBatch batch;
    batch.x = handout.input("x", x);
    batch.value = handout.output("value", has(k, 0) ? count : 0);
    batch.first = handout.output("first", has(k, 1) ? count : 0);
    batch.second = handout.output("second", has(k, 2) && !description.linear ? count : 0);
    batch.value_dp = handout.output("value_dp", has(k, 3) ? derivatives : 0);
    batch.first_dp = handout.output("first_dp", has(k, 4) ? derivatives : 0);
    part.respond(handout.input("parameters", p), batch);
    handout.verify();
  }
}

void invariant(const EnergyPart& part, std::span<const double> p) {
  constexpr std::size_t numbers = sizeof(Invariant) / sizeof(double);
  constexpr std::size_t fence = 4;
  using Words = std::array<std::uint64_t, numbers>;
  const auto& description = part.describe();
  const std::size_t count = description.invariant_parameters.size();
  const Invariant post{
      .i1 = -7e77, .i2 = -7e77, .fibre = -7e77, .normal = -7e77, .across = -7e77, .offset = -7e77, .angle = -7e77};
  std::vector<Invariant> memory(count + 2 * fence, post);
  Invariant value;
  part.invariant(p, value, std::span(memory).subspan(fence, count));
  for (std::size_t k = 0; k < memory.size(); ++k)
    if ((k < fence || k >= fence + count) && std::bit_cast<Words>(memory[k]) != std::bit_cast<Words>(post))
      throw MemoryFault(fmt::format("invariant() of the part '{}' writes {} its 'derivatives', which are {}",
                                    description.name, k < fence ? "before the beginning of" : "past the end of",
                                    count));
}

}  // namespace

Verdict writes_its_outputs_and_nothing_else(const Model& model, std::uint64_t seed) {
  const std::string compared = "the memory around and in each output, in every combination, with that before the call";
  Sampler sampler(seed);
  try {
    for (const std::size_t count : batch_sizes) {
      tensors(model, sampler, count);
      if (model.describe().principal_axes) axes(model, sampler, count);
    }
    const std::vector<double> p = sampler.parameters(model.describe());
    for (const auto& part : model.parts()) {
      for (const std::size_t count : batch_sizes) respond(*part, p, count);
      invariant(*part, p);
    }
  } catch (const MemoryFault& fault) {
    return broken(compared, fault.what());
  }
  return {.compared = compared};
}

}  // namespace tunica::conformance
