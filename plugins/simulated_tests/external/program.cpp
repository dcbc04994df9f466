// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "tunica/error.hpp"

namespace tunica::external {

namespace fs = std::filesystem;

fs::path program_file(const std::string& name, const fs::path& folder) {
  const auto runs = [](const fs::path& file) { return fs::is_regular_file(file) && access(file.c_str(), X_OK) == 0; };
  if (name.find('/') != std::string::npos) {
    fs::path file = (folder / name).lexically_normal();
    if (runs(file)) return file;
    throw InputError(
        fmt::format("the program '{}' of \"command\" {}; correct its path, which begins at the folder of "
                    "the experiment file",
                    file.string(), fs::exists(file) ? "may not be executed (chmod +x)" : "does not exist"));
  }
  const char* const path = std::getenv("PATH");
  std::string_view left = path != nullptr ? path : "/usr/bin:/bin";
  while (!left.empty()) {
    const std::size_t colon = left.find(':');
    fs::path file = fs::path(left.substr(0, colon)) / name;
    if (file.is_absolute() && runs(file)) return file;
    left = colon == std::string::npos ? std::string_view() : left.substr(colon + 1);
  }
  throw InputError(
      fmt::format("the program '{}' of \"command\" is in no folder of PATH; install it, or give its path", name));
}

std::string last_lines(const fs::path& file, std::size_t count) {
  constexpr std::streamoff shown = 65536;  // bytes from the end; a program may print without end
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  stream.seekg(std::max<std::streamoff>(0, static_cast<std::streamoff>(stream.tellg()) - shown));
  std::deque<std::string> lines;
  for (std::string line; std::getline(stream, line);) {
    const std::size_t end = line.find_last_not_of(" \t\r");
    if (end == std::string::npos) continue;
    lines.push_back(line.substr(line.find_first_not_of(" \t"), std::size_t{200}));
    lines.back().resize(std::min(lines.back().size(), lines.back().find_last_not_of(" \t\r") + 1));
    if (lines.size() > count) lines.pop_front();
  }
  return lines.empty() ? "nothing" : fmt::format("{}", fmt::join(lines, " | "));
}

}  // namespace tunica::external
