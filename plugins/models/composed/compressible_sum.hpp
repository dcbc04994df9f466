// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "law_table.hpp"
#include "tunica/models/isochoric.hpp"

namespace tunica::composed {

/// A material that changes its volume:
///
///     W = W₁(C) − a ln J + W₂(C̄) + Σ_k U_k(J),   C̄ = J^(−2/3) C,   a = S₁(1), so that nothing is stressed at rest.
///
/// It has no parts, so mechanisms cannot change it. Threads and failure: as Model.
class CompressibleSum final : public Model {
 public:
  /// U(J), a function of x = J − 1, and where its parameters stand in the description.
  struct VolumeTerm {
    Respond respond;
    std::vector<std::size_t> parameters;
  };

  /// Either model may be null. Both have all parameters of the description.
  CompressibleSum(ModelDescription description, std::unique_ptr<Model> full, std::unique_ptr<Model> isochoric,
                  std::vector<VolumeTerm> terms)
      : description_(std::move(description)),
        full_(std::move(full)),
        isochoric_(std::move(isochoric)),
        terms_(std::move(terms)) {
    description_.compressible = true;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    Scratch& s = scratch();
    s.volumes.clear();
    for (std::size_t i = 0; i < n; ++i) {
      VolumeEnergy::Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      s.volumes.emplace_back(C);
    }
    if (full_) {
      if (Status status = full_->evaluate(points, out); !status.ok()) return status;
      if (Status status = relieve(points, out, s); !status.ok()) return status;
    } else {
      for (const std::span<double> rows : {out.energy, out.stress, out.tangent, out.stress_dp})
        std::fill(rows.begin(), rows.end(), 0.0);
    }
    if (isochoric_)
      if (Status status = add_isochoric(points, out, s); !status.ok()) return status;
    for (const VolumeTerm& term : terms_)
      for (std::size_t i = 0; i < n; ++i) add(term, points.parameters, s.volumes[i], out, n, i);
    return {};
  }

 private:
  /// Of one thread: predictions call with one point, thousands of times.
  struct Scratch {
    std::vector<VolumeEnergy> volumes;
    std::vector<double> C, energy, stress, tangent, stress_dp, at_rest_dp;
  };
  static Scratch& scratch() {
    thread_local Scratch instance;
    return instance;
  }

  /// −a ln J, with a the stress of W₁ at rest across the wall, where no family pulls.
  Status relieve(const MaterialPoints& points, const MaterialResponse& out, Scratch& s) const {
    constexpr std::array<double, 6> rest{1, 1, 1, 0, 0, 0};
    const std::size_t n = points.count, parameters = out.stress_dp.empty() ? 0 : description_.parameters.size();
    std::array<double, 6> at_rest{};
    s.at_rest_dp.resize(6 * parameters);
    if (Status status = full_->evaluate({1, rest, points.parameters, {}, {}}, {{}, at_rest, {}, s.at_rest_dp, {}});
        !status.ok())
      return status;
    for (std::size_t i = 0; i < n; ++i) {
      s.volumes[i].add(-at_rest[2] * s.volumes[i].log_volume(), -at_rest[2], 0, out, n, i);
      for (std::size_t j = 0; j < parameters; ++j) s.volumes[i].add_parameter(j, -s.at_rest_dp[6 * j + 2], out, n, i);
    }
    return {};
  }

  Status add_isochoric(const MaterialPoints& points, const MaterialResponse& out, Scratch& s) const {
    const std::size_t n = points.count;
    s.C.assign(points.C.begin(), points.C.end());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 6; ++c) s.C[c * n + i] *= isochoric_factor(s.volumes[i]);
    s.energy.resize(out.energy.size());
    s.stress.resize(6 * n);  // the tangent needs it
    s.tangent.resize(out.tangent.size());
    s.stress_dp.resize(out.stress_dp.size());
    const MaterialResponse response{s.energy, s.stress, s.tangent, s.stress_dp, {}};
    if (Status status = isochoric_->evaluate({n, s.C, points.parameters, {}, {}}, response); !status.ok())
      return status;
    for (std::size_t i = 0; i < n; ++i) make_isochoric(points, s.volumes[i], response, n, i);
    add(s.energy, out.energy);
    add(s.stress, out.stress);
    add(s.tangent, out.tangent);
    add(s.stress_dp, out.stress_dp);
    return {};
  }
  static void add(const std::vector<double>& more, std::span<double> onto) {
    for (std::size_t k = 0; k < onto.size(); ++k) onto[k] += more[k];
  }

  /// With θ = ln J: U_θ = J U',  U_θθ = J² U'' + J U',  ∂U_θ/∂p = J ∂U'/∂p.
  static void add(const VolumeTerm& term, std::span<const double> parameters, const VolumeEnergy& volume,
                  const MaterialResponse& out, std::size_t n, std::size_t i) {
    constexpr std::size_t most = 2;
    const std::size_t count = term.parameters.size();
    const double x = std::expm1(volume.log_volume()), J = 1 + x;
    std::array<double, most> p{}, value_dp{}, first_dp{};
    for (std::size_t j = 0; j < count; ++j) p[j] = parameters[term.parameters[j]];
    double U = 0, first = 0, second = 0;
    term.respond({p.data(), count},
                 {{&x, 1}, {&U, 1}, {&first, 1}, {&second, 1}, {value_dp.data(), count}, {first_dp.data(), count}});
    volume.add(U, J * first, J * J * second + J * first, out, n, i);
    for (std::size_t j = 0; j < count; ++j) volume.add_parameter(term.parameters[j], J * first_dp[j], out, n, i);
  }

  ModelDescription description_;
  std::unique_ptr<Model> full_, isochoric_;
  std::vector<VolumeTerm> terms_;
};

}  // namespace tunica::composed
