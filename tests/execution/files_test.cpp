// SPDX-License-Identifier: Apache-2.0
#include "execution/files.hpp"

#include <cerrno>

#include <gmock/gmock.h>

#include "execution/folder.hpp"
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
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "checkpoint.json.new"));
  EXPECT_THROW(execution::write_atomically(folder.path() / "missing" / "file", "text"), WriteFailure);
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
  EXPECT_THAT(message, HasSubstr("/nowhere/result.json: cannot be read: No such file"));
}
