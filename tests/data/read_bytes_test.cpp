// SPDX-License-Identifier: Apache-2.0
#include "data/read_bytes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

using ::testing::HasSubstr;

std::string refusal(const std::filesystem::path& file, std::size_t most = largest_file) {
  return testing::message_of<InputError>([&] { static_cast<void>(read_bytes(file, most)); });
}

TEST(ReadBytes, GivesTheWholeFile) {
  const testing::Folder folder;
  EXPECT_EQ(read_bytes(folder.write("empty", "")), "");
  const std::string long_text(200'000, 'x');
  EXPECT_EQ(read_bytes(folder.write("long", long_text)), long_text);
}

// Each of these would wait for ever, or never end.
TEST(ReadBytes, RefusesPipesDevicesAndFilesOfTheKernel) {
  const testing::Folder folder;
  const auto pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink("/dev/zero", folder.path() / "link");
  for (const std::filesystem::path& file :
       {pipe, folder.path() / "link", std::filesystem::path("/dev/zero"), std::filesystem::path("/proc/self/status")})
    EXPECT_THAT(refusal(file), HasSubstr("this is not a regular file. Name a text file."));
  EXPECT_NE(refusal("/proc/kmsg"), "");
}

TEST(ReadBytes, SaysWhatIsWrong) {
  const testing::Folder folder;
  EXPECT_THAT(refusal(folder.path() / "nowhere"), HasSubstr("there is no such file. Check its name"));
  EXPECT_THAT(refusal(folder.write("file", "") / "below"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("this is a folder. Name a file in it."));
  EXPECT_THAT(refusal(folder.write("large", std::string(3'000'000, 'x')), 1 << 20),
              HasSubstr("large: the file has 3 MiB; expected at most 1. Take out what is not needed, or split it."));
}

}  // namespace
}  // namespace tunica::data
