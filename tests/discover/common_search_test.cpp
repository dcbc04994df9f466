// SPDX-License-Identifier: Apache-2.0
// One search in several specimens, of which a few made-up laws are all that there is to find.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

#include "discover/six_blocks.hpp"
#include "discovery/common/common_discovery.hpp"
#include "discovery/common/common_rivals.hpp"
#include "discovery/preparation.hpp"
#include "discovery/search.hpp"

namespace tunica::discovery::common_search_test {
namespace {

using diagnosis::Verdict;
using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using ::testing::StartsWith;
using trial::levels_with;
using trial::levels_with_fibres;
using trial::MadeUpTerms;
using trial::Measuring;
using trial::six_blocks;
using trial::six_blocks_with_fibres;

using Levels = std::vector<double>;

class Tissue {
 public:
  /// One specimen for each list of levels, with noise of 1 that is seeded by their number, from 2.
  explicit Tissue(const std::vector<Levels>& levels, double sd = 1,
                  const std::map<std::string, trial::MadeUpLaw>& of = six_blocks(), bool two_channels = false) {
    for (const Levels& one : levels) {
      specimens.push_back(std::make_unique<MadeUpTerms>(
          one, of, Measuring{.two_channels = two_channels, .sd = sd, .seed = specimens.size() + 2}));
      members.push_back({"S" + std::to_string(specimens.size()), specimens.back()->with_base("base")});
    }
    request.model = "m";
    request.quick = true;
    request.invariants = {"I1"};
    request.laws = {"linear", "quadratic"};
  }
  [[nodiscard]] CommonDiscovery discover() const {
    return discover_together(members, request, specimens.front()->shelf);
  }

  std::vector<std::unique_ptr<MadeUpTerms>> specimens;
  std::vector<Member> members;
  Request request;
};

std::vector<std::string> names_of(const std::vector<KindPointer>& kinds) {
  std::vector<std::string> names;
  for (const KindPointer& kind : kinds) names.push_back(kind->name);
  return names;
}

/// P-values of the alarms together: for n specimens with −Σ ln p = x it is e^−x Σ x^k/k!, k < n.
double together(const std::vector<SpecimenOutcome>& specimens) {
  double x = 0, sum = 0, term = 1;
  for (const SpecimenOutcome& one : specimens) x -= std::log(std::max(one.analysis.alarm.p(), 1e-12));
  for (std::size_t k = 0; k < specimens.size(); ++k) {
    sum += term;
    term *= x / static_cast<double>(k + 1);
  }
  return std::exp(-x) * sum;
}

TEST(CommonSearch, GoesThroughAllSpecimens) {
  const Tissue tissue({levels_with(2), levels_with(3), levels_with(1)});
  std::vector<std::pair<std::string, double>> said;
  const auto found =
      discover_together(tissue.members, tissue.request, tissue.specimens.front()->shelf,
                        [&](const std::string& stage, double share) { said.emplace_back(stage, share); });
  EXPECT_THAT(said, ElementsAre(Pair("specimen 1 of 3", 0), Pair("specimen 2 of 3", 0.5 * 1 / 3),
                                Pair("specimen 3 of 3", 0.5 * 2 / 3), Pair("terms of the energy", 0.5),
                                Pair("mechanisms as rivals", 0.8), Pair("done", 1)));
  EXPECT_EQ(found.judgement.verdict, Verdict::discovered);
  ASSERT_TRUE(found.best);
  EXPECT_THAT(names_of(found.best->kinds), ElementsAre("I1_quadratic"));
  EXPECT_NEAR(found.p_before, together(found.specimens), 1e-6 * found.p_before);
  EXPECT_EQ(found.rows, 180U);
  EXPECT_THAT(found.left_out, IsEmpty());
  EXPECT_THAT(found.warnings, IsEmpty());
  ASSERT_THAT(found.specimens, SizeIs(3));
  double before = 0;
  std::vector<std::unique_ptr<const Fitter>> fitters;
  std::vector<const Fitter*> pointers;
  std::vector<std::vector<KindPointer>> kinds;
  std::vector<std::vector<Rival>> rivals;
  for (std::size_t s = 0; s < 3; ++s) {
    const SpecimenOutcome& one = found.specimens[s];
    EXPECT_EQ(one.id, tissue.members[s].id);
    EXPECT_EQ(one.chi2_before, one.analysis.evidence.fit.chi2);
    EXPECT_LT(one.chi2_after, 100);
    before += one.chi2_before;
    ASSERT_TRUE(one.subject);
    fitters.push_back(std::make_unique<const Fitter>(*one.subject, one.analysis.evidence));
    pointers.push_back(fitters.back().get());
    kinds.push_back(
        scaled_kinds(*fitters.back(),
                     kinds_of(tissue.request, reached_states(*one.subject, one.analysis.evidence.fit.free), false)));
    const diagnosis::Request of_analysis = analysis_request(tissue.request);
    const diagnosis::Progress silent;
    rivals.push_back(
        rivals_of({tissue.members[s].experiment, of_analysis, tissue.specimens.front()->shelf, silent}, one.analysis));
  }
  EXPECT_NEAR(found.chi2_before, before, 1e-9 * before);
  const CommonFitter fitter(pointers, kinds, false);
  EXPECT_EQ(found.sets_tried, search(fitter, {3}, [](const CommonFit&) { return true; }).size());
  const std::vector<Rival> expected = common_rivals(rivals, fitter.root());
  ASSERT_THAT(found.rivals, SizeIs(2));
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(found.rivals[k].id, expected[k].id);
    EXPECT_NEAR(found.rivals[k].log_evidence, expected[k].log_evidence, 1e-9 * std::abs(expected[k].log_evidence));
  }
}

TEST(CommonSearch, EndsWhereNoAlarmIsRaised) {
  const Tissue tissue({levels_with(0), levels_with(0)});
  std::vector<std::string> said;
  const auto found = discover_together(tissue.members, tissue.request, tissue.specimens.front()->shelf,
                                       [&](const std::string& stage, double) { said.push_back(stage); });
  EXPECT_THAT(said, ElementsAre("specimen 1 of 2", "specimen 2 of 2", "done"));
  EXPECT_EQ(found.judgement.verdict, Verdict::nothing_detected);
  EXPECT_NEAR(found.p_before, together(found.specimens), 1e-9);
  EXPECT_EQ(found.p_after, found.p_before);
  EXPECT_EQ(found.chi2_after, found.chi2_before);
  EXPECT_EQ(found.rows, 120U);
  EXPECT_EQ(found.sets_tried, 0U);
  EXPECT_THAT(found.rivals, IsEmpty());
  ASSERT_THAT(found.specimens, SizeIs(2));
  for (const SpecimenOutcome& one : found.specimens) {
    EXPECT_FALSE(one.subject);
    EXPECT_EQ(one.p_after, one.analysis.alarm.p());
    EXPECT_EQ(one.chi2_before, one.analysis.evidence.fit.chi2);
    EXPECT_EQ(one.chi2_after, one.chi2_before);
  }
  Tissue sensitive({levels_with(0), levels_with(0)});
  sensitive.request.alpha = found.p_before;
  EXPECT_TRUE(sensitive.discover().specimens.front().subject) << "an alarm at its level is one";
}

TEST(CommonSearch, HasNoDoubtOfDataWithoutNoise) {
  EXPECT_EQ(Tissue({levels_with(0), levels_with(0)}, 0).discover().p_before, 1);
}

/// However little it says: the noise of this seed has p = 0.94.
TEST(CommonSearch, OfOneSpecimenHasItsAlarm) {
  Tissue tissue(std::vector<Levels>(4, levels_with(0)));
  tissue.members.erase(tissue.members.begin(), tissue.members.end() - 1);
  const auto found = tissue.discover();
  ASSERT_THAT(found.specimens, SizeIs(1));
  EXPECT_GT(found.specimens.front().analysis.alarm.p(), 0.7);
  EXPECT_NEAR(found.p_before, found.specimens.front().analysis.alarm.p(), 1e-9);
}

/// Each at 1 in 20 by the smaller one of two tests.
TEST(CommonSearch, CountsRestsThatAreNotNoise) {
  EXPECT_EQ(p_of_rests({0.003}), 0.003);
  EXPECT_NEAR(p_of_rests({0.025, 0.5}), 1 - 0.95 * 0.95, 1e-12);
  EXPECT_EQ(p_of_rests({0.026, 0.5}), 1);
}

/// Alarms that say nothing alone may say something together.
TEST(CommonSearch, AddsUpWhatAlarmsSay) {
  const auto found = Tissue({levels_with(0.12), levels_with(0.12), levels_with(0.12), levels_with(0.12)}).discover();
  EXPECT_NEAR(found.p_before, together(found.specimens), 1e-9);
  for (const SpecimenOutcome& one : found.specimens) EXPECT_LT(found.p_before, one.analysis.alarm.p());
}

TEST(CommonSearch, MakesAWholeEnergyWithoutAnAlarm) {
  Tissue tissue({{5, 10, 15, 20, 25, 30}, {6, 12, 18, 24, 30, 36}}, 0);
  tissue.request.from_nothing = true;
  const auto found = tissue.discover();
  ASSERT_TRUE(found.best);
  EXPECT_THAT(names_of(found.best->kinds), ElementsAre("I1_linear"));
  EXPECT_THAT(found.rivals, IsEmpty()) << "there is no base that mechanisms would act on";
  EXPECT_NEAR(found.chi2_before, 0, 1e-6) << "of what a term linear in I1 leaves, whatever the file's model";
  for (const SpecimenOutcome& one : found.specimens) {
    EXPECT_TRUE(one.subject->from_nothing);
    EXPECT_NEAR(one.chi2_after, 0, 1e-6);
  }
}

/// A row that stands apart is left out beside a base, and is the terms' own business from nothing.
TEST(CommonSearch, LeavesOutGrossRowsBesideABase) {
  for (const bool from_nothing : {false, true}) {
    Tissue tissue({levels_with(2), levels_with(2)});
    std::vector<double> x, y;
    for (int i = 10; i < 70; ++i) {
      x.push_back(i);
      y.push_back(levels_with(2)[static_cast<std::size_t>(i / 10 - 1)] + 0.5 * std::sin(2.3 * i * i) +
                  (i == 35 ? 60 : 0));
    }
    tissue.specimens[0]->run.tests.clear();
    tissue.specimens[0]->experiment.tests.clear();
    auto& test = tissue.specimens[0]->add_test("gross", x, y);
    test.data.noise = {{"y", {.absolute = 1}}};
    tissue.specimens[0]->experiment.runs = {tissue.specimens[0]->run};
    tissue.members[0].experiment = tissue.specimens[0]->with_base("base");
    tissue.request.from_nothing = from_nothing;
    const auto found = tissue.discover();
    EXPECT_THAT(found.specimens[0].analysis.evidence.gross, SizeIs(from_nothing ? 0 : 1));
    EXPECT_THAT(found.specimens[1].analysis.evidence.gross, IsEmpty());
  }
}

/// What cannot be read, what cannot be fitted, and what nothing was measured of.
TEST(CommonSearch, LeavesSpecimensOutWithTheirReason) {
  Tissue tissue({levels_with(2), levels_with(2), levels_with(2), {10, 10, 10, 10}});
  tissue.members[1].experiment.tests.front().data.columns = {{"x", "x"}, {"y", "no such column"}};
  fakes::set_behaviour([](double, std::span<double> values, Status& status) {
    if (values.size() == 40) status = Status::failed("it tears");
  });
  const auto found = tissue.discover();
  ASSERT_THAT(found.specimens, SizeIs(2));
  EXPECT_EQ(found.specimens[0].id, "S1");
  EXPECT_EQ(found.specimens[1].id, "S3");
  ASSERT_THAT(found.left_out, SizeIs(2));
  EXPECT_EQ(found.left_out[0].id, "S2");
  EXPECT_THAT(found.left_out[0].reason, HasSubstr("no such column"));
  EXPECT_EQ(found.left_out[1].id, "S4");
  EXPECT_THAT(found.left_out[1].reason, HasSubstr("it tears"));

  tissue.members[2].experiment.tests.front().measured = false;
  const auto without = tissue.discover();
  ASSERT_THAT(without.left_out, SizeIs(3));
  EXPECT_EQ(without.left_out[1].id, "S3");
  EXPECT_THAT(without.left_out[1].reason, HasSubstr("no test has measured values"));

  tissue.members.erase(tissue.members.begin() + 2);
  tissue.members.erase(tissue.members.begin());
  EXPECT_THAT(fakes::message_of([&] { (void)tissue.discover(); }),
              AllOf(HasSubstr("none of 2 specimens can be fitted"), HasSubstr("'S2'"), HasSubstr("no such column")));
}

TEST(CommonSearch, AsksForAModelAndForSpecimens) {
  Tissue tissue({levels_with(0)});
  tissue.members.clear();
  EXPECT_THAT(fakes::message_of([&] { (void)tissue.discover(); }), HasSubstr("no specimen to search in"));
  tissue.request.model.clear();
  EXPECT_THAT(fakes::message_of([&] { (void)tissue.discover(); }), HasSubstr("Name one in"));
}

/// One warning of a kind, of the first specimen that has it.
TEST(CommonSearch, GathersWarnings) {
  Tissue tissue({levels_with(0), levels_with(0), levels_with(0)});
  const auto silent = [&](std::size_t s) { tissue.members[s].experiment.tests.front().data.noise.clear(); };
  silent(1);
  const auto one = tissue.discover().warnings;
  ASSERT_THAT(one, SizeIs(1));
  EXPECT_EQ(one[0].kind, diagnosis::WarningKind::noise_estimated);
  EXPECT_THAT(one[0].text, StartsWith("S2: "));
  EXPECT_EQ(one[0].text.find("of this kind"), std::string::npos);
  silent(2);
  const auto two = tissue.discover().warnings;
  ASSERT_THAT(two, SizeIs(1));
  EXPECT_THAT(two[0].text, AllOf(StartsWith("S2: "), EndsWith(" (of this kind in 2 of 3 specimens)")));
}

/// Noise that nobody states is asked once more of what the terms leave.
TEST(CommonSearch, EstimatesNoiseOnceMore) {
  for (const std::size_t open : {0U, 1U}) {
    auto without_mechanisms = six_blocks();
    without_mechanisms.erase("stiffer");
    Tissue tissue({levels_with(2), levels_with(2)}, 1, without_mechanisms);
    tissue.members[open].experiment.tests.front().data.noise.clear();
    const diagnosis::Request of_analysis = analysis_request(tissue.request);
    const diagnosis::Progress silent;
    const diagnosis::Analysis first =
        diagnosis::analyse({tissue.members[open].experiment, of_analysis, tissue.specimens.front()->shelf, silent}, {});
    const auto found = tissue.discover();
    const SpecimenOutcome& one = found.specimens[open];
    const double sd = one.analysis.evidence.noise.front().noise.absolute;
    EXPECT_NEAR(sd, 1, 0.2);
    EXPECT_GT(first.evidence.noise.front().noise.absolute, 1.5);
    EXPECT_EQ(found.specimens[1 - open].analysis.evidence.noise.front().noise.absolute, 1);
    EXPECT_NEAR(found.p_before, together(found.specimens), 1e-6 * found.p_before);
    EXPECT_EQ(one.chi2_before, one.analysis.evidence.fit.chi2);
    EXPECT_NEAR(one.chi2_after, 60, 10);
  }
}

/// Of a law and it beside another law of its invariant, which is little likelier, the law.
TEST(CommonSearch, PutsTheSimplestFirst) {
  for (const double first_law : {0.29, 0.4}) {
    const std::vector<Alternative> all =
        Tissue(std::vector<Levels>(2, levels_with(2, first_law)), 0).discover().judgement.all;
    const bool simplest = names_of(all.at(0).kinds).size() == 1;
    EXPECT_EQ(simplest, first_law < 0.3);
    if (simplest) {
      EXPECT_GT(all.at(1).probability, 2 * all[0].probability);
    }
  }
}

struct FibreSearch : Tissue {
  explicit FibreSearch(const std::vector<Levels>& levels, bool two_channels = true)
      : Tissue(levels, 0, six_blocks_with_fibres(), two_channels) {
    request.from_nothing = true;
    request.invariants.clear();
  }
};

bool has_fibres(const CommonDiscovery& found) {
  return found.best && std::any_of(found.best->kinds.begin(), found.best->kinds.end(),
                                   [](const KindPointer& kind) { return !kind->isotropic(); });
}

/// Where an isotropic energy leaves more than noise, and the tests show two directions.
TEST(CommonSearch, TriesFibresWhereTheyMayBe) {
  EXPECT_FALSE(has_fibres(FibreSearch({levels_with_fibres(5), levels_with_fibres(4)}).discover()))
      << "no two rows at the same stretch show two directions";
  EXPECT_FALSE(has_fibres(FibreSearch({levels_with_fibres(5), levels_with_fibres(4)}, false).discover()))
      << "one direction";
  FibreSearch beside({levels_with_fibres(5), levels_with_fibres(4)});
  beside.request.from_nothing = false;
  EXPECT_FALSE(has_fibres(beside.discover())) << "beside a base that has no directions";
}

/// They would be likelier, by what they take of the noise.
TEST(CommonSearch, TriesNoFibresWhereNothingIsLeft) {
  const auto found = FibreSearch({levels_with_fibres(0.45), levels_with_fibres(0.45)}).discover();
  EXPECT_GT(found.chi2_after, 20);
  EXPECT_FALSE(has_fibres(found));
  // One of two specimens may have a rest that is not noise: 1 − 0.95².
  for (const std::size_t odd : {0U, 1U}) {
    std::vector<Levels> levels(2, levels_with_fibres(0));
    levels[odd] = levels_with_fibres(3);
    const auto one = FibreSearch(levels).discover();
    EXPECT_NEAR(one.p_after, 0.0975, 1e-9);
    EXPECT_FALSE(has_fibres(one));
  }
}

TEST(CommonSearch, LeavesFibresThatDoNotHelp) {
  const auto found = FibreSearch({levels_with_fibres(0, 2), levels_with_fibres(0, 2)}).discover();
  ASSERT_TRUE(found.best);
  EXPECT_LT(found.p_after, 0.01);
  EXPECT_FALSE(has_fibres(found));
  for (const KindPointer& kind : found.best->kinds)
    EXPECT_NEAR(kind->log_prior, std::log(0.5), 1e-12) << "as one of two laws";
}

TEST(CommonSearch, MakesNothingOfNothing) {
  FibreSearch nothing({Levels(6, 0), Levels(6, 0)});
  const auto found = nothing.discover();
  EXPECT_FALSE(found.best);
  EXPECT_EQ(found.sets_tried, 0U);
}

}  // namespace
}  // namespace tunica::discovery::common_search_test
