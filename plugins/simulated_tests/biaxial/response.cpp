// SPDX-License-Identifier: Apache-2.0
#include "response.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "tunica/detail/axis_path.hpp"

namespace tunica::biaxial {
namespace {

/// (a, b) of the six pairs tt, zz, rr, tz, zr, tr.
constexpr std::array<std::array<std::size_t, 2>, 6> pair{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

using Tensor = std::array<double, 6>;  // tt, zz, rr, tz, zr, tr

/// The sheet's axes e_t', e_z', e_r as tensors over the material's: e⊗e of each, and e_t'⊗e_z' made symmetric.
struct Turned {
  std::array<Tensor, 3> along;
  Tensor across;

  /// z turns towards t, and t away from z.
  explicit Turned(double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    along = {{{c * c, s * s, 0, -s * c, 0, 0}, {s * s, c * c, 0, s * c, 0, 0}, {0, 0, 1, 0, 0, 0}}};
    across = {s * c, -s * c, 0, 0.5 * (c * c - s * s), 0, 0};
  }
};

/// A : B, off-diagonal entries of both count twice.
double contract(const Tensor& a, const double* b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

}  // namespace

void Response::reserve(std::size_t n, std::size_t parameters) {
  if (c.size() < 3 * n) {
    c.resize(3 * n);
    shear.resize(n);
    stress.resize(3 * n);
    tangent.resize(6 * n);
    factor.resize(2 * n);
  }
  if (stress_dp.size() < 3 * n * parameters) stress_dp.resize(3 * n * parameters);
}

/// P = σ/λ, S = σ/λ².
void Response::set_factors(std::size_t n, int power) {
  if (power == 0) std::fill_n(factor.begin(), 2 * n, 1.0);
  for (std::size_t k = 0; power != 0 && k < 2 * n; ++k) factor[k] = power == 2 ? 1 / c[k] : 1 / std::sqrt(c[k]);
}

Status Response::evaluate(const Model& model, std::span<const double> parameters, std::span<const double> time,
                          std::size_t n, double angle, Wants wants) {
  const ModelDescription& description = model.describe();
  if (angle != 0) return on_tensors(model, parameters, time, n, angle, wants);
  if (description.principal_axes && description.history_size == 0) return on_axes(model, parameters, n, wants);
  if (description.axis_history_size > 0 && !wants.tangent) {
    if (wants.parameters || model.remembers(parameters)) return on_path(model, parameters, time, n, wants);
    const Model& elastic = model.elastic();
    return on_axes(elastic, parameters.first(elastic.describe().parameters.size()), n, wants);
  }
  return on_tensors(model, parameters, time, n, 0, wants);
}

Status Response::on_axes(const Model& model, std::span<const double> parameters, std::size_t n, Wants wants) {
  Status status = model.evaluate_axes({n, {c.data(), 3 * n}, parameters},
                                      {{},
                                       {stress.data(), 3 * n},
                                       {tangent.data(), wants.tangent ? 6 * n : 0},
                                       {stress_dp.data(), wants.parameters ? 3 * n * parameters.size() : 0}});
  if (!status.ok()) return status;
  // S_aa = 2 ∂W/∂c_a,  2 ∂S_aa/∂C_bb = 4 ∂²W/∂c_a∂c_b
  for (std::size_t k = 0; k < 3 * n; ++k) stress[k] *= 2;
  for (std::size_t k = 0; wants.tangent && k < 6 * n; ++k) tangent[k] *= 4;
  for (std::size_t k = 0; wants.parameters && k < 3 * n * parameters.size(); ++k) stress_dp[k] *= 2;
  return {};
}

/// Stretches are prescribed: nothing has to be solved, and derivatives by the parameters run along.
Status Response::on_path(const Model& model, std::span<const double> parameters, std::span<const double> time,
                         std::size_t n, Wants wants) {
  thread_local detail::AxisPath path;
  path.prepare(model, parameters, n);
  for (std::size_t a = 0; a < 3; ++a) std::copy_n(c.begin() + static_cast<std::ptrdiff_t>(a * n), n, path.c(a));
  if (Status status = path.evaluate(wants.parameters); !status.ok()) return status;
  path.begin(0, 0, wants.parameters, !time.empty());
  for (std::size_t i = 0; i < n; ++i) {
    path.load(i);
    double step = 0;
    if (!time.empty()) step = i == 0 ? std::max(0.0, time[0]) : time[i] - time[i - 1];
    path.remember(step);
    for (std::size_t a = 0; a < 3; ++a) {
      const double* const g = path.g_row(a);
      stress[a * n + i] = 2 * g[0];
      for (std::size_t j = 0; wants.parameters && j < parameters.size(); ++j)
        stress_dp[(3 * j + a) * n + i] = 2 * g[path.parameter_place() + j];
    }
  }
  return {};
}

Status Response::on_tensors(const Model& model, std::span<const double> parameters, std::span<const double> time,
                            std::size_t n, double angle, Wants wants) {
  const std::size_t history = model.describe().history_size, count = parameters.size();
  const Turned axes(angle);
  tensor_.resize(6);
  tensor_stress_.resize(6);
  tensor_tangent_.resize(36);
  tensor_stress_dp_.resize(6 * count);
  old_state_.resize(history);
  new_state_.resize(history);
  for (std::size_t i = 0; i < n; ++i) {
    // C = Σ c_a e_a⊗e_a
    for (std::size_t k = 0; k < 6; ++k) {
      tensor_[k] = 0;
      for (std::size_t a = 0; a < 3; ++a) tensor_[k] += c[a * n + i] * axes.along[a][k];
    }
    double step = 0;
    if (!time.empty()) step = i == 0 ? std::max(0.0, time[0]) : time[i] - time[i - 1];
    Status status = model.evaluate({1,
                                    tensor_,
                                    parameters,
                                    {&step, history > 0 && !time.empty() ? 1u : 0u},
                                    {old_state_.data(), i > 0 ? history : 0}},
                                   {{},
                                    tensor_stress_,
                                    {tensor_tangent_.data(), wants.tangent ? 36u : 0u},
                                    {tensor_stress_dp_.data(), wants.parameters ? 6 * count : 0},
                                    new_state_});
    if (!status.ok()) return status;
    std::swap(old_state_, new_state_);
    // e_a·S e_a, and e_a⊗e_a : 2 ∂S/∂C : e_b⊗e_b
    shear[i] = contract(axes.across, tensor_stress_.data());
    for (std::size_t a = 0; a < 3; ++a) {
      stress[a * n + i] = contract(axes.along[a], tensor_stress_.data());
      for (std::size_t j = 0; wants.parameters && j < count; ++j)
        stress_dp[(3 * j + a) * n + i] = contract(axes.along[a], &tensor_stress_dp_[6 * j]);
    }
    for (std::size_t k = 0; wants.tangent && k < 6; ++k) {
      Tensor row;
      for (std::size_t p = 0; p < 6; ++p) row[p] = contract(axes.along[pair[k][1]], &tensor_tangent_[6 * p]);
      tangent[k * n + i] = contract(axes.along[pair[k][0]], row.data());
    }
  }
  return {};
}

}  // namespace tunica::biaxial
