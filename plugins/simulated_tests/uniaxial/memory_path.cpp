// SPDX-License-Identifier: Apache-2.0
#include "memory_path.hpp"

#include <algorithm>
#include <cmath>

#include "maxwell_path.hpp"
#include "scaled_path.hpp"
#include "symmetric_memory.hpp"
#include "tunica/detail/axis_path.hpp"
#include "tunica/detail/solve_strip.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::uniaxial {
namespace {

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
  Pass(const Strip& strip, const TestInput& input, std::span<const double> stretch, bool symmetric,
       const PathRows& rows, Memory& memory)
      : strip_(strip),
        stretch_(stretch),
        rows_(rows),
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
      if (!rows_.y_dp.empty()) rows_.y_dp[j * n_ + i] = by[k];
      rows_.stress_dp[j * n_ + i] = 2 * (c1 * g1[k] - c3 * g3[k]) + stress_by_y * by[k];
    }
    path.settle(by);
  }

  const Strip& strip_;
  std::span<const double> stretch_;
  const PathRows& rows_;
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
         found.size() <= MaxwellPath::most_branches &&
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
bool settle(Pass& pass, bool symmetric, bool parameters, Memory& m, Status& status) {
  const auto step_on = [&m] { stretch_by(m.step, m.u); };
  // Symmetry has given the answer already: one pass then has values and derivatives.
  bool found = symmetric && parameters;
  for (int k = 0; k < NewtonStep::most && !found; ++k) {
    if (status = pass.run(false); !status.ok()) return false;
    if (!pass.sound()) return false;
    found = pass.largest_step() < (parameters ? NewtonStep::near : free_strip::last_step);
    if (!found || parameters) step_on();
  }
  for (int k = 0; parameters && found && k < NewtonStep::most; ++k) {
    if (status = pass.run(true); !status.ok()) return false;
    found = pass.sound();
    if (!found || pass.largest_step() < NewtonStep::settled) break;
    step_on();
    found = k + 1 < NewtonStep::most;
  }
  return found;
}

/// λ2² of all rows and what else the path has found; false where Newton's method does not end.
bool follow(const Strip& strip, const TestInput& input, std::span<const double> stretch, const free_strip::Start& start,
            const PathRows& rows, bool parameters, Status& status) {
  Memory& m = thread_memory();
  const std::size_t n = stretch.size();
  const bool of_branches = !strip.time.empty() && find_branches(input.model, input.model_parameters.size(), m.branches);
  if (of_branches && remember_symmetric(strip, input, stretch, m.branches, m.elastic, m.stress,
                                        parameters ? rows.stress_dp : std::span<double>(), status)) {
    for (std::size_t i = 0; i < n; ++i) m.u[i] = 1 / stretch[i];
    std::fill(rows.y_dp.begin(), rows.y_dp.end(), 0.0);
    return status.ok();
  }
  if (const auto* const scaled = dynamic_cast<const EnergyScaledModel*>(&input.model);
      scaled != nullptr && scaled->scale_path({input.model_parameters, {}, {}}, {})) {
    status = scale_elastic(strip, input, stretch, start, *scaled, m.elastic, rows, parameters);
    return status.ok();
  }
  // Begun from the elastic strip.
  const Model& elastic = input.model.elastic();
  m.y.resize(n);
  StripPath path{.loaded = strip.loaded,
                 .parameters = input.model_parameters.first(elastic.describe().parameters.size()),
                 .stretch = stretch,
                 .stress = {},
                 .lateral = m.y};
  if (input.abscissae.empty()) start.set(path);
  if (status = free_strip::solve(elastic, path, m.elastic); !status.ok()) return false;
  if (of_branches) return MaxwellPath(strip, input, stretch, m.branches, m.y, rows).solve(parameters, status);
  m.step.resize(n);
  m.before.assign(n, 0);
  m.u.assign(n, 1);
  stretch_by(m.y, m.u);
  const bool symmetric = free_strip::is_symmetric({elastic, path.parameters, path.loaded}, stretch);
  if (symmetric)
    for (std::size_t i = 0; i < n; ++i) m.u[i] = 1 / stretch[i];
  Pass pass(strip, input, stretch, symmetric, rows, m);
  if (!settle(pass, symmetric, parameters, m, status)) return false;
  stretch_by(m.step, m.u);
  return true;
}

/// Whether every channel is a stress, so that nothing asks for the lateral stretch by parameters.
bool of_stress(const Strip& strip) {
  return std::all_of(strip.channels.begin(), strip.channels.end(),
                     [](Channel channel) { return channel == Channel::stress; });
}

/// All channels from the stress and λ2² of every row.
void write(const Strip& strip, std::span<const double> stretch, const PathRows& path, std::size_t count,
           const TestOutput& output) {
  const std::size_t n = stretch.size(), channels = strip.channels.size(), rows = channels * n;
  const bool parameters = !output.jacobian.empty();
  for (std::size_t k = 0; k < channels; ++k) {
    const auto solution = [&](std::size_t i) {
      const double y = strip.channels[k] == Channel::stress ? 0 : std::log(path.u[i]);
      return RowSolution{stretch[i], path.stress[i], y, 0, 0};
    };
    for (std::size_t i = 0; !output.values.empty() && i < n; ++i)
      output.values[k * n + i] = channel_value(strip.channels[k], strip.measure, solution(i));
    // One channel of Cauchy stress is written where it was derived.
    if (!parameters || (path.stress_dp.data() == output.jacobian.data() && strip.measure == Measure::cauchy)) continue;
    for (std::size_t j = 0; j < count; ++j)
      for (std::size_t i = 0; i < n; ++i) {
        const double y_p = path.y_dp.empty() ? 0 : path.y_dp[j * n + i];
        output.jacobian[j * rows + k * n + i] =
            channel_derivative(strip.channels[k], strip.measure, solution(i), path.stress_dp[j * n + i], y_p);
      }
  }
  // At α = 0 the mirrored families make every channel even in α.
  if (parameters) std::fill_n(output.jacobian.data() + count * rows, rows, 0.0);
}

}  // namespace

Status MemoryPath::predict(const Strip& strip, const TestInput& input, const TestOutput& output) const {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const std::size_t n = stretch.size(), count = input.model_parameters.size();
  const bool parameters = !output.jacobian.empty();
  Memory& m = thread_memory();
  m.u.resize(n);
  m.stress.resize(n);
  PathRows rows{m.u, m.stress, {}, {}};
  if (parameters && strip.channels.size() == 1) rows.stress_dp = output.jacobian.first(n * count);
  if (parameters && strip.channels.size() > 1) {
    m.stress_dp.resize(n * count);
    rows.stress_dp = m.stress_dp;
  }
  if (parameters && !of_stress(strip)) {
    m.y_dp.resize(n * count);
    rows.y_dp = m.y_dp;
  }
  Status status;
  if (!follow(strip, input, stretch, start_, rows, parameters, status))
    return status.ok() ? Status::failed("uniaxial: no lateral equilibrium along the path of a model with memory")
                       : status;

  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(m.stress[i]) || !(m.u[i] > 0) || !std::isfinite(m.u[i]))
      return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, i));
    if (output.diagnostics.empty()) continue;
    output.diagnostics[i] = std::sqrt(m.u[i]);
    output.diagnostics[n + i] = 1 / (stretch[i] * output.diagnostics[i]);
  }
  write(strip, stretch, rows, count, output);
  return {};
}

}  // namespace tunica::uniaxial
