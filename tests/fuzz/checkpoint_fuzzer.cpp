// SPDX-License-Identifier: Apache-2.0
// checkpoint.json: refused, or a checkpoint that, written and read once more, is the same.
#include "execution/checkpoint.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto& folder = fuzzing::folder();
  (void)folder.write("checkpoint.json", fuzzing::text_of(data, size));
  fuzzing::expect_read_or_refused([&] {
    const execution::Checkpoint read = execution::read_checkpoint(folder.path());
    execution::write_checkpoint(folder.path(), read);
    const execution::Checkpoint again = execution::read_checkpoint(folder.path());
    fuzzing::promise(again.facts == read.facts, "facts read back");
    fuzzing::promise(again.finished.size() == read.finished.size(), "realisations read back");
  });
  return 0;
}
