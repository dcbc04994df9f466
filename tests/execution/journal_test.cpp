// SPDX-License-Identifier: Apache-2.0
#include "execution/journal.hpp"

#include <gmock/gmock.h>

#include "execution/damage.hpp"
#include "execution/folder.hpp"
#include "execution/recovery.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using execution::EvaluationTable;
using execution::Journal;
using execution::Task;
using ::testing::HasSubstr;

namespace {

/// One run with three realisations.
struct Journaled {
  trial::Folder folder;
  EvaluationTable table{{{"m/o", {{"a", "1"}}, {"t"}}}};
  std::vector<Task> tasks{{0, 1}, {0, 2}, {0, 3}};

  [[nodiscard]] std::filesystem::path main() const { return Journal::main_file(folder.path()); }
  [[nodiscard]] std::string part(std::size_t task) const {
    return trial::text_of(Journal::part_file(folder.path(), task));
  }
  Journal open(Journal::Stored stored = {}) { return Journal(folder.path(), table, tasks, std::move(stored)); }
  execution::Recovered recover() { return execution::recover(folder.path(), table, tasks, {true, true, true}); }
};

void record(Journal& journal, std::size_t task, std::uint64_t index, double a) {
  const std::vector<double> parameters{a}, per_test{a * a};
  journal.record(task, {index, parameters, a * a, per_test, Status(), 0});
}

std::string row(std::uint64_t id, int realisation, const std::string& a, const std::string& cost) {
  return trial::checked(fmt::format("{},m/o,{},{},{},{},ok,,,0.000000", id, realisation, a, cost, cost));
}

const std::string header = "id,run,realisation,a [1],cost.t,objective,status,violation,reason,time [s],checksum\n";

}  // namespace

TEST(Journal, OrdersRowsByRealisationHoweverTheyCome) {
  Journaled files;
  {
    auto journal = files.open();
    record(journal, 1, 0, 3);
    record(journal, 0, 0, 1);
    record(journal, 2, 0, 5);
    journal.flush();
    EXPECT_EQ(files.part(1), row(1, 2, "3", "9"));
    journal.finish(2);
    record(journal, 0, 1, 2);
    journal.finish(0);
    record(journal, 1, 1, 4);
    journal.finish(1);
  }
  EXPECT_EQ(trial::text_of(files.main()), header + row(1, 1, "1", "1") + row(2, 1, "2", "4") + row(1, 2, "3", "9") +
                                              row(2, 2, "4", "16") + row(1, 3, "5", "25"));
  EXPECT_FALSE(std::filesystem::exists(files.folder.path() / "parts"));
}

TEST(Journal, HasRowsOnDiskAfterAFlush) {
  Journaled files;
  auto journal = files.open();
  record(journal, 0, 0, 1);
  EXPECT_EQ(trial::text_of(files.main()), header);
  journal.flush();
  EXPECT_EQ(trial::text_of(files.main()), header + row(1, 1, "1", "1"));
}

TEST(Journal, KeepsAWriteFailureInsteadOfThrowingIntoTheOptimiser) {
  Journaled files;
  auto journal = files.open();
  record(journal, 0, 0, 1);
  EXPECT_FALSE(journal.failed());
  {
    const trial::NoLargerFile limit(std::filesystem::file_size(files.main()));
    journal.flush();
  }
  EXPECT_TRUE(journal.failed());
  EXPECT_THAT(journal.failure(), HasSubstr("File too large"));
}

TEST(Journal, IsNotWrittenThroughALink) {
  Journaled files;
  const auto victim = files.folder.write("victim", "mine");
  std::filesystem::create_symlink(victim, files.main());
  EXPECT_THAT(trial::message_of<execution::WriteFailure>([&] { files.open(); }),
              HasSubstr("It is a symbolic link, which is never followed here; remove it"));
  EXPECT_EQ(trial::text_of(victim), "mine");
}

TEST(Recovery, DropsATornLastLineAndGoesOnBehindIt) {
  Journaled files;
  {
    auto journal = files.open();
    record(journal, 0, 0, 1);
    record(journal, 1, 0, 3);
  }  // not flushed, as after a kill
  EXPECT_EQ(trial::text_of(files.main()), header);
  execution::AppendFile(files.main()).append(row(1, 1, "1", "1") + "2,m/o,1,0.33");
  std::filesystem::create_directories(files.folder.path() / "parts");
  files.folder.write("parts/2.csv", row(1, 2, "3", "9") + row(2, 2, "4", "16") + "3,m");
  auto recovered = files.recover();
  EXPECT_THAT(recovered.stored.rows, ::testing::ElementsAre(1, 2, 0));
  EXPECT_EQ(trial::text_of(files.main()), header + row(1, 1, "1", "1"));
  search::JournalEntry entry;
  ASSERT_TRUE(recovered.evaluations[1].get(1, entry));
  EXPECT_EQ(entry.parameters.front(), 4);
  EXPECT_EQ(entry.objective, 16);
  EXPECT_FALSE(recovered.evaluations[1].get(2, entry));
  {
    auto journal = files.open(recovered.stored);
    for (std::uint64_t index = 0; index < 2; ++index) record(journal, 0, index, static_cast<double>(index + 1));
    journal.finish(0);
    for (std::uint64_t index = 0; index < 3; ++index) record(journal, 1, index, static_cast<double>(index + 3));
    journal.finish(1);
  }
  EXPECT_EQ(trial::text_of(files.main()), header + row(1, 1, "1", "1") + row(2, 1, "2", "4") + row(1, 2, "3", "9") +
                                              row(2, 2, "4", "16") + row(3, 2, "5", "25"));
}

TEST(Recovery, FinishesAMoveThatWasCutShort) {
  Journaled files;
  std::filesystem::create_directories(files.folder.path() / "parts");
  files.folder.write("evaluations.csv", header + row(1, 1, "1", "1") + row(1, 2, "3", "9"));
  files.folder.write("parts/2.csv", row(1, 2, "3", "9") + row(2, 2, "4", "16"));
  const auto recovered = files.recover();
  EXPECT_THAT(recovered.stored.rows, ::testing::ElementsAre(1, 2, 0));
  EXPECT_EQ(recovered.stored.head, 1u);
  EXPECT_EQ(trial::text_of(files.main()), header + row(1, 1, "1", "1") + row(1, 2, "3", "9") + row(2, 2, "4", "16"));
  EXPECT_EQ(files.part(1), "");
}

TEST(Recovery, BringsBackStatusesOtherThanOk) {
  Journaled files;
  files.folder.write("evaluations.csv",
                     header + row(1, 1, "1", "1") + trial::checked("2,m/o,1,2,,,failed,,no root,0.5"));
  const auto recovered = files.recover();
  search::JournalEntry entry;
  ASSERT_TRUE(recovered.evaluations[0].get(1, entry));
  EXPECT_EQ(entry.status.reason(), "no root");
  EXPECT_EQ(entry.seconds, 0.5);
}

TEST(Recovery, NamesFileAndLineOfWhatDoesNotBelong) {
  Journaled files;
  const auto message = [&] { return trial::message_of<InputError>([&] { files.recover(); }); };
  files.folder.write("evaluations.csv", header + row(1, 1, "1", "1") + row(3, 1, "2", "4"));
  EXPECT_THAT(message(), HasSubstr("evaluations.csv:3: id 3 follows id 1"));
  EXPECT_THAT(message(), HasSubstr("another -o"));
  files.folder.write("evaluations.csv", header + row(1, 9, "1", "1"));
  EXPECT_THAT(message(), HasSubstr("no realisation 9 is planned"));
  files.folder.write("evaluations.csv", "id,run\n");
  EXPECT_THAT(message(), HasSubstr("evaluations.csv:1: the columns are not those of this experiment"));
}
