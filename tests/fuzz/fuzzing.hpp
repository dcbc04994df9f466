// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "data/written_file.hpp"
#include "tunica/error.hpp"

/// What fuzz targets share. A target reads any bytes; an InputError is a good answer, anything else that is thrown is a
/// finding, and so is a promise that does not hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace tunica::fuzzing {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder for the files that a target writes, the same for all inputs of a process.
inline const testing::Folder& folder() {
  static const testing::Folder one;
  return one;
}

/// Ends the program: the fuzzer keeps the input.
inline void promise(bool kept, const char* what) {
  if (kept) return;
  std::fprintf(stderr, "a promise does not hold: %s\n", what);
  std::abort();
}

/// Reads with `call`; refused input must say something.
template <class Call>
void expect_read_or_refused(const Call& call) {
  try {
    call();
  } catch (const InputError& problem) {
    promise(!std::string_view(problem.what()).empty(), "a refusal says why");
  }
}

/// Takes a line off the front.
inline std::string_view next_line(std::string_view& rest) {
  const std::string_view line = rest.substr(0, rest.find('\n'));
  rest.remove_prefix(line.size() < rest.size() ? line.size() + 1 : rest.size());
  return line;
}

}  // namespace tunica::fuzzing
