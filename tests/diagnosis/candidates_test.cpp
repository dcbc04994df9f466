// SPDX-License-Identifier: Apache-2.0
// Where every mechanism is looked for, what it would show there, and why it is not looked for.
#include <mutex>

#include <gmock/gmock.h>

#include "diagnosis/search_bed.hpp"
#include "tunica/error.hpp"

namespace tunica::diagnosis::candidates_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using Side = MechanismFactory::Side;
using Tests = std::vector<std::string>;

const Effect proportional = [](double x, auto own, const Options&) { return own[0] * x; };

Eigen::VectorXd vector(std::vector<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void expect_signature(const Hypothesis& found, const std::vector<double>& expected, double tolerance = 1e-7) {
  ASSERT_EQ(found.signature.size(), static_cast<Eigen::Index>(expected.size()));
  EXPECT_LT((found.signature - vector(expected)).norm(), tolerance) << found.signature.transpose();
}

/// Test "a" with rows at 1, 2 and channels y and z (σ = 0.5 and 5), "b" with rows at 3, 4, 5.
struct TwoTests : SearchBed {
  TwoTests() {
    add("a", {1, 2}, true);
    add("b", {3, 4, 5});
  }
};

TEST(Candidates, ActOnEachTestAndWhereTheyAreSharedOnAllOfThem) {
  TwoTests bed;
  bed.put(acting("alone", proportional));
  MechanismFactory shared = acting("shared", proportional);
  shared.shared = true;
  bed.put(shared);
  bed.close();
  const Candidate alone = bed.find("alone");
  EXPECT_EQ(alone.absent, "");
  EXPECT_EQ(alone.absence, Absence::none);
  ASSERT_THAT(alone.hypotheses, SizeIs(2));
  EXPECT_EQ(alone.hypotheses[0].addition.place.tests, Tests{"a"});
  EXPECT_EQ(alone.hypotheses[0].side, Side::both);
  expect_signature(alone.hypotheses[0], {2, 4, 0.2, 0.4, 0, 0, 0});
  EXPECT_EQ(alone.hypotheses[1].addition.place.tests, Tests{"b"});
  expect_signature(alone.hypotheses[1], {0, 0, 0, 0, 6, 8, 10});
  const Candidate everywhere = bed.find("shared");
  ASSERT_THAT(everywhere.hypotheses, SizeIs(3));
  EXPECT_EQ(everywhere.hypotheses[2].addition.place.tests, (Tests{"a", "b"}));
  expect_signature(everywhere.hypotheses[2], {2, 4, 0.2, 0.4, 6, 8, 10});

  SearchBed one;
  one.add("a", {1, 2});
  one.put(shared);
  one.close();
  EXPECT_THAT(one.find("shared").hypotheses, SizeIs(1)) << "all tests are one";
}

TEST(Candidates, AreThoseThatWereAskedForOrAll) {
  TwoTests bed;
  bed.put(acting("p", proportional));
  MechanismFactory open = acting("open", proportional);
  open.parameters_of = [parameters = open.parameters](const Options&) { return parameters; };
  bed.put(open);
  bed.close();
  const auto ids = [&bed] {
    std::vector<std::string> found;
    for (const Candidate& one : bed.all()) found.push_back(one.id);
    return found;
  };
  EXPECT_THAT(
      ids(), ::testing::UnorderedElementsAre("cubic", "doubling", "memory", "offset", "p", "scale_error", "strip_only"))
      << "what may stand for anything is left to discovery";
  bed.request.mechanisms = {"p", "cubic"};
  EXPECT_THAT(ids(), ::testing::UnorderedElementsAre("cubic", "p"));
}

TEST(Candidates, AreThoseOfTheGroupsThatWereAskedForUnlessTheyAreNamed) {
  TwoTests bed;
  MechanismFactory wall = acting("wall", proportional);
  wall.origin = MechanismFactory::Origin::material;
  bed.put(wall);
  bed.close();
  const auto ids_in = [&bed](const std::vector<std::string>& groups) {
    bed.request.groups = groups;
    std::vector<std::string> found;
    for (const Candidate& one : bed.all()) found.push_back(one.id);
    return found;
  };
  EXPECT_THAT(ids_in({"material", "file"}), Contains("wall"));
  EXPECT_THAT(ids_in({"material", "file"}), Not(Contains("offset")));
  EXPECT_THAT(ids_in({"rig"}), Contains("offset"));
  EXPECT_THAT(ids_in({"rig"}), Not(Contains("wall")));
  EXPECT_EQ(ids_in({"material"}).size() + ids_in({"rig"}).size(), ids_in({"material", "rig"}).size());
  EXPECT_THAT(ids_in({"file"}), IsEmpty());
  bed.request.mechanisms = {"wall"};
  EXPECT_THAT(ids_in({"rig"}), ElementsAre("wall"));
}

TEST(Candidates, AreCountedInTheProgress) {
  TwoTests bed;
  bed.request.mechanisms = {"cubic", "offset"};
  std::vector<double> shares;
  std::mutex mutex;
  bed.progress = [&](const std::string& stage, double share) {
    EXPECT_THAT(stage, HasSubstr("signatures"));
    const std::scoped_lock lock(mutex);
    shares.push_back(share);
  };
  bed.close();
  EXPECT_THAT(bed.all(), SizeIs(2));
  std::sort(shares.begin(), shares.end());
  using ::testing::DoubleNear;
  EXPECT_THAT(shares, ElementsAre(DoubleNear(0.1, 1e-12), DoubleNear(0.15, 1e-12), DoubleNear(0.2, 1e-12)));
}

// S + β x³ and S · factor at a = 3, c = 0.5: 3 + 0.1 x + 0.5 x².
TEST(Candidates, OfTheMaterialShowWhatItDoesAtTheFitInAllTests) {
  TwoTests bed;
  for (const char* name : {"a", "c"}) {
    auto& setting = bed.parameter(name);
    setting.fixed.reset();
    setting.initial = 1;
  }
  bed.close({3, 0.5});
  const Candidate cubic = bed.find("cubic");
  ASSERT_THAT(cubic.hypotheses, SizeIs(1));
  EXPECT_THAT(cubic.hypotheses[0].addition.place.tests, IsEmpty());
  EXPECT_EQ(cubic.hypotheses[0].addition.place.model, "") << "there is one only";
  expect_signature(cubic.hypotheses[0], {2, 16, 2, 16, 54, 128, 250});
  const Candidate doubling = bed.find("doubling");
  ASSERT_FALSE(doubling.hypotheses.empty());
  expect_signature(doubling.hypotheses.back(), {7.2, 10.4, 7.2, 10.4, 15.6, 22.8, 32});
}

TEST(Candidates, OfAWallAreLookedForInEachMaterial) {
  SearchBed bed;
  bed.experiment.models.push_back(bed.experiment.models.front());
  bed.experiment.models.back().name = "n";
  auto& wall = bed.add("wall", {1, 2});
  wall.type = "stack";
  wall.layers = {{"m", 1}, {"n", 3}};
  bed.run.model.clear();
  bed.close();
  const Candidate cubic = bed.find("cubic");
  ASSERT_THAT(cubic.hypotheses, SizeIs(2));
  EXPECT_EQ(cubic.hypotheses[0].addition.place.model, "m");
  EXPECT_EQ(cubic.hypotheses[1].addition.place.model, "n");
  expect_signature(cubic.hypotheses[0], {2, 16});
  expect_signature(cubic.hypotheses[1], {6, 48});
  bed.experiment.models.back().mechanisms.push_back({"cubic", {}, {}});
  bed.experiment.models.back().mechanisms.back().parameters["beta"].fixed = 0.1;
  bed.close();
  ASSERT_THAT(bed.find("cubic").hypotheses, SizeIs(1));
  EXPECT_EQ(bed.find("cubic").hypotheses[0].addition.place.model, "m") << "the other has it";
}

TEST(Candidates, AreNotLookedForWhereTheyAreAlready) {
  TwoTests bed;
  bed.model().mechanisms.push_back({"cubic", {}, {}});
  bed.model().mechanisms.back().parameters["beta"].fixed = 0.1;
  const auto offset_in = [&bed](std::size_t test) {
    bed.experiment.tests[test].mechanisms.push_back({"offset", {}, {}});
    bed.experiment.tests[test].mechanisms.back().parameters["value"].fixed = 0.1;
  };
  offset_in(0);
  bed.close();
  const Candidate cubic = bed.find("cubic");
  EXPECT_THAT(cubic.hypotheses, IsEmpty());
  EXPECT_EQ(cubic.absence, Absence::already_there);
  EXPECT_THAT(cubic.absent, HasSubstr("already"));
  ASSERT_THAT(bed.find("offset").hypotheses, SizeIs(1));
  EXPECT_EQ(bed.find("offset").hypotheses[0].addition.place.tests, Tests{"b"});
  offset_in(1);
  bed.close();
  EXPECT_THAT(bed.find("offset").hypotheses, IsEmpty());
  EXPECT_EQ(bed.find("offset").absence, Absence::no_place);
}

TEST(Candidates, SayWhyTheyAreNotThere) {
  TwoTests bed;
  bed.put(acting_with_nuisance("slow", proportional, "s"));
  bed.put(acting("still", [](double, auto, const Options&) { return 0.0; }));
  bed.put(acting("undefined", [](double, auto own, const Options&) { return own[0] == 0 ? 0 : NAN; }));
  MechanismFactory refusing = acting("refusing", proportional);
  refusing.wrap_test = [](std::unique_ptr<tunica::Test> base, const Options&) -> std::unique_ptr<tunica::Test> {
    throw InputError(base->rows().count == 2 ? "not for two" : "not for three");
  };
  bed.put(refusing);
  MechanismFactory choosy = acting("choosy", proportional);
  choosy.wrap_test = [wrap = choosy.wrap_test](std::unique_ptr<tunica::Test> base, const Options& options) {
    if (base->rows().count == 2) throw InputError("not for two");
    return wrap(std::move(base), options);
  };
  bed.put(choosy);
  bed.close();
  const auto expect_absent = [&bed](const std::string& id, Absence why, const std::string& words) {
    const Candidate found = bed.find(id);
    EXPECT_THAT(found.hypotheses, IsEmpty()) << id;
    EXPECT_EQ(found.absence, why) << id;
    EXPECT_THAT(found.absent, HasSubstr(words)) << id;
  };
  expect_absent("slow", Absence::no_clock, "no time");
  expect_absent("still", Absence::no_trace, "no trace");
  expect_absent("undefined", Absence::no_trace, "no trace");
  expect_absent("strip_only", Absence::no_place, "no test");
  expect_absent("refusing", Absence::not_applicable, "not for two");
  const Candidate found = bed.find("choosy");
  ASSERT_THAT(found.hypotheses, SizeIs(1));
  EXPECT_EQ(found.absent, "") << "it acts somewhere";
  EXPECT_EQ(found.absence, Absence::none);
}

// From 1 to 2, at two a second, half a second passes.
TEST(Candidates, WithTimesAreLookedForWhereTheDataHaveTime) {
  SearchBed bed;
  bed.add("a", {1, 1.5, 2}).data.time_rate = 2;
  bed.put(acting_with_nuisance("slow", proportional, "s"));
  bed.close();
  const Candidate found = bed.find("slow");
  ASSERT_THAT(found.hypotheses, SizeIs(6));
  EXPECT_NEAR(found.hypotheses.front().addition.setting.front().second, 0.25, 1e-9) << "from the shortest step";
  EXPECT_NEAR(found.hypotheses.back().addition.setting.front().second, 0.5, 1e-9) << "to all of it";
}

// The fake model answers along one axis only.
TEST(Candidates, WithDirectionsAreLookedForWhereTheModelHasThem) {
  TwoTests bed;
  MechanismFactory fibres = acting("fibres", proportional);
  fibres.directional = true;
  bed.put(fibres);
  bed.close();
  EXPECT_THAT(bed.find("fibres").hypotheses, SizeIs(2));
}

// "memory" adds a share of the row before; "hysteresis" is a memory of the material that acts on a test, "lag" one of
// the rig.
struct Remembering : SearchBed {
  Remembering(const std::vector<double>& first, const std::vector<double>& second, bool ordered = true) {
    add("a", first).data.order = ordered ? data::Order::loading : data::Order::unknown;
    add("b", second).data.order = data::Order::loading;
    MechanismFactory one = acting("lag", proportional);
    one.memory = true;
    put(one);
    one.id = "hysteresis";
    one.origin = MechanismFactory::Origin::material;
    put(one);
    one.id = "residual";
    one.memory = false;
    put(one);
    close();
  }
  [[nodiscard]] std::vector<Tests> tests_of(const std::string& id) const {
    std::vector<Tests> found;
    for (const Hypothesis& one : find(id).hypotheses) found.push_back(one.addition.place.tests);
    return found;
  }
};

TEST(CandidatesWithMemory, AreLookedForWhereTheOrderOfTheRowsIsKnown) {
  const Remembering known({1, 2, 1}, {3, 5, 4});
  EXPECT_THAT(known.find("memory").hypotheses, ::testing::Not(IsEmpty()));
  EXPECT_THAT(known.find("memory").without_past, IsEmpty());
  EXPECT_THAT(known.tests_of("lag"), ElementsAre(Tests{"a"}, Tests{"b"}));

  Remembering unknown({1, 2, 1}, {1, 3, 2}, false);
  EXPECT_THAT(unknown.find("memory").hypotheses, ::testing::Not(IsEmpty())) << "in b; a is a first loading";
  EXPECT_THAT(unknown.find("memory").without_past, ElementsAre("a"));
  const Remembering nowhere({1, 2, 1}, {1, 2, 3}, false);
  EXPECT_EQ(nowhere.find("memory").absence, Absence::no_past) << "b does not unload";
  EXPECT_THAT(nowhere.find("memory").absent, HasSubstr("past"));
  EXPECT_THAT(unknown.tests_of("lag"), ElementsAre(Tests{"b"}));
  EXPECT_THAT(unknown.find("lag").without_past, ElementsAre("a"));
  EXPECT_THAT(unknown.tests_of("hysteresis"), ElementsAre(Tests{"b"}));
  EXPECT_THAT(unknown.tests_of("offset"), ElementsAre(Tests{"a"}, Tests{"b"})) << "no memory";
  unknown.request.mechanisms = {"memory", "lag"};
  EXPECT_THAT(unknown.find("memory").hypotheses, ::testing::Not(IsEmpty())) << "it was asked for";
  EXPECT_THAT(unknown.tests_of("lag"), ElementsAre(Tests{"a"}, Tests{"b"}));
}

// Far from rest the rows of "a" begin, and unload: a sensor needs no more than their order, a specimen does.
TEST(CandidatesWithMemory, NeedToKnowOfAMaterialWhatCameBefore) {
  const Remembering bed({5, 3, 1}, {5, 3, 1});
  EXPECT_THAT(bed.tests_of("lag"), ElementsAre(Tests{"a"}, Tests{"b"}));
  EXPECT_EQ(bed.find("hysteresis").absence, Absence::no_past);
  EXPECT_THAT(bed.find("hysteresis").without_past, ElementsAre("a", "b"));
  EXPECT_EQ(bed.find("memory").absence, Absence::no_past);
}

TEST(CandidatesWithMemory, OfTheMaterialShowWhereTheLoadIsTakenOff) {
  EXPECT_THAT(Remembering({1, 3, 2}, {1, 2, 3}).tests_of("hysteresis"), ElementsAre(Tests{"a"}));
  const Remembering rising({1, 2, 3}, {1, 2, 3});
  EXPECT_EQ(rising.find("hysteresis").absence, Absence::no_trace);
  EXPECT_THAT(rising.find("hysteresis").absent, HasSubstr("load"));
  for (const char* id : {"lag", "residual"})
    EXPECT_THAT(rising.tests_of(id), ElementsAre(Tests{"a"}, Tests{"b"})) << id;
}

// v x^w with w of each setting; and with the power as an option, of which another value needs another test.
TEST(Candidates, AreLookedForInEverySetting) {
  SearchBed bed;
  bed.add("a", {1, 2});
  MechanismFactory nuisance = acting_with_nuisance(
      "nuisance", [](double x, auto own, const Options&) { return own[0] * std::pow(x, own[1]); }, "1");
  nuisance.scan = {{{"w", 1}}, {{"w", 3}}};
  bed.put(nuisance);
  MechanismFactory option = acting("option", [](double x, auto own, const Options& options) {
    return own[0] * std::pow(x, options.number("power"));
  });
  option.options = {Option::number("power", 1, {0, 9}, "")};
  option.scan = {{{"power", 2}}, {{"power", 4}}};
  bed.put(option);
  bed.close();
  const Candidate scanned = bed.find("nuisance"), other = bed.find("option");
  ASSERT_THAT(scanned.hypotheses, SizeIs(2));
  EXPECT_EQ(scanned.hypotheses[0].addition.setting, nuisance.scan[0]);
  expect_signature(scanned.hypotheses[0], {2, 4});
  EXPECT_EQ(scanned.hypotheses[1].addition.setting, nuisance.scan[1]);
  expect_signature(scanned.hypotheses[1], {2, 16});
  ASSERT_THAT(other.hypotheses, SizeIs(2));
  expect_signature(other.hypotheses[0], {2, 8});
  expect_signature(other.hypotheses[1], {2, 32});
}

TEST(Candidates, ThatTakeRowsAreLookedForInEachOfThem) {
  TwoTests bed;
  MechanismFactory shift = acting("shift", [](double, auto own, const Options&) { return own[0]; });
  shift.stage = Stage::data;
  shift.options = {Option::text("channel", "y", ""), Option::text("rows", "all", "")};
  bed.put(shift);
  bed.close();
  const Candidate found = bed.find("shift");
  ASSERT_THAT(found.hypotheses, SizeIs(3 + 7)) << "curves, and rows of curves";
  EXPECT_EQ(found.hypotheses[1].addition.place.channel, "z");
  expect_signature(found.hypotheses[0], {2, 2, 0, 0, 0, 0, 0});
  expect_signature(found.hypotheses[1], {0, 0, 0.2, 0.2, 0, 0, 0});
  expect_signature(found.hypotheses[2], {0, 0, 0, 0, 2, 2, 2});
  for (std::size_t k = 0; k < 7; ++k) {
    const Hypothesis& one = found.hypotheses[3 + k];
    std::vector<double> expected(7, 0);
    expected[k] = k == 2 || k == 3 ? 0.2 : 2;
    expect_signature(one, expected);
    EXPECT_EQ(one.addition.place.row, k < 4 ? k % 2 : k - 4);
  }
}

}  // namespace
}  // namespace tunica::diagnosis::candidates_test
