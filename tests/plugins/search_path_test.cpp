// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <stdlib.h>

#include "plugins/loader.hpp"

namespace tunica::plugins {
namespace {

using Folders = std::vector<std::filesystem::path>;

/// Sets an environment variable for one test; CTest runs each case in a process of its own.
class SearchPathTest : public ::testing::Test {
 protected:
  static Folders path(const char* variable, const Folders& from_command_line) {
    variable == nullptr ? unsetenv("TUNICA_PLUGIN_PATH") : setenv("TUNICA_PLUGIN_PATH", variable, 1);
    return default_search_path(from_command_line).folders;
  }
};

TEST_F(SearchPathTest, IsCommandLineThenEnvironmentThenInstallFolder) {
  EXPECT_EQ(path("/from/variable:relative::", {"/from/line"}),
            (Folders{"/from/line", "/from/variable", "relative", std::filesystem::canonical(TUNICA_PLUGIN_DIR)}));
}

TEST_F(SearchPathTest, FindsThePluginsBesideTheExecutable) {
  EXPECT_EQ(path(nullptr, {}), (Folders{std::filesystem::canonical(TUNICA_PLUGIN_DIR)}));
}

TEST_F(SearchPathTest, RefusesWorldWritablePluginsUnlessTold) {
  EXPECT_FALSE(default_search_path({}).allow_world_writable);
}

}  // namespace
}  // namespace tunica::plugins
