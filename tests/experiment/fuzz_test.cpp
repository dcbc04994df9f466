// SPDX-License-Identifier: Apache-2.0
#include "data/mutation.hpp"
#include "experiment/reading.hpp"

namespace tunica::experiment {
namespace {

struct Fuzz : testing::Reading {};

// Deterministic: seed 20260102, so there is no false alarm. Whatever is done to an experiment file, the reader refuses
// it with an InputError that names it, or gives an experiment whose input file reads as the same experiment.
TEST_F(Fuzz, DamagedExperimentFilesAreRefusedOrConsistent) {
  testing::Mutator mutate(20260102, {"{",
                                     "}",
                                     "[",
                                     "]",
                                     ":",
                                     ",",
                                     "\"",
                                     "\\",
                                     "\\u0000",
                                     "\\ud800",
                                     "//",
                                     "/*",
                                     "*/",
                                     "null",
                                     "true",
                                     "-1",
                                     "0",
                                     "1e308",
                                     "1e999",
                                     "\"\"",
                                     "{}",
                                     "[]",
                                     "\"1 kPa\"",
                                     "\"5 kPaa\"",
                                     "\"::\"",
                                     "\"fixed\": 1,",
                                     "\"share\": \"s\",",
                                     "gho",
                                     "es",
                                     "lm",
                                     ".",
                                     "\n",
                                     "[[[[[[[[",
                                     "18446744073709551615",
                                     "-9223372036854775808",
                                     "99999999999999999999999",
                                     "\xC3",
                                     "\"data\"",
                                     "\"stages\": [\"lm\"],"});
  std::size_t accepted = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = mutate(testing::design_example);
    try {
      const Experiment e = read(text);
      ++accepted;
      if (accepted % 4 == 0) {
        ASSERT_EQ(read(e.input_json).input_json, e.input_json) << text;
      }
    } catch (const InputError& error) {
      ASSERT_NE(std::string_view(error.what()).find("experiment.json: "), std::string_view::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(accepted, 50u);
  EXPECT_GT(refused, 500u);
}

}  // namespace
}  // namespace tunica::experiment
