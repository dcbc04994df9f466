// SPDX-License-Identifier: Apache-2.0
#include "conformance/isolated.hpp"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>

#include "conformance/captured_output.hpp"

namespace tunica::conformance {
namespace {

using ::testing::HasSubstr;

TEST(Isolated, PassesAVerdictOnAsItIs) {
  const Verdict given{"a with b", std::numeric_limits<double>::infinity(), 1e-6, "\"counter\nexample\"", "", "note"};
  const Verdict found = isolated([&] { return given; }, 60);
  EXPECT_EQ(found.compared, given.compared);
  EXPECT_EQ(found.worst, given.worst);
  EXPECT_EQ(found.tolerance, given.tolerance);
  EXPECT_EQ(found.counter_example, given.counter_example);
  EXPECT_EQ(found.note, given.note);
}

TEST(Isolated, PassesFiguresOnThatAreBarelyOnes) {
  for (const double figure : {1e-310, 5e-324, -1e-310, std::numeric_limits<double>::max()})
    EXPECT_EQ(isolated([&] { return Verdict{"a with b", figure, figure}; }, 60).worst, figure);
}

TEST(Isolated, TurnsAnExceptionIntoACounterExample) {
  EXPECT_EQ(isolated([]() -> Verdict { throw std::runtime_error("no"); }, 60).counter_example, "no");
  EXPECT_THAT(isolated([]() -> Verdict { throw 7; }, 60).counter_example, HasSubstr("no std::exception"));
}

TEST(Isolated, SurvivesACrash) {
  const auto crash = []() -> Verdict {
    std::signal(SIGTERM, SIG_DFL);  // whatever the framework of tests has set
    std::raise(SIGTERM);
    return {};
  };
  EXPECT_THAT(isolated(crash, 60).counter_example, HasSubstr("ended by signal 15"));
  EXPECT_THAT(isolated([]() -> Verdict { std::_Exit(3); }, 60).counter_example, HasSubstr("exit code 3"));
}

TEST(Isolated, EndsWhatDoesNotEnd) {
  const auto forever = []() -> Verdict {
    while (true) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  };
  EXPECT_THAT(isolated(forever, 0.2).counter_example, HasSubstr("no end after 0.2 s"));
}

TEST(Isolated, KeepsTheOutputOfACheckOffTheTerminal) {
  CapturedOutput output;
  isolated(
      [] {
        std::puts("a plugin that talks");
        std::fflush(stdout);
        return Verdict{};
      },
      60);
  EXPECT_EQ(output.text(), "");
}

TEST(CapturedOutput, IsWhatTheProcessWrites) {
  CapturedOutput output;
  std::fputs("to stdout\n", stdout);
  std::fputs("to stderr\n", stderr);
  const std::string text = output.text();
  EXPECT_THAT(text, HasSubstr("to stdout"));
  EXPECT_THAT(text, HasSubstr("to stderr"));
}

}  // namespace
}  // namespace tunica::conformance
