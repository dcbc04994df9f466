// SPDX-License-Identifier: Apache-2.0
// An experiment file: refused, or an experiment whose file with all defaults reads as the same experiment.
#include "experiment/design_example.hpp"
#include "experiment/experiment.hpp"
#include "experiment/fake_catalogue.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool written = [] {
    (void)fuzzing::folder().write("circ.csv", testing::circ_csv);
    (void)fuzzing::folder().write("inflation.csv", testing::inflation_csv);
    return true;
  }();
  (void)written;
  const auto read = [](std::string_view text) {
    return experiment::read_experiment(fuzzing::folder().write("experiment.json", text), testing::fake_catalogue());
  };
  fuzzing::expect_read_or_refused([&] {
    const std::string complete = read(fuzzing::text_of(data, size)).input_json;
    std::string again;
    try {
      again = read(complete).input_json;
    } catch (const InputError& problem) {
      std::fprintf(stderr, "%s\n", problem.what());
    }
    fuzzing::promise(again == complete, "what is written with all defaults reads as the same experiment");
  });
  return 0;
}
