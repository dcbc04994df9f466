// SPDX-License-Identifier: Apache-2.0
// A file as a testing machine wrote it: an experiment is proposed, or the file is refused.
#include "experiment/fake_catalogue.hpp"
#include "fuzz/fuzzing.hpp"
#include "importing/proposal.hpp"

using namespace tunica;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  importing::Answers answers;
  if (data[0] & 1) answers.test = data[0] & 2 ? "uniaxial" : "tube";
  if (data[0] & 4) answers.cycle = "last";
  if (data[0] & 8) answers.branch = "loading";
  if (data[0] & 16) answers.width = "10 mm", answers.thickness = "1 mm", answers.gauge_length = "20 mm";
  answers.files = {fuzzing::folder().write("rig.csv", fuzzing::text_of(data + 1, size - 1))};
  fuzzing::expect_read_or_refused([&] {
    const auto ask = [](const importing::Question& question) { return question.example; };
    const importing::Proposal proposal =
        importing::propose(answers, fuzzing::folder().path(), testing::fake_catalogue(), ask);
    fuzzing::promise(proposal.experiment.is_object(), "a proposal is an experiment");
  });
  return 0;
}
