// SPDX-License-Identifier: Apache-2.0
#include "execution/progress.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "execution/laboratory.hpp"
#include "text/wrapping.hpp"

using namespace tunica;
using execution::Meter;
using execution::Progress;

TEST(Progress, CountsAndKeepsTheBestSuccess) {
  Meter meter;
  const std::vector<double> none;
  const Status ok, failed = Status::failed("no");
  meter.count({0, none, 5, none, ok, 0});
  meter.count({1, none, 1, none, failed, 0});
  meter.count({2, none, 4, none, ok, 0});
  EXPECT_EQ(meter.evaluations, 3u);
  EXPECT_EQ(meter.best, 4);
}

TEST(Progress, ShowsShareRateBestAndTimeLeft) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 1000, 2);
  const auto plan = laboratory.plan();
  std::vector<Meter> meters(2);
  meters[0].evaluations = 1000;
  meters[0].best = 2.5;
  meters[0].finished = true;
  meters[1].evaluations = 500;
  meters[1].running = true;
  const Progress progress(Progress::Style::lines, plan, meters);
  EXPECT_EQ(progress.text(3), " 75 %  1/2 searches  500 /s  m/walk: best 2.5  max 0:01 left");
}

TEST(Progress, ShortensTheNameOfTheRunBeforeAnyFigure) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 1000, 2);
  auto plan = laboratory.plan();
  plan.runs[0].label = std::string(90, 'm');
  std::vector<Meter> meters(2);
  meters[0].evaluations = 500;
  meters[0].best = 2.5;
  meters[0].running = true;
  const Progress progress(Progress::Style::lines, plan, meters);
  EXPECT_EQ(progress.text(1, 79),
            " 25 %  0/2 searches  500 /s  " + std::string(24, 'm') + "…: best 2.5  max 0:03 left");
  EXPECT_EQ(text::columns(progress.text(1, 79)), 79u);
  EXPECT_EQ(progress.text(1, 50), " 25 %  0/2 searches  500 /s  best 2.5  max 0:03 left");
}
