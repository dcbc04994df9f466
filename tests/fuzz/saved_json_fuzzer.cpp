// SPDX-License-Identifier: Apache-2.0
// Any JSON that was saved: refused, or a document that can be copied and written, and reads back.
#include <nlohmann/json.hpp>

#include "fuzz/fuzzing.hpp"
#include "tunica/detail/bounded_json.hpp"

using namespace tunica;

namespace {

template <class Json>
std::size_t levels(const Json& value) {
  std::size_t deepest = 0;
  if (value.is_structured())
    for (const auto& child : value) deepest = std::max(deepest, levels(child));
  return deepest + (value.is_structured() ? 1 : 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Json = nlohmann::ordered_json;
  for (const bool comments : {false, true}) {
    const Json read = detail::parse_json<Json>(fuzzing::text_of(data, size), false, comments);
    if (read.is_discarded()) continue;
    fuzzing::promise(levels(read) <= detail::deepest_json, "no more than 64 levels");
    const std::string written = read.dump(-1, ' ', false, Json::error_handler_t::replace);
    fuzzing::promise(detail::parse_json<Json>(written, false).dump() == written, "a document reads back");
  }
  return 0;
}
