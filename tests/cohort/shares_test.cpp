// SPDX-License-Identifier: Apache-2.0
#include "cohort/shares.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::cohort {
namespace {

TEST(Shares, AreDisjointAndTogetherAll) {
  for (const std::size_t of : {1U, 2U, 7U, 30U})
    for (std::size_t specimen = 0; specimen < 23; ++specimen) {
      std::size_t holders = 0;
      for (std::size_t part = 1; part <= of; ++part) holders += Share{part, of}.holds(specimen) ? 1 : 0;
      EXPECT_EQ(holders, 1U) << "specimen " << specimen << " of " << of << " shares";
    }
}

TEST(Shares, AreWrittenAsKOfN) {
  EXPECT_EQ(parse_share("2/7").part, 2U);
  EXPECT_EQ(parse_share("2/7").of, 7U);
  for (const char* wrong : {"", "2", "0/7", "8/7", "2/", "/7", "2/7x", "-1/7", "2 / 7", "a/b"})
    EXPECT_THAT(testing::message_of<InputError>([&] { parse_share(wrong); }),
                ::testing::HasSubstr("expected k/N with 1 ≤ k ≤ N"))
        << wrong;
}

}  // namespace
}  // namespace tunica::cohort
