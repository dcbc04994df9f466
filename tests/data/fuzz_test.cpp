// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <gtest/gtest.h>

#include "data/mutation.hpp"
#include "data/strip.hpp"

namespace tunica::data {
namespace {

// Deterministic: seed 20260101, so there is no false alarm. Whatever is done to a file, the reader refuses it with an
// InputError that names it, or gives a data set whose parts fit together.
TEST(Fuzz, DamagedDataFilesAreRefusedOrConsistent) {
  const std::string comma =
      "# a strip\nspecimen,time [s],stretch [-],stress [kPa],note\nA,0,1,0,x\nA,1,1.1,2.5,\"y, "
      "z\"\nB,2,1.2,4,\nA,3,1.3,7.25,q\n";
  const std::string semicolon =
      "specimen;time [min];stretch [%];stress [MPa]\r\nA;0;100;0\r\nA;1;110;0,0025\r\nA;1;120;0,004\r\n";
  const std::string blank = "specimen time [s] stretch stress [mmHg]\nA 0 1 0\nA 1 1.1 2.5e1\nA 2 1.2 4e1\n";
  testing::Mutator mutate(20260101, {",",
                                     ";",
                                     "\t",
                                     "\"",
                                     "\n",
                                     "\r",
                                     "#",
                                     "[",
                                     "]",
                                     "[kPaa]",
                                     "[m",
                                     "nan",
                                     "inf",
                                     "1e999",
                                     "-1",
                                     "1,5",
                                     "0",
                                     "",
                                     " ",
                                     "\xEF\xBB\xBF",
                                     std::string(1, '\0'),
                                     "stress",
                                     "1e-999",
                                     "99999999999999999999"});
  std::size_t read = 0, refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const std::string text = mutate(i % 3 == 0 ? comma : i % 3 == 1 ? semicolon : blank);
    DataRequest request;
    if (i % 2 == 0) request.where = {{"specimen", "A"}};
    if (i % 5 == 0) request.rows = {i % 3, {}, 2};
    testing::Mapping columns = {{"stretch", "stretch"}, {"stress", "stress"}};
    if (i % 4 == 0)
      columns.emplace_back("time", "time");
    else if (i % 4 == 1)
      request.time_rate = 0.01;
    try {
      const Dataset strip = i % 7 == 0 ? testing::read_strips({comma, text}, columns, request)
                                       : testing::read_strip(text, columns, request);
      ASSERT_GT(strip.count, 0u);
      ASSERT_EQ(strip.lines.size(), strip.count);
      for (const Channel& channel : strip.channels) {
        ASSERT_EQ(channel.values.size(), strip.count);
        for (const double value : channel.values) ASSERT_TRUE(std::isfinite(value)) << text;
        for (const auto& replicate : channel.replicates) ASSERT_EQ(replicate.size(), strip.count);
      }
      for (const auto& [name, values] : strip.abscissae) {
        ASSERT_EQ(values.size(), strip.count);
        for (const double value : values) ASSERT_TRUE(std::isfinite(value) && value > 0) << text;
      }
      ASSERT_TRUE(strip.time.empty() || strip.time.size() == strip.count);
      ++read;
    } catch (const InputError& error) {
      ASSERT_NE(std::string_view(error.what()).find("strip"), std::string_view::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(read, 300u);
  EXPECT_GT(refused, 300u);
}

}  // namespace
}  // namespace tunica::data
