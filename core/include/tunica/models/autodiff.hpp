// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <ceres/jet.h>

#include "tunica/detail/taylor.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/energy_part.hpp"
#include "tunica/models/jet_functions.hpp"

namespace tunica {

/// The formula of a law, as kernels call it.
template <class Law, class T>
TUNICA_FOR_KERNELS inline T formula(const T& x, std::span<const T> p) {
  return Law::template energy<T>(x, p);
}

/// Evaluates ψ, ψ', ψ'' and their parameter derivatives from the formula of a law (laws.hpp) alone.
///
/// Sizes and meaning are those of ResponseBatch. Method: the formula on Taylor numbers (tunica/detail/taylor.hpp), over
/// lanes; without parameters unless their derivatives are wanted. Inlined by force: a copy that the compiler has
/// specialised would stay outside of the kernels of vector_level.hpp. Thread-safe; allocates nothing.
template <class Law>
[[gnu::always_inline]] inline void respond_by_autodiff(std::span<const double> p, const ResponseBatch& b) {
  static constexpr std::size_t n = Law::parameter_count, chunk = 64;
  const std::size_t count = b.x.size();
  const auto evaluate = [ p, &b, count ](auto zero, bool by_parameters) __attribute__((always_inline)) {
    using T = decltype(zero);
    std::array<T, n> parameters;
    for (std::size_t j = 0; j < n; ++j) parameters[j] = T::parameter(p[j], j);
    alignas(64) std::array<double, chunk> value, first, second;
    alignas(64) std::array<std::array<double, chunk>, std::tuple_size_v<decltype(zero.p)> + 1> value_dp, first_dp;
    for (std::size_t begin = 0; begin < count; begin += chunk) {
      const std::size_t m = std::min(chunk, count - begin);
      const double* const x = b.x.data() + begin;
      TUNICA_LANES
      for (std::size_t i = 0; i < m; ++i) {
        const T w = formula<Law, T>(T::argument(x[i]), parameters);
        value[i] = w.value;
        first[i] = w.x;
        second[i] = w.xx;
        for (std::size_t j = 0; j < w.p.size(); ++j) {
          value_dp[j][i] = w.p[j];
          first_dp[j][i] = w.xp[j];
        }
      }
      const auto take = [begin, m](std::span<double> out, const std::array<double, chunk>& from, std::size_t row) {
        if (!out.empty()) std::copy_n(from.data(), m, out.data() + row + begin);
      };
      take(b.value, value, 0);
      take(b.first, first, 0);
      take(b.second, second, 0);
      for (std::size_t j = 0; by_parameters && j < n; ++j) {
        take(b.value_dp, value_dp[j], j * count);
        take(b.first_dp, first_dp[j], j * count);
      }
    }
  };
  if (b.value_dp.empty() && b.first_dp.empty())
    evaluate(Taylor<0>(), false);
  else
    evaluate(Taylor<n>(), true);
}

/// The law's own respond() if it has one, else the formula.
template <class Law>
[[gnu::always_inline]] inline void respond_on_this_level(std::span<const double> p, const ResponseBatch& batch) {
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
