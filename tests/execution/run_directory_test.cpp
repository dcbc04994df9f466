// SPDX-License-Identifier: Apache-2.0
#include "execution/run_directory.hpp"

#include <gmock/gmock.h>

#include "execution/folder.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::RunDirectory;
using ::testing::HasSubstr;

namespace {

/// The default folder is relative to where the user stands.
class Inside {
 public:
  explicit Inside(const std::filesystem::path& path) : before_(std::filesystem::current_path()) {
    std::filesystem::current_path(path);
  }
  ~Inside() { std::filesystem::current_path(before_); }

 private:
  std::filesystem::path before_;
};

std::string directory_refusal(const std::filesystem::path& path) {
  return trial::message_of<InputError>([&] { RunDirectory::create(path, "x"); });
}

}  // namespace

TEST(RunDirectory, NumbersItsOwnFolders) {
  const trial::Folder folder;
  const Inside inside(folder.path());
  EXPECT_EQ(RunDirectory::create({}, "lamb aorta").path(), "results/lamb-aorta-1");
  EXPECT_EQ(RunDirectory::create({}, "lamb aorta").path(), "results/lamb-aorta-2");
  EXPECT_EQ(RunDirectory::reopen({}, "lamb aorta").path(), "results/lamb-aorta-2");
  EXPECT_THAT(trial::message_of<InputError>([] { RunDirectory::reopen({}, "other"); }), HasSubstr("no run to resume"));
}

TEST(RunDirectory, NeverOverwrites) {
  const trial::Folder folder;
  EXPECT_EQ(RunDirectory::create(folder.path() / "a" / "b", "x").path(), folder.path() / "a" / "b");
  folder.write("a/b/note.txt", "mine");
  EXPECT_THAT(directory_refusal(folder.path() / "a" / "b"),
              HasSubstr("is not empty, and results are never overwritten"));
  EXPECT_THAT(directory_refusal(folder.path() / "a" / "b"), ::testing::Not(HasSubstr("--resume")));
  folder.write("a/b/checkpoint.json", "{}");
  EXPECT_THAT(directory_refusal(folder.path() / "a" / "b"), HasSubstr("go on with the run in it with --resume"));
  EXPECT_THAT(directory_refusal(folder.path() / "a/b/note.txt"), HasSubstr("is a file; name a folder with -o"));
}

TEST(RunDirectory, SaysWhenItCannotBeCreated) {
  EXPECT_THAT(directory_refusal("/proc/tunica/results"), HasSubstr("/proc/tunica/results: cannot be created: "));
}

TEST(RunDirectory, IsHeldAgainstASecondProcess) {
  const trial::Folder folder;
  {
    const auto first = RunDirectory::reopen(folder.path(), "x");
    EXPECT_THAT(trial::message_of<InputError>([&] { RunDirectory::reopen(folder.path(), "x"); }),
                HasSubstr("another tunica is running in it"));
  }
  EXPECT_EQ(RunDirectory::reopen(folder.path(), "x").path(), folder.path());
}

TEST(RunDirectory, NeedsAFolderToResume) {
  EXPECT_THAT(trial::message_of<InputError>([] { RunDirectory::reopen("/nowhere/at/all", "x"); }),
              HasSubstr("/nowhere/at/all: no such folder"));
}
