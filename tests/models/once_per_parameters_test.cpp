// SPDX-License-Identifier: Apache-2.0
#include "tunica/models/once_per_parameters.hpp"

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace tunica::testing::once_per_parameters_test {
namespace {

using Values = std::span<const double>;

TEST(OncePerParameters, MakesAValueOnceForASetOfParameters) {
  int made = 0;
  const OncePerParameters<double> sum([&made](Values p) { return ++made, p[0] + p[1]; });
  const std::vector<double> first{1, 2}, second{1, 3};
  for (int k = 0; k < 3; ++k) {
    EXPECT_EQ(*sum(first), 3);
    EXPECT_EQ(*sum(second), 4);
  }
  EXPECT_EQ(made, 2);
}

TEST(OncePerParameters, WhatWasHandedOutOutlivesWhatIsKept) {
  const OncePerParameters<std::vector<double>> copy([](Values p) { return std::vector<double>(p.begin(), p.end()); });
  const auto held = copy(std::vector<double>{0.5});
  for (int k = 1; k <= 100; ++k) (void)copy(std::vector<double>{static_cast<double>(k)});
  EXPECT_EQ(*held, std::vector<double>{0.5});
  EXPECT_EQ(*copy(std::vector<double>{0.5}), *held);
}

TEST(OncePerParameters, ConcurrentCallsGetTheirOwnValue) {
  const OncePerParameters<double> square([](Values p) { return p[0] * p[0]; });
  std::atomic<int> wrong = 0;
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int k = 0; k < 2000; ++k) {
        const std::vector<double> p{static_cast<double>(k % 7 + 100 * t)};
        wrong += *square(p) != p[0] * p[0] ? 1 : 0;
      }
    });
  threads.clear();  // joins
  EXPECT_EQ(wrong, 0);
}

TEST(OncePerParameters, AFailureIsNotKept) {
  bool fails = true;
  const OncePerParameters<int> one([&fails](Values) { return fails ? throw std::runtime_error("no weights") : 1; });
  EXPECT_THROW((void)one(std::vector<double>{1}), std::runtime_error);
  fails = false;
  EXPECT_EQ(*one(std::vector<double>{1}), 1);
}

}  // namespace
}  // namespace tunica::testing::once_per_parameters_test
