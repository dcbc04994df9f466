// SPDX-License-Identifier: Apache-2.0
#include "tensor_path.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/safeguarded_newton.hpp"
#include "tunica/detail/symmetric_strip.hpp"

namespace tunica::uniaxial {
namespace {

using Tensor = std::array<double, 6>;  // tt, zz, rr, tz, zr, tr

/// e⊗f symmetrised, for in-plane vectors given by their components along t and z.
Tensor dyad(const std::array<double, 2>& e, const std::array<double, 2>& f) {
  return {e[0] * f[0], e[1] * f[1], 0, 0.5 * (e[0] * f[1] + e[1] * f[0]), 0, 0};
}
double contract(const Tensor& a, const Tensor& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// One row: the model at (λ1, y = ln u) with a fixed old state.
class Row {
 public:
  Row(const Strip& strip, const TestInput& input, double misalignment) : input_(input) {
    const double c = std::cos(misalignment), s = std::sin(misalignment);
    const std::array<double, 2> along = strip.loaded == 0 ? std::array{c, s} : std::array{s, c};
    const std::array<double, 2> across = strip.loaded == 0 ? std::array{-s, c} : std::array{c, -s};
    e11_ = dyad(along, along);
    e22_ = dyad(across, across);
    e12_ = dyad(along, across);
    if (input.model.describe().parameter_derivatives) stress_dp_.resize(6 * input.model_parameters.size());
  }

  void set(double stretch, std::span<const double> time_step, std::span<const double> state) {
    c1_ = stretch * stretch;
    time_step_ = time_step;
    state_ = state;
  }

  /// Evaluates at y; the members below then hold for this point. `new_state` may be empty.
  bool evaluate(double y, bool parameters, std::span<double> new_state) {
    u_ = std::exp(y);
    c3_ = 1 / (c1_ * u_);
    return evaluate(parameters, new_state);
  }

  /// Evaluates at λ2 = λ3. Whether the response there stays the same when these two axes change places, to second
  /// order: symmetry then gives the answer, and total derivatives follow it.
  bool is_symmetric() {
    symmetric_ = false;
    u_ = c3_ = std::sqrt(1 / c1_);
    if (!evaluate(false, {})) return false;
    const Tensor by_1 = stress_change(e11_), by_2 = stress_change(e22_), by_3 = stress_change({0, 0, 1, 0, 0, 0});
    const double s1 = contract(e11_, stress_), s2 = contract(e22_, stress_), s3 = stress_[2];
    const double d12 = contract(e11_, by_2), d13 = contract(e11_, by_3);
    const double d22 = contract(e22_, by_2), d33 = by_3[2];
    const double slope = std::abs(s1) + std::abs(s2) + std::abs(s3);
    const double bend =
        std::abs(contract(e11_, by_1)) + std::abs(d22) + std::abs(d33) + std::abs(d12) + std::abs(d13) + slope / u_;
    // In a turned frame rounding is larger than along the axes.
    const auto same = [](double a, double b, double scale) {
      return std::abs(a - b) <= 10 * free_strip::alike * scale;
    };
    symmetric_ = std::isfinite(slope) && std::isfinite(bend) && same(s2, s3, slope) && same(d22, d33, bend) &&
                 same(d12, d13, bend);
    return symmetric_;
  }
  [[nodiscard]] bool rests() const { return symmetric_; }

  bool evaluate(bool parameters, std::span<double> new_state) {
    Tensor C = combine(c1_, u_, c3_);
    const Status status = input_.model.evaluate(
        {1, C, input_.model_parameters, time_step_, state_},
        {{}, stress_, tangent_, parameters ? std::span<double>(stress_dp_) : std::span<double>{}, new_state});
    if (!status.ok()) {
      failure_ = status.reason();
      return false;
    }
    residual_ = u_ * contract(e22_, stress_) - c3_ * stress_[2];
    stress11_ = c1_ * contract(e11_, stress_) - c3_ * stress_[2];
    // ∂C/∂y = u e2⊗e2 − c3 r⊗r
    const Tensor by_y = stress_change(combine(0, u_, -c3_));
    slope_ = u_ * (contract(e22_, stress_) + contract(e22_, by_y)) + c3_ * (stress_[2] - by_y[2]);
    stress_by_y_ = c1_ * contract(e11_, by_y) + c3_ * (stress_[2] - by_y[2]);
    return true;
  }

  /// Total derivatives along the free path from the partial ones at fixed y.
  void total(double stress_partial, double residual_partial, double& stress, double& y) const {
    y = symmetric_ ? 0 : -residual_partial / slope_;
    stress = stress_partial + stress_by_y_ * y;
  }
  void by_stretch(double& stress, double& y) const {  // l = ln λ1: ∂C/∂l = 2 c1 e1⊗e1 − 2 c3 r⊗r
    const Tensor dS = stress_change(combine(2 * c1_, 0, -2 * c3_));
    const double normal = c3_ * (2 * stress_[2] - dS[2]);
    const double stress_partial = c1_ * (2 * contract(e11_, stress_) + contract(e11_, dS)) + normal;
    if (symmetric_) {
      y = -1;
      stress = stress_partial - stress_by_y_;
    } else {
      total(stress_partial, u_ * contract(e22_, dS) + normal, stress, y);
    }
  }
  void by_parameter(std::size_t j, double& stress, double& y) const {
    Tensor dS;
    for (std::size_t c = 0; c < 6; ++c) dS[c] = stress_dp_[6 * j + c];
    total(c1_ * contract(e11_, dS) - c3_ * dS[2], u_ * contract(e22_, dS) - c3_ * dS[2], stress, y);
  }
  void by_misalignment(double& stress, double& y) const {  // e1' = e2, e2' = −e1
    Tensor dC;
    for (std::size_t c = 0; c < 6; ++c) dC[c] = 2 * (c1_ - u_) * e12_[c];
    const Tensor dS = stress_change(dC);
    const double turn = 2 * contract(e12_, stress_);
    total(c1_ * (contract(e11_, dS) + turn) - c3_ * dS[2], u_ * (contract(e22_, dS) - turn) - c3_ * dS[2], stress, y);
  }

  [[nodiscard]] detail::Residual residual() const { return {residual_, slope_}; }
  [[nodiscard]] double stress() const { return stress11_; }
  [[nodiscard]] const std::string& failure() const { return failure_; }

 private:
  Tensor combine(double c1, double u, double c3) const {
    Tensor C;
    for (std::size_t c = 0; c < 6; ++c) C[c] = c1 * e11_[c] + u * e22_[c];
    C[2] += c3;
    return C;
  }
  /// dS = ½ (2 ∂S/∂C) : dC
  Tensor stress_change(const Tensor& dC) const {
    Tensor dS;
    for (std::size_t p = 0; p < 6; ++p) {
      dS[p] = 0;
      for (std::size_t q = 0; q < 6; ++q) dS[p] += 0.5 * tangent_[6 * p + q] * dC[q] * (q < 3 ? 1 : 2);
    }
    return dS;
  }

  const TestInput& input_;
  Tensor e11_, e22_, e12_;
  bool symmetric_ = false;
  double c1_ = 1, u_ = 1, c3_ = 1, residual_ = 0, slope_ = 0, stress11_ = 0, stress_by_y_ = 0;
  std::span<const double> time_step_, state_;
  Tensor stress_{};
  std::array<double, 36> tangent_{};
  std::vector<double> stress_dp_;
  std::string failure_;
};

}  // namespace

Status predict_on_tensors(const Strip& strip, const TestInput& input, double misalignment, const TestOutput& output) {
  const std::span<const double> stretch =
      input.abscissae.empty() ? std::span<const double>(strip.stretch) : input.abscissae[0];
  const ModelDescription& description = input.model.describe();
  const std::size_t n = stretch.size(), channels = strip.channels.size(), rows = channels * n;
  const std::size_t history = description.history_size, parameters = input.model_parameters.size();
  if (history > 0 && (!output.jacobian.empty() || !output.abscissa_derivative.empty()))
    return Status::failed("uniaxial: no exact Jacobian along the path of a model with history");
  if (!description.parameter_derivatives && !output.jacobian.empty())
    return Status::failed("uniaxial: the model has no parameter derivatives");

  Row row(strip, input, misalignment * std::numbers::pi / 180);
  std::vector<double> old_state(history), new_state(history);
  double y = 0, previous = 1;
  for (std::size_t i = 0; i < n; ++i) {
    double time_step = 0;
    if (!strip.time.empty()) time_step = i == 0 ? std::max(0.0, strip.time[0]) : strip.time[i] - strip.time[i - 1];
    const auto set_row = [&] {
      row.set(stretch[i], {&time_step, history > 0 && !strip.time.empty() ? std::size_t{1} : 0},
              {old_state.data(), i > 0 ? history : 0});
    };
    set_row();
    // Symmetry, else from the last row's λ1 u carried over. Where that fails, in small stretch steps from it.
    const auto at = [&](double trial) {
      return row.evaluate(trial, false, {}) ? row.residual()
                                            : detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
    };
    double guess = y + std::log(previous / stretch[i]);
    bool found = row.is_symmetric();
    if (found)
      guess = -std::log(stretch[i]);
    else
      found = detail::safeguarded_newton(at, guess);
    for (int parts = 4; !found && history == 0 && parts <= 256; parts *= 4) {
      guess = y;
      found = true;
      for (int k = 1; k <= parts && found; ++k) {
        row.set(previous * std::pow(stretch[i] / previous, double(k) / parts), {}, {});
        guess += std::log(previous / stretch[i]) / parts;
        found = detail::safeguarded_newton(at, guess);
      }
    }
    // Last, from λ2² = 1/λ1, where I1 is least: an energy with a limit of I1 is defined there if anywhere.
    if (!found) {
      set_row();
      guess = -std::log(stretch[i]);
      found = detail::safeguarded_newton(at, guess);
    }
    if (!found)
      return Status::failed("uniaxial: no lateral equilibrium at " + row_name(strip, stretch, i) +
                            (row.failure().empty() ? ": the energy overflows or has no stationary point on the path"
                                                   : ": " + row.failure()));
    y = guess;
    previous = stretch[i];
    if (!row.evaluate(y, !output.jacobian.empty(), new_state))
      return Status::failed("uniaxial: " + row_name(strip, stretch, i) + ": " + row.failure());
    if (const detail::Residual left = row.residual();
        !row.rests() && !(std::abs(left.value) < free_strip::last_step * left.slope))
      return Status::failed("uniaxial: " + free_strip::jumping_row().reason() + ", at " + row_name(strip, stretch, i));
    std::swap(old_state, new_state);

    RowSolution solution{stretch[i], row.stress(), y, 0, 0};
    if (!std::isfinite(solution.stress))
      return Status::failed("uniaxial: the stress overflows at " + row_name(strip, stretch, i));
    if (!output.abscissa_derivative.empty()) row.by_stretch(solution.stress_by_l, solution.y_by_l);
    for (std::size_t k = 0; k < channels; ++k) {
      const std::size_t place = k * n + i;
      if (!output.values.empty()) output.values[place] = channel_value(strip.channels[k], strip.measure, solution);
      if (!output.abscissa_derivative.empty())
        output.abscissa_derivative[place] = channel_by_stretch(strip.channels[k], strip.measure, solution);
      for (std::size_t j = 0; !output.jacobian.empty() && j <= parameters; ++j) {
        double stress_p, y_p, factor = 1;
        if (j < parameters) {
          row.by_parameter(j, stress_p, y_p);
        } else {
          row.by_misalignment(stress_p, y_p);
          factor = std::numbers::pi / 180;
        }
        output.jacobian[j * rows + place] =
            factor * channel_derivative(strip.channels[k], strip.measure, solution, stress_p, y_p);
      }
    }
    if (!output.diagnostics.empty()) {
      output.diagnostics[i] = std::exp(y / 2);
      output.diagnostics[n + i] = 1 / (stretch[i] * output.diagnostics[i]);
    }
  }
  return {};
}

}  // namespace tunica::uniaxial
