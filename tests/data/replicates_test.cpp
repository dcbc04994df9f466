// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include <gtest/gtest.h>

#include "data/strip.hpp"

namespace tunica::data {
namespace {

using testing::read_strips;

std::string refusal(const std::vector<std::string>& texts) {
  return testing::message_of<InputError>([&] { read_strips(texts); });
}

TEST(Replicates, WithTheSameAbscissaeAreAveragedAndKept) {
  const Dataset strip = read_strips({"stretch,stress [kPa]\n1,0\n1.1,2\n", "stretch,stress [Pa]\n1,1000\n1.1,3000\n"});
  EXPECT_EQ(strip.channels[0].values, (std::vector<double>{0.5, 2.5}));
  EXPECT_EQ(strip.channels[0].replicates, (std::vector<std::vector<double>>{{0, 2}, {1, 3}}));
  EXPECT_EQ(strip.sha256.size(), 2u);
  EXPECT_TRUE(strip.warnings.empty());
}

TEST(Replicates, WithOtherAbscissaeAreInterpolatedWithAWarning) {
  const Dataset strip =
      read_strips({"stretch,stress [kPa]\n1,0\n1.1,2\n1.2,4\n", "stretch,stress [kPa]\n1,0\n1.05,2\n1.15,6\n"});
  ASSERT_EQ(strip.count, 2u) << "1.2 lies beyond the second replicate";
  EXPECT_NEAR(strip.channels[0].replicates[1][1], 4, 1e-12);
  EXPECT_NEAR(strip.channels[0].values[1], 3, 1e-12);
  ASSERT_EQ(strip.warnings.size(), 2u);
  EXPECT_NE(strip.warnings[0].find("strip.csv: 1 of 3 rows are left out because some replicate does not reach them"),
            std::string::npos);
  EXPECT_EQ(strip.warnings[1],
            "strip2.csv: the abscissae differ from those of strip.csv; its rows are interpolated linearly there.");
  EXPECT_EQ(strip.lines, (std::vector<std::size_t>{2, 3}));
}

TEST(Replicates, ThatCannotBeInterpolatedAreRefused) {
  EXPECT_NE(refusal({"stretch,stress [kPa]\n1,0\n1.1,2\n", "stretch,stress [kPa]\n1,0\n1.2,2\n1.1,1\n"})
                .find("strip2.csv, line 4, column 1 ('stretch'): replicates with other abscissae are interpolated"),
            std::string::npos);
  EXPECT_NE(refusal({"stretch,stress [kPa]\n1,0\n1.1,2\n", "stretch,stress [kPa]\n1.5,0\n1.6,2\n"})
                .find("strip.csv: no row of this file lies where all replicates have measured"),
            std::string::npos);
}

TEST(Replicates, NameTheFileThatIsWrong) {
  EXPECT_NE(refusal({"stretch,stress [kPa]\n1,0\n", "stretch,stress [kPa]\n1,x\n"})
                .find("strip2.csv, line 2, column 2 ('stress'): found 'x'"),
            std::string::npos);
}

// The measured strips that the examples fit.
TEST(Dataset, ReadsTheRealAortaStrips) {
  const std::filesystem::path file = TUNICA_SOURCE_DIR "/examples/lamb_aorta/circumferential.csv";
  DataRequest request;
  request.files = {file};
  request.columns = {{"stretch", "stretch"}, {"stress", "stress"}};
  request.rows = {0, 240, 6};
  const Dataset strip = read_dataset(request, testing::strip_observables());
  EXPECT_EQ(strip.count, 40u);
  EXPECT_EQ(strip.abscissae[0].second[0], 1);
  EXPECT_EQ(strip.lines[1], 13u);
  EXPECT_TRUE(strip.warnings.empty());
}

}  // namespace
}  // namespace tunica::data
