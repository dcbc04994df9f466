// SPDX-License-Identifier: Apache-2.0
// By a clock of the test's own: the speed of the machine decides nothing.
#include "calibration/timing.hpp"

#include <gtest/gtest.h>

using tunica::calibration::median_time;

namespace {

/// Calls that take what they are told, by their number from 0.
struct Calls {
  double time = 17;
  int count = 0;

  template <class Duration>
  double median(const Duration& of_call) {
    return median_time([&] { time += of_call(count++); }, [&] { return time; });
  }
};

}  // namespace

TEST(Timing, TellsTheMedian) {
  Calls calls;
  // Of 1001 the first 290 and the last 291 take long, so that the median does, though the middle one does not.
  EXPECT_NEAR(calls.median([](int call) { return call < 290 || call > 709 ? 5e-5 : 1e-6; }), 5e-5, 1e-12);
  EXPECT_EQ(calls.count, 1001) << "a thousand are enough";
  EXPECT_NEAR(Calls().median([](int call) { return call == 0 ? 0.1 : 1e-4; }), 1e-4, 1e-12);
}

TEST(Timing, TakesAFifthOfASecondAtMost) {
  Calls calls;
  EXPECT_NEAR(calls.median([](int) { return 0.0101; }), 0.0101, 1e-12);
  EXPECT_EQ(calls.count, 20);
}

TEST(Timing, CallsOnceWhateverTheClockDoes) {
  Calls calls;
  EXPECT_EQ(calls.median([](int) { return 3600.0; }), 3600);
  EXPECT_EQ(calls.count, 1);
}
