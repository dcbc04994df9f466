// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <ceres/jet.h>

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

/// Evaluates a law by its own respond() if it has one, else from its formula.
template <class Law>
void respond(std::span<const double> p, const ResponseBatch& batch) {
  if constexpr (requires { Law::respond(p, batch); }) {
    Law::respond(p, batch);
  } else {
    respond_by_autodiff<Law>(p, batch);
  }
}

}  // namespace tunica
