// SPDX-License-Identifier: Apache-2.0
// What rows say of the past of a specimen, and rows put in an order of their own.
#include "data/loading_path.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/strip.hpp"

namespace tunica::data {
namespace {

using testing::Mapping;
using testing::read_strip;
using testing::strip_observables;

constexpr const char* loop = "stretch,stress [kPa]\n1,0\n1.25,5\n1.5,20\n1.2,3\n1.02,0.1\n";

DataRequest with(Order order, bool sorted = false) {
  DataRequest request;
  request.order = order;
  request.sorted = sorted;
  return request;
}

Past past(const char* text, const DataRequest& request = {}, const Mapping& columns = {}) {
  return past_of(read_strip(text, columns, request), strip_observables());
}

TEST(LoadingPath, BeginsUnderLoadWhereTheClockRanBefore) {
  const Mapping timed = {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}};
  const auto start = [&](const char* text) { return loaded_start_of(read_strip(text, timed), strip_observables()); };
  const auto found = start("stretch,stress [kPa],time [min]\n1.4,9,2\n1.4,8,3\n1.4,7,9\n");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->abscissa, "stretch");
  EXPECT_EQ(found->value, 1.4);
  EXPECT_EQ(found->time, 120);
  EXPECT_FALSE(start("stretch,stress [kPa],time [s]\n1.4,9,1\n1.4,8,3\n1.4,7,9\n")) << "a first sample";
  EXPECT_FALSE(start("stretch,stress [kPa],time [s]\n1.4,9,0\n1.4,8,3\n1.4,7,9\n")) << "a jump";
  EXPECT_FALSE(start("stretch,stress [kPa],time [s]\n1.01,1,2\n1.4,9,3\n1.4,8,9\n")) << "hardly loaded";
  EXPECT_FALSE(loaded_start_of(read_strip("stretch,stress [kPa]\n1.4,9\n1.4,8\n", {}), strip_observables()))
      << "no clock";
}

TEST(LoadingPath, IsKnownWhereTheFileOrTimeSaysIt) {
  EXPECT_EQ(past(loop), Past::order_unknown);
  EXPECT_EQ(past(loop, with(Order::loading)), Past::known);
  const Mapping timed = {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}};
  EXPECT_EQ(past("stretch,stress [kPa],time [s]\n1,0,0\n1.2,5,1\n1.1,1,2\n", {}, timed), Past::known);
  EXPECT_EQ(past("stretch,stress [kPa],time [s]\n1,0,3\n1.2,5,3\n1.1,1,3\n", {}, timed), Past::order_unknown);
  DataRequest rate;
  rate.time_rate = 0.01;
  EXPECT_EQ(past(loop, rate), Past::known);
}

TEST(LoadingPath, HasAnUnknownBeginningWhereItStartsFarFromRestAndUnloads) {
  const auto declared = with(Order::loading);
  EXPECT_EQ(past("stretch,stress [kPa]\n1.5,20\n1.3,9\n1.1,2\n1.5,19\n", declared), Past::starts_unloading);
  EXPECT_EQ(past("stretch,stress [kPa]\n1.4,15\n1.5,20\n1.3,9\n1.1,2\n", declared), Past::known);  // goes on loading
  EXPECT_EQ(past("stretch,stress [kPa]\n1.5,20\n1.5,19\n1.5,18\n", declared), Past::known);        // a hold
  EXPECT_EQ(past("stretch,stress [kPa]\n1.5,20\n1.5,18\n1.5,17\n1.5,16\n1.2,5\n1.1,2\n", declared), Past::known)
      << "a jump, a hold, then unloading";
  EXPECT_EQ(past("stretch,stress [kPa]\n0.6,-20\n0.8,-9\n0.9,-2\n", declared), Past::starts_unloading);
  EXPECT_EQ(past("stretch,stress [kPa]\n1.1,2\n1,0\n1.5,20\n1,0\n", declared), Past::known);  // begins near rest
}

TEST(LoadingPath, IsToldInWords) {
  EXPECT_EQ(path_words(read_strip(loop), strip_observables()),
            "stretch 1 → 1.5 → 1.02, 1 cycle, 5 rows; starts at rest");
  EXPECT_THAT(path_words(read_strip("stretch,stress [kPa]\n1.045,1\n9,20\n18.09,60\n"), strip_observables()),
              ::testing::HasSubstr("starts near rest"));
  EXPECT_EQ(path_words(read_strip("stretch,stress [kPa]\n1.5,20\n1.3,9\n1.1,2\n"), strip_observables()),
            "stretch 1.5 → 1.1, 3 rows; starts far from rest and unloads");
  const std::vector<double> cycles = {1, 1.5, 1.1, 1.5, 1.1, 1.5, 1.49, 1.5};
  EXPECT_EQ(turning_points(cycles), (std::vector<double>{1, 1.5, 1.1, 1.5, 1.1, 1.5}));
  EXPECT_EQ(path_drawing(cycles, 60), "▁█▂█▂███");
}

TEST(LoadingPath, SortedRowsAreTheSameWhateverTheirOrderWas) {
  const auto sorted = with(Order::unknown, true);
  const Dataset one = read_strip(loop, {}, sorted);
  const Dataset other =
      read_strip("stretch,stress [kPa]\n1.02,0.1\n1.2,3\n1.5,20\n1.25,5\n1,0\n", {}, sorted);  // reversed
  EXPECT_EQ(one.abscissae.front().second, (std::vector<double>{1, 1.02, 1.2, 1.25, 1.5}));
  EXPECT_EQ(one.abscissae, other.abscissae);
  EXPECT_EQ(one.channels.front().values, (std::vector<double>{0, 0.1, 3, 5, 20}));
  EXPECT_EQ(one.channels.front().values, other.channels.front().values);
  EXPECT_EQ(one.file_rows, (std::vector<std::size_t>{0, 4, 3, 1, 2}));
  EXPECT_EQ(other.file_rows, (std::vector<std::size_t>{4, 0, 1, 3, 2}));
  EXPECT_EQ(one.lines, (std::vector<std::size_t>{2, 6, 5, 3, 4}));
}

// Sorted, loading and unloading would be neighbours, and their difference would look like noise.
TEST(LoadingPath, RowsThatRunToAndFroStandAsTheyWereMeasured) {
  const auto is_sorted = [](const std::vector<double>& x) { return std::is_sorted(x.begin(), x.end()); };
  const auto table = [](const std::vector<int>& steps) {
    std::string text = "stretch,stress [kPa]\n";
    for (const int step : steps) text += fmt::format("{},{}\n", 1 + 0.1 * step, 10 * step);
    return read_strip(text, {}, with(Order::unknown, true)).abscissae.front().second;
  };
  EXPECT_FALSE(is_sorted(table({0, 1, 2, 3, 4, 5, 4, 3, 2, 1, 0})));
  EXPECT_TRUE(is_sorted(table({0, 5, 1, 4, 2, 3, 2, 4, 1, 5, 0}))) << "in any order";
  EXPECT_TRUE(is_sorted(table({0, 1, 2, 3, 4, 5, 0, 1, 2, 3, 4}))) << "a second curve is no way back";
}

}  // namespace
}  // namespace tunica::data
