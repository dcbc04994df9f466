// SPDX-License-Identifier: Apache-2.0
#include "data/table_file.hpp"

#include <chrono>

#include <gmock/gmock.h>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

namespace tunica::data {
namespace {

/// A file that was written so many seconds ago, as its times say.
std::filesystem::path written(const testing::Folder& folder, std::string_view text, int seconds_ago) {
  auto file = folder.write("a.csv", text);
  std::filesystem::last_write_time(file,
                                   std::filesystem::file_time_type::clock::now() - std::chrono::seconds(seconds_ago));
  return file;
}

TEST(TableFile, IsReadOnceHoweverOftenItIsAskedFor) {
  const testing::Folder folder;
  const auto file = written(folder, "x,y\n1,2\n", 60);
  const auto first = table_file(file, {});
  EXPECT_EQ(first->csv.rows.size(), 1u);
  EXPECT_EQ(first->sha256.size(), 64u);
  EXPECT_EQ(table_file(file, {}), first);
}

TEST(TableFile, IsReadAgainWhereItHasChanged) {
  const testing::Folder folder;
  const auto before = table_file(written(folder, "x,y\n1,2\n", 60), {});
  const auto after = table_file(written(folder, "x,y\n1,3\n", 50), {});
  EXPECT_EQ(after->csv.rows.front().cells[1], "3");
  EXPECT_NE(after->sha256, before->sha256);
}

TEST(TableFile, IsReadAgainWhereItIsTooYoungForItsTimesToTell) {
  const testing::Folder folder;
  (void)table_file(folder.write("a.csv", "x,y\n1,2\n"), {});
  EXPECT_EQ(table_file(folder.write("a.csv", "x,y\n1,3\n"), {})->csv.rows.front().cells[1], "3");
}

TEST(TableFile, IsCutAsTheLayoutSays) {
  const testing::Folder folder;
  const auto file = written(folder, "of,a,day\nx,y,z\n1,2,3\n", 60);
  TableLayout layout;
  layout.skip_lines = 1;
  EXPECT_EQ(table_file(file, layout)->csv.columns.front().name, "x");
  layout.skip_lines = 0;
  EXPECT_EQ(table_file(file, layout)->csv.columns.front().name, "of");
}

TEST(TableFile, IsRefusedWhereItIsGone) {
  const testing::Folder folder;
  const auto file = written(folder, "x,y\n1,2\n", 60);
  (void)table_file(file, {});
  std::filesystem::remove(file);
  EXPECT_THROW((void)table_file(file, {}), InputError);
}

}  // namespace
}  // namespace tunica::data
