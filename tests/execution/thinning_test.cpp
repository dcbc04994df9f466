// SPDX-License-Identifier: Apache-2.0
#include "execution/thinning.hpp"

#include <gmock/gmock.h>

#include "execution/running.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using trial::Many;

namespace {

/// A finished run of six searches.
struct Thinned {
  Many laboratory;
  trial::Folder folder;
  execution::Execution expected = trial::run(laboratory, folder.path());

  [[nodiscard]] std::size_t lines() const {
    const std::string text = trial::rows(folder.path());
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) - 1;
  }
  void thin() const { execution::thin_evaluations(laboratory.plan(), folder.path()); }
};

}  // namespace

TEST(Thinning, KeepsTheRowsThatImproved) {
  const Thinned run;
  const std::size_t before = run.lines();
  run.thin();
  std::size_t improvements = 0;
  for (const auto& of_run : run.expected.runs)
    for (const auto& realisation : of_run.realisations) improvements += realisation.trace.size();
  EXPECT_EQ(run.lines(), improvements);
  EXPECT_LT(improvements, before / 4);
  const std::string rows = trial::rows(run.folder.path());
  run.thin();  // a second time changes nothing
  EXPECT_EQ(trial::rows(run.folder.path()), rows);
}

TEST(Thinning, AThinnedRunIsResumedToTheSameResults) {
  const Thinned run;
  run.thin();
  const std::string rows = trial::rows(run.folder.path());
  trial::expect_equal(trial::run(run.laboratory, run.folder.path(), 1, true), run.expected);
  EXPECT_EQ(trial::rows(run.folder.path()), rows);
  trial::expect_equal(trial::run(run.laboratory, run.folder.path(), 2, true), run.expected);
}

/// A process that ends after the note in the checkpoint, and before the rows are gone.
TEST(Thinning, AnEndInTheMiddleLosesNothing) {
  const Thinned run;
  auto checkpoint = execution::read_checkpoint(run.folder.path());
  checkpoint.facts.thinned = true;
  execution::write_checkpoint(run.folder.path(), checkpoint);
  const std::size_t before = run.lines();
  trial::expect_equal(trial::run(run.laboratory, run.folder.path(), 1, true), run.expected);
  EXPECT_EQ(run.lines(), before);
  run.thin();
  EXPECT_LT(run.lines(), before);
}

TEST(Thinning, ADamagedSearchCannotBeMadeAgain) {
  const Thinned run;
  run.thin();
  auto checkpoint = execution::read_checkpoint(run.folder.path());
  checkpoint.finished.pop_back();
  execution::write_checkpoint(run.folder.path(), checkpoint);
  try {
    trial::run(run.laboratory, run.folder.path(), 1, true);
    FAIL() << "was resumed";
  } catch (const InputError& problem) {
    EXPECT_THAT(problem.what(),
                HasSubstr("1 of 6 searches are not in checkpoint.json any more, and evaluations.csv holds improvements "
                          "only, so that they cannot be made again from it; start anew with another -o"));
  }
}
