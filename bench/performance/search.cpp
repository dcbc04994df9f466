// SPDX-License-Identifier: Apache-2.0
// What searches cost beside the objective: an optimiser's own work an evaluation, the host's work around it, the gain
// of a second thread, and a constraint.
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <tbb/global_control.h>

#include "conformance/functions.hpp"
#include "energies.hpp"
#include "lamb_aorta.hpp"
#include "rows.hpp"
#include "search/calibration_problem.hpp"
#include "strip_memory.hpp"
#include "tools.hpp"

namespace tunica::bench {
namespace {

constexpr std::size_t dimension = 5;

struct Method {
  std::string name, type;
  OptionValues options;
};

/// A whole search on a function that costs next to nothing.
Work search_of(const Method& method) {
  constexpr std::uint64_t evaluations = 12000;
  const std::shared_ptr<Optimizer> optimizer = make_optimizer(method.type, method.options);
  const auto search = [optimizer] {
    conformance::FunctionProblem problem(conformance::sphere(dimension), {.budget = evaluations, .seed = 1});
    static_cast<void>(optimizer->minimise(problem));
    return problem.evaluations();
  };
  return {[search] { static_cast<void>(search()); }, static_cast<double>(search())};
}

Prepared overhead(const Method& method) {
  Prepared row;
  row.work = search_of(method);
  // Normal variates of a point and the function itself.
  const auto sink = std::make_shared<double>(0);
  row.floors = {{"its normal random numbers and the function",
                 "",
                 {[sink, generator = std::mt19937_64(7), normal = std::normal_distribution<double>()]() mutable {
                    for (int k = 0; k < 1000; ++k) {
                      double sum = 0;
                      for (std::size_t j = 0; j < dimension; ++j) {
                        const double y = normal(generator) - 0.1 * static_cast<double>(j);
                        sum += y * y;
                      }
                      *sink += sum;
                    }
                  },
                  1000}}};
  if (catalogue().optimizers().contains("pagmo_cmaes") && !method.type.starts_with("pagmo"))
    row.peers = {{"pagmo's cmaes", "", search_of({"", "pagmo_cmaes", {}})}};
  return row;
}

constexpr std::uint64_t strip_evaluations = 12000;

const assembly::Assembly& strips_by_es() {
  static const assembly::Assembly assembly(lamb_aorta(), run_of("gho", "es"), catalogue());
  return assembly;
}

/// A calibration of two strips by `es` through the host. `points` keeps the evaluated points.
void calibrate(const assembly::Assembly& assembly, std::uint64_t seed, std::size_t threads,
               std::vector<double>* points) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  search::CalibrationProblem::Settings settings;
  settings.stop.max_evaluations = strip_evaluations;
  settings.seed = seed;
  if (points != nullptr)
    settings.record = [points](const search::Record& record) {
      points->insert(points->end(), record.parameters.begin(), record.parameters.end());
    };
  search::CalibrationProblem problem(assembly, std::move(settings));
  static_cast<void>(make_optimizer("es")->minimise(problem));
}

Prepared host() {
  const auto points = std::make_shared<std::vector<double>>();
  calibrate(strips_by_es(), 1, 1, points.get());
  const std::shared_ptr<assembly::Workspace> workspace = strips_by_es().evaluator().make_workspace();
  Prepared row;
  row.work = {[] { calibrate(strips_by_es(), 1, 1, nullptr); }, strip_evaluations};
  row.floors = {{"objective alone at the same points",
                 "",
                 {[points, workspace] {
                    const std::size_t n = strips_by_es().layout().parameters.size();
                    double value = 0;
                    std::array<double, 2> per_test{};
                    for (std::size_t k = 0; k + n <= points->size(); k += n)
                      static_cast<void>(strips_by_es().evaluator().evaluate({points->data() + k, n}, value, per_test,
                                                                            {}, {}, *workspace));
                  },
                  static_cast<double>(points->size()) / static_cast<double>(dimension)}}};
  return row;
}

Prepared two_threads() {
  Prepared row;
  row.work = {[] { calibrate(strips_by_es(), 1, 2, nullptr); }, strip_evaluations};
  row.floors = {
      {"half the time of one thread", "", {[] { calibrate(strips_by_es(), 1, 1, nullptr); }, 2 * strip_evaluations}}};
  return row;
}

/// transverse_stability at every measured stretch. Its floor is the equilibrium of the strips, which it needs at least.
Prepared stability(bool jacobian) {
  static const experiment::Experiment read =
      experiment::read_experiment(TUNICA_SOURCE_DIR "/examples/lamb_aorta_stable/experiment.json", catalogue());
  const auto* run = &read.runs.front();
  for (const auto& one : read.runs)
    if (one.model == "gho" && one.optimizer == "es") run = &one;
  const auto assembly = std::make_shared<assembly::Assembly>(read, *run, catalogue());
  const std::size_t count = assembly->constraints().count(), n = assembly->layout().parameters.size();
  if (count == 0) throw std::runtime_error("examples/lamb_aorta_stable has no constraint");
  std::vector<double> p;
  for (const auto& parameter : assembly->layout().parameters) p.push_back(parameter.initial);
  const auto values = std::make_shared<std::vector<double>>(count),
             J = std::make_shared<std::vector<double>>(jacobian ? count * n : 0);
  Prepared row;
  row.work = {[=, k = 0]() mutable {
    std::vector<double> at = p;
    at[0] *= 1 + 1e-3 * (++k % 7 - 3);
    check(assembly->constraints().evaluate(at, *values, *J));
  }};
  const auto& channels = assembly->layout().channels;
  const auto t = std::make_shared<StripMemory>(channels.at(0)), z = std::make_shared<StripMemory>(channels.at(1));
  for (const floors::Kernels* const kernels : levels())
    row.floors.push_back({"fused kernel of the strips", kernels->level, {[=, k = 0]() mutable {
                            std::vector<double> at = p;
                            at[0] *= 1 + 1e-3 * (++k % 7 - 3);
                            const floors::Energy energy = *fibre_energy("gho", at);
                            kernels->strip(energy, t->strip(false, jacobian, 2));
                            kernels->strip(energy, z->strip(true, jacobian, 2));
                          }}});
  row.facts = {{"values", static_cast<double>(count)}};
  return row;
}

}  // namespace

std::vector<Row> search_rows() {
  std::vector<Row> rows;
  for (const Method& method : std::vector<Method>{{"es", "es", {}},
                                                  {"cma_es", "cma_es", {}},
                                                  {"nlopt_crs2_lm", "nlopt", {{"algorithm", std::string("crs2_lm")}}}})
    rows.push_back({.name = "optimizer/" + method.name,
                    .what = "a search on a sphere of 5 parameters",
                    .unit = "evaluation",
                    .by = "",
                    .sizes = {1},
                    .make = [method](std::size_t) { return overhead(method); }});
  rows.push_back({.name = "search/es/one_thread",
                  .what = "calibration of two strips through the host",
                  .unit = "evaluation",
                  .by = "",
                  .sizes = {1},
                  .make = [](std::size_t) { return host(); }});
  rows.push_back({.name = "search/es/two_threads",
                  .what = "the same on two threads",
                  .unit = "evaluation",
                  .by = "",
                  .sizes = {1},
                  .make = [](std::size_t) { return two_threads(); },
                  .clock = Clock::wall});
  for (const bool jacobian : {false, true})
    rows.push_back({.name = std::string("constraint/transverse_stability/") + (jacobian ? "jacobian" : "values"),
                    .what = jacobian ? "values and Jacobian" : "values",
                    .unit = "call",
                    .by = "",
                    .sizes = {1},
                    .make = [=](std::size_t) { return stability(jacobian); }});
  return rows;
}

}  // namespace tunica::bench
