// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include <gtest/gtest.h>

namespace tunica {
namespace {

struct CloseProcess {
  void operator()(FILE* stream) const { pclose(stream); }
};

/// Names that the library defines for others, one a line, as nm prints them.
std::string exported_symbols(const std::filesystem::path& library) {
  const std::string command = "nm -D --defined-only --format=just-symbols '" + library.string() + "'";
  const std::unique_ptr<FILE, CloseProcess> stream(popen(command.c_str(), "r"));
  std::string text;
  std::array<char, 4096> line{};
  while (stream && std::fgets(line.data(), line.size(), stream.get()) != nullptr) text += line.data();
  return text;
}

TEST(BuiltPlugins, ExportOneSymbolOnly) {
  std::size_t plugins = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TUNICA_PLUGIN_DIR)) {
    if (entry.path().extension() != ".so") continue;
    ++plugins;
    EXPECT_EQ(exported_symbols(entry.path()), "tunica_plugin\n") << entry.path();
  }
  EXPECT_GT(plugins, 0u) << "no plugin in " << TUNICA_PLUGIN_DIR;
}

}  // namespace
}  // namespace tunica
