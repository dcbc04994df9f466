// SPDX-License-Identifier: Apache-2.0
#include "memory_path.hpp"

#include <algorithm>
#include <cmath>

#include "maxwell_pass.hpp"
#include "tunica/detail/axis_path.hpp"
#include "tunica/detail/solve_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

constexpr int iterations = 40;
// Newton's step in y = ln u. Its error is the square of the step before, so that behind a step of `near` the
// derivatives by parameters can be taken at once; they are taken again where a kink between left more than `settled`.
constexpr double near = 1e-5, settled = 1e-9;

/// Scratch of one thread.
struct Memory {
  free_strip::Scratch elastic;
  detail::AxisPath path;
  std::vector<MaxwellModel::Branch> branches;
  std::vector<double> y,   ///< ln λ2² of the elastic strip
      u,                   ///< λ2², one a row
      step, before,        ///< of Newton in y, and the one before
      stress, by_unknown,  ///< σ11 with the step in it; what directions do to y
      stress_dp, y_dp;     ///< derivatives by model parameters, of row i at [j·n + i]
};
Memory& thread_memory() {
  thread_local Memory instance;
  return instance;
}

/// One pass along the path at u, row by row. Without parameters: Newton's step of every row, that of the rows before it
/// included. With them: total derivatives of σ11 and y.
class Pass {
 public:
  /// `symmetric`: the elastic response does not tell the lateral axes apart. Rows that memory leaves so stay at λ2 =
  /// λ3.
  Pass(const Strip& strip, const TestInput& input, std::span<const double> stretch, bool symmetric, Memory& memory)
      : strip_(strip),
        stretch_(stretch),
        m_(memory),
        n_(stretch.size()),
        count_(input.model_parameters.size()),
        symmetric_(symmetric) {
    m_.path.prepare(input.model, input.model_parameters, n_);
  }

  Status run(bool parameters) {
    set_stretches();
    if (Status status = m_.path.evaluate(parameters); !status.ok()) return status;
    m_.path.begin(1, 1, parameters, !strip_.time.empty());
    m_.by_unknown.assign(m_.path.width(), 0);
    newton_ = {};
    for (std::size_t i = 0; i < n_ && newton_.sound; ++i) row(i, parameters);
    return {};
  }
  [[nodiscard]] bool sound() const { return newton_.sound; }
  [[nodiscard]] double largest_step() const { return newton_.largest; }

 private:
  void set_stretches() {
    double* const c1 = m_.path.c(strip_.loaded);
    double* const c2 = m_.path.c(strip_.transverse);
    double* const c3 = m_.path.c(2);
    for (std::size_t i = 0; i < n_; ++i) {
      c1[i] = stretch_[i] * stretch_[i];
      c2[i] = m_.u[i];
      c3[i] = 1 / (c1[i] * c2[i]);
    }
  }

  /// r = u g2 − c3 g3 = 0, σ = 2 (c1 g1 − c3 g3). Direction 1 is y with ∂u/∂y = u, ∂c3/∂y = −c3; direction 2 is
  /// Newton's step of the rows before; the parameters follow.
  void row(std::size_t i, bool parameters) {
    detail::AxisPath& path = m_.path;
    path.load(i);
    const double c1 = path.c_row(strip_.loaded)[0], c2 = path.c_row(strip_.transverse)[0], c3 = path.c_row(2)[0];
    path.c_row(strip_.transverse)[1] = c2;
    path.c_row(2)[1] = -c3;
    double time_step = 0;
    if (!strip_.time.empty()) time_step = i == 0 ? std::max(0.0, strip_.time[0]) : strip_.time[i] - strip_.time[i - 1];
    path.remember(time_step);
    const double* const g1 = path.g_row(strip_.loaded);
    const double* const g2 = path.g_row(strip_.transverse);
    const double* const g3 = path.g_row(2);
    const double residual = c2 * g2[0] - c3 * g3[0];
    const double slope = c2 * (g2[0] + g2[1]) + c3 * (g3[0] - g3[1]);
    const double stress = 2 * (c1 * g1[0] - c3 * g3[0]), stress_by_y = 2 * (c1 * g1[1] + c3 * (g3[0] - g3[1]));
    const double at_step = residual + c2 * g2[2] - c3 * g3[2];
    const bool rests = symmetric_ && std::abs(at_step) <=
                                         free_strip::alike * c2 * (std::abs(g1[0]) + std::abs(g2[0]) + std::abs(g3[0]));
    const double by_residual = rests ? 0 : -1 / slope;
    const double step = m_.step[i] = newton_.take(at_step, slope, by_residual, rests, m_.before[i]);
    m_.stress[i] = stress + 2 * (c1 * g1[2] - c3 * g3[2]) + stress_by_y * step;
    double* const by = m_.by_unknown.data();
    by[2] = step;
    const std::size_t first = path.parameter_place();
    for (std::size_t j = 0; parameters && j < count_; ++j) {
      const std::size_t k = first + j;
      by[k] = (c2 * g2[k] - c3 * g3[k]) * by_residual;
      m_.y_dp[j * n_ + i] = by[k];
      m_.stress_dp[j * n_ + i] = 2 * (c1 * g1[k] - c3 * g3[k]) + stress_by_y * by[k];
    }
    path.settle(by);
  }

  const Strip& strip_;
  std::span<const double> stretch_;
  Memory& m_;
  std::size_t n_, count_;
  bool symmetric_;
  NewtonStep newton_;
};

/// Whether the model has no other memory than as many Maxwell branches as can be followed together.
bool find_branches(const Model& model, std::size_t parameters, std::vector<MaxwellModel::Branch>& found) {
  found.clear();
  const auto* const maxwell = dynamic_cast<const MaxwellModel*>(&model);
  return maxwell != nullptr && maxwell->add_branches(found) && !found.empty() &&
         found.size() <= MaxwellPass::most_branches &&
         std::all_of(found.begin(), found.end(),
                     [parameters](const auto& one) { return one.g < parameters && one.tau < parameters; });
}

/// u ← u e^y
void stretch_by(const std::vector<double>& y, std::vector<double>& u) {
  detail::vectorised([n = u.size(), by = y.data(), to = u.data()] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) to[i] *= detail::lane_exp(by[i]);
  });
}

/// Passes until all rows have settled; false where they do not.
template <class AnyPass>
bool settle(AnyPass& pass, bool symmetric, bool parameters, Memory& m, Status& status) {
  const auto step_on = [&m] { stretch_by(m.step, m.u); };
  // Symmetry has given the answer already: one pass then has values and derivatives.
  bool found = symmetric && parameters;
  for (int k = 0; k < iterations && !found; ++k) {
    if (status = pass.run(false); !status.ok()) return false;
    if (!pass.sound()) return false;
    found = pass.largest_step() < (parameters ? near : free_strip::last_step);
    if (!found || parameters) step_on();
  }
  for (int k = 0; parameters && found && k < iterations; ++k) {
    if (status = pass.run(true); !status.ok()) return false;
    found = pass.sound();
    if (!found || pass.largest_step() < settled) break;
    step_on();
    found = k + 1 < iterations;
  }
  return found;
}

}  // namespace

Status MemoryPath::predict(const Strip& strip, const TestInput& input, const TestOutput& output) const {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const std::size_t n = stretch.size(), channels = strip.channels.size(), rows = channels * n;
  const std::size_t count = input.model_parameters.size();
  const bool parameters = !output.jacobian.empty();
  Memory& m = thread_memory();
  m.y.resize(n);
  m.step.resize(n);
  m.before.assign(n, 0);
  m.stress.resize(n);
  if (parameters) {
    m.y_dp.resize(n * count);
    m.stress_dp.resize(n * count);
  }

  // Begun from the elastic strip.
  const Model& elastic = input.model.elastic();
  StripPath path{.loaded = strip.loaded,
                 .parameters = input.model_parameters.first(elastic.describe().parameters.size()),
                 .stretch = stretch,
                 .stress = {},
                 .lateral = m.y};
  if (input.abscissae.empty()) start_.set(path);
  if (Status status = free_strip::solve(elastic, path, m.elastic); !status.ok()) return status;
  m.u.assign(n, 1);
  stretch_by(m.y, m.u);
  const bool symmetric = free_strip::is_symmetric({elastic, path.parameters, path.loaded}, stretch);
  if (symmetric)
    for (std::size_t i = 0; i < n; ++i) m.u[i] = 1 / stretch[i];
  const PathRows rows_of_path{stretch, m.u, m.step, m.before, m.stress, m.stress_dp, m.y_dp};
  Status status;
  const auto settles = [&](auto&& pass) { return settle(pass, symmetric, parameters, m, status); };
  const bool of_branches = !strip.time.empty() && find_branches(input.model, count, m.branches);
  const bool found = of_branches ? settles(MaxwellPass(strip, input, rows_of_path, symmetric, m.branches))
                                 : settles(Pass(strip, input, stretch, symmetric, m));
  if (!status.ok()) return status;
  if (!found) return Status::failed("uniaxial: no lateral equilibrium along the path of a model with memory");

  stretch_by(m.step, m.u);
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(m.stress[i]) || !(m.u[i] > 0) || !std::isfinite(m.u[i]))
      return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, i));
    if (output.diagnostics.empty()) continue;
    output.diagnostics[i] = std::sqrt(m.u[i]);
    output.diagnostics[n + i] = 1 / (stretch[i] * output.diagnostics[i]);
  }
  for (std::size_t k = 0; k < channels; ++k) {
    const auto solution = [&](std::size_t i) {
      const double y = strip.channels[k] == Channel::stress ? 0 : std::log(m.u[i]);
      return RowSolution{stretch[i], m.stress[i], y, 0, 0};
    };
    for (std::size_t i = 0; !output.values.empty() && i < n; ++i)
      output.values[k * n + i] = channel_value(strip.channels[k], strip.measure, solution(i));
    for (std::size_t j = 0; parameters && j < count; ++j)
      for (std::size_t i = 0; i < n; ++i)
        output.jacobian[j * rows + k * n + i] = channel_derivative(strip.channels[k], strip.measure, solution(i),
                                                                   m.stress_dp[j * n + i], m.y_dp[j * n + i]);
  }
  // At α = 0 the mirrored families make every channel even in α.
  if (parameters) std::fill_n(output.jacobian.data() + count * rows, rows, 0.0);
  return {};
}

}  // namespace tunica::uniaxial
