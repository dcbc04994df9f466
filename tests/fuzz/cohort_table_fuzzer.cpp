// SPDX-License-Identifier: Apache-2.0
// The table of the specimens of a cohort: every specimen has an experiment, or its problem says why not.
#include <set>

#include "cohort/files.hpp"
#include "experiment/json_document.hpp"
#include "fuzz/fuzzing.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const testing::CohortFiles files;
  static const cohort::Specification cohort = files.read();
  (void)files.folder.write("specimens.csv", fuzzing::text_of(data, size));
  fuzzing::expect_read_or_refused([&] {
    const cohort::SpecimenTable table = cohort::read_specimens(cohort);
    const cohort::Template experiment(cohort, table);
    std::set<std::string> folders;
    for (const auto& specimen : table.specimens) {
      if (!specimen.problem.empty()) continue;
      fuzzing::promise(!specimen.folder.empty() && specimen.folder.find('/') == std::string::npos,
                       "a folder is a name");
      fuzzing::promise(specimen.folder != "." && specimen.folder != "..", "a folder lies in its own");
      fuzzing::promise(folders.insert(specimen.folder).second, "no two specimens share a folder");
      fuzzing::expect_read_or_refused([&] {
        const std::string text = experiment.of(specimen);
        (void)experiment::JsonDocument("strip.json", text);
      });
    }
  });
  return 0;
}
