// SPDX-License-Identifier: Apache-2.0
// evaluations.csv and a part of it, separated by a zero byte: refused, or repaired so that it reads a second time as
// the first.
#include "execution/recovery.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto& folder = fuzzing::folder();
  const execution::EvaluationTable table(
      {{"m/o", {{"a", "1"}, {"b", "kPa"}}, {"strip", "tube"}}, {"n/o", {{"b", "kPa"}}, {"tube"}}});
  const std::vector<execution::Task> tasks{{0, 1}, {0, 2}, {1, 1}};
  const std::vector<bool> wanted{true, true, true};
  const std::string_view text = fuzzing::text_of(data, size);
  const std::size_t cut = std::min(text.find('\0'), text.size());
  const auto write = [&](const std::filesystem::path& file, std::string_view content) {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << content;
  };
  write(execution::Journal::main_file(folder.path()), text.substr(0, cut));
  std::filesystem::remove(execution::Journal::part_file(folder.path(), 1));
  if (cut < text.size()) write(execution::Journal::part_file(folder.path(), 1), text.substr(cut + 1));
  fuzzing::expect_read_or_refused([&] {
    const auto first = execution::recover(folder.path(), table, tasks, wanted);
    const auto second = execution::recover(folder.path(), table, tasks, wanted);
    fuzzing::promise(first.stored.rows == second.stored.rows, "what is repaired reads the same");
    for (std::size_t task = 0; task < tasks.size(); ++task)
      fuzzing::promise(first.evaluations[task].size() == first.stored.rows[task], "every wanted row is kept");
  });
  return 0;
}
