// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Fewer things to draw, and which: a report says how many were left out.
namespace tunica::report {

/// `most` of `count` places, spread evenly, always with the first and the last. All of them where that is enough.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

/// Points of a curve that keep its shape, in their order: the first, the last, and in each of the equal stretches
/// between them the lowest and the highest, so that no peak is lost. Points that are no numbers are left out. All of
/// them where `most` is enough; `most` is at least 4.
std::vector<std::size_t> shape_keeping(std::span<const double> y, std::size_t most);

}  // namespace tunica::report
