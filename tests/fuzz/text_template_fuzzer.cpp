// SPDX-License-Identifier: Apache-2.0
// A template of an external solver: places have names, and everything else stays as it is.
#include "fuzz/fuzzing.hpp"
#include "text_template.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = fuzzing::text_of(data, size);
  const external::TextTemplate made(text);
  for (const auto& place : made.places()) fuzzing::promise(!place.name.empty(), "a place has a name");
  const std::string filled = made.filled([](const auto&) { return std::string(); });
  fuzzing::promise(filled.size() + 5 * made.places().size() <= text.size(), "a place takes five characters or more");
  if (made.places().empty()) fuzzing::promise(filled == text, "a text without places stays");
  return 0;
}
