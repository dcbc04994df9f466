// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include "shape.hpp"
#include "tunica/options.hpp"

/// The specimen, from the options of the test. Throws InputError if the options contradict each other.
namespace tunica::plane {

Shape shape_of(const Options& given);

/// "elements": [along, across], or null for the default of the shape.
std::array<std::size_t, 2> elements_of(const std::string& text, const Shape& shape);

}  // namespace tunica::plane
