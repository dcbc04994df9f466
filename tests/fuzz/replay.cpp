// SPDX-License-Identifier: Apache-2.0
// The main function of a fuzz target where there is no libFuzzer: every file of the corpus, then damaged ones.
//
//   NAME_fuzzer CORPUS DICTIONARY [EXECUTIONS]
//
// Deterministic: the damage depends on nothing but the number of the execution.
#include <algorithm>
#include <iterator>
#include <vector>

#include "data/mutation.hpp"
#include "fuzz/fuzzing.hpp"

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The words of a dictionary of libFuzzer: name="text", with \\, \" and \xAB.
std::vector<std::string> words(const std::filesystem::path& file) {
  std::vector<std::string> found;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t begin = line.find('"'), end = line.rfind('"');
    if (line.starts_with('#') || begin == end) continue;
    std::string word;
    for (std::size_t i = begin + 1; i < end; ++i) {
      if (line[i] != '\\') {
        word += line[i];
      } else if (line[i + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(i + 2, 2), nullptr, 16));
        i += 3;
      } else {
        word += line[++i];
      }
    }
    found.push_back(word);
  }
  return found;
}

void run(const std::string& text) {
  static_cast<void>(LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 3) {
    std::fprintf(stderr, "found %d arguments, expected a corpus and a dictionary\n", count - 1);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const auto& file : files) run(texts.emplace_back(content(file)));
  if (texts.empty()) {
    std::fprintf(stderr, "%s: found no file, expected seeds\n", arguments[1]);
    return 2;
  }
  const unsigned long executions = count > 3 ? std::stoul(arguments[3]) : 2000;
  tunica::testing::Mutator mutate(20260103, words(arguments[2]));
  for (unsigned long i = 0; i < executions; ++i) run(mutate(texts[i % texts.size()]));
  std::printf("%zu seeds, %lu damaged ones\n", texts.size(), executions);
  return 0;
}
