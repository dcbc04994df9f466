// SPDX-License-Identifier: Apache-2.0
// Sets of terms in several specimens: who takes part, and what all of them say together.
#include <cmath>
#include <memory>
#include <numbers>

#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discovery/common/common_fit.hpp"

namespace tunica::discovery::common_sets_test {
namespace {

using ::testing::ElementsAre;
using ::testing::SizeIs;
using trial::FittedRubber;
using trial::hidden;

/// ln of what one specimen gives away for a term that may be too weak to see there.
constexpr double either_way = std::numbers::ln2;

/// Rubbers with a linear term in I2 of these moduli, which the base does not have; 0 is none.
class Specimens {
 public:
  explicit Specimens(const std::vector<double>& moduli, bool from_nothing = false,
                     const std::vector<std::string>& names = {"I2_linear", "I1_cubic"}) {
    for (const double modulus : moduli) {
      trial::ToFit what;
      if (modulus > 0) what.hide = hidden("I2", "linear", {{"mu", modulus}});
      what.sd = 3;
      what.seed = 20 + rubbers.size();
      what.from_nothing = from_nothing;
      rubbers.push_back(std::make_unique<FittedRubber>(what));
      fitters.push_back(&rubbers.back()->fitter);
      kinds.emplace_back();
      for (const std::string& name : names) kinds.back().push_back(rubbers.back()->kind(name));
    }
  }
  [[nodiscard]] CommonFitter all(bool from_nothing = false) const { return {fitters, kinds, from_nothing}; }

  std::vector<std::unique_ptr<FittedRubber>> rubbers;
  std::vector<const Fitter*> fitters;
  std::vector<std::vector<KindPointer>> kinds;
};

std::vector<std::string> names_of(const std::vector<KindPointer>& kinds) {
  std::vector<std::string> names;
  for (const KindPointer& kind : kinds) names.push_back(kind->name);
  return names;
}

/// In half of the specimens at least, as the first that has it sees it.
TEST(KindsOfSpecimens, ActInHalfOfThem) {
  Specimens two({40, 40});
  two.kinds[1].pop_back();  // without I1_cubic
  const CommonFitter both = two.all();
  EXPECT_THAT(both.kinds(), ElementsAre(two.kinds[0][0], two.kinds[0][1]));
  Specimens three({40, 40, 40});
  three.kinds[0].pop_back();
  three.kinds[1].pop_back();
  EXPECT_THAT(three.all().kinds(), ElementsAre(three.kinds[0][0])) << "one of three";
}

/// The base of every specimen, and no term that could be too weak.
TEST(SetsOfSpecimens, BeginWithTheBases) {
  const Specimens two({40, 0});
  const CommonFitter both = two.all();
  const CommonFit& root = both.root();
  EXPECT_THAT(root.kinds, SizeIs(0));
  ASSERT_THAT(root.specimens, SizeIs(2));
  const SetFit &one = two.fitters[0]->root(), &other = two.fitters[1]->root();
  EXPECT_NEAR(root.log_evidence, one.log_evidence + other.log_evidence, 1e-9);
  EXPECT_EQ(root.chi2(), one.chi2() + other.chi2());
  EXPECT_EQ(root.parameter_count(), 2U);
  EXPECT_FALSE(root.lacks_a_term());
  const Specimens empty({40, 0}, true);
  EXPECT_TRUE(empty.all(true).root().lacks_a_term());
}

/// ln E = ln prior of the set + Σ (ln E_s − ln 2): where a term does not show the base stands.
TEST(SetsOfSpecimens, AreWeighedTogether) {
  const Specimens three({40, 0, 60});
  const CommonFitter all = three.all();
  const KindPointer second = three.kinds[0][0];
  const auto grown = all.grown(all.root(), second, -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_THAT(grown->kinds, ElementsAre(second));
  ASSERT_THAT(grown->specimens, SizeIs(3));
  EXPECT_THAT(names_of(grown->specimens[0].kinds), ElementsAre("I2_linear"));
  EXPECT_THAT(grown->specimens[1].kinds, SizeIs(0)) << "it does not show";
  EXPECT_THAT(names_of(grown->specimens[2].kinds), ElementsAre("I2_linear"));
  EXPECT_EQ(grown->parameter_count(), 5U);
  const double prior = second->log_prior;
  double sum = prior;
  for (std::size_t s = 0; s < 3; ++s) {
    const auto alone = three.fitters[s]->grown(three.fitters[s]->root(), three.kinds[s][0], -INFINITY);
    const double base = three.fitters[s]->root().log_evidence;
    const double data = s == 1 ? base : alone->log_evidence - three.kinds[s][0]->log_prior;
    EXPECT_NEAR(data_evidence(grown->specimens[s], false), data, 1e-9);
    sum += data - either_way;
  }
  EXPECT_NEAR(grown->log_evidence, sum, 1e-9);
  // Of some of them alone.
  EXPECT_NEAR(all.log_evidence(*grown, {1}), prior + three.fitters[1]->root().log_evidence - either_way, 1e-9);
  EXPECT_NEAR(all.log_evidence(*grown, {0, 2}), sum - three.fitters[1]->root().log_evidence + either_way, 1e-9);
}

/// Terms that show in fewer than half of the specimens are no property of the tissue.
TEST(SetsOfSpecimens, NeedATermInHalfOfThem) {
  const Specimens half({40, 0, 60, 0}), fewer({40, 0, 0});
  const CommonFitter of_half = half.all(), of_fewer = fewer.all();
  EXPECT_TRUE(of_half.grown(of_half.root(), half.kinds[0][0], -INFINITY));
  EXPECT_FALSE(of_fewer.grown(of_fewer.root(), fewer.kinds[0][0], -INFINITY));
}

/// One specimen is what its fitter says, down to what a term is worth.
TEST(SetsOfSpecimens, OfOneAreThoseOfItsFitter) {
  const Specimens one({40});
  const CommonFitter alone = one.all();
  const Fitter& fitter = *one.fitters[0];
  const KindPointer second = one.kinds[0][0], cubic = one.kinds[0][1];
  const auto grown = alone.grown(alone.root(), second, -INFINITY);
  const auto expected = fitter.grown(fitter.root(), second, -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_EQ(grown->log_evidence, expected->log_evidence);
  EXPECT_EQ(grown->chi2(), expected->chi2());
  EXPECT_FALSE(alone.grown(alone.root(), second, fitter.root().log_evidence + 2 * fitter.root().chi2()));
  // A term that the data hardly ask for is fitted all the same.
  const auto both = fitter.grown(*expected, cubic, -INFINITY);
  const auto common = alone.grown(*grown, cubic, -INFINITY);
  ASSERT_EQ(both.has_value(), common.has_value());
  if (both) {
    EXPECT_EQ(common->log_evidence, both->log_evidence);
    EXPECT_THAT(names_of(common->kinds), ElementsAre("I1_cubic", "I2_linear")) << "sorted by name";
  }
}

/// In every specimen the power becomes the linear law, and stays out where it was not seen.
TEST(SetsOfSpecimens, TakeALinearLawForAPower) {
  const Specimens two({40, 60}, false, {"stretches_falling", "I2_linear"});
  const CommonFitter both = two.all();
  const KindPointer power = two.kinds[0][0], linear = two.kinds[0][1];
  CommonFit from{{power}, {}};
  for (std::size_t s = 0; s < 2; ++s)
    from.specimens.push_back(two.rubbers[s]->at({two.kinds[s][0]}, {300, s == 0 ? -40. : -60., -2}));
  const auto simpler = both.with_linear(from, 0, linear);
  ASSERT_TRUE(simpler);
  EXPECT_THAT(simpler->kinds, ElementsAre(linear));
  for (std::size_t s = 0; s < 2; ++s) {
    const auto own = two.fitters[s]->with_linear(from.specimens[s], 0, two.kinds[s][1]);
    ASSERT_TRUE(own);
    EXPECT_EQ(simpler->specimens[s].chi2(), own->chi2());
  }
  from.specimens[1] = two.fitters[1]->root();
  const auto half = both.with_linear(from, 0, linear);
  ASSERT_TRUE(half);
  EXPECT_THAT(half->specimens[1].kinds, SizeIs(0));
  EXPECT_NEAR(half->log_evidence,
              linear->log_prior + data_evidence(half->specimens[0], false) + two.fitters[1]->root().log_evidence -
                  2 * either_way,
              1e-9);
  Specimens without = Specimens({40, 60}, false, {"stretches_falling", "I2_linear"});
  without.kinds[0].pop_back();
  EXPECT_FALSE(without.all().with_linear(
      {{without.kinds[0][0]}, {without.rubbers[0]->at({without.kinds[0][0]}, {300, -40, -2}), from.specimens[1]}}, 0,
      without.kinds[1][1]))
      << "the first has no such law";
}

/// Of two powers of one name the second one becomes linear.
TEST(SetsOfSpecimens, TellCopiesOfAKindApart) {
  const Specimens one({40}, false, {"stretches_falling", "I2_linear"});
  const CommonFitter alone = one.all();
  const KindPointer power = one.kinds[0][0], linear = one.kinds[0][1];
  CommonFit from{{power, power}, {}};
  const BoundSet set(one.rubbers[0]->subject, {power, power});
  std::vector<double> free(5);
  free[0] = 300;
  for (std::size_t k = 0; k < 2; ++k) {
    free[set.terms()[k].amplitude] = k == 0 ? -1 : -40;
    free[set.terms()[k].shapes[0]] = k == 0 ? -4 : -2;
  }
  from.specimens.push_back(one.rubbers[0]->at({power, power}, free));
  for (const std::size_t out : {0U, 1U}) {
    const auto common = alone.with_linear(from, out, linear);
    const auto own = one.fitters[0]->with_linear(from.specimens[0], out, linear);
    ASSERT_EQ(common.has_value(), own.has_value()) << out;
    if (own) {
      EXPECT_EQ(common->specimens[0].fit.evaluations, own->fit.evaluations) << out;
      EXPECT_EQ(common->chi2(), own->chi2()) << out;
    }
  }
}

/// One law for all terms of its invariant, where they are.
TEST(SetsOfSpecimens, TakeOneLawForSeveral) {
  const Specimens two({40, 60}, false, {"I2_linear", "I2_quadratic", "I1_cubic"});
  const CommonFitter both = two.all();
  const KindPointer linear = two.kinds[0][0], curved = two.kinds[0][1];
  CommonFit from{{linear, curved}, {}};
  for (std::size_t s = 0; s < 2; ++s)
    from.specimens.push_back(two.rubbers[s]->at({two.kinds[s][0], two.kinds[s][1]}, {300, s == 0 ? 38. : 58., 0.1}));
  const auto single = both.distilled(from, linear);
  ASSERT_TRUE(single);
  EXPECT_THAT(single->kinds, ElementsAre(linear));
  for (std::size_t s = 0; s < 2; ++s) {
    const auto own = two.fitters[s]->distilled(from.specimens[s], two.kinds[s][0]);
    ASSERT_TRUE(own);
    EXPECT_EQ(single->specimens[s].chi2(), own->chi2());
  }
  from.specimens[0] = two.fitters[0]->root();
  const auto half = both.distilled(from, linear);
  ASSERT_TRUE(half);
  EXPECT_THAT(half->specimens[0].kinds, SizeIs(0));
  EXPECT_THAT(names_of(half->specimens[1].kinds), ElementsAre("I2_linear"));
}

}  // namespace
}  // namespace tunica::discovery::common_sets_test
