// SPDX-License-Identifier: Apache-2.0
// A changed digit in a file that a run is resumed from: the result is the identical one, or the run is refused.
#include "execution/damage.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "execution/checkpoint.hpp"
#include "execution/running.hpp"
#include "execution/shards.hpp"
#include "tunica/error.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using trial::Many;

namespace {

/// A run that was cut off: two of its six searches are finished, one has not begun, and rows are in two files.
struct CutOff {
  Many laboratory;
  trial::Folder whole;
  execution::Execution expected = trial::run(laboratory, whole.path());
  std::string rows = trial::rows(whole.path());
  std::map<std::string, std::string> files;

  CutOff() {
    std::istringstream stream(trial::text_of(whole.path() / "evaluations.csv"));
    std::vector<std::string> of(6);
    std::string line, header;
    std::getline(stream, header);
    for (std::size_t number = 0; std::getline(stream, line); ++number) of[number / 500] += line + '\n';
    const auto half = [](const std::string& text) { return text.substr(0, text.find('\n', text.size() / 2) + 1); };
    files["evaluations.csv"] = header + '\n' + of[0] + half(of[1]);
    files["parts/3.csv"] = of[2];
    files["parts/4.csv"] = half(of[3]);
    auto checkpoint = execution::read_checkpoint(whole.path());
    std::erase_if(checkpoint.finished, [](const auto& entry) { return entry.first != 0 && entry.first != 2; });
    const trial::Folder folder;
    execution::write_checkpoint(folder.path(), checkpoint);
    files["checkpoint.json"] = trial::text_of(folder.path() / "checkpoint.json");
  }

  void put(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder / "parts");
    for (const auto& [name, text] : files) std::ofstream(folder / name, std::ios::binary) << text;
    std::ofstream(folder / "input.json") << laboratory.bench.experiment.input_json;
  }

  enum class Outcome { refused, told, silent };
  /// Resumes with another character in one place; a result that is not the identical one fails the test.
  Outcome resumed_with(const std::string& name, std::size_t place) const {
    const trial::Folder folder;
    put(folder.path());
    folder.write(name, trial::changed(files.at(name), place));
    std::vector<std::string> told;
    try {
      trial::expect_equal(
          trial::run(laboratory, folder.path(), 1, true, [&](const std::string& one) { told.push_back(one); }),
          expected);
      EXPECT_TRUE(trial::rows(folder.path()) == rows) << name << ", byte " << place;
    } catch (const InputError& refusal) {
      EXPECT_STRNE(refusal.what(), "");
      return Outcome::refused;
    }
    return told.empty() ? Outcome::silent : Outcome::told;
  }
};

}  // namespace

TEST(Damage, OfAnyDigitOfTheJournalIsToldAndTheResultIsIdentical) {
  const CutOff run;
  for (const auto& [name, text] : run.files) {
    if (name == "checkpoint.json") continue;
    const std::size_t begin = name == "evaluations.csv" ? text.find('\n') : 0;
    // A last line without its end is taken for one that was being written: it is dropped without a word.
    for (std::size_t place = begin + 1; place + 1 < text.size(); place += text.size() / 61)
      EXPECT_EQ(run.resumed_with(name, place), CutOff::Outcome::told) << name << ", byte " << place;
  }
}

TEST(Damage, OfEveryDigitOfARowIsSeen) {
  const CutOff run;
  const std::string& text = run.files.at("evaluations.csv");
  const std::size_t begin = text.find('\n') + 1, end = text.find('\n', begin);
  const std::string row = text.substr(begin, end - begin);
  ASSERT_TRUE(execution::EvaluationTable::intact(row));
  for (std::size_t place = 0; place < row.size(); ++place)
    EXPECT_FALSE(execution::EvaluationTable::intact(trial::changed(row, place))) << row << ", byte " << place;
  for (std::size_t length = 0; length < row.size(); ++length)
    EXPECT_FALSE(execution::EvaluationTable::intact(row.substr(0, length)));
}

TEST(Damage, OfTheHeaderIsRefused) {
  const CutOff run;
  for (std::size_t place = 0; place < run.files.at("evaluations.csv").find('\n'); place += 5)
    EXPECT_EQ(run.resumed_with("evaluations.csv", place), CutOff::Outcome::refused);
}

// White space and the last digits of a number that mean the same double change nothing, so nothing is said.
TEST(Damage, OfTheCheckpointIsRefusedOrToldAndTheResultIsIdentical) {
  const CutOff run;
  const std::string& text = run.files.at("checkpoint.json");
  int silent = 0, all = 0;
  for (std::size_t place = 0; place < text.size(); place += 1 + text.size() / 307, ++all)
    silent += run.resumed_with("checkpoint.json", place) == CutOff::Outcome::silent ? 1 : 0;
  EXPECT_LT(silent, all / 20);
}

TEST(Damage, IsToldWithItsPlaceAndWhatIsCutOffIsKept) {
  const CutOff run;
  const trial::Folder folder;
  run.put(folder.path());
  const std::string& journal = run.files.at("evaluations.csv");
  std::size_t third_row = 0;
  for (int line = 0; line < 3; ++line) third_row = journal.find('\n', third_row) + 1;
  folder.write("evaluations.csv", trial::changed(journal, third_row));
  std::string checkpoint = run.files.at("checkpoint.json");
  checkpoint = trial::changed(checkpoint, checkpoint.rfind("\"seconds\":") + 12);
  folder.write("checkpoint.json", checkpoint);
  std::vector<std::string> told;
  trial::run(run.laboratory, folder.path(), 1, true, [&](const std::string& one) { told.push_back(one); });
  ASSERT_EQ(told.size(), 2u);
  EXPECT_THAT(told[0], HasSubstr("checkpoint.json: entry 2 of \"finished\" is not what was written"));
  EXPECT_THAT(told[1],
              HasSubstr("evaluations.csv:4: the row is not what was written; its checksum does not fit. It and "
                        "what follows, 749 rows, are in damaged_rows.csv"));
  EXPECT_EQ(trial::text_of(folder.path() / "damaged_rows.csv"), trial::changed(journal, third_row).substr(third_row));
  EXPECT_THAT(trial::text_of(folder.path() / "run.log"), HasSubstr("damaged_rows.csv"));
}

TEST(Damage, OfTheFactsIsRefusedWithWhatToDo) {
  const CutOff run;
  const trial::Folder folder;
  run.put(folder.path());
  const std::string& text = run.files.at("checkpoint.json");
  folder.write("checkpoint.json", trial::changed(text, text.find("\"seed\":") + 9));
  EXPECT_THAT(trial::message_of<InputError>([&] { execution::read_checkpoint(folder.path()); }),
              HasSubstr("\"facts\" is not what was written; its checksum does not fit. Use a copy of the file"));
}

TEST(Damage, OfAPartIsToldWhenTheyAreMerged) {
  const Many laboratory;
  const trial::Folder folder;
  const auto plan = laboratory.plan();
  const auto part = execution::shard_folder(folder.path(), {1, 1});
  std::filesystem::create_directories(part);
  trial::run(laboratory, part);
  const std::string journal = trial::text_of(part / "evaluations.csv");
  std::ofstream(part / "evaluations.csv") << trial::changed(journal, journal.size() - 12);
  std::vector<std::string> told;
  execution::gather_shards(plan, folder.path(), [&](const std::string& one) { told.push_back(one); });
  ASSERT_EQ(told.size(), 1u);
  EXPECT_THAT(told[0], HasSubstr("evaluations.csv:2801: the row is not what was written"));
}
