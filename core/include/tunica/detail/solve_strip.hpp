// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "tunica/detail/free_strip.hpp"
#include "tunica/detail/strip_start.hpp"
#include "tunica/detail/symmetric_strip.hpp"
#include "tunica/detail/vector_level.hpp"

namespace tunica::free_strip {

/// First u = λ2² of every row: interpolated from the nodes, or 1/λ1 where there are none.
inline Status guess(const Pull& pull, const StripPath& path, Scratch& scratch, std::span<double> u,
                    std::optional<std::size_t>& lost) {
  constexpr std::size_t node_count = Start::node_count;
  if (path.nodes.empty()) {
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = 1 / path.stretch[i];
    return {};
  }
  constexpr double coarse = 1e-3;  // a start's error is squared by the next Newton step
  std::array<double, 2 * node_count> at_nodes;
  for (std::size_t k = 0; k < node_count; ++k) at_nodes[k] = 1 / path.nodes[k];
  Batch batch(pull, path.nodes, scratch);
  if (Status status = iterate(pull, path.nodes, coarse, batch, {at_nodes.data(), node_count}, lost); !status.ok()) {
    if (lost) lost = nearest(path.stretch, path.nodes[*lost]);
    return status;
  }
  for (std::size_t k = 0; k < node_count; ++k) {
    double stress_by_l, y_by_l;
    batch.by_stretch(k, stress_by_l, y_by_l);
    at_nodes[k] *= 1 + scratch.step[k];
    at_nodes[node_count + k] = at_nodes[k] * (1 + y_by_l);
  }
  const double* const weights = path.interpolation.data();
  double* const row = u.data();
  detail::vectorised([&, n = u.size(), stride = path.row_stride] {
    TUNICA_LANES
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t k = 0; k < 2 * node_count; ++k) sum += weights[k * stride + i] * at_nodes[k];
      row[i] = sum;
    }
  });
  return {};
}

/// The same as Model::solve_strip, by batches of evaluate_axes().
inline Status solve_by_batches(const Model& model, const StripPath& path, Scratch& scratch) {
  const std::size_t n = path.stretch.size();
  const Pull pull{model, path.parameters, path.loaded};
  scratch.reserve(n, path.parameters.size());
  const std::span<double> u(scratch.u.data(), n);
  Batch batch(pull, path.stretch, scratch);
  std::optional<std::size_t> lost;
  Status status = guess(pull, path, scratch, u, lost);
  if (status.ok()) status = iterate(pull, path.stretch, last_step, batch, u, lost);
  if (status.ok())
    if (const std::size_t row = first_unsettled(scratch.step.data(), n, last_step); row < n) {
      lost = row;
      status = jumping_row();
    }
  if (lost && path.lost != nullptr) *path.lost = *lost;
  if (!status.ok()) return status;
  const bool along = !path.stress_by_l.empty() || !path.lateral_by_l.empty();
  if (along || !path.stress_dp.empty()) {
    for (std::size_t i = 0; i < n; ++i) u[i] *= 1 + scratch.step[i];
    if (status = batch.evaluate(u.data(), !path.stress_dp.empty()); !status.ok()) return status;
  }
  for (std::size_t i = 0; i < path.stress.size(); ++i)
    path.stress[i] = scratch.stress[i] + scratch.stress_by_y[i] * scratch.step[i];
  for (std::size_t i = 0; i < path.lateral.size(); ++i) path.lateral[i] = std::log(u[i]) + std::log1p(scratch.step[i]);
  for (std::size_t i = 0; along && i < n; ++i) {
    double stress_by_l, lateral_by_l;
    batch.by_stretch(i, stress_by_l, lateral_by_l);
    if (!path.stress_by_l.empty()) path.stress_by_l[i] = stress_by_l;
    if (!path.lateral_by_l.empty()) path.lateral_by_l[i] = lateral_by_l;
  }
  if (path.stress_dp.empty()) return {};
  batch.prepare_parameters();
  for (std::size_t j = 0; j < path.parameters.size(); ++j) {
    batch.stress_by_parameter(j, path.stress_dp.data() + j * n);
    for (std::size_t i = 0; !path.lateral_dp.empty() && i < n; ++i) {
      double stress_p;
      batch.by_parameter(i, j, stress_p, path.lateral_dp[j * n + i]);
    }
  }
  return {};
}

/// Answers for any model with a principal-axes path: by symmetry where that gives the answer, by the model's own solver
/// where it has one, else by batches. A model without parts that solves its strips itself knows its own symmetry: to
/// ask for its response would cost a call a strip. It is asked only where the model fails.
inline Status solve(const Model& model, const StripPath& path, Scratch& scratch) {
  Status status;
  const Symmetry said = symmetry_of_parts(model, path.parameters);
  const bool by_model = said != Symmetry::isotropic && model.solve_strip(path, status);
  if (by_model && (status.ok() || said == Symmetry::other)) return status;
  Status symmetric;
  if (said != Symmetry::other && solve_symmetric({model, path.parameters, path.loaded}, path, scratch, symmetric))
    return symmetric;
  return by_model ? status : solve_by_batches(model, path, scratch);
}

}  // namespace tunica::free_strip
