// SPDX-License-Identifier: Apache-2.0
#include "process.hpp"

#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "execution/folder.hpp"
#include "external/gone.hpp"
#include "program.hpp"
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
  EXPECT_TRUE(trial::is_gone(std::stoi(trial::text_of(folder.path() / "child"))));
}

TEST(Process, AnInterruptEndsTheWholeGroup) {
  const trial::Folder folder;
  Command command = shell(folder, "sleep 50 & echo $! > child; sleep 50", 40);
  command.interrupted = [&] { return std::filesystem::exists(folder.path() / "child"); };
  const Ending ending = run(command);
  EXPECT_TRUE(ending.interrupted);
  EXPECT_FALSE(ending.timed_out);
  EXPECT_TRUE(trial::is_gone(std::stoi(trial::text_of(folder.path() / "child"))));
}

// Of kill -9 nothing can be caught: the keeper of the program sees that its parent is gone.
TEST(Process, WhereThisProcessIsKilledItsProgramsAreToo) {
  const trial::Folder folder, scratch;
  const pid_t killed = fork();
  if (killed == 0) {
    Command command = shell(folder, "sleep 50 & echo $! > child.part; mv child.part child; sleep 50", 40);
    command.discarded = scratch.path() / "run";
    std::filesystem::create_directories(command.discarded / "below");
    (void)run(command);
    _exit(0);
  }
  for (int k = 0; k < 1000 && !std::filesystem::exists(folder.path() / "child"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(killed, SIGKILL);
  waitpid(killed, nullptr, 0);
  EXPECT_TRUE(trial::is_gone(std::stoi(trial::text_of(folder.path() / "child"))));
  for (int k = 0; k < 1000 && std::filesystem::exists(scratch.path() / "run"); ++k)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "run"));
}

TEST(Process, WhyAProgramCannotBeStartedIsSaid) {
  const trial::Folder folder;
  const auto file = folder.write("solver", "#!/no/such/interpreter\n");
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  Command command = shell(folder, "");
  command.words = {file.string()};
  const Ending ending = run(command);
  EXPECT_FALSE(ending.started);
  EXPECT_EQ(ending.words, "could not be started: No such file or directory");
  command.folder = folder.path() / "nowhere";
  EXPECT_THAT(run(command).words, HasSubstr("in its scratch folder: No such file"));
}

// A host such as Python ignores SIGPIPE; a program that inherits this does not notice that its reader is gone.
TEST(Process, SignalsAreThoseOfAShell) {
  const trial::Folder folder;
  const auto before = std::signal(SIGPIPE, SIG_IGN);
  EXPECT_TRUE(run(shell(folder, "grep -E '^SigIgn:.0+$' /proc/self/status")).good());
  std::signal(SIGPIPE, before);
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
