// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"

namespace tunica::composed {

/// The sum of an energy of invariants and one of principal stretches, W = W_1(C; p) + W_2(C; p_k …). It has no parts,
/// so that mechanisms cannot change it.
class WithStretches final : public Model {
 public:
  /// `invariants` may be null. `indices` are the parameters of `stretches` in the description.
  WithStretches(ModelDescription description, std::unique_ptr<Model> invariants, std::unique_ptr<Model> stretches,
                std::vector<std::size_t> indices)
      : description_(std::move(description)),
        invariants_(std::move(invariants)),
        stretches_(std::move(stretches)),
        indices_(std::move(indices)) {
    description_.principal_axes = true;
    description_.energy_derivatives = true;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    if (invariants_) {
      if (Status status = invariants_->evaluate(points, out); !status.ok()) return status;
    } else {
      for (const std::span<double> rows : {out.energy, out.stress, out.tangent, out.stress_dp}) clear(rows);
    }
    const auto own = gathered(points.parameters);
    const std::size_t n = points.count;
    TensorScratch scratch;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
      const std::size_t m = std::min(chunk, n - begin);
      take(points.C, n, begin, m, scratch.C);
      const MaterialResponse response{wanted(scratch.energy, out.energy, m),
                                      wanted(scratch.stress, out.stress, 6 * m),
                                      wanted(scratch.tangent, out.tangent, 36 * m),
                                      wanted(scratch.stress_dp, out.stress_dp, 6 * indices_.size() * m),
                                      {}};
      Status status = stretches_->evaluate({m, {scratch.C.data(), 6 * m}, own_span(own), {}, {}}, response);
      if (!status.ok()) return status;
      add(response.energy, 1, 0, n, begin, m, out.energy);
      add(response.stress, 6, 0, n, begin, m, out.stress);
      add(response.tangent, 36, 0, n, begin, m, out.tangent);
      for (std::size_t j = 0; !out.stress_dp.empty() && j < indices_.size(); ++j)
        add(response.stress_dp.subspan(6 * j * m, 6 * m), 6, 6 * indices_[j], n, begin, m, out.stress_dp);
    }
    return {};
  }

  Status evaluate_axes(const AxisPoints& points, const AxisResponse& out) const override {
    if (invariants_) {
      if (Status status = invariants_->evaluate_axes(points, out); !status.ok()) return status;
    } else {
      for (const std::span<double> rows : {out.energy, out.gradient, out.hessian, out.gradient_dp, out.energy_dp})
        clear(rows);
    }
    const auto own = gathered(points.parameters);
    const std::size_t n = points.count;
    AxesScratch scratch;
    for (std::size_t begin = 0; begin < n; begin += chunk) {
      const std::size_t m = std::min(chunk, n - begin);
      take(points.c, n, begin, m, scratch.c);
      const AxisResponse response{wanted(scratch.energy, out.energy, m), wanted(scratch.gradient, out.gradient, 3 * m),
                                  wanted(scratch.hessian, out.hessian, 6 * m),
                                  wanted(scratch.gradient_dp, out.gradient_dp, 3 * indices_.size() * m),
                                  wanted(scratch.energy_dp, out.energy_dp, indices_.size() * m)};
      Status status = stretches_->evaluate_axes({m, {scratch.c.data(), 3 * m}, own_span(own)}, response);
      if (!status.ok()) return status;
      add(response.energy, 1, 0, n, begin, m, out.energy);
      add(response.gradient, 3, 0, n, begin, m, out.gradient);
      add(response.hessian, 6, 0, n, begin, m, out.hessian);
      for (std::size_t j = 0; j < indices_.size(); ++j) {
        if (!out.gradient_dp.empty())
          add(response.gradient_dp.subspan(3 * j * m, 3 * m), 3, 3 * indices_[j], n, begin, m, out.gradient_dp);
        if (!out.energy_dp.empty())
          add(response.energy_dp.subspan(j * m, m), 1, indices_[j], n, begin, m, out.energy_dp);
      }
    }
    return {};
  }

 private:
  static constexpr std::size_t chunk = 32, most = 12;  ///< parameters: six terms
  struct TensorScratch {
    std::array<double, 6 * chunk> C, stress;
    std::array<double, chunk> energy;
    std::array<double, 36 * chunk> tangent;
    std::array<double, 6 * most * chunk> stress_dp;
  };
  struct AxesScratch {
    std::array<double, 3 * chunk> c, gradient;
    std::array<double, chunk> energy;
    std::array<double, 6 * chunk> hessian;
    std::array<double, 3 * most * chunk> gradient_dp;
    std::array<double, most * chunk> energy_dp;
  };

  /// As much of the scratch as is wanted.
  template <class Rows>
  static std::span<double> wanted(Rows& scratch, std::span<double> out, std::size_t count) {
    return {scratch.data(), out.empty() ? 0 : count};
  }
  static void clear(std::span<double> rows) { std::fill(rows.begin(), rows.end(), 0.0); }
  [[nodiscard]] std::array<double, most> gathered(std::span<const double> parameters) const {
    std::array<double, most> own{};
    for (std::size_t j = 0; j < indices_.size(); ++j) own[j] = parameters[indices_[j]];
    return own;
  }
  [[nodiscard]] std::span<const double> own_span(const std::array<double, most>& own) const {
    return {own.data(), indices_.size()};
  }
  /// Points [begin, begin + m) of every row of n.
  template <class Rows>
  static void take(std::span<const double> from, std::size_t n, std::size_t begin, std::size_t m, Rows& to) {
    for (std::size_t c = 0; c * n < from.size(); ++c)
      for (std::size_t i = 0; i < m; ++i) to[c * m + i] = from[c * n + begin + i];
  }
  /// Adds rows of m to those of n from row `first` on; nothing where nothing is wanted.
  static void add(std::span<const double> from, std::size_t rows, std::size_t first, std::size_t n, std::size_t begin,
                  std::size_t m, std::span<double> to) {
    if (to.empty()) return;
    for (std::size_t c = 0; c < rows; ++c)
      for (std::size_t i = 0; i < m; ++i) to[(first + c) * n + begin + i] += from[c * m + i];
  }

  ModelDescription description_;
  std::unique_ptr<Model> invariants_, stretches_;
  std::vector<std::size_t> indices_;
};

}  // namespace tunica::composed
