// SPDX-License-Identifier: Apache-2.0
#include "memory_path.hpp"

#include <algorithm>
#include <cmath>

#include "tunica/detail/axis_path.hpp"
#include "tunica/detail/solve_strip.hpp"

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
  std::vector<double> u,   ///< λ2², one a row
      step, before,        ///< of Newton in y, and the one before
      stress, by_unknown,  ///< σ11 with the step in it; what directions do to y
      stress_dp, y_dp;     ///< derivatives by model parameters, row-major
};
Memory& thread_memory() {
  thread_local Memory instance;
  return instance;
}

/// One pass along the path at u. Without parameters: Newton's step of every row, that of the rows before it included.
/// With them: total derivatives of σ11 and y.
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
    largest_ = 0;
    sound_ = true;
    for (std::size_t i = 0; i < n_ && sound_; ++i) row(i, parameters);
    return {};
  }
  [[nodiscard]] bool sound() const { return sound_; }
  [[nodiscard]] double largest_step() const { return largest_; }

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
    double step = rests ? 0 : -at_step / slope;
    sound_ = rests || (slope > 0 && std::abs(step) < 1e10);
    largest_ = std::max(largest_, std::abs(step));
    step = std::clamp(step, -0.6, 1.5);
    // Where fibres switch, steps may go to and fro across the kink.
    if (step * m_.before[i] < 0 && std::abs(step) > 0.5 * std::abs(m_.before[i])) step *= 0.5;
    m_.step[i] = m_.before[i] = step;
    m_.stress[i] = stress + 2 * (c1 * g1[2] - c3 * g3[2]) + stress_by_y * step;
    double* const by = m_.by_unknown.data();
    by[2] = step;
    const std::size_t first = path.parameter_place();
    for (std::size_t j = 0; parameters && j < count_; ++j) {
      const std::size_t k = first + j;
      by[k] = rests ? 0 : -(c2 * g2[k] - c3 * g3[k]) / slope;
      m_.y_dp[i * count_ + j] = by[k];
      m_.stress_dp[i * count_ + j] = 2 * (c1 * g1[k] - c3 * g3[k]) + stress_by_y * by[k];
    }
    path.settle(by);
  }

  const Strip& strip_;
  std::span<const double> stretch_;
  Memory& m_;
  std::size_t n_, count_;
  bool symmetric_, sound_ = true;
  double largest_ = 0;
};

}  // namespace

Status MemoryPath::predict(const Strip& strip, const TestInput& input, const TestOutput& output) const {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const std::size_t n = stretch.size(), channels = strip.channels.size(), rows = channels * n;
  const std::size_t count = input.model_parameters.size();
  const bool parameters = !output.jacobian.empty();
  Memory& m = thread_memory();
  m.u.resize(n);
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
                 .lateral = m.u};
  if (input.abscissae.empty()) start_.set(path);
  if (Status status = free_strip::solve(elastic, path, m.elastic); !status.ok()) return status;
  for (double& u : m.u) u = std::exp(u);

  const bool symmetric = free_strip::is_symmetric({elastic, path.parameters, path.loaded}, stretch);
  if (symmetric)
    for (std::size_t i = 0; i < n; ++i) m.u[i] = 1 / stretch[i];
  Pass pass(strip, input, stretch, symmetric, m);
  const auto step_on = [&] {
    for (std::size_t i = 0; i < n; ++i) m.u[i] *= std::exp(m.step[i]);
  };
  // Symmetry has given the answer already: one pass then has values and derivatives.
  bool found = symmetric && parameters;
  for (int k = 0; k < iterations && !found; ++k) {
    if (Status status = pass.run(false); !status.ok()) return status;
    if (!pass.sound()) break;
    found = pass.largest_step() < (parameters ? near : free_strip::last_step);
    if (!found || parameters) step_on();
  }
  for (int k = 0; parameters && found && k < iterations; ++k) {
    if (Status status = pass.run(true); !status.ok()) return status;
    found = pass.sound();
    if (!found || pass.largest_step() < settled) break;
    step_on();
    found = k + 1 < iterations;
  }
  if (!found) return Status::failed("uniaxial: no lateral equilibrium along the path of a model with memory");

  for (std::size_t i = 0; i < n; ++i) {
    const RowSolution row{stretch[i], m.stress[i], std::log(m.u[i]) + m.step[i], 0, 0};
    if (!std::isfinite(row.stress) || !std::isfinite(row.y))
      return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, i));
    for (std::size_t k = 0; k < channels; ++k) {
      const std::size_t at = k * n + i;
      if (!output.values.empty()) output.values[at] = channel_value(strip.channels[k], strip.measure, row);
      for (std::size_t j = 0; parameters && j < count; ++j)
        output.jacobian[j * rows + at] = channel_derivative(strip.channels[k], strip.measure, row,
                                                            m.stress_dp[i * count + j], m.y_dp[i * count + j]);
    }
    if (!output.diagnostics.empty()) {
      output.diagnostics[i] = std::exp(row.y / 2);
      output.diagnostics[n + i] = 1 / (stretch[i] * output.diagnostics[i]);
    }
  }
  // At α = 0 the mirrored families make every channel even in α.
  if (parameters) std::fill_n(output.jacobian.data() + count * rows, rows, 0.0);
  return {};
}

}  // namespace tunica::uniaxial
