// SPDX-License-Identifier: Apache-2.0
// The header of a plugin: size and number, then fingerprint, name and version, each ended by a zero byte. What the
// dynamic linker says of a file it cannot map, in any words.
#include "fuzz/fuzzing.hpp"
#include "plugins/refusals.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  std::string rest(fuzzing::text_of(data + 2, size - 2));
  const auto next = [&rest] {
    const std::size_t end = std::min(rest.find('\0'), rest.size());
    std::string text = rest.substr(0, end);
    rest.erase(0, std::min(rest.size(), end + 1));
    return text;
  };
  const std::string fingerprint = next(), name = next(), version = next();
  PluginHeader header{sizeof(PluginHeader), TUNICA_PLUGIN_API, fingerprint.c_str(),
                      name.c_str(),         version.c_str(),   nullptr};
  if (data[0] & 1) header.struct_size = data[0];
  if (data[0] & 2) header.api = data[1];
  if (data[0] & 4) header.fingerprint = nullptr;
  if (data[0] & 8) header.name = nullptr;
  if (data[0] & 16) header.version = nullptr;
  if (data[0] & 32) header.fingerprint = TUNICA_ABI_FINGERPRINT;
  const std::string reason = plugins::refuse_header(&header);
  const bool alike = header.fingerprint && std::string_view(header.fingerprint) == TUNICA_ABI_FINGERPRINT;
  if (!alike || header.api != TUNICA_PLUGIN_API || header.struct_size != sizeof(PluginHeader))
    fuzzing::promise(!reason.empty(), "a plugin of another build is refused");
  fuzzing::promise(!plugins::explain_load_failure("plugin.so", rest).empty(), "a failure is explained");
  return 0;
}
