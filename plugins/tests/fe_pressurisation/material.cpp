// SPDX-License-Identifier: Apache-2.0
#include "material.hpp"

#include <algorithm>
#include <array>

namespace tunica::fe {
namespace {

/// Every part is a function of an invariant without I2: then W depends on the diagonal of C alone while C_tz = C_tr =
/// 0.
bool linear_in_C(const Model& model, std::span<const double> parameters) {
  if (!model.describe().principal_axes || model.parts().empty()) return false;
  return std::ranges::all_of(model.parts(), [&](const auto& part) {
    Invariant x;
    part->invariant(parameters, x, {});
    return x.i2 == 0;
  });
}

/// What a call writes, and what nobody reads.
struct Scratch {
  std::vector<double> tensors, stress, tangent, stress_dp, gradient_dp;
};

}  // namespace

Material::Material(const Model& model, std::span<const double> parameters)
    : model_(model), parameters_(parameters), diagonal_(linear_in_C(model, parameters)) {}

Status Material::evaluate(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                          std::span<double> first_dp) const {
  if (!diagonal_) return on_tensors(n, C, first, second, first_dp);
  thread_local Scratch scratch;
  if (!first_dp.empty()) scratch.gradient_dp.resize(3 * parameters_.size() * n);
  const std::span<double> gradient_dp = first_dp.empty() ? std::span<double>() : std::span(scratch.gradient_dp);
  const Status status = model_.evaluate_axes(
      {n, C.first(3 * n), parameters_},
      {{}, first.empty() ? first : first.first(3 * n), second.empty() ? second : second.first(6 * n), gradient_dp});
  for (std::size_t j = 0; j < (first_dp.empty() ? 0 : parameters_.size()); ++j) {
    std::copy_n(gradient_dp.begin() + static_cast<std::ptrdiff_t>(3 * j * n), 3 * n,
                first_dp.begin() + static_cast<std::ptrdiff_t>(4 * j * n));
    std::fill_n(first_dp.begin() + static_cast<std::ptrdiff_t>((4 * j + 3) * n), n, 0.0);
  }
  return status;
}

Status Material::energy(std::size_t n, std::span<const double> C, std::span<double> energy) const {
  std::vector<double> tensors(6 * n);
  std::copy_n(C.begin(), 3 * n, tensors.begin());
  std::copy_n(C.begin() + static_cast<std::ptrdiff_t>(3 * n), n, tensors.begin() + static_cast<std::ptrdiff_t>(4 * n));
  return model_.evaluate({n, tensors, parameters_, {}, {}}, {energy, {}, {}, {}, {}});
}

Status Material::on_tensors(std::size_t n, std::span<const double> C, std::span<double> first, std::span<double> second,
                            std::span<double> first_dp) const {
  thread_local Scratch scratch;
  const std::size_t parameters = first_dp.empty() ? 0 : parameters_.size();
  scratch.tensors.assign(6 * n, 0);
  scratch.stress.resize(first.empty() ? 0 : 6 * n);
  scratch.tangent.resize(second.empty() ? 0 : 36 * n);
  scratch.stress_dp.resize(6 * parameters * n);
  std::copy_n(C.begin(), 3 * n, scratch.tensors.begin());
  std::copy_n(C.begin() + static_cast<std::ptrdiff_t>(3 * n), n,
              scratch.tensors.begin() + static_cast<std::ptrdiff_t>(4 * n));
  const Status status = model_.evaluate({n, scratch.tensors, parameters_, {}, {}},
                                        {{}, scratch.stress, scratch.tangent, scratch.stress_dp, {}});
  if (!status.ok()) return status;

  // δW = ½ S : δC: ∂W/∂C_aa = S_aa/2 on the diagonal, ∂W/∂s = S_zr
  constexpr std::array<std::size_t, firsts> component{0, 1, 2, 4};
  constexpr std::array<double, firsts> factor{0.5, 0.5, 0.5, 1};
  const auto take = [&](std::span<const double> from, std::span<double> to) {
    for (std::size_t a = 0; a < firsts; ++a)
      for (std::size_t i = 0; i < n; ++i) to[a * n + i] = factor[a] * from[component[a] * n + i];
  };
  if (!first.empty()) take(scratch.stress, first);
  for (std::size_t j = 0; j < parameters; ++j)
    take(std::span(scratch.stress_dp).subspan(6 * j * n, 6 * n), first_dp.subspan(4 * j * n, 4 * n));
  // with A = 2 ∂S/∂C in tensor components: ∂²W/∂C_aa∂C_bb = A_aabb/4, ∂²W/∂C_aa∂s = A_aazr/2, ∂²W/∂s² = A_zrzr
  constexpr std::array<std::array<std::size_t, 2>, seconds> pair{
      {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}, {3, 3}, {0, 3}, {1, 3}, {2, 3}}};
  for (std::size_t k = 0; k < (second.empty() ? 0 : seconds); ++k) {
    const auto [a, b] = pair[k];
    for (std::size_t i = 0; i < n; ++i)
      second[k * n + i] = factor[a] * factor[b] * scratch.tangent[(6 * component[a] + component[b]) * n + i];
  }
  return {};
}

}  // namespace tunica::fe
