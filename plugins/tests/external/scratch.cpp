// SPDX-License-Identifier: Apache-2.0
#include "scratch.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>

namespace tunica::external {

Scratch::Scratch(const std::filesystem::path& parent) {
  std::error_code error;
  std::filesystem::create_directories(parent, error);
  std::string name = (parent / "tunica-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(fmt::format("no scratch folder can be made in {}: {}; name another one in \"scratch\"",
                                         parent.string(), std::strerror(errno)));
  folder_ = name;
}

Scratch::~Scratch() {
  std::error_code error;
  if (!kept_) std::filesystem::remove_all(folder_, error);
}

void Scratch::keep_as_failed() {
  const std::string name = folder_.filename().string();
  const auto failed = folder_.parent_path() / ("tunica-failed" + name.substr(name.rfind('-')));
  std::error_code error;
  std::filesystem::rename(folder_, failed, error);
  if (!error) folder_ = failed;
  keep();
}

void Scratch::write(const std::string& name, const std::string& text) const {
  const std::filesystem::path file = folder_ / name;
  std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(fmt::format("{} cannot be written", file.string()));
}

}  // namespace tunica::external
