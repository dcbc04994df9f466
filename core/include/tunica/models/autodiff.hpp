// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <ceres/jet.h>

#include "tunica/detail/vector_level.hpp"
#include "tunica/energy_part.hpp"
#include "tunica/models/jet_functions.hpp"

namespace tunica {

/// Evaluates ψ, ψ', ψ'' and their parameter derivatives from the formula of a law (laws.hpp) alone.
///
/// Sizes and meaning are those of ResponseBatch. Method: a jet over (x; p) inside a jet over x. It costs several times
/// as much as derivatives by hand. Thread-safe; allocates nothing.
template <class Law>
void respond_by_autodiff(std::span<const double> p, const ResponseBatch& b) {
  constexpr int n = static_cast<int>(Law::parameter_count);
  using Inner = ceres::Jet<double, 1 + n>;  // derivative by x, then by each p
  using Outer = ceres::Jet<Inner, 1>;       // second derivative by x
  std::array<Outer, Law::parameter_count> parameters;
  for (int j = 0; j < n; ++j) parameters[j] = Outer(Inner(p[j], 1 + j));
  const std::size_t count = b.x.size();
  for (std::size_t i = 0; i < count; ++i) {
    Outer x(Inner(b.x[i], 0));
    x.v[0] = Inner(1.0);
    const Outer w = Law::template energy<Outer>(x, std::span<const Outer>(parameters));
    if (!b.value.empty()) b.value[i] = w.a.a;
    if (!b.first.empty()) b.first[i] = w.a.v[0];
    if (!b.second.empty()) b.second[i] = w.v[0].v[0];
    for (int j = 0; j < n; ++j) {
      if (!b.value_dp.empty()) b.value_dp[j * count + i] = w.a.v[1 + j];
      if (!b.first_dp.empty()) b.first_dp[j * count + i] = w.v[0].v[1 + j];
    }
  }
}

/// The law's own respond() if it has one, else the formula.
template <class Law>
void respond_on_this_level(std::span<const double> p, const ResponseBatch& batch) {
  if constexpr (requires { Law::respond(p, batch); }) {
    Law::respond(p, batch);
  } else {
    respond_by_autodiff<Law>(p, batch);
  }
}

/// Evaluates a law on the vector level of this library. A value does not depend on its place: a batch that does not
/// fill whole vectors is filled up with its last point.
template <class Law>
void respond(std::span<const double> p, const ResponseBatch& batch) {
  const std::size_t n = batch.x.size(), width = detail::lanes_of(detail::vector_level());
  if (n % width == 0) {
    detail::vectorised([p, &batch] { respond_on_this_level<Law>(p, batch); });
    return;
  }
  constexpr std::size_t chunk = 32, rows = Law::parameter_count;
  std::array<double, chunk> x, value, first, second;
  std::array<double, chunk * rows> value_dp, first_dp;
  for (std::size_t begin = 0; begin < n; begin += chunk) {
    const std::size_t m = std::min(chunk, n - begin), filled = (m + width - 1) / width * width;
    for (std::size_t i = 0; i < filled; ++i) x[i] = batch.x[begin + std::min(i, m - 1)];
    const auto wanted = [filled](std::span<double> out, double* row, std::size_t count) {
      return std::span<double>(row, out.empty() ? 0 : count * filled);
    };
    const ResponseBatch whole{{x.data(), filled},
                              wanted(batch.value, value.data(), 1),
                              wanted(batch.first, first.data(), 1),
                              wanted(batch.second, second.data(), 1),
                              wanted(batch.value_dp, value_dp.data(), rows),
                              wanted(batch.first_dp, first_dp.data(), rows)};
    detail::vectorised([p, &whole] { respond_on_this_level<Law>(p, whole); });
    const auto take = [=](std::span<double> out, const double* from, std::size_t count) {
      for (std::size_t j = 0; !out.empty() && j < count; ++j)
        std::copy_n(from + j * filled, m, out.data() + j * n + begin);
    };
    take(batch.value, value.data(), 1);
    take(batch.first, first.data(), 1);
    take(batch.second, second.data(), 1);
    take(batch.value_dp, value_dp.data(), rows);
    take(batch.first_dp, first_dp.data(), rows);
  }
}

}  // namespace tunica
