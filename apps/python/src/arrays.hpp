// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include "tunica/error.hpp"

namespace tunica::python {

/// What numpy hands over is converted to doubles in a row-major array.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

inline std::span<const double> span_of(const Array& array) {
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// A vector of this length, or an InputError that names it.
inline std::span<const double> vector_of(const Array& array, std::size_t count, const char* what) {
  if (static_cast<std::size_t>(array.size()) != count || array.ndim() > 1)
    throw InputError(fmt::format("{}: found {} numbers in {} dimensions, expected a vector of {}", what, array.size(),
                                 array.ndim(), count));
  return span_of(array);
}

inline Array array_of(std::span<const double> values) {
  Array array(static_cast<pybind11::ssize_t>(values.size()));
  std::ranges::copy(values, array.mutable_data());
  return array;
}

inline Array matrix_of(std::span<const double> values, std::size_t rows, std::size_t columns) {
  Array array({static_cast<pybind11::ssize_t>(rows), static_cast<pybind11::ssize_t>(columns)});
  std::ranges::copy(values, array.mutable_data());
  return array;
}

}  // namespace tunica::python
