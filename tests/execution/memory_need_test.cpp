// SPDX-License-Identifier: Apache-2.0
#include "execution/memory_need.hpp"

#include <limits>

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "execution/laboratory.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::HasSubstr;

namespace {

constexpr double GiB = 1024.0 * 1024 * 1024;

double sum_of(const std::vector<execution::MemoryShare>& need) {
  double sum = 0;
  for (const auto& share : need) sum += share.bytes;
  return sum;
}

}  // namespace

TEST(MemoryNeed, GrowsWithWhatIsCounted) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk");
  const double small = sum_of(execution::memory_need(laboratory.plan(), 1));
  EXPECT_LT(small, 1e6) << "a small experiment fits everywhere";
  EXPECT_GT(sum_of(execution::memory_need(laboratory.plan(), 1000)), small) << "threads";
  laboratory.bench.experiment.analysis.bootstrap_draws = 1000000;
  EXPECT_GT(sum_of(execution::memory_need(laboratory.plan(), 1)), 1e8) << "draws";
  laboratory.bench.experiment.analysis.bootstrap_draws = 0;
  laboratory.add_run("walk", 100, 100000);
  EXPECT_GT(sum_of(execution::memory_need(laboratory.plan(), 1)), 1e8) << "realisations";
}

TEST(MemoryNeed, IsRefusedWithItsFigureBeforeTheStart) {
  trial::Laboratory laboratory;
  laboratory.add_run("walk", 100, 100000);
  const auto need = execution::memory_need(laboratory.plan(), 1);
  EXPECT_NO_THROW(execution::refuse_excess(need, 4 * GiB));
  const std::string message = trial::message_of<InputError>([&] { execution::refuse_excess(need, 0.1 * GiB); });
  EXPECT_THAT(message, HasSubstr("the experiment needs about 982 MiB of memory, most of it for 100000 realisations ("));
  EXPECT_THAT(message, HasSubstr("and this process may have 102 MiB; lower \"realisations\" of the runs"));
}

TEST(MemoryNeed, TheLimitIsThatOfTheMachineOrLess) {
  EXPECT_GT(execution::memory_limit(), 0);
  EXPECT_LT(execution::memory_limit(), std::numeric_limits<double>::infinity());
}
