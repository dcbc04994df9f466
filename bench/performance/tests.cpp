// SPDX-License-Identifier: Apache-2.0
// Objectives of single tests through the host, as a search calls them: two strips, a sheet, a long tube. Parameters
// walk around an optimum, so that every evaluation meets others; the floor walks the same way.
#include <array>
#include <fstream>
#include <map>
#include <numeric>

#include <boost/math/special_functions/legendre.hpp>
#include <fmt/format.h>

#include "assembly/assembly.hpp"
#include "energies.hpp"
#include "experiment/experiment.hpp"
#include "rows.hpp"
#include "strip_memory.hpp"
#include "tools.hpp"

namespace tunica::bench {
namespace {

struct Box {
  double centre, width;
};
/// The optimum of examples/lamb_aorta and the width of its box.
const std::map<std::string, Box> aorta{{"mu", {22.386, 100}}, {"kappa", {0.20334, 1. / 3}}, {"A", {0.2, 1. / 3}},
                                       {"B", {0.397, 1}},     {"k1", {15.097, 100}},        {"k2", {0.036, 3}},
                                       {"theta", {57.17, 90}}};
/// Set S of Canales et al. (2023); the width is the value itself.
const std::map<std::string, Box> set_s{{"mu", {18.668, 18.668}},
                                       {"kappa", {0.1367, 0.1367}},
                                       {"k1", {24.905, 24.905}},
                                       {"k2", {0.2912, 0.2912}},
                                       {"theta", {46.44, 46.44}}};

/// Points within ±5 % of the widths, each parameter in steps of its own.
struct Walk {
  static constexpr std::size_t steps = 97;
  std::vector<std::vector<double>> points;
  std::size_t at = 0;

  Walk(const std::map<std::string, Box>& around, const std::vector<std::string>& names) {
    for (std::size_t k = 0; k < steps; ++k) {
      points.emplace_back();
      for (std::size_t j = 0; j < names.size(); ++j) {
        const Box box = around.at(names[j]);
        const double offset = 0.1 * static_cast<double>((k * (j + 3)) % steps) / steps - 0.05;
        points.back().push_back(std::max(1e-3 * box.width, box.centre + offset * box.width));
      }
    }
  }
  const std::vector<double>& next() { return points[at = (at + 1) % steps]; }
};

/// The model as the experiment file has it, and the order of its parameters.
struct Material {
  std::string type, json;
  std::vector<std::string> names;
};
Material material(const std::string& type) {
  if (type == "holzapfel_2015") return {type, R"({"type": "holzapfel_2015"})", {"mu", "A", "B", "k1", "k2", "theta"}};
  if (type == "composed")
    return {type,
            R"({"type": "composed", "terms": [{"name": "m", "invariant": "I1", "law": "linear"},
                {"name": "f", "invariant": "fibre", "family": "diagonal", "law": "exponential_square",
                 "dispersion": "rotational"}]})",
            {"mu", "k1", "k2", "theta", "kappa"}};
  return {type, fmt::format(R"({{"type": "{}"}})", type), {"mu", "kappa", "k1", "k2", "theta"}};
}

/// A run over tests that are given as JSON, from a file in the scratch folder.
struct Problem {
  experiment::Experiment experiment;
  assembly::Assembly assembly;
  assembly::WorkspacePointer workspace;
  std::vector<double> per_test, residuals, jacobian;
  double objective = 0;
  std::uint64_t failures = 0;

  Problem(const std::string& model, const std::string& tests)
      : experiment(read(model, tests)),
        assembly(experiment, experiment.runs.front(), catalogue()),
        workspace(assembly.evaluator().make_workspace()),
        per_test(assembly.layout().test_count) {}

  void want_jacobian() {
    residuals.resize(assembly.layout().residual_count);
    jacobian.resize(residuals.size() * assembly.layout().parameters.size());
  }
  void evaluate(const std::vector<double>& p) {
    failures += assembly.evaluator().evaluate(p, objective, per_test, residuals, jacobian, *workspace).ok() ? 0u : 1u;
  }
  /// All predictions and their Jacobian, parameter j of row i at [j·rows + i].
  void predict(const std::vector<double>& p, std::vector<double>& values, std::vector<double>& derivatives) {
    const std::size_t rows = assembly.layout().prediction_count, n = p.size();
    std::vector<double> by_row(rows * n);
    values.resize(rows);
    derivatives.resize(rows * n);
    check(assembly.evaluator().predict(p, values, by_row, *workspace));
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < n; ++j) derivatives[j * rows + i] = by_row[i * n + j];
  }

 private:
  static experiment::Experiment read(const std::string& model, const std::string& tests) {
    const std::filesystem::path file = scratch() / "experiment.json";
    std::ofstream(file) << fmt::format(
        R"({{"format": 1, "name": "benchmark", "models": {{"m": {}}}, "tests": {}, "objective": "sum_of_norms",
           "optimizers": {{"lm": {{"type": "ceres_lm"}}}}, "runs": [{{"model": "m", "optimizer": "lm"}}]}})",
        model, tests);
    return experiment::read_experiment(file, catalogue());
  }
};

/// The work of a row, and its floors: `floor` takes the kernels and the energy of a point of the walk.
template <class FloorCall>
Prepared prepared(const std::shared_ptr<Problem>& problem, const Material& material,
                  const std::map<std::string, Box>& around, const FloorCall& floor) {
  Prepared row;
  row.work = {[problem, walk = Walk(around, material.names)]() mutable { problem->evaluate(walk.next()); }};
  const bool shared_by_floor = material.type != "holzapfel_2015";
  const Material known = bench::material(shared_by_floor ? "gho" : material.type);
  const Walk walk(around, known.names);
  std::vector<floors::Energy> energies;
  for (const auto& p : walk.points) energies.push_back(*fibre_energy(known.type, p));
  for (const floors::Kernels* const kernels : levels())
    row.floors.push_back({"fused kernel", kernels->level, {[=, k = std::size_t{0}]() mutable {
                            floor(*kernels, energies[k = (k + 1) % energies.size()]);
                          }}});
  return row;
}

using Facts = std::vector<std::pair<std::string, double>>;

/// How far the floor is from the predictions and the Jacobian of the program over the walk, of the largest value.
template <class FloorCall>
std::pair<double, double> deviation(Problem& problem, const Material& known, const std::map<std::string, Box>& around,
                                    std::size_t rows, const FloorCall& floor) {
  const Walk walk(around, known.names);
  std::pair<double, double> off{0, 0};
  std::vector<double> values, derivatives;
  const std::size_t shapes = known.names.size() - 3;
  for (std::size_t k = 0; k < 2 * walk.points.size(); ++k) {
    const auto& p = walk.points[k % walk.points.size()];
    const auto [floor_values, floor_jacobian] = floor(*fibre_energy(known.type, p));
    if (k < walk.points.size()) continue;  // the first round warms up
    problem.predict(p, values, derivatives);
    off.first = std::max(off.first, difference(values, floor_values));
    for (std::size_t j = 0; j < p.size(); ++j) {  // of the model, in the order mu, shapes but theta, k1, k2, theta
      const std::size_t of = j == 0 ? 0 : j < shapes ? 2 + j : j == shapes + 2 ? 2 + shapes : j - shapes + 1;
      off.second = std::max(off.second, difference(std::span(derivatives).subspan(j * rows, rows),
                                                   std::span(floor_jacobian).subspan(of * rows, rows)));
    }
  }
  return off;
}

/// As few Newton steps as give the floor the answers of the program to 1e-6, and its Jacobian to 1e-5: what makes it a
/// floor.
template <class FloorCall>
int steps_for(bool jacobian, Problem& problem, const Material& material, const std::map<std::string, Box>& around,
              std::size_t rows, const FloorCall& floor, Facts& facts) {
  if (material.type != "gho" && material.type != "holzapfel_2015") return jacobian ? 3 : 2;  // as gho
  for (int steps = 2;; ++steps) {
    const auto off =
        deviation(problem, material, around, rows, [&](const floors::Energy& w) { return floor(w, steps); });
    if (steps < 4 && (off.first > 1e-6 || (jacobian && off.second > 1e-5))) continue;
    facts.emplace_back("floor_newton_steps", steps);
    facts.emplace_back("floor_differs", off.first);
    if (jacobian) facts.emplace_back("floor_jacobian_differs", off.second);
    return steps;
  }
}

Prepared strips(const std::string& type, bool jacobian, std::size_t points) {
  const Material m = material(type);
  const auto test = [&](const char* name, const char* axis) {
    return fmt::format(
        R"("{0}": {{"type": "uniaxial", "direction": "{0}", "data": {{"file": "{1}/examples/lamb_aorta/{2}.csv",
      "columns": {{"stretch": "stretch", "stress": "stress"}}, "stress_measure": "cauchy", "rows": "0:240:{3}"}}}})",
        name, TUNICA_SOURCE_DIR, axis, 240 / points);
  };
  const auto problem = std::make_shared<Problem>(
      m.json, fmt::format("{{{}, {}}}", test("circumferential", "circumferential"), test("axial", "axial")));
  if (jacobian) problem->want_jacobian();
  const auto& channels = problem->assembly.layout().channels;
  Facts facts;
  const auto t = std::make_shared<StripMemory>(channels[0]), z = std::make_shared<StripMemory>(channels[1]);
  const int steps = steps_for(
      jacobian, *problem, m, aorta, 2 * points,
      [&](const floors::Energy& w, int by) {
        std::pair<std::vector<double>, std::vector<double>> found;
        floors::baseline().strip(w, t->strip(false, true, by));
        floors::baseline().strip(w, z->strip(true, true, by));
        for (const auto* s : {t.get(), z.get()})
          for (std::size_t i = 0; i < points; ++i) found.first.push_back(s->residual[i] + s->measured[i]);
        for (std::size_t j = 0; j < m.names.size(); ++j)
          for (const auto* s : {t.get(), z.get()})
            for (std::size_t i = 0; i < points; ++i) found.second.push_back(s->jacobian[j * points + i]);
        return found;
      },
      facts);
  Prepared row = prepared(problem, m, aorta, [=](const floors::Kernels& kernels, const floors::Energy& w) {
    kernels.strip(w, t->strip(false, jacobian, steps));
    kernels.strip(w, z->strip(true, jacobian, steps));
  });
  row.facts = facts;
  return row;
}

Prepared sheet(bool jacobian, std::size_t points) {
  const Material m = material("gho");
  const std::filesystem::path file = scratch() / fmt::format("sheet_{}.csv", points);
  const auto c = std::make_shared<std::vector<double>>(2 * points),
             measured = std::make_shared<std::vector<double>>(2 * points);
  {
    std::ofstream out(file);
    out << "stretch_t,stretch_z,stress_t [kPa],stress_z [kPa]\n";
    for (std::size_t i = 0; i < points; ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(points), t = 1 + 0.4 * share,
                   z = 1 + 0.3 * share;
      out << fmt::format("{},{},{},{}\n", t, z, 100 * share, 80 * share);
      (*c)[i] = t * t;
      (*c)[points + i] = z * z;
      (*measured)[i] = 100 * share;
      (*measured)[points + i] = 80 * share;
    }
  }
  const auto problem =
      std::make_shared<Problem>(m.json, fmt::format(R"({{"sheet": {{"type": "biaxial", "data": {{"file": "{}",
      "columns": {{"stretch_circumferential": "stretch_t", "stretch_axial": "stretch_z", "stress_circumferential": "stress_t",
      "stress_axial": "stress_z"}}, "stress_measure": "cauchy"}}}}}})",
                                                    file.string()));
  if (jacobian) problem->want_jacobian();
  const auto residual = std::make_shared<std::vector<double>>(2 * points),
             J = std::make_shared<std::vector<double>>(10 * points);
  const auto at = [=](bool wants) {
    return floors::Sheet{points, c->data(), measured->data(), wants ? residual->data() : nullptr,
                         wants ? J->data() : nullptr};
  };
  Prepared row = prepared(problem, m, aorta, [=](const floors::Kernels& kernels, const floors::Energy& w) {
    kernels.sheet(w, at(jacobian));
  });
  const auto off = deviation(*problem, m, aorta, 2 * points, [&](const floors::Energy& w) {
    floors::baseline().sheet(w, at(true));
    std::pair<std::vector<double>, std::vector<double>> found{*residual, *J};
    for (std::size_t i = 0; i < 2 * points; ++i) found.first[i] += (*measured)[i];
    return found;
  });
  row.facts = {{"floor_differs", off.first}};
  if (jacobian) row.facts.emplace_back("floor_jacobian_differs", off.second);
  return row;
}

constexpr double inner = 3.71, outer = 5.77, stretch = 1.2, highest = 22.66474;  // mm, 1, kPa

Prepared tube(bool jacobian, std::size_t pressures) {
  constexpr int sections = 6;
  const Material m = material("gho");
  const std::filesystem::path file = scratch() / fmt::format("tube_{}.csv", pressures);
  struct TubeMemory {
    std::vector<double> node, weight, pressure, measured, y, residual, jacobian;
  };
  const auto memory = std::make_shared<TubeMemory>();
  {
    std::ofstream out(file);
    out << "pressure [kPa],outer\n";
    for (std::size_t i = 0; i < pressures; ++i) {
      const double share = static_cast<double>(i) / static_cast<double>(pressures - 1), opened = 0.9 + 0.45 * share;
      out << fmt::format("{},{}\n", highest * share, opened);
      memory->pressure.push_back(highest * share);
      memory->measured.push_back(opened);
    }
  }
  const auto add = [&](double x, double weight) {
    memory->node.push_back(std::pow(inner * std::pow(outer / inner, 0.5 * (1 + x)), 2));
    memory->weight.push_back(weight);
  };
  for (const double x : boost::math::legendre_p_zeros<double>(sections)) {
    const double slope = boost::math::legendre_p_prime(sections, x), weight = 1 / ((1 - x * x) * slope * slope);
    add(x, weight);
    if (x != 0) add(-x, weight);
  }
  memory->y.assign(pressures, std::log(inner));
  memory->residual.resize(pressures);
  memory->jacobian.resize(5 * pressures);
  const auto problem = std::make_shared<Problem>(m.json, fmt::format(R"({{"tube": {{"type": "thick_wall_pressurisation",
      "inner_radius": "{} mm", "thickness": "{} mm", "axial_stretch": {}, "data": {{"file": "{}",
      "columns": {{"pressure": "pressure", "outer_diameter_stretch": "outer"}}}}}}}})",
                                                                     inner, outer - inner, stretch, file.string()));
  if (jacobian) problem->want_jacobian();
  const auto at = [=](bool wants, int steps) {
    return floors::Tube{pressures,
                        memory->node.size(),
                        steps,
                        memory->node.data(),
                        memory->weight.data(),
                        inner,
                        outer,
                        stretch * stretch,
                        memory->pressure.data(),
                        memory->measured.data(),
                        memory->y.data(),
                        wants ? memory->residual.data() : nullptr,
                        wants ? memory->jacobian.data() : nullptr};
  };
  const floors::Energy centre = *fibre_energy("gho", Walk(set_s, m.names).points[48]);
  for (int k = 0; k < 20; ++k) floors::baseline().tube(centre, at(false, 2));
  Facts facts;
  const int steps = steps_for(
      jacobian, *problem, m, set_s, pressures,
      [&](const floors::Energy& w, int by) {
        floors::baseline().tube(w, at(true, by));
        std::pair<std::vector<double>, std::vector<double>> found{memory->residual, memory->jacobian};
        for (std::size_t i = 0; i < pressures; ++i) found.first[i] += memory->measured[i];
        return found;
      },
      facts);
  Prepared row = prepared(problem, m, set_s, [=](const floors::Kernels& kernels, const floors::Energy& w) {
    kernels.tube(w, at(jacobian, steps));
  });
  row.facts = facts;
  return row;
}

}  // namespace

std::vector<Row> test_rows() {
  std::vector<Row> rows;
  for (const bool jacobian : {false, true}) {
    const std::string name = jacobian ? "jacobian" : "objective",
                      what = jacobian ? "objective and exact Jacobian" : "objective";
    for (const std::string type : {"gho", "holzapfel_2015", "composed", "gho_parts", "gho_joint"})
      rows.push_back({"strip/" + type + "/" + name,
                      "two strips, " + what,
                      "evaluation",
                      "points a strip",
                      {40, 10, 120, 240},
                      [=](std::size_t n) { return strips(type, jacobian, n); }});
    rows.push_back(
        {"sheet/gho/" + name, "biaxial sheet, " + what, "evaluation", "points", {40, 10, 160, 640}, [=](std::size_t n) {
           return sheet(jacobian, n);
         }});
    rows.push_back(
        {"tube/gho/" + name, "long tube, " + what, "evaluation", "pressures", {35, 9, 140, 560}, [=](std::size_t n) {
           return tube(jacobian, n);
         }});
  }
  return rows;
}

}  // namespace tunica::bench
