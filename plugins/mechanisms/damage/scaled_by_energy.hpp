// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "tunica/energy_scaled_model.hpp"
#include "tunica/models/history_model.hpp"

namespace tunica {

/// A base model whose stress is multiplied by a factor η(W, Wmax): W the energy of the base counted from rest, Wmax the
/// largest so far.
///
/// State: Wmax; in principal axes W at rest and Wmax. The energy it returns is that of the base, with which Wmax is
/// compared.
class ScaledByEnergy : public HistoryModel, public EnergyScaledModel {
 public:
  bool scale_path(const ScaledPath& path, const Factors& factors) const final {
    if (base().describe().history_size > 0) return false;
    scale_rows(path.parameters.subspan(base().describe().parameters.size()), path, factors);
    return true;
  }

 protected:
  ScaledByEnergy(std::string id, std::unique_ptr<Model> base, const std::vector<Parameter>& own)
      : HistoryModel(std::move(id), std::move(base), own, 1, 2) {}

  /// η and dη/dW.
  struct Factor {
    double eta = 1, slope = 0;
  };
  /// At energy W, where that of earlier points was at most `before` and the largest principal-axis stress is `stress`.
  [[nodiscard]] virtual Factor factor(std::span<const double> own, double W, double before, double stress) const = 0;
  /// As EnergyScaledModel::scale_path(), with the mechanism's own parameters.
  virtual void scale_rows(std::span<const double> own, const ScaledPath& path, const Factors& out) const = 0;
  /// Whether η can differ from 1 in a step at all.
  [[nodiscard]] virtual bool scales(const Step& step) const = 0;

 private:
  Status evaluate_step(Step& step) const final {
    const MaterialPoints& points = step.base_points;
    MaterialResponse& out = step.base_response;
    const std::size_t n = points.count;
    const bool tangent = !out.tangent.empty(), scaled = (tangent || !out.stress.empty()) && scales(step);
    if (!scaled && step.new_state.empty()) return base().evaluate(points, out);

    std::vector<double> energy, stress;
    if (out.energy.empty()) {
      energy.resize(n);
      out.energy = energy;
    }
    if (scaled && out.stress.empty()) {
      stress.resize(6 * n);
      out.stress = stress;
    }
    if (Status status = base().evaluate(points, out); !status.ok()) return status;
    double at_rest = 0;
    const double identity[] = {1, 1, 1, 0, 0, 0};
    if (Status status = base().evaluate({1, identity, points.parameters, {}, {}}, {{&at_rest, 1}, {}, {}, {}, {}});
        !status.ok())
      return status;
    // 2 ∂W/∂C, which is S itself where the base has no memory.
    std::vector<double> conservative;
    std::span<const double> by_energy = out.stress;
    if (scaled && tangent && base().describe().history_size > 0) {
      conservative.resize(6 * n);
      by_energy = conservative;
      if (Status status = base().evaluate({n, points.C, points.parameters, {}, {}}, {{}, conservative, {}, {}, {}});
          !status.ok())
        return status;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double W = out.energy[i] - at_rest, before = step.old_state.empty() ? 0 : step.old_state[i];
      if (scaled) scale(factor(step.parameters, W, before, largest(out.stress, n, i)), n, i, by_energy, out);
      if (!step.new_state.empty()) step.new_state[i] = std::isnan(W) ? W : std::max(before, W);
    }
    return {};
  }

  static double largest(std::span<const double> stress, std::size_t n, std::size_t i) {
    return std::max({std::abs(stress[i]), std::abs(stress[n + i]), std::abs(stress[2 * n + i])});
  }

  /// S → η S, and the tangent consistent with it: η A + S ⊗ 2 ∂η/∂C = η A + η' S ⊗ 2 ∂W/∂C.
  static void scale(const Factor& by, std::size_t n, std::size_t i, std::span<const double> by_energy,
                    const MaterialResponse& out) {
    if (by.eta == 1 && by.slope == 0) return;
    for (std::size_t a = 0; a < (out.tangent.empty() ? 0 : 6); ++a)
      for (std::size_t b = 0; b < 6; ++b) {
        double& entry = out.tangent[(6 * a + b) * n + i];
        entry = by.eta * entry + by.slope * out.stress[a * n + i] * by_energy[b * n + i];
      }
    // The stress last: where the base has no memory, `by_energy` is it.
    for (std::size_t a = 0; a < 6; ++a) out.stress[a * n + i] *= by.eta;
  }
};

}  // namespace tunica
