// SPDX-License-Identifier: Apache-2.0
// What `composed` costs beside a built-in model of the same energy, through the batch interface that tests call.
// `of_built_in` is time/time of the built-in model in the same run; asked for are 1.3 at most.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "plugins.hpp"

namespace {

using namespace tunica;

/// The same energy twice; `p` are the parameters of each.
struct Pair {
  std::string model, terms;
  std::vector<double> p, own;
};

std::vector<Pair> pairs() {
  const std::string matrix = R"({"name": "m", "invariant": "I1", "law": "linear"})";
  const auto fibres = [](const std::string& dispersion) {
    return R"({"name": "f", "invariant": "fibre", "family": "diagonal", "law": "exponential_square", "dispersion": ")" +
           dispersion + "\"}";
  };
  return {{"neo_hooke", "[" + matrix + "]", {30}, {30}},
          {"yeoh",
           "[" + matrix + R"(, {"name": "q", "invariant": "I1", "law": "quadratic"},
              {"name": "c", "invariant": "I1", "law": "cubic"}])",
           {150, -2, 0.1},
           {300, -4, 0.3}},
          {"gent", R"([{"name": "g", "invariant": "I1", "law": "gent"}])", {300, 80}, {300, 80}},
          {"gho",
           "[" + matrix + ", " + fibres("rotational") + "]",
           {18.668, 0.1367, 24.905, 0.2912, 46.44},
           {18.668, 24.905, 0.2912, 46.44, 0.1367}},
          {"holzapfel_2015",
           "[" + matrix + ", " + fibres("two_planes") + "]",
           {18.668, 0.2, 0.4, 24.905, 0.2912, 46.44},
           {18.668, 24.905, 0.2912, 46.44, 0.2, 0.4}}};
}

enum class Call { axes, axes_with_parameters, tensors };
constexpr std::size_t points = 40;

/// What both models read and write. The same memory for both: where it lies in the cache decides for neither.
struct Memory {
  std::vector<double> c = std::vector<double>(3 * points), C = std::vector<double>(6 * points, 0.02), gradient = c,
                      hessian = C, stress = C, tangent = std::vector<double>(36 * points),
                      dp = std::vector<double>(36 * points);
  Memory() {  // a biaxial path
    for (std::size_t i = 0; i < points; ++i) {
      const double t = 1 + 0.012 * static_cast<double>(i), z = 1 + 0.006 * static_cast<double>(i);
      c[i] = t * t;
      c[points + i] = z * z;
      c[2 * points + i] = 1 / (t * t * z * z);
    }
    std::copy(c.begin(), c.end(), C.begin());
  }
};

/// One call of the interface; the sum of the stresses.
double answer(const Model& model, const std::vector<double>& p, Call call, Memory& at) {
  const auto dp = [&](std::size_t components, bool wanted) {
    return std::span<double>(at.dp.data(), wanted ? components * p.size() * points : 0);
  };
  if (call == Call::tensors)
    static_cast<void>(model.evaluate({points, at.C, p, {}, {}}, {{}, at.stress, at.tangent, dp(6, true), {}}));
  else
    static_cast<void>(model.evaluate_axes(
        {points, at.c, p}, {{}, at.gradient, at.hessian, dp(3, call == Call::axes_with_parameters), {}}));
  double sum = 0;
  for (const double one : call == Call::tensors ? at.stress : at.gradient) sum += one;
  return sum;
}

/// Seconds of one call, the mean of a round.
double round_of(const Model& model, const std::vector<double>& p, Call call, Memory& memory) {
  constexpr int calls = 2000;
  double sum = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) sum += answer(model, p, call, memory);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / calls;
  return std::isfinite(sum) ? seconds : 0;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

int main() {
  fmt::print("{:<16} {:<34} {:>9} {:>12}\n", "built-in", "one call at 40 points", "built-in", "of_built_in");
  for (const Pair& pair : pairs())
    for (const auto& [call, words] : {std::pair{Call::axes, "axes: gradient, Hessian"},
                                      std::pair{Call::axes_with_parameters, "axes, and derivatives by parameters"},
                                      std::pair{Call::tensors, "tensors: stress, tangent, parameters"}}) {
      const auto& entry = bench::catalogue().models().at("composed");
      const auto built_in = bench::make_model(pair.model),
                 composed = plugins::create(entry, bench::options_of(entry.factory.options, {{"terms", pair.terms}}));
      Memory memory;
      const double off =
          std::abs(answer(*composed, pair.own, call, memory) / answer(*built_in, pair.p, call, memory) - 1);
      // Round by round in turn, so that a disturbance meets both.
      std::vector<double> seconds, ratios;
      for (int round = 0; round < 61; ++round) {
        seconds.push_back(round_of(*built_in, pair.p, call, memory));
        ratios.push_back(round_of(*composed, pair.own, call, memory) / seconds.back());
      }
      fmt::print("{:<16} {:<36} {:>6.0f} ns {:>9.2f}   stresses differ by {:.1e}\n", pair.model, words,
                 median(seconds) * 1e9, median(ratios), off);
    }
}
