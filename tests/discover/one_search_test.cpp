// SPDX-License-Identifier: Apache-2.0
// A whole discovery in one specimen, of which a few made-up laws are all that there is to find.
#include <algorithm>
#include <cmath>
#include <mutex>

#include <gmock/gmock.h>

#include "diagnosis/prospects/gain.hpp"
#include "discover/six_blocks.hpp"
#include "discovery/discovery.hpp"
#include "discovery/preparation.hpp"
#include "discovery/remainder.hpp"

namespace tunica::discovery::one_search_test {
namespace {

using diagnosis::Verdict;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;
using ::testing::SizeIs;
using trial::levels_with;
using trial::levels_with_fibres;
using trial::MadeUpTerms;
using trial::Measuring;
using trial::over_blocks;
using trial::six_blocks;
using trial::six_blocks_with_fibres;

using Levels = std::vector<double>;
using Laws = std::map<std::string, trial::MadeUpLaw>;

/// One specimen, and what is asked of it.
struct Specimen {
  explicit Specimen(const Levels& levels, const Laws& laws = six_blocks(), const Measuring& how = {.sd = 1, .seed = 2})
      : terms(levels, laws, how), experiment(terms.with_base("base")) {
    request.model = "m";
    request.quick = true;
    request.invariants = {"I1"};
    request.laws = {"linear", "quadratic"};
  }
  [[nodiscard]] Discovery discover(const diagnosis::Progress& progress = {}) const {
    return discovery::discover(experiment, request, terms.shelf, progress);
  }

  MadeUpTerms terms;
  experiment::Experiment experiment;
  Request request;
};

std::vector<std::string> names_of(const std::vector<KindPointer>& kinds) {
  std::vector<std::string> names;
  for (const KindPointer& kind : kinds) names.push_back(kind->name);
  return names;
}

std::vector<std::string> best_of(const Discovery& found) {
  return found.best ? names_of(found.best->kinds) : std::vector<std::string>{};
}

using Said = std::vector<std::pair<std::string, double>>;

/// What is reported, in the order that it is, of these stages.
Said said_of(const Specimen& one, const std::vector<std::string>& stages) {
  Said said;
  std::mutex mutex;
  (void)one.discover([&](const std::string& stage, double share) {
    const std::scoped_lock lock(mutex);
    if (std::find(stages.begin(), stages.end(), stage) != stages.end()) said.emplace_back(stage, share);
  });
  return said;
}

const std::vector<std::string> stages{"what the data reach", "terms of the energy", "terms of fibres",
                                      "mechanisms as rivals", "done"};

TEST(OneSearch, FindsTheTermAndSaysWhatItIsWorth) {
  const Specimen one(levels_with(2));
  EXPECT_THAT(said_of(one, stages), ElementsAre(Pair("what the data reach", 0.3), Pair("terms of the energy", 0.4),
                                                Pair("mechanisms as rivals", 0.8), Pair("done", 1)));
  const Discovery found = one.discover();
  EXPECT_EQ(found.judgement.verdict, Verdict::discovered);
  EXPECT_THAT(best_of(found), ElementsAre("I1_quadratic"));
  EXPECT_EQ(found.chi2_before, found.analysis.evidence.fit.chi2);
  EXPECT_EQ(found.chi2_after, found.best->chi2());
  EXPECT_NEAR(found.chi2_after, 58, 25);
  EXPECT_EQ(found.p_after, p_of_rest(found.analysis, found.best->fit));
  EXPECT_LT(found.p_after, 1);
  EXPECT_THAT(found.warnings, IsEmpty());
  ASSERT_THAT(found.terms, SizeIs(1));
  const FoundTerm& term = found.terms.front();
  EXPECT_NEAR(term.parameters.front().value, 2, 0.2);
  EXPECT_NEAR(term.curve.slope.at(30), term.parameters.front().value, 1e-9);

  const diagnosis::Request of_analysis = analysis_request(one.request);
  const diagnosis::Progress silent;
  const diagnosis::Inquiry inquiry{one.experiment, of_analysis, one.terms.shelf, silent};
  const std::vector<Rival> rivals = rivals_of(inquiry, found.analysis);
  ASSERT_EQ(found.rivals.size(), rivals.size());
  for (std::size_t k = 0; k < rivals.size(); ++k) EXPECT_EQ(found.rivals[k].log_evidence, rivals[k].log_evidence);
  // Rows beyond 70 % of the range are predicted by the others.
  const auto& assembly = found.best->set->assembly();
  const auto variables = diagnosis::all_variables(assembly);
  const auto held_out =
      diagnosis::held_out_blocks(inquiry, found.analysis.evidence, {assembly, variables, found.best->fit, {1}});
  ASSERT_THAT(held_out, SizeIs(1));
  ASSERT_THAT(found.held_out, SizeIs(1));
  EXPECT_EQ(found.held_out.front().p_value, held_out.front().p_value);
}

/// The rows that are fitted do not show a term of the last ones.
TEST(OneSearch, PredictsNothingFromRowsThatDoNotShowTheTerm) {
  Laws laws = six_blocks();
  laws["quadratic"] = over_blocks({0, 0, 0, 0, 0, 1});
  const Discovery found = Specimen({10, 10, 10, 10, 10, 20}, laws).discover();
  EXPECT_THAT(best_of(found), ElementsAre("I1_quadratic"));
  EXPECT_THAT(found.held_out, IsEmpty());
}

TEST(OneSearch, EndsWhereNoAlarmIsRaised) {
  const Specimen one(levels_with(0));
  const Discovery found = one.discover();
  EXPECT_EQ(found.judgement.verdict, Verdict::nothing_detected);
  EXPECT_FALSE(found.subject);
  EXPECT_THAT(found.rivals, IsEmpty());
  EXPECT_THAT(said_of(one, stages), IsEmpty());
}

/// What no law takes is left as the base leaves it.
TEST(OneSearch, HasNoTermWhereNoneHelps) {
  Specimen one({14, 10, 14, 10, 14, 10});
  one.request.laws.push_back("spline");
  const Discovery found = one.discover();
  EXPECT_FALSE(found.best);
  EXPECT_EQ(found.sets_tried, 0U);
  EXPECT_EQ(found.chi2_before, found.analysis.evidence.fit.chi2);
  EXPECT_EQ(found.chi2_after, found.chi2_before);
  EXPECT_GT(found.chi2_after, 200);
  EXPECT_THAT(found.terms, IsEmpty());
  EXPECT_THAT(found.held_out, IsEmpty());
  EXPECT_EQ(found.next, "");
}

/// Of what the terms leave where there are any, of what the base leaves where there are none.
TEST(OneSearch, LooksForHistoryInWhatIsLeft) {
  for (const double second : {0.0, 2.0}) {
    Levels there = levels_with(second), back = there;
    for (double& level : there) level += 3;
    for (double& level : back) level -= 3;
    Specimen one(there, six_blocks(), {.back = back});
    one.experiment.tests.front().data.order = data::Order::loading;
    const Discovery found = one.discover();
    EXPECT_EQ(found.best.has_value(), second > 0);
    const PathDependence expected =
        path_dependence(found.analysis.evidence, found.best ? found.best->fit : found.analysis.evidence.fit);
    EXPECT_TRUE(found.paths.decides());
    EXPECT_EQ(found.paths.share, expected.share);
    EXPECT_NEAR(found.paths.chi2, expected.chi2, 1e-9 * expected.chi2);
    EXPECT_EQ(found.judgement.reasons.front().kind, ReasonKind::not_an_energy);
  }
}

TEST(OneSearch, MakesAWholeEnergyWithoutAnAlarm) {
  Specimen one({5, 10, 15, 20, 25, 30}, six_blocks(), {});
  one.request.from_nothing = true;
  const Discovery found = one.discover();
  EXPECT_THAT(best_of(found), ElementsAre("I1_linear"));
  EXPECT_THAT(found.rivals, IsEmpty());
  EXPECT_NEAR(found.chi2_before, 0, 1e-6) << "of what a term linear in I1 leaves, whatever the file's model";
  EXPECT_NEAR(found.chi2_after, 0, 1e-6);
  Specimen nothing(Levels(6, 0), six_blocks(), {});
  nothing.request.from_nothing = true;
  const Discovery none = nothing.discover();
  EXPECT_FALSE(none.best);
  EXPECT_THAT(none.terms, IsEmpty());
}

TEST(OneSearch, LeavesOutGrossRowsBesideABase) {
  for (const bool from_nothing : {false, true}) {
    Specimen one(levels_with(2));
    std::vector<double> x, y;
    for (int i = 10; i < 70; ++i) {
      x.push_back(i);
      y.push_back(levels_with(2)[static_cast<std::size_t>(i / 10 - 1)] + 0.5 * std::sin(2.3 * i * i) +
                  (i == 35 ? 60 : 0));
    }
    one.terms.run.tests.clear();
    one.terms.experiment.tests.clear();
    one.terms.add_test("gross", x, y).data.noise = {{"y", {.absolute = 1}}};
    one.terms.experiment.runs = {one.terms.run};
    one.experiment = one.terms.with_base("base");
    one.request.from_nothing = from_nothing;
    EXPECT_THAT(one.discover().analysis.evidence.gross, SizeIs(from_nothing ? 0 : 1));
  }
}

TEST(OneSearch, AsksForAModel) {
  Specimen one(levels_with(2));
  one.request.model.clear();
  EXPECT_THAT(fakes::message_of([&] { (void)one.discover(); }), HasSubstr("Name one in"));
}

/// Noise that nobody states is asked once more of what the terms leave; whoever reads is told of it, and of what the
/// fits do not keep to.
TEST(OneSearch, EstimatesNoiseOnceMore) {
  Laws laws = six_blocks();
  laws.erase("stiffer");
  Specimen one(levels_with(2), laws);
  one.experiment.tests.front().data.noise.clear();
  one.experiment.runs.front().constraints.push_back({"transverse_stability"});
  const diagnosis::Request of_analysis = analysis_request(one.request);
  const diagnosis::Progress silent;
  const double first = diagnosis::analyse({one.experiment, of_analysis, one.terms.shelf, silent}, {})
                           .evidence.noise.front()
                           .noise.absolute;
  const Discovery found = one.discover();
  const diagnosis::Evidence& evidence = found.analysis.evidence;
  EXPECT_GT(first, 1.5);
  EXPECT_NEAR(evidence.noise.front().noise.absolute, 1, 0.2);
  EXPECT_THAT(said_of(one, {"what the data reach"}), SizeIs(2)) << "searched again";
  EXPECT_EQ(found.chi2_before, evidence.fit.chi2);
  EXPECT_EQ(found.chi2_after, found.best->chi2());
  EXPECT_NEAR(found.chi2_after, 60, 10);
  EXPECT_EQ(found.best->set->experiment().tests.front().data.noise.front().second.absolute,
            evidence.noise.front().noise.absolute);
  std::vector<diagnosis::WarningKind> kinds;
  for (const diagnosis::Warning& warning : found.warnings) kinds.push_back(warning.kind);
  EXPECT_THAT(kinds,
              ElementsAre(diagnosis::WarningKind::constraints_not_applied, diagnosis::WarningKind::noise_estimated));
}

/// Of a law and it beside another law of its invariant, which is little likelier, the law; and a word on what would
/// tell them apart.
TEST(OneSearch, PutsTheSimplestFirst) {
  for (const double first_law : {0.34, 0.5}) {
    const Discovery found = Specimen(levels_with(2, first_law), six_blocks(), {}).discover();
    const bool simplest = best_of(found).size() == 1;
    EXPECT_EQ(simplest, first_law < 0.4);
    EXPECT_EQ(found.sets_tried, 3U);
    if (simplest) {
      EXPECT_GT(found.judgement.all.at(1).probability, 3 * found.judgement.all[0].probability);
    }
    EXPECT_EQ(found.next.find("I1 (quadratic), or I1 (linear) and I1 (quadratic)") != std::string::npos, simplest);
  }
}

/// Fibres along the test beside laws of I1.
struct FibreSpecimen : Specimen {
  explicit FibreSpecimen(const Levels& levels, bool two_channels = true)
      : Specimen(levels, six_blocks_with_fibres(), {.two_channels = two_channels}) {
    request.from_nothing = true;
    request.invariants.clear();
  }
};

/// Where an isotropic energy leaves more than noise, and the tests show two directions.
TEST(OneSearch, TriesFibresWhereTheyMayBe) {
  const std::vector<std::string> isotropic{"I1_linear"}, both{"I1_linear", "fibre_circumferential_quadratic"};
  const FibreSpecimen one(levels_with_fibres(5));
  EXPECT_EQ(best_of(one.discover()), isotropic) << "no two rows at the same stretch show two directions";
  EXPECT_THAT(said_of(one, {"terms of fibres"}), IsEmpty());
  EXPECT_EQ(best_of(FibreSpecimen(levels_with_fibres(5), false).discover()), isotropic) << "one direction";
  FibreSpecimen beside(levels_with_fibres(5));
  beside.request.from_nothing = false;
  EXPECT_THAT(said_of(beside, {"terms of fibres"}), IsEmpty()) << "beside a base";
  // These leave more than noise.
  FibreSpecimen listed(levels_with_fibres(5, 2));
  listed.request.invariants = {"I1", "fibre circumferential"};
  EXPECT_EQ(best_of(listed.discover()), both);
  EXPECT_THAT(said_of(listed, {"terms of fibres"}), IsEmpty()) << "at once, as they are asked for";
  FibreSpecimen directed(levels_with_fibres(5, 2));
  directed.experiment.models.front() = {"m", "parabola", {}, {}, {}};
  EXPECT_EQ(best_of(directed.discover()), both);
  EXPECT_THAT(said_of(directed, {"terms of fibres"}), IsEmpty()) << "at once, as the file's model has directions";
}

TEST(OneSearch, TriesNoFibresWhereNothingIsLeft) {
  const FibreSpecimen one(levels_with_fibres(0.45));
  const Discovery found = one.discover();
  EXPECT_GT(found.p_after, 0.01);
  EXPECT_THAT(best_of(found), ElementsAre("I1_linear"));
  EXPECT_THAT(said_of(one, {"terms of fibres"}), IsEmpty());
}

TEST(OneSearch, LeavesFibresThatDoNotHelp) {
  const Discovery found = FibreSpecimen(levels_with_fibres(0, 2)).discover();
  ASSERT_TRUE(found.best);
  EXPECT_LT(found.p_after, 0.01);
  for (const KindPointer& kind : found.best->kinds) {
    EXPECT_TRUE(kind->isotropic());
    EXPECT_NEAR(kind->log_prior, std::log(0.5), 1e-12) << "as one of two laws";
  }
}

/// A law of blocks 1 and 3, and curves whose heights are the levels of the first four blocks.
Laws with_curves() {
  Laws laws = six_blocks();
  laws["quadratic"] = over_blocks({0, 1, 0, 3, 0, 0});
  laws["spline"] = over_blocks({});
  for (std::size_t j = 0; j < 9; ++j)
    laws["spline"].heights.push_back([j](std::size_t block) { return j == block && j < 4 ? 1.0 : 0.0; });
  return laws;
}

/// Twice the law, and more in blocks 0 and 2.
Levels levels_of_a_curve(double more) { return {10 + more, 12, 10 + more, 16, 10, 10}; }

TEST(OneSearch, TakesACurveWhereItSaysMore) {
  const std::vector<std::string> law{"I1_quadratic"}, curve{"I1_curve"};
  Specimen one(levels_of_a_curve(4), with_curves(), {});
  EXPECT_EQ(best_of(one.discover()), law) << "not asked for";
  one.request.laws.push_back("spline");
  EXPECT_EQ(best_of(one.discover()), curve);
  one.request.laws.clear();
  EXPECT_EQ(best_of(one.discover()), curve) << "as one of all";
  for (const std::size_t most : {1U, 20U}) {
    one.request.most_parameters = most;
    EXPECT_EQ(best_of(one.discover()), law) << "a curve has many parameters";
  }
  for (const double more : {1.5, 1.7}) {
    Specimen weaker(levels_of_a_curve(more), with_curves(), {});
    weaker.request.laws.push_back("spline");
    const Discovery found = weaker.discover();
    EXPECT_EQ(found.sets_tried, more > 1.6 ? 2U : 1U) << "it has to be clearly ahead";
    EXPECT_EQ(best_of(found), more > 1.6 ? curve : law);
  }
}

/// In addition where there is room for a term, and more than noise is left.
TEST(OneSearch, PutsACurveBesideTheTerms) {
  Laws laws = with_curves();
  laws["quadratic"] = over_blocks({0, 0, 0, 0, 1, 2});
  laws.erase("rig");
  laws.erase("stiffer");
  laws["circumferential quadratic"] = over_blocks({0, 1, 0, 0, 0, 0});
  laws["circumferential spline"] = over_blocks({1});
  for (std::size_t block = 2; block < 10; ++block)
    laws["circumferential spline"].heights.push_back(
        [block](std::size_t at) { return block == 2 && at == 2 ? 1.0 : 0.0; });
  const auto best = [&](double rest, std::size_t most_terms) {
    Specimen one({10 + rest, 10, 10 + rest, 10, 16, 22}, laws, {});
    one.request.invariants = {"I1", "fibre circumferential"};
    one.request.laws.push_back("spline");
    one.request.most_terms = most_terms;
    const Discovery found = one.discover();
    EXPECT_EQ(found.p_after > 0.01, rest < 3 || best_of(found).size() == 2);
    return best_of(found);
  };
  const std::vector<std::string> law{"I1_quadratic"}, both{"I1_quadratic", "fibre_circumferential_curve"};
  EXPECT_EQ(best(6, 2), both);
  EXPECT_EQ(best(6, 1), law);
  EXPECT_EQ(best(2, 2), law) << "what it leaves is noise";
}

}  // namespace
}  // namespace tunica::discovery::one_search_test
