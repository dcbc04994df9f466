// SPDX-License-Identifier: Apache-2.0
// Time of a pressurised tube by finite elements, on one core: the whole curve of 35 pressures (set S, clamped, 0 to
// 170 mmHg) by values alone and with every sensitivity; one Newton iteration by its parts, the factorisation beside
// the floor that its operations set; and our band factor beside a library's on the same matrix.
//
// Peers on this kind of machine: general finite-element programs 9.9 s (nearly incompressible) and 22.8 s
// (incompressible), CalculiX 35 s. Floors: throw-away prototypes with the baseline instruction set, 32 ms (25×50
// four-node), 66 ms (25×100), 63 ms (12×25 nine-node).
#include <algorithm>
#include <ctime>
#include <functional>
#include <vector>

#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "plugins.hpp"
#include "simulation.hpp"

namespace tunica::bench {
namespace {

using fe::Tube;

struct Time {
  double median = 0, least = 0;  ///< s
};

/// Of this thread, so that others on the machine count as little as they can.
double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Time measure(std::size_t runs, const std::function<void()>& work) {
  std::vector<double> seconds;
  work();  // memory and caches
  for (std::size_t k = 0; k < runs; ++k) {
    const double begin = cpu_seconds();
    work();
    seconds.push_back(cpu_seconds() - begin);
  }
  std::ranges::sort(seconds);
  return {seconds[runs / 2], seconds.front()};
}

std::string ms(const Time& time) { return fmt::format("{:8.2f} ({:.2f})", 1e3 * time.median, 1e3 * time.least); }

/// Multiply–adds a second of one core in loops as those of the factor: four columns into one, all in the first cache.
double peak() {
  constexpr std::size_t n = 128, repeats = 20000;
  std::vector<double> to(n, 1), from(4 * n, 1e-9);
  const Time time = measure(15, [&] {
    double* __restrict__ const a = to.data();
    const double* __restrict__ const b = from.data();
    for (std::size_t k = 0; k < repeats; ++k) {
      const double w = 1e-9 * static_cast<double>(k);
      for (std::size_t i = 0; i < n; ++i) a[i] -= (w * b[i] + w * b[n + i]) + (w * b[2 * n + i] + w * b[3 * n + i]);
    }
  });
  return 4. * n * repeats / time.least;
}

/// Set S of Canales et al. 2023: mu, kappa, k1, k2, theta.
const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};

/// A model and the loads of the curve.
struct Problem {
  std::unique_ptr<Model> model;
  std::vector<double> parameters = set_s;
  fe::Material material{*model, parameters};
  std::vector<fe::Load> loads;

  explicit Problem(std::unique_ptr<Model> made) : model(std::move(made)) {
    for (int k = 0; k < 35; ++k) loads.push_back({1.2, 22.66474 * k / 34});
  }
};

Tube tube(std::size_t order, std::size_t radial, std::size_t axial) {
  return {.order = order, .radial = radial, .axial = axial, .inner = 3.71, .outer = 5.77, .length = 14};
}

void check(const Status& status) {
  if (!status.ok()) throw std::runtime_error(status.reason());
}

void curve(const Problem& problem, const Tube& is, double floor_ms) {
  fe::Simulation simulation(is);
  std::vector<fe::Sample> samples, fine;
  std::size_t failed_at = 0;
  const auto run = [&](const fe::Wanted& derivatives) {
    check(simulation.run(problem.material, problem.loads, derivatives, samples, failed_at));
  };
  const Time values = measure(21, [&] { run({}); });
  const fe::Effort effort = simulation.solver().effort();
  const std::size_t solutions = simulation.solutions();
  // Its own fine-step result: every row solved alone.
  double off = 0, off_force = 0, largest = 0;
  run({});
  const std::vector<fe::Sample> coarse = samples;
  for (std::size_t k = 0; k < problem.loads.size(); ++k) {
    check(simulation.run(problem.material, {&problem.loads[k], 1}, {}, fine, failed_at));
    off = std::max(off, std::abs(fine[0].value[0] - coarse[k].value[0]) / is.outer);
    off_force = std::max(off_force, std::abs(fine[0].value[2] - coarse[k].value[2]));
    largest = std::max(largest, std::abs(fine[0].value[2]));
  }
  const Time all = measure(21, [&] { run({true, true, true}); });
  const Time sensitivities = measure(21, [&] { run({true}); });
  fmt::print(
      "{}-node {}x{:<4} {}  {} +{:.0f} % (+{:.0f} %)  {} +{:.0f} %   {} points, {} factors, {} iterations; off {:.0e} "
      "in D/D0, "
      "{:.0e} in force; {:.2f} of the prototype\n",
      is.order == 1 ? "four" : "nine", is.radial, is.axial, ms(values), ms(sensitivities),
      100 * (sensitivities.median / values.median - 1), 100 * (sensitivities.least / values.least - 1), ms(all),
      100 * (all.least / values.least - 1), solutions, effort.factorisations, effort.iterations, off,
      off_force / largest, 1e3 * values.least / floor_ms);
}

/// One Newton iteration at 120 mmHg, by its parts.
void iteration(const Problem& problem, const Tube& is, double multiply_adds) {
  fe::Simulation simulation(is);
  fe::Solver& solver = simulation.solver();
  std::vector<fe::Sample> samples;
  std::size_t failed_at = 0;
  const fe::Load load{1.2, 16};
  check(simulation.run(problem.material, {&load, 1}, {}, samples, failed_at));
  fe::State state = solver.rest();
  fe::Path path(solver, {});
  check(solver.begin(problem.material));
  check(path.begin());
  check(path.go(load, true));
  state = path.state();

  fe::Assembly& assembly = solver.assembly();
  fe::System system;
  system.gamma = solver.system().gamma;
  const Time tangent =
      measure(101, [&] { check(assembly.assemble(problem.material, state, load.pressure, true, system)); });
  const Time residual =
      measure(101, [&] { check(assembly.assemble(problem.material, state, load.pressure, false, system)); });
  fe::Sensitivity sensitivity(solver);
  sensitivity.begin(problem.material, {true, true, true});
  fe::Sample sample;
  const Time derivatives = measure(101, [&] { check(sensitivity.sample(path, sample)); });
  fe::Banded matrix = system.matrix;
  const fe::Mesh& mesh = solver.mesh();
  const std::size_t end = mesh.planes() - 1;
  const double diagonal = *matrix.column(2 * mesh.node(mesh.across() / 2, end / 2));
  for (std::size_t i = 0; i < mesh.across(); ++i) {
    matrix.fix(2 * mesh.node(i, 0) + 1, diagonal);
    matrix.fix(2 * mesh.node(i, end) + 1, diagonal);
    matrix.fix(2 * mesh.node(i, end), diagonal);
  }
  fe::Banded factor;
  std::vector<double> x(matrix.size());
  const Time copy = measure(101, [&] { factor = matrix; });
  const Time copied = measure(101, [&] { factor = matrix, static_cast<void>(factor.factorise()); });
  const Time factorise{copied.median - copy.median, copied.least - copy.least};
  const Time solution = measure(101, [&] {
    std::ranges::fill(x, 1.);
    factor.solve(x);
  });
  const double n = static_cast<double>(matrix.size()), w = static_cast<double>(matrix.width());
  const double floor_factor = n * w * w / 2 / multiply_adds, floor_solution = 2 * n * w / multiply_adds;
  fmt::print("{}-node {}x{}: {} unknowns, half band {}\n", is.order == 1 ? "four" : "nine", is.radial, is.axial,
             matrix.size(), matrix.width());
  fmt::print("  assembly with tangent {}, residual alone {} ms\n", ms(tangent), ms(residual));
  fmt::print("  factorisation         {} ms, {:.2f} of the floor of {:.3f} ms; copy of the matrix {}\n", ms(factorise),
             factorise.least / floor_factor, 1e3 * floor_factor, ms(copy));
  fmt::print("  solution              {} ms, {:.2f} of the floor of {:.3f} ms\n", ms(solution),
             solution.least / floor_solution, 1e3 * floor_solution);

  fmt::print("  all sensitivities of one load, at its factor {} ms\n", ms(derivatives));

  // The same matrix in a library: numeric factorisation only, the pattern analysed before.
  Eigen::SparseMatrix<double> sparse(static_cast<int>(matrix.size()), static_cast<int>(matrix.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < matrix.size(); ++j)
    for (std::size_t i = 0; i <= matrix.width() && j + i < matrix.size(); ++i)
      if (matrix.column(j)[i] != 0)
        entries.emplace_back(static_cast<int>(j + i), static_cast<int>(j), matrix.column(j)[i]);
  sparse.setFromTriplets(entries.begin(), entries.end());
  const auto peer = [&](const char* name, auto library) {
    library.analyzePattern(sparse);
    const Time time = measure(21, [&] { library.factorize(sparse); });
    Eigen::VectorXd b = Eigen::VectorXd::Ones(sparse.rows());
    const Time solve = measure(21, [&] { b = library.solve(Eigen::VectorXd::Ones(sparse.rows())); });
    std::ranges::fill(x, 1.);
    factor.solve(x);
    double off = 0;
    for (std::size_t i = 0; i < x.size(); ++i) off = std::max(off, std::abs(x[i] - b[static_cast<Eigen::Index>(i)]));
    fmt::print("  Eigen {:<20} {} ms, {:.1f} times ours; solution {}; difference {:.0e} of the solution\n", name,
               ms(time), time.least / factorise.least, ms(solve), off / b.cwiseAbs().maxCoeff());
  };
  peer("SimplicialLDLT natural",
       Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>());
  peer("SimplicialLDLT AMD",
       Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>());
}

void report() {
  const Problem problem(make_model("gho"));
  const double multiply_adds = peak();
  fmt::print(
      "one core, processor time; medians of repeated runs, the least in brackets; {:.2f} G multiply-adds/s in a "
      "loop\n\n",
      multiply_adds * 1e-9);
  fmt::print(
      "35 pressures, ms       values        with sensitivities of the outer diameter    of all three observables\n");
  curve(problem, tube(1, 25, 50), 32);
  curve(problem, tube(1, 25, 100), 66);
  curve(problem, tube(2, 12, 25), 63);
  fmt::print("\none Newton iteration, ms\n");
  iteration(problem, tube(1, 25, 50), multiply_adds);
  iteration(problem, tube(2, 12, 25), multiply_adds);
}

}  // namespace
}  // namespace tunica::bench

int main() { tunica::bench::report(); }
