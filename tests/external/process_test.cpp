// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using namespace tunica::external;
using ::testing::HasSubstr;

namespace {

Command shell(const trial::Folder& folder, const std::string& script, double seconds = 20) {
  return {{"/bin/sh", "-c", script}, folder.path(), folder.path() / "output.txt", {{"GIVEN", "seven"}}, seconds, 0};
}

}  // namespace

TEST(Process, RunsInItsFolderWithItsEnvironment) {
  const trial::Folder folder;
  const Ending ending = run(shell(folder, "pwd; echo $GIVEN; echo wrong >&2; exit 4"));
  EXPECT_TRUE(ending.started);
  EXPECT_EQ(ending.code, 4);
  EXPECT_FALSE(ending.good());
  EXPECT_EQ(last_lines(folder.path() / "output.txt", 3), folder.path().string() + " | seven | wrong");
  EXPECT_EQ(last_lines(folder.path() / "output.txt", 1), "wrong");
}

TEST(Process, AtTheLimitTheWholeGroupIsKilled) {
  const trial::Folder folder;
  const Ending ending = run(shell(folder, "sleep 50 & echo $! > child; sleep 50", 0.3));
  EXPECT_TRUE(ending.timed_out);
  EXPECT_THAT(ending.words, HasSubstr("time limit of 0.3 s"));
  const pid_t child = std::stoi(trial::text_of(folder.path() / "child"));
  bool gone = false;  // the grandchild is reaped by init, some time after it was killed
  for (int k = 0; k < 200 && !gone; ++k) {
    gone = kill(child, 0) != 0 ||
           trial::text_of("/proc/" + std::to_string(child) + "/stat").find(") Z") != std::string::npos;
    if (!gone) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(gone);
}

TEST(Process, ASignalIsNamed) {
  const trial::Folder folder;
  const Ending ending = run(shell(folder, "kill -SEGV $$"));
  EXPECT_EQ(ending.signal, SIGSEGV);
  EXPECT_THAT(ending.words, HasSubstr("SEGV"));
}

TEST(Process, MemoryIsLimited) {
  const trial::Folder folder;
  Command command = shell(folder, "exec " TUNICA_PYTHON " -c \"x = bytearray(400 << 20); print('had it')\"");
  EXPECT_TRUE(run(command).good());
  command.mebibytes = 200;
  EXPECT_FALSE(run(command).good());
  EXPECT_THAT(last_lines(command.output, 1), HasSubstr("MemoryError"));
}

TEST(Process, SeveralRunSideBySide) {
  const trial::Folder folder;
  std::vector<std::jthread> threads;
  std::vector<Ending> endings(8);
  for (std::size_t k = 0; k < endings.size(); ++k)
    threads.emplace_back([&, k] {
      Command command = shell(folder, "exit " + std::to_string(k));
      command.output = folder.path() / std::to_string(k);
      endings[k] = run(command);
    });
  threads.clear();
  for (std::size_t k = 0; k < endings.size(); ++k) EXPECT_EQ(endings[k].code, static_cast<int>(k));
}

TEST(Process, ProgramsAreFoundInPathOrBelowTheFolder) {
  const trial::Folder folder;
  const auto file = folder.write("solver", "#!/bin/sh\n");
  EXPECT_THAT(trial::message_of<InputError>([&] { (void)program_file("./solver", folder.path()); }),
              HasSubstr("chmod +x"));
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  EXPECT_EQ(program_file("./solver", folder.path()), file);
  EXPECT_EQ(program_file("sh", folder.path()).filename(), "sh");
}
