// SPDX-License-Identifier: Apache-2.0
// A quantity and two units, a line each: converted there and back it is the same quantity, or it is refused.
#include <cmath>

#include "data/units.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest = fuzzing::text_of(data, size);
  const std::string_view quantity = fuzzing::next_line(rest), from = fuzzing::next_line(rest), to = rest;
  for (const char* base : {"kPa", "mm", "mN", "s", "deg", "1"})
    fuzzing::expect_read_or_refused(
        [&] { fuzzing::promise(std::isfinite(data::parse_quantity(quantity, base)), "a quantity is finite"); });
  fuzzing::expect_read_or_refused([&] {
    // Where the units differ by so much that the number leaves the range of a double, there is no way back.
    const double there = data::convert(1.5, from, to);
    if (!std::isnormal(there)) return;
    const double back = data::convert(there, to, from);
    // Units with a zero of their own (degC) and logarithmic ones lose digits.
    const double lost = 1e-9 * (1.5 + std::abs(there - data::convert(0, from, to)) + std::abs(there));
    fuzzing::promise(!std::isfinite(back) || std::abs(back - 1.5) < std::max(1e-6, lost),
                     "a conversion has a way back");
  });
  (void)data::is_unit(from);
  return 0;
}
