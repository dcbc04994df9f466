// SPDX-License-Identifier: Apache-2.0
// History only where there is one: what depends on the order of rows is looked for where somebody gives it, and nothing
// else depends on it.
#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "assembly/assembly.hpp"
#include "diagnosis/evidence/least_squares.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"
#include "plugins/guarded.hpp"

namespace tunica::trial {
namespace {

using diagnosis::Absence;
using diagnosis::Candidate;
using diagnosis::Diagnosis;
using diagnosis::WarningKind;
using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Up and down twice: every stretch but the turning points is measured several times.
std::vector<double> cycles(double rest) {
  std::vector<double> path = testing::evenly(rest, 1.6, 16);
  for (const auto& [from, to] : {std::pair{1.58, 1.04}, std::pair{1.06, 1.6}})
    for (const double x : testing::evenly(from, to, 14)) path.push_back(x);
  return path;
}

struct Cyclic : Measured {
  Cyclic() : Measured({{.stretch = cycles(1.02)}, {.name = "axial", .stretch = cycles(1.02)}}) {}

  /// Nobody says in which order the rows were measured.
  void forget_order() {
    for (auto& [name, test] : experiment["tests"].items()) test["data"].erase("order");
  }

  /// Puts the rows of every file into another order.
  template <class Reorder>
  void rewrite(Reorder reorder) const {
    for (const Strip& strip : strips) {
      std::ifstream file(folder.path() / (strip.name + ".csv"));
      std::string header, line;
      std::getline(file, header);
      std::vector<std::string> rows;
      while (std::getline(file, line)) rows.push_back(line);
      file.close();
      reorder(rows);
      std::string text = header + '\n';
      for (const std::string& row : rows) text += row + '\n';
      folder.write(strip.name + ".csv", text);
    }
  }
  void reverse() const {
    rewrite([](auto& rows) { std::reverse(rows.begin(), rows.end()); });
  }
  void shuffle(std::uint64_t seed) const {
    rewrite([&](auto& rows) { std::shuffle(rows.begin(), rows.end(), std::mt19937_64(seed)); });
  }
};

std::vector<std::string> sentences(const Diagnosis& found, WarningKind kind) {
  std::vector<std::string> texts;
  for (const diagnosis::Warning& warning : found.warnings())
    if (warning.kind == kind) texts.push_back(warning.text);
  return texts;
}

void expect_the_same(const Diagnosis& a, const Diagnosis& b) {
  EXPECT_EQ(a.explanation.verdict, b.explanation.verdict);
  EXPECT_NEAR(a.analysis.evidence.fit.chi2, b.analysis.evidence.fit.chi2, 1e-6 * a.analysis.evidence.fit.chi2);
  EXPECT_NEAR(a.analysis.alarm.p(), b.analysis.alarm.p(), 1e-9);
  const auto &one = a.explanation.claim, &other = b.explanation.claim;
  EXPECT_EQ(one.named, other.named);
  EXPECT_EQ(one.ambiguity_set, other.ambiguity_set);
  ASSERT_EQ(one.causes.size(), other.causes.size());
  for (std::size_t k = 0; k < one.causes.size(); ++k) {
    EXPECT_EQ(one.causes[k].id, other.causes[k].id);
    EXPECT_EQ(one.causes[k].place.tests, other.causes[k].place.tests);
    EXPECT_NEAR(one.causes[k].probability, other.causes[k].probability, 1e-6);
    EXPECT_NEAR(one.causes[k].amplitude.value, other.causes[k].amplitude.value,
                1e-4 * (1e-3 + std::abs(one.causes[k].amplitude.value)));
  }
}

void hide_softening(json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("stress_softening", "s", 0.5)}; }

void hide_fibres(json& truth) { truth["models"]["gho"]["mechanisms"] = {mechanism("axial_fibres", "k", 6)}; }

// Seed 3. Where nobody states the noise, rows that run to and fro show it, and others tell nothing by their order.
TEST(RowOrder, ChangesNoVerdictWhereNobodySaysIt) {
  for (const bool stated : {true, false})
    for (const auto hide : {hide_fibres, hide_softening}) {
      Cyclic measured;
      measured.measure(3, hide);
      measured.forget_order();
      if (!stated)
        for (auto& [name, test] : measured.experiment["tests"].items()) test["data"].erase("noise");
      const Diagnosis stored = measured.diagnose();
      measured.reverse();
      const Diagnosis reversed = measured.diagnose();
      measured.shuffle(11);
      const Diagnosis shuffled = measured.diagnose();
      measured.shuffle(12);
      expect_the_same(shuffled, measured.diagnose());
      if (!stated) continue;
      expect_the_same(stored, reversed);
      expect_the_same(stored, shuffled);
    }
}

// The stored rows are in loading order, the test says so, and then the reversed ones are another experiment.
TEST(RowOrder, IsReadWhereTheFileDeclaresIt) {
  Cyclic measured;
  measured.measure(3, hide_softening);
  const Diagnosis found = measured.diagnose();
  EXPECT_FALSE(candidate(found, "stress_softening").hypotheses.empty());
  ASSERT_FALSE(found.explanation.claim.causes.empty());
  EXPECT_EQ(found.explanation.claim.causes.front().id, "stress_softening");
  EXPECT_THAT(sentences(found, WarningKind::memory_not_looked_for), ::testing::IsEmpty());
}

TEST(RowOrder, MemoryIsNotLookedForWithoutItAndOneSentenceSaysWhatToRecord) {
  Cyclic measured;
  measured.measure(3);
  measured.forget_order();
  const Diagnosis found = measured.diagnose();
  for (const char* id : {"stress_softening", "permanent_set", "signal_drift"}) {
    EXPECT_TRUE(candidate(found, id).hypotheses.empty()) << id;
    EXPECT_STREQ(code_of(candidate(found, id).absence), "no_past") << id;
  }
  EXPECT_FALSE(candidate(found, "axial_fibres").hypotheses.empty());
  EXPECT_THAT(sentences(found, WarningKind::memory_not_looked_for),
              ::testing::ElementsAre(AllOf(HasSubstr("stress_softening"), HasSubstr("were not looked for"),
                                           HasSubstr("nobody says in which order the rows of 'axial' and "
                                                     "'circumferential' were measured"),
                                           HasSubstr("add \"order\": \"loading\""))));
}

// The axial strip is a first loading, on which softening has no effect; its rows stand by their values.
TEST(RowOrder, OfOneTestIsEnoughForAMemoryOfTheMaterial) {
  Measured measured({{.stretch = cycles(1.02)}, {.name = "axial"}});
  measured.measure(3, hide_softening);
  measured.experiment["tests"]["axial"]["data"].erase("order");
  const Diagnosis found = measured.diagnose();
  ASSERT_THAT(found.explanation.claim.causes, ::testing::Not(::testing::IsEmpty()));
  EXPECT_EQ(found.explanation.claim.causes.front().id, "stress_softening");
  EXPECT_THAT(found.explanation.claim.ambiguity_set, ::testing::Contains("stress_softening"));
  EXPECT_NEAR(found.explanation.claim.causes.front().amplitude.value, 0.5, 0.05);
  EXPECT_THAT(sentences(found, WarningKind::run_takes_file_order),
              ::testing::ElementsAre(HasSubstr("the rows of 'axial' were measured")));
}

/// Two strips of which nobody kept the clock of the axial one: the other took 2 s from row to row.
Diagnosis diagnosed_with_one_clock(double axial_pace) {
  const std::vector<double> path = cycles(1.02);
  std::vector<double> time, fast;
  for (std::size_t i = 0; i < path.size(); ++i) time.push_back(2.0 * static_cast<double>(i));
  for (std::size_t i = 0; i < 30; ++i) fast.push_back(axial_pace * static_cast<double>(i));
  Measured measured({{.stretch = path, .time = time}, {.name = "axial", .time = fast}});
  measured.measure(3, [](json& truth) {
    json branch = mechanism("viscoelasticity", "g", 0.4);
    branch["parameters"]["tau"] = {{"initial", 10}};
    truth["models"]["gho"]["mechanisms"] = {branch};
  });
  json& axial = measured.experiment["tests"]["axial"]["data"];
  axial["columns"].erase("time");
  axial.erase("order");
  return measured.diagnose();
}

// It is stiffer than at rest, by how much its pace decides: that of the other strip, or too fast to relax.
TEST(RowOrder, WithoutAClockAStripMayHaveBeenPulledAtTheOthersPaceOrFaster) {
  for (const auto& [pace, words] : {std::pair{2.0, "load, 2 s from row to row"}, {0.001, "load, too fast to relax"}}) {
    const Diagnosis found = diagnosed_with_one_clock(pace);
    ASSERT_THAT(found.explanation.claim.causes, ::testing::Not(::testing::IsEmpty())) << pace;
    EXPECT_EQ(found.explanation.claim.causes.front().id, "viscoelasticity") << pace;
    EXPECT_NEAR(found.explanation.claim.causes.front().amplitude.value, 0.4, 0.1) << pace;
    EXPECT_THAT(sentences(found, WarningKind::run_takes_file_order),
                ::testing::ElementsAre(AllOf(HasSubstr(words), HasSubstr("without time"))));
  }
}

// The axial strip begins far from rest. What it bore before is unknown, so no memory of the material is looked for.
TEST(RowOrder, WithoutAPastADriftOfTheSensorIsNoName) {
  Measured measured({{.stretch = cycles(1.02)}, {.name = "axial", .stretch = testing::evenly(1.6, 1.02, 30)}});
  measured.measure(3, [](json& truth) {
    truth["tests"]["circumferential"]["mechanisms"] = {mechanism("signal_drift", "value", 8, {{"channel", "stress"}})};
  });
  const Diagnosis found = measured.diagnose();
  EXPECT_EQ(found.explanation.verdict, diagnosis::Verdict::indistinguishable);
  EXPECT_THAT(found.explanation.claim.ambiguity_set, ::testing::IsSupersetOf({"signal_drift", "stress_softening"}));
  EXPECT_THAT(found.explanation.reasons.front().text, HasSubstr("not looked for"));
}

TEST(RowOrder, OneTestWithoutItKeepsASensorOutOfThatTest) {
  Cyclic measured;
  measured.measure(3);
  measured.experiment["tests"]["axial"]["data"].erase("order");
  const Diagnosis found = measured.diagnose();
  for (const auto& one : candidate(found, "signal_drift").hypotheses)
    EXPECT_THAT(one.addition.place.tests, ::testing::ElementsAre("circumferential"));
  EXPECT_FALSE(candidate(found, "signal_drift").hypotheses.empty());
  EXPECT_THAT(
      sentences(found, WarningKind::memory_not_looked_for),
      ::testing::ElementsAre(AllOf(HasSubstr("permanent_set and signal_drift were not looked for in these tests"),
                                   HasSubstr("; stress_softening only as in a first loading"),
                                   HasSubstr("the rows of 'axial' were measured"))));
}

TEST(RowOrder, IsAssumedWithAWarningWhereMemoryIsAskedFor) {
  Cyclic measured;
  measured.measure(3, hide_softening);
  measured.forget_order();
  measured.experiment["diagnosis"]["mechanisms"] = {"stress_softening"};
  const Diagnosis found = measured.diagnose();
  EXPECT_FALSE(candidate(found, "stress_softening").hypotheses.empty());
  EXPECT_THAT(sentences(found, WarningKind::order_assumed),
              ::testing::ElementsAre(HasSubstr("taken for the whole loading path")));
}

// Declared, but it begins where the strip had been pulled to before.
TEST(RowOrder, SaysLittleWhereATestBeginsFarFromRestAndUnloads) {
  Measured measured({{}, {.name = "axial", .stretch = testing::evenly(1.6, 1.02, 30)}});
  measured.measure(3);
  const Diagnosis found = measured.diagnose();
  EXPECT_TRUE(candidate(found, "stress_softening").hypotheses.empty());
  EXPECT_FALSE(candidate(found, "signal_drift").hypotheses.empty());  // the sensor's past does not matter
  EXPECT_THAT(sentences(found, WarningKind::memory_not_looked_for),
              ::testing::ElementsAre(HasSubstr("the rows of 'axial' start far from rest and unload")));
}

// Of the file, wherever the row stands in the diagnosis. Seed 3; 200 σ.
TEST(RowOrder, GrossRowsAreCountedAsTheFileHasThem) {
  Cyclic measured;
  measured.measure(3);
  measured.forget_order();
  std::size_t at = 0;
  measured.rewrite([&at](std::vector<std::string>& rows) {
    at = 20;
    const auto comma = rows[at].find(',');
    rows[at] = rows[at].substr(0, comma + 1) + std::to_string(std::stod(rows[at].substr(comma + 1)) + 60);
  });
  const Diagnosis found = measured.diagnose();
  const auto& gross = found.explanation.gross.empty() ? found.analysis.evidence.gross : found.explanation.gross;
  ASSERT_EQ(gross.size(), 2u);
  for (const auto& row : gross) EXPECT_EQ(row.file_row, at);
  const json extended = json::parse(diagnosis::extended_experiment(found, testing::catalogue()));
  std::size_t taken_out = 0;
  for (const auto& [name, test] : extended["tests"].items())
    for (const auto& entry : test["mechanisms"])
      if (entry["type"] == "outliers") {
        EXPECT_EQ(entry["rows"], "20:21:1");
        ++taken_out;
      }
  EXPECT_GE(taken_out, 1u);
}

// What a run makes of shuffled rows of unknown order; hold_out means rows of the file.
TEST(RowOrder, ChangesNoParameterOfARun) {
  Cyclic measured;
  measured.measure(3);
  measured.forget_order();
  const auto fitted = [&] {
    const experiment::Experiment read = measured.read();
    const assembly::Assembly assembly(read, read.runs.front(), testing::catalogue());
    std::vector<double> initial(assembly.layout().parameters.size());
    assembly.box().from_unit(assembly.box().initial(), initial);
    return diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), initial,
                                    *assembly.evaluator().make_workspace())
        .free;
  };
  const std::vector<double> stored = fitted();
  measured.shuffle(11);
  const std::vector<double> shuffled = fitted();
  for (std::size_t k = 0; k < stored.size(); ++k) EXPECT_NEAR(stored[k], shuffled[k], 1e-5 * std::abs(stored[k]));
}

}  // namespace
}  // namespace tunica::trial
