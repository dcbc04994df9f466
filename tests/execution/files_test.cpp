// SPDX-License-Identifier: Apache-2.0
#include "execution/files.hpp"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <iterator>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include "execution/folder.hpp"
#include "execution/run_directory.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::AppendFile;
using execution::WriteFailure;
using ::testing::HasSubstr;

TEST(Files, AreReplacedWholeOrNotAtAll) {
  const trial::Folder folder;
  const auto file = folder.write("checkpoint.json", "old");
  execution::write_atomically(file, "new");
  EXPECT_EQ(trial::text_of(file), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "a temporary file is left";
  EXPECT_THROW(execution::write_atomically(folder.path() / "missing" / "file", "text"), WriteFailure);
}

TEST(Files, KnowWhenAnotherOneHasTakenTheirPlace) {
  const trial::Folder folder;
  AppendFile file(folder.path() / "rows"), other(folder.path() / "other");
  file.append("one\n");
  const int spare = ::dup(file.descriptor());
  ASSERT_GE(::dup2(other.descriptor(), file.descriptor()), 0);
  EXPECT_THAT(trial::message_of<WriteFailure>([&] { file.append("two\n"); }),
              HasSubstr("put another one in its place"));
  EXPECT_EQ(trial::text_of(folder.path() / "other"), "");
  ASSERT_GE(::dup2(spare, file.descriptor()), 0);
  file.append("three\n");
  ::close(file.descriptor());
  EXPECT_THAT(trial::message_of<WriteFailure>([&] { file.sync(); }), HasSubstr("has closed the file"));
  ::close(spare);
  EXPECT_EQ(trial::text_of(folder.path() / "rows"), "one\nthree\n");
}

TEST(Files, OfNewResultsAreAllThereOrNone) {
  const trial::Folder folder;
  for (const bool was_there : {false, true})
    for (const bool complete : {false, true}) {
      const auto path = folder.path() / (std::string(was_there ? "old" : "new") + (complete ? "whole" : "half"));
      if (was_there) std::filesystem::create_directory(path);
      {
        const auto directory = execution::RunDirectory::create(path, "x");
        execution::NewResults results(directory);
        execution::write_atomically(path / "result.json", "{}");
        if (complete) results.complete();
      }
      EXPECT_EQ(std::filesystem::exists(path / "result.json"), complete);
      EXPECT_EQ(std::filesystem::exists(path), was_there || complete);
    }
}

TEST(Files, LocksAreNotInherited) {
  const trial::Folder folder;
  const auto path = folder.path() / "run";
  std::optional<execution::RunDirectory> held(execution::RunDirectory::create(path, "x"));
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    [[maybe_unused]] const auto told = ::write(ready[1], "!", 1);
    for (;;) ::pause();
  }
  char byte = 0;
  ASSERT_EQ(::read(ready[0], &byte, 1), 1);
  for (const int end : ready) ::close(end);
  EXPECT_THROW(execution::RunDirectory::reopen(path, "x"), InputError);
  held.reset();
  EXPECT_NO_THROW(execution::RunDirectory::reopen(path, "x"));
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST(Files, AreNeverWrittenThroughALink) {
  const trial::Folder folder;
  const auto victim = folder.write("victim", "mine");
  for (const char* name : {"report.html", "report.html.new"})
    std::filesystem::create_symlink(victim, folder.path() / name);
  execution::write_atomically(folder.path() / "report.html", "new");
  EXPECT_EQ(trial::text_of(victim), "mine");
  EXPECT_FALSE(std::filesystem::is_symlink(folder.path() / "report.html"));
  EXPECT_EQ(trial::text_of(folder.path() / "report.html"), "new");
  std::filesystem::create_symlink(victim, folder.path() / "run.log");
  EXPECT_THAT(trial::message_of<WriteFailure>([&] { AppendFile(folder.path() / "run.log"); }),
              HasSubstr("It is a symbolic link, which is never followed here; remove it"));
  EXPECT_EQ(trial::text_of(victim), "mine");
}

TEST(Files, HaveTheFoldersThatAreMade) {
  const trial::Folder folder;
  EXPECT_FALSE(execution::make_folders(folder.path() / "a/b/c"));
  EXPECT_TRUE(std::filesystem::is_directory(folder.path() / "a/b/c"));
  EXPECT_FALSE(execution::make_folders(folder.path() / "a/b/c/"));
  folder.write("file", "");
  EXPECT_TRUE(execution::make_folders(folder.path() / "file/d"));
}

TEST(Files, AreCutAndGrowBehindTheCut) {
  const trial::Folder folder;
  AppendFile file(folder.write("rows.csv", "whole\ntorn"));
  file.cut(6);
  file.append("row\n");
  EXPECT_EQ(trial::text_of(folder.path() / "rows.csv"), "whole\nrow\n");
}

TEST(Files, AreWholeWhenSeveralProcessesWriteThemAtOnce) {
  const trial::Folder folder;
  const auto file = folder.write("record.json", std::string(1 << 20, '0'));
  const auto write_often = [&file](char letter) {
    for (int n = 0; n < 50; ++n) execution::write_atomically(file, std::string(1 << 20, letter));
  };
  std::vector<pid_t> writers;
  for (const char letter : {'a', 'b', 'c'}) {
    const pid_t id = fork();
    ASSERT_GE(id, 0);
    if (id == 0) {
      try {
        write_often(letter);
      } catch (...) {
        _exit(1);
      }
      _exit(0);
    }
    writers.push_back(id);
  }
  for (int n = 0; n < 50; ++n) {
    const std::string text = trial::text_of(file);
    ASSERT_EQ(text.size(), std::size_t{1} << 20);
    ASSERT_EQ(text.find_first_not_of(text.front()), std::string::npos) << "two texts in one file";
  }
  for (const pid_t id : writers) {
    int status = -1;
    waitpid(id, &status, 0);
    EXPECT_EQ(status, 0) << "a writer failed because of another";
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Files, GrowAtTheEnd) {
  const trial::Folder folder;
  const auto file = folder.write("rows.csv", "a\n");
  AppendFile append(file);
  append.append("b\n");
  append.sync();
  EXPECT_EQ(trial::text_of(file), "a\nb\n");
}

TEST(Files, SayThatTheDiskIsFullAndWhatToDo) {
  AppendFile full("/dev/full");
  const auto message = trial::message_of<WriteFailure>([&] { full.append("row\n"); });
  EXPECT_THAT(message, HasSubstr("/dev/full: cannot write: No space left on device"));
  EXPECT_THAT(message, HasSubstr("Free some space"));
}

TEST(Files, SayWhichFileCannotBeRead) {
  const auto message = trial::message_of<InputError>([] { execution::read_text("/nowhere/result.json"); });
  EXPECT_THAT(message, HasSubstr("/nowhere/result.json: there is no such file. Check its name"));
}

TEST(Files, SayWhichFolderCannotBeMade) {
  const trial::Folder folder;
  execution::make_folder(folder.path() / "a" / "b");
  execution::make_folder(folder.path() / "a" / "b");
  const auto below = folder.write("file", "") / "below";
  EXPECT_THAT(trial::message_of<WriteFailure>([&] { execution::make_folder(below); }),
              HasSubstr(below.string() + ": cannot write: Not a directory"));
}
