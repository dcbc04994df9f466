// SPDX-License-Identifier: Apache-2.0
// A pressurised tube by finite elements (gho with set S, clamped, axial stretch 1.2, 35 pressures from 0 to 170 mmHg)
// by mesh: values alone, with all sensitivities of one and of three observables; and the band factor beside the
// operations that it needs and beside a library's.
#include <array>
#include <fstream>
#include <numeric>
#include <sstream>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "energies.hpp"
#include "rows.hpp"
#include "simulation.hpp"
#include "tools.hpp"

namespace tunica::bench {
namespace {

struct Mesh {
  std::size_t order, radial, axial;

  [[nodiscard]] std::string name() const {
    return fmt::format("fe/{}/{}x{}/", order == 1 ? "four_node" : "nine_node", radial, axial);
  }
};
// {2, 8, 20} is what tests take by default.
constexpr std::array<Mesh, 11> meshes{{{1, 10, 40},
                                       {1, 25, 50},
                                       {1, 25, 100},
                                       {1, 50, 200},
                                       {1, 100, 400},
                                       {2, 5, 20},
                                       {2, 8, 20},
                                       {2, 12, 25},
                                       {2, 10, 40},
                                       {2, 25, 100},
                                       {2, 50, 200}}};

/// Model, loads and a simulation that lives on, as in a calibration: parameters walk by ±1 % from run to run.
struct Tube {
  std::unique_ptr<Model> model = make_model("gho");
  std::vector<double> parameters = centre;  ///< set S of Canales et al. (2023)
  std::unique_ptr<fe::Material> material;
  std::vector<fe::Load> loads;
  fe::Simulation simulation;
  std::vector<fe::Sample> samples;
  std::size_t step = 0;

  inline static const std::vector<double> centre{18.668, 0.1367, 24.905, 0.2912, 46.44};

  explicit Tube(const Mesh& mesh)
      : material(std::make_unique<fe::Material>(*model, parameters)),
        simulation({.order = mesh.order,
                    .radial = mesh.radial,
                    .axial = mesh.axial,
                    .inner = 3.71,
                    .outer = 5.77,
                    .length = 14}) {
    for (int k = 0; k < 35; ++k) loads.push_back({1.2, 22.66474 * k / 34});
  }
  void run(const fe::Wanted& wanted, bool walks) {
    ++step;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      parameters[j] = centre[j] * (1 + (walks ? 0.02 * (static_cast<double>((step * (j + 3)) % 97) / 97 - 0.5) : 0));
    material = std::make_unique<fe::Material>(*model, parameters);
    std::size_t failed_at = 0;
    check(simulation.run(*material, loads, wanted, samples, failed_at));
  }
};

/// The outer diameter stretches of the reference, 24 x 50 nine-node elements.
std::vector<double> reference() {
  std::ifstream in(TUNICA_SOURCE_DIR "/examples/cn_pressurisation/s_tube.csv");
  std::vector<double> values;
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && (std::isdigit(static_cast<unsigned char>(line[0])) != 0))
      values.push_back(std::strtod(line.c_str() + line.find(',') + 1, nullptr));
  return values;
}

/// Multiply–adds of the program's own factors and solutions, at the rate of this machine: what is left if elements,
/// iterations that decide nothing and memory cost nothing.
std::vector<Floor> operations(double count, const std::string& what) {
  std::vector<Floor> floors;
  for (const floors::Kernels* const kernels : levels()) {
    const auto to = std::make_shared<std::vector<double>>(128, 1.),
               from = std::make_shared<std::vector<double>>(512, 1e-9);
    // A call does a fixed part of the operations, so that a sample of the floor stays short.
    constexpr std::size_t repeats = 2000;
    floors.push_back({what,
                      kernels->level,
                      {[=] { kernels->multiply_add(to->data(), from->data(), repeats); }, 512. * repeats / count}});
  }
  return floors;
}

/// Mesh and state of a solved tube, as the fused kernel of four-node elements reads them.
struct Elements {
  fe::Mesh mesh;
  fe::State state;
  std::vector<double> force, matrix;
  double gamma;

  explicit Elements(fe::Simulation& simulation)
      : mesh(simulation.solver().mesh()), state(simulation.last()), gamma(simulation.solver().system().gamma) {
    force.resize(2 * mesh.nodes());
    matrix.resize(force.size() * (2 * (mesh.radial + 2) + 2));
  }
  [[nodiscard]] floors::Elements floor(bool tangent) {
    return {mesh.radial,    mesh.axial,     mesh.inner, mesh.outer,   mesh.layer.data(),
            state.x.data(), state.q.data(), gamma,      force.data(), tangent ? matrix.data() : nullptr};
  }
  /// How far force and matrix are from those of the program at the same state, of the largest.
  double deviation(const fe::Material& material, fe::Solver& solver, const floors::Energy& energy) {
    fe::System system;
    system.gamma = gamma;
    check(solver.assembly().assemble(material, state, 0, true, system));
    floors::baseline().elements(energy, floor(true));
    const std::size_t stride = 2 * (mesh.radial + 2) + 2;
    std::vector<double> own, kernel;
    for (std::size_t j = 0; j < force.size(); ++j)
      for (std::size_t i = 0; i < stride && j + i < force.size(); ++i) {
        own.push_back(system.matrix.entry(j + i, j));
        kernel.push_back(matrix[j * stride + i]);
      }
    return std::max(difference(system.force, force), difference(own, kernel));
  }
};

/// Of the factors and solutions that a run took.
double operations_of(const fe::Effort& effort, const fe::FactorCost& cost) {
  return static_cast<double>(effort.factorisations) * cost.operations +
         static_cast<double>(effort.iterations) * 2 * cost.kept;
}

/// The program's own numbers of factors and iterations, by fused elements and multiply–adds at the rate of the machine.
std::vector<Floor> newton(const std::shared_ptr<Elements>& elements, const floors::Energy& energy,
                          const fe::Effort& effort, const fe::FactorCost& cost) {
  std::vector<Floor> floors;
  const auto to = std::make_shared<std::vector<double>>(128, 1.),
             from = std::make_shared<std::vector<double>>(512, 1e-9);
  const auto multiply_adds = static_cast<std::size_t>(operations_of(effort, cost) / 512);
  for (const floors::Kernels* const kernels : levels())
    floors.push_back({"its factors and iterations by fused elements, and multiply-adds", kernels->level, {[=] {
                        for (std::size_t k = 0; k < effort.factorisations; ++k)
                          kernels->elements(energy, elements->floor(true));
                        for (std::size_t k = effort.factorisations; k < effort.iterations; ++k)
                          kernels->elements(energy, elements->floor(false));
                        kernels->multiply_add(to->data(), from->data(), multiply_adds);
                      }}});
  return floors;
}

enum class Start { parameters_before, nothing };

Prepared curve(const Mesh& mesh, const fe::Wanted& wanted, Start start) {
  const auto tube = std::make_shared<Tube>(mesh);
  tube->run(wanted, false);
  Prepared row;
  double off = 0;
  const std::vector<double> expected = reference();
  for (std::size_t k = 0; k < expected.size() && k < tube->samples.size(); ++k)
    off = std::max(off, std::abs(tube->samples[k].value[0] / 5.77 - expected[k]));
  const bool large = tube->simulation.solver().mesh().nodes() > 20000;
  if (start == Start::parameters_before && !large && !bare)  // counts of a run that may use the one before
    for (int k = 0; k < 3; ++k) tube->run(wanted, true);
  const fe::Effort effort = tube->simulation.solver().effort();
  const fe::Stencil& matrix = tube->simulation.solver().system().matrix;
  const fe::FactorCost cost = fe::Factor::cost(tube->simulation.solver().mesh());
  row.facts = {{"unknowns", static_cast<double>(matrix.size())},
               {"half_band", static_cast<double>(matrix.width())},
               {"operations_of_a_factor", cost.operations},
               {"load_points", static_cast<double>(tube->simulation.solutions())},
               {"factors", static_cast<double>(effort.factorisations)},
               {"iterations", static_cast<double>(effort.iterations)},
               {"off_reference", off}};
  if (start == Start::nothing)
    row.work = {[mesh, wanted] { Tube(mesh).run(wanted, false); }};
  else
    row.work = {[tube, wanted] { tube->run(wanted, true); }};
  if (bare) return row;
  if (mesh.order == 1) {
    const floors::Energy energy = *fibre_energy("gho", Tube::centre);
    if (!large) tube->run({}, false);
    const auto elements = std::make_shared<Elements>(tube->simulation);
    row.facts.emplace_back("floor_differs", elements->deviation(*tube->material, tube->simulation.solver(), energy));
    row.floors = newton(elements, energy, effort, cost);
  } else {
    row.floors = operations(operations_of(effort, cost), "multiply-adds of its factors and solutions");
  }
  return row;
}

/// The matrix of the last load, its prescribed rows taken out.
fe::Banded matrix_of(Tube& tube) {
  tube.run({}, false);
  fe::Solver& solver = tube.simulation.solver();
  fe::Banded matrix;
  solver.system().matrix.spread(matrix);
  const fe::Mesh& mesh = solver.mesh();
  const std::size_t end = mesh.planes() - 1;
  const double diagonal = *matrix.column(2 * mesh.node(mesh.across() / 2, end / 2));
  for (std::size_t i = 0; i < mesh.across(); ++i)
    for (const std::size_t held : {2 * mesh.node(i, 0) + 1, 2 * mesh.node(i, end) + 1, 2 * mesh.node(i, end)})
      matrix.fix(held, diagonal);
  return matrix;
}

/// The band factor and one solution. The library's factor is timed as a floor of its own kind: a peer.
Prepared factor(const Mesh& mesh) {
  Tube tube(mesh);
  struct FactorMemory {
    fe::Banded matrix, factor;
    std::vector<double> x;
    Eigen::SparseMatrix<double> sparse;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> library;
  };
  const auto memory = std::make_shared<FactorMemory>();
  memory->matrix = matrix_of(tube);
  const fe::Banded& a = memory->matrix;
  memory->x.resize(a.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < a.size(); ++j)
    for (std::size_t i = 0; i <= a.width() && j + i < a.size(); ++i)
      if (a.column(j)[i] != 0) entries.emplace_back(static_cast<int>(j + i), static_cast<int>(j), a.column(j)[i]);
  memory->sparse.resize(static_cast<int>(a.size()), static_cast<int>(a.size()));
  memory->sparse.setFromTriplets(entries.begin(), entries.end());
  memory->library.analyzePattern(memory->sparse);

  const double n = static_cast<double>(a.size()), w = static_cast<double>(a.width());
  Prepared row;
  row.work = {[memory] {
    memory->factor = memory->matrix;
    static_cast<void>(memory->factor.factorise());
    std::fill(memory->x.begin(), memory->x.end(), 1.);
    memory->factor.solve(memory->x);
  }};
  row.work.call();
  const std::vector<double> own = memory->x;
  row.floors = operations(n * w * w / 2 + 2 * n * w, "multiply-adds of the band factor and a solution");
  row.peers = {{"Eigen SimplicialLDLT (AMD), factor and solution", "", {[memory] {
                  memory->library.factorize(memory->sparse);
                  Eigen::Map<Eigen::VectorXd>(memory->x.data(), static_cast<Eigen::Index>(memory->x.size())) =
                      memory->library.solve(Eigen::VectorXd::Ones(memory->sparse.rows()));
                }}}};
  row.peers.front().work.call();
  row.facts = {{"unknowns", n}, {"half_band", w}, {"peer_differs", difference(own, memory->x)}};
  return row;
}

}  // namespace

std::vector<Row> fe_rows() {
  std::vector<Row> rows;
  for (const Mesh& mesh : meshes) {
    const std::string what =
        fmt::format("{}-node {}x{}, 35 pressures", mesh.order == 1 ? "four" : "nine", mesh.radial, mesh.axial);
    const std::size_t nodes = (mesh.order * mesh.radial + 1) * (mesh.order * mesh.axial + 1);
    const auto add = [&](const char* name, const std::string& words, const fe::Wanted& wanted,
                         Start start = Start::parameters_before) {
      rows.push_back({.name = mesh.name() + name,
                      .what = what + words,
                      .unit = "curve",
                      .by = "nodes",
                      .sizes = {nodes},
                      .make = [=](std::size_t) { return curve(mesh, wanted, start); },
                      .shows_memory = true});
    };
    add("values", "", {});
    add("one_channel", ", all sensitivities of one observable", {true, false, false});
    if (mesh.axial == 50 || mesh.radial == 8)
      add("from_nothing", ", nothing kept from a run before", {}, Start::nothing);
    add("three_channels", ", all sensitivities of three observables", {true, true, true});
  }
  for (const Mesh& mesh : {meshes[1], meshes[6]})
    rows.push_back({.name = mesh.name() + "factor",
                    .what = "band factor and a solution",
                    .unit = "factor",
                    .by = "",
                    .sizes = {1},
                    .make = [=](std::size_t) { return factor(mesh); }});
  return rows;
}

}  // namespace tunica::bench
