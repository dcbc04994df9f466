// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "settings.hpp"

namespace tunica::ceres_lm {

/// `count` points of [0, 1]^n, one a row, spread more evenly than independent ones.
///
/// latin_hypercube: each coordinate takes every one of `count` equal intervals once (McKay, Beckman, Conover,
/// Technometrics 21 (1979) 239). sobol: the Sobol' sequence (Joe & Kuo directions, as Boost has them), shifted at
/// random modulo 1 (Cranley & Patterson 1976), so that the seed matters here as well.
std::vector<double> spread_points(Sampling sampling, std::size_t count, std::size_t n, std::uint64_t seed);

}  // namespace tunica::ceres_lm
