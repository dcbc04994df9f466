// SPDX-License-Identifier: Apache-2.0
// result.json as a file of parameters, and the record that a shard leaves of a specimen: refused or understood.
#include <cmath>

#include "calibration/fakes.hpp"
#include "cohort/record.hpp"
#include "comparison/parameter_file.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

namespace {

const assembly::Assembly& parabola() {
  static fakes::Bench& bench = *[] {
    auto* const made = new fakes::Bench();
    made->add_test("curve", {0, 0.5, 1}, {2, 3, 6});
    return made;
  }();
  static const assembly::Assembly one = bench.assemble();
  return one;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(fuzzing::text_of(data, size));
  const auto file = fuzzing::folder().write("result.json", text);
  fuzzing::expect_read_or_refused([&] {
    for (const double value : comparison::read_parameters(file, "m", "", parabola()).first)
      fuzzing::promise(std::isfinite(value), "a parameter is finite");
  });
  if (const auto record = cohort::record_of(text)) {
    const std::string written = cohort::to_json(*record);
    const auto again = cohort::record_of(written);
    fuzzing::promise(again && cohort::to_json(*again) == written, "a record reads back");
  }
  return 0;
}
