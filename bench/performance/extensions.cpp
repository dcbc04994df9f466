// SPDX-License-Identifier: Apache-2.0
// What extensions cost beside the same without them: `composed` beside built-in models of the same energies, and
// mechanisms that remember beside the model alone. The bare one stands where others have a floor.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "rows.hpp"
#include "tools.hpp"

namespace tunica::bench {
namespace {

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

enum class Interface { axes, axes_with_parameters, tensors };

/// What both models read and write. The same memory for both: where it lies in the cache decides for neither.
struct Batch {
  static constexpr std::size_t points = 40;
  std::vector<double> c = std::vector<double>(3 * points), C = std::vector<double>(6 * points, 0.02), gradient = c,
                      hessian = C, stress = C, tangent = std::vector<double>(36 * points),
                      dp = std::vector<double>(36 * points);
  Batch() {  // a biaxial path
    for (std::size_t i = 0; i < points; ++i) {
      const double t = 1 + 0.012 * static_cast<double>(i), z = 1 + 0.006 * static_cast<double>(i);
      c[i] = t * t;
      c[points + i] = z * z;
      c[2 * points + i] = 1 / (t * t * z * z);
    }
    std::copy(c.begin(), c.end(), C.begin());
  }
  void ask(const Model& model, const std::vector<double>& p, Interface call) {
    const auto by_parameters = [&](std::size_t components, bool wanted) {
      return std::span<double>(dp.data(), wanted ? components * p.size() * points : 0);
    };
    if (call == Interface::tensors)
      check(model.evaluate({points, C, p, {}, {}}, {{}, stress, tangent, by_parameters(6, true), {}}));
    else
      check(model.evaluate_axes(
          {points, c, p}, {{}, gradient, hessian, by_parameters(3, call == Interface::axes_with_parameters), {}}));
  }
  [[nodiscard]] const std::vector<double>& answer(Interface call) const {
    return call == Interface::tensors ? stress : gradient;
  }
};

Prepared composed(const Pair& pair, Interface call) {
  const auto& entry = catalogue().models().at("composed");
  const std::shared_ptr<Model> built_in = make_model(pair.model);
  const std::shared_ptr<Model> own = plugins::create(entry, options_of(entry.factory.options, {{"terms", pair.terms}}));
  const auto batch = std::make_shared<Batch>();
  Prepared row;
  row.work = {[=] { batch->ask(*own, pair.own, call); }, Batch::points};
  row.floors = {
      {"the built-in model", "", {[=] { batch->ask(*built_in, pair.p, call); }, static_cast<double>(Batch::points)}}};
  row.work.call();
  const std::vector<double> found = batch->answer(call);
  row.floors.front().work.call();
  row.facts = {{"floor_differs", difference(batch->answer(call), found)}};
  return row;
}

using Names = std::vector<std::string>;

/// Loops of VHB 4910 at three rates with a model under mechanisms, at the initial point.
Work loops(const std::string& model, const Names& mechanisms, bool jacobian) {
  auto experiment =
      experiment::read_experiment(TUNICA_SOURCE_DIR "/examples/vhb4910_cause/experiment.json", catalogue());
  experiment.models.front().type = model;
  experiment.models.front().parameters = {};
  experiment.models.front().options = options_of(catalogue().models().at(model).factory.options);
  for (const std::string& type : mechanisms) {
    auto& on = experiment.models.front().mechanisms;
    on.push_back({type,
                  options_of(catalogue().mechanisms().at(type).factory.options),
                  {},
                  fmt::format("{}_{}", type, on.size())});
  }
  struct State {
    assembly::Assembly assembly;
    assembly::WorkspacePointer workspace = assembly.evaluator().make_workspace();
    std::vector<double> at, residuals, J, per_test;
    double value = 0;

    explicit State(const experiment::Experiment& read) : assembly(read, read.runs.front(), catalogue()) {}
  };
  const auto state = std::make_shared<State>(experiment);
  const auto& layout = state->assembly.layout();
  for (const auto& parameter : layout.parameters) state->at.push_back(parameter.initial);
  state->residuals.resize(layout.residual_count);
  if (jacobian) state->J.resize(layout.residual_count * state->at.size());
  state->per_test.resize(layout.test_count);
  return {[state] {
    check(state->assembly.evaluator().evaluate(state->at, state->value, state->per_test, state->residuals, state->J,
                                               *state->workspace));
  }};
}

Prepared memory(const std::string& model, const Names& mechanisms, bool jacobian) {
  Prepared row;
  row.work = loops(model, mechanisms, jacobian);
  row.floors = {{"the model alone", "", loops(model, {}, jacobian)}};
  return row;
}

}  // namespace

std::vector<Row> extension_rows() {
  std::vector<Row> rows;
  for (const Pair& pair : pairs())
    for (const auto& [call, name] :
         {std::pair{Interface::axes, "axes"}, std::pair{Interface::axes_with_parameters, "axes_with_parameters"},
          std::pair{Interface::tensors, "tensors"}})
      rows.push_back({.name = fmt::format("composed/{}/{}", pair.model, name),
                      .what = "`composed` with the energy of " + pair.model,
                      .unit = "point",
                      .by = "",
                      .sizes = {1},
                      .make = [=, call = call](std::size_t) { return composed(pair, call); }});
  for (const Names& mechanisms :
       {Names{"stress_softening"}, Names{"viscoelasticity"}, Names{"viscoelasticity", "viscoelasticity"},
        Names{"stress_softening", "viscoelasticity"}})
    for (const bool jacobian : {false, true})
      rows.push_back(
          {.name = fmt::format("history/gho/{}/{}", fmt::join(mechanisms, "+"), jacobian ? "jacobian" : "residuals"),
           .what = jacobian ? "loops of VHB 4910, residuals and Jacobian" : "loops of VHB 4910, residuals",
           .unit = "evaluation",
           .by = "",
           .sizes = {1},
           .make = [=](std::size_t) { return memory("gho", mechanisms, jacobian); }});
  return rows;
}

}  // namespace tunica::bench
