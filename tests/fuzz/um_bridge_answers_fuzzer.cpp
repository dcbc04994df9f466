// SPDX-License-Identifier: Apache-2.0
// The answer of a server of UM-Bridge: refused with words, or sizes that fit into memory and finite numbers.
#include <cmath>
#include <stdexcept>

#include "answers.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

namespace {

template <class Call>
void understood_or_refused(const Call& call) {
  try {
    call();
  } catch (const std::runtime_error& problem) {
    fuzzing::promise(!std::string_view(problem.what()).empty(), "a refusal says why");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  understood_or_refused([&] {
    const auto answer = um_bridge::read_answer("server", 200, std::string(fuzzing::text_of(data, size)));
    understood_or_refused([&] {
      std::size_t sum = 0;
      for (const std::size_t one : um_bridge::sizes_in(answer, "outputSizes", "server")) sum += one;
      fuzzing::promise(sum <= 10'000'000, "sizes fit into memory");
    });
    understood_or_refused([&] {
      for (const auto& vector : um_bridge::vectors_in(answer, "server"))
        for (const double value : vector) fuzzing::promise(std::isfinite(value), "an output is finite");
    });
    understood_or_refused([&] { static_cast<void>(um_bridge::vector_in(answer, "server")); });
  });
  return 0;
}
