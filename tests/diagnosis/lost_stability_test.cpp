// SPDX-License-Identifier: Apache-2.0
// What a fit that behaves as no material lacks, on sheets whose stability is known, and what restores it.
#include <gmock/gmock.h>

#include "diagnosis/naming/admissibility.hpp"
#include "diagnosis/sheets.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;
using Side = MechanismFactory::Side;

/// Strips of a sheet along t and z up to a stretch of 1.3.
struct TwoStrips : Sheets {
  TwoStrips(double kt, double kz, double e, double largest = 1.3) {
    set("m", 10, kt, kz, e);
    add("circ", "along_t", 1.3);
    add("axial", "along_z", 1.3);
    add("wide", "held", largest);
    close();
  }
  [[nodiscard]] Admissibility found() const { return admissibility_of(analysis.evidence); }
};

TEST(LostStability, IsNoneOfASheetWithoutFibres) {
  const Admissibility found = TwoStrips(0, 0, 0).found();
  EXPECT_EQ(found.stable, true);
  EXPECT_EQ(found.where, "");
  EXPECT_EQ(found.remedy, "");
  EXPECT_THAT(found.sentences, SizeIs(4)) << "two strips, ellipticity, and Drucker's condition";
}

TEST(LostStability, IsToldByTheStripAndTheStretch) {
  const Admissibility circ = TwoStrips(300, 0, 0).found(), axial = TwoStrips(0, 300, 0).found();
  EXPECT_EQ(circ.stable, false);
  EXPECT_EQ(circ.where, "transverse stability of the circumferential strip from stretch 1");
  EXPECT_EQ(axial.stable, false);
  EXPECT_EQ(axial.where, "transverse stability of the axial strip from stretch 1");
  EXPECT_THAT(axial.sentences, Contains(HasSubstr("axial strip: UNSTABLE")));
}

// Lost at a stretch of √2, to which the third test goes.
TEST(LostStability, IsThatOfEllipticityToo) {
  const Admissibility found = TwoStrips(0, 0, -5, 1.6).found(), shorter = TwoStrips(0, 0, -5, 1.35).found();
  EXPECT_EQ(found.stable, false);
  EXPECT_THAT(found.where, AllOf(StartsWith("ellipticity in "), HasSubstr(" from stretch 1.4")));
  EXPECT_EQ(shorter.stable, true);
  EXPECT_EQ(shorter.where, "");
}

TEST(LostStability, IsSaidOfAllThatIsLost) {
  const Admissibility found = TwoStrips(300, 0, -5, 1.6).found();
  EXPECT_EQ(found.stable, false);
  EXPECT_THAT(found.where, AllOf(StartsWith("transverse stability of the circumferential strip from stretch 1"),
                                 HasSubstr("; ellipticity in ")));
}

/// A strip of a model "m", or none, and another test up to 1.6 of a model "n".
struct TwoModels : Sheets {
  TwoModels(bool strip, double kt, double e) {
    add_model("n");
    set("m", 10, kt, 0, 0);
    set("n", 10, 0, 0, e);
    add("first", strip ? "along_t" : "held", 1.3);
    add("second", "held", 1.6).layers = {{"n", 1}};
    close();
  }
  [[nodiscard]] Admissibility found() const { return admissibility_of(analysis.evidence); }
};

TEST(LostStability, OfOneOfTheModelsIsEnough) {
  EXPECT_EQ(TwoModels(true, 300, 0).found().stable, false);
  EXPECT_EQ(TwoModels(true, 0, -5).found().stable, false);
  EXPECT_THAT(TwoModels(true, 0, -5).found().where, StartsWith("ellipticity in "));
  const Admissibility both = TwoModels(true, 300, -5).found();
  EXPECT_EQ(both.stable, false);
  EXPECT_THAT(both.where, AllOf(StartsWith("transverse stability"), HasSubstr("; ellipticity in ")));
  EXPECT_THAT(both.sentences, SizeIs(3 + 4)) << "Drucker's condition is asked of the second alone";
}

TEST(LostStability, IsUnknownWhereAModelHasNoStrip) {
  EXPECT_EQ(TwoModels(true, 0, 0).found().stable, std::nullopt);
  EXPECT_EQ(TwoModels(false, 0, 0).found().stable, std::nullopt);
  EXPECT_EQ(TwoModels(false, 300, 0).found().stable, std::nullopt);
}

/// An unstable strip, and mechanisms "m0", "m1", … that mend it and explain these squares of its readings.
struct Unstable : Sheets {
  explicit Unstable(std::vector<double> squares) : squares_(std::move(squares)) {
    set("m", 10, 300, 0, 0);
    std::vector<double> y;
    for (const double one : squares_) y.push_back(std::sqrt(one));
    while (y.size() < 3) y.push_back(0);
    add("circ", "along_t", 1.3, y);
    rows_ = static_cast<Eigen::Index>(y.size());
  }
  Mending mending(std::size_t k) const {
    Mending one{"m" + std::to_string(k), Eigen::VectorXd::Unit(rows_, static_cast<Eigen::Index>(k))};
    return one;
  }
  /// All of them.
  Unstable& closed() {
    for (std::size_t k = 0; k < squares_.size(); ++k) add(mending(k));
    close();
    return *this;
  }
  [[nodiscard]] Explanation explanation() const {
    return stabilised(inquiry(), analysis, admissibility_of(analysis.evidence));
  }
  [[nodiscard]] std::vector<ReasonKind> reasons() const {
    std::vector<ReasonKind> kinds;
    for (const Reason& reason : explanation().reasons) kinds.push_back(reason.kind);
    return kinds;
  }

 private:
  std::vector<double> squares_;
  Eigen::Index rows_;
};

std::vector<double> probabilities_of(const Claim& claim) {
  std::vector<double> all;
  for (const Cause& cause : claim.causes) all.push_back(cause.probability);
  return all;
}

TEST(RestoredStability, NamesTheMechanismThatMends) {
  Unstable causes({16, 9});
  Mending idle = causes.mending(0);
  idle.mends = [](double) { return false; };
  causes.add(idle);
  causes.add(causes.mending(1));
  causes.close();
  const Explanation found = causes.explanation();
  EXPECT_EQ(found.verdict, Verdict::named);
  EXPECT_EQ(found.claim.named, 1u);
  EXPECT_THAT(found.claim.ambiguity_set, ElementsAre("m1"));
  ASSERT_THAT(found.claim.causes, SizeIs(1));
  EXPECT_NEAR(found.claim.causes[0].gain, 9, 1e-4);
  EXPECT_NEAR(found.claim.causes[0].amplitude.value, 3, 1e-4);
  EXPECT_EQ(found.claim.causes[0].p_value, 0.02) << "that of the second candidate";
  EXPECT_NEAR(found.claim.causes[0].probability, 1, 1e-12);
  EXPECT_EQ(found.claim.best.value().additions.front().id, "m1");
  EXPECT_THAT(found.claim.rivals, SizeIs(1));
  EXPECT_EQ(found.admissibility.remedy, "m1");
  ASSERT_THAT(causes.reasons(), ElementsAre(ReasonKind::stability_restored));
  EXPECT_THAT(found.reasons[0].text, AllOf(StartsWith("the base fit loses transverse stability of the circ"),
                                           HasSubstr("; with m1 the fit is as good")));
}

TEST(RestoredStability, IsUnknownWhereNothingMends) {
  Unstable causes({16});
  Mending idle = causes.mending(0);
  idle.mends = [](double) { return false; };
  causes.add(idle);
  causes.close();
  const Explanation found = causes.explanation();
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_THAT(found.claim.causes, IsEmpty());
  EXPECT_EQ(found.admissibility.remedy, "");
  ASSERT_THAT(causes.reasons(), ElementsAre(ReasonKind::lost_stability));
  EXPECT_THAT(found.reasons[0].text, AllOf(StartsWith("the base fit loses transverse stability of the circ"),
                                           HasSubstr(", and no mechanism of the catalogue")));
}

// Of |r|², and of twice the logarithm of the odds: 6 is as good.
TEST(RestoredStability, HasRivalsThatAreAboutAsLikely) {
  Unstable causes({13.9, 20, 14.1});
  const Explanation found = causes.closed().explanation();
  EXPECT_EQ(found.verdict, Verdict::indistinguishable);
  EXPECT_THAT(found.claim.ambiguity_set, ElementsAre("m1", "m2"));
  EXPECT_EQ(found.claim.named, 1u);
  const double all = 1 + std::exp(-5.9 / 2) + std::exp(-6.1 / 2);
  EXPECT_THAT(probabilities_of(found.claim),
              ElementsAre(DoubleNear(1 / all, 1e-5), DoubleNear(std::exp(-5.9 / 2) / all, 1e-5)));
  EXPECT_EQ(found.claim.causes[1].p_value, 0.03);
  ASSERT_THAT(found.claim.rivals, SizeIs(2));
  EXPECT_EQ(found.claim.rivals[1].additions.front().id, "m2");
  EXPECT_EQ(found.claim.best->additions.front().id, "m1");
  EXPECT_EQ(found.admissibility.remedy, "m1");
}

TEST(RestoredStability, IsUnknownBeyondFourThatAreAboutAsLikely) {
  EXPECT_EQ(Unstable(std::vector<double>(4, 9)).closed().explanation().verdict, Verdict::indistinguishable);
  const Explanation found = Unstable(std::vector<double>(5, 9)).closed().explanation();
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_THAT(found.claim.causes, SizeIs(5));
}

// One side of the null is twice as likely a priori, two directions of one mechanism half as likely each.
TEST(RestoredStability, WeighsWhatIsLikelierBeforeTheData) {
  Unstable causes({9, 9, 9});
  Mending one_sided = causes.mending(1), scattered = causes.mending(2);
  one_sided.declare = [](MechanismFactory& factory) {
    factory.side = Side::positive;
    factory.plausible_min = 0;
  };
  scattered.hypotheses = 2;
  causes.add(causes.mending(0));
  causes.add(one_sided);
  causes.add(scattered);
  causes.close();
  const Claim claim = causes.explanation().claim;
  EXPECT_THAT(claim.ambiguity_set, ElementsAre("m1", "m0", "m2"));
  EXPECT_THAT(probabilities_of(claim),
              ElementsAre(DoubleNear(2 / 3.5, 1e-5), DoubleNear(1 / 3.5, 1e-5), DoubleNear(0.5 / 3.5, 1e-5)));
}

/// What needs so many parameters.
Mending larger_by(Mending one, int more) {
  one.declare = [more](MechanismFactory& factory) {
    for (int k = 0; k < more; ++k)
      factory.parameters.push_back({"w" + std::to_string(k), "1", 0.5, 0, 1, Scale::linear, "", ""});
  };
  return one;
}

TEST(RestoredStability, NamesTheSmallestExtensionHoweverWellLargerOnesFit) {
  Unstable causes({400, 9, 900});
  causes.add(larger_by(causes.mending(0), 1));
  causes.add(causes.mending(1));
  causes.add(larger_by(causes.mending(2), 2));
  causes.close();
  const Explanation found = causes.explanation();
  EXPECT_EQ(found.verdict, Verdict::named);
  EXPECT_THAT(found.claim.ambiguity_set, ElementsAre("m1"));
  EXPECT_NEAR(found.claim.causes[0].probability, 1, 1e-12);
  ASSERT_THAT(causes.reasons(), ElementsAre(ReasonKind::stability_restored, ReasonKind::restored_by_larger));
  EXPECT_THAT(found.reasons[1].text, StartsWith("m0, m2 do so too"));

  Unstable with_one({400, 9});
  with_one.add(larger_by(with_one.mending(0), 1));
  with_one.add(with_one.mending(1));
  with_one.close();
  EXPECT_THAT(with_one.explanation().reasons.at(1).text, StartsWith("m0 does so too"));
}

TEST(RestoredStability, IsAMatterOfTheEnergyAlone) {
  const auto verdict_of = [](Stage stage) {
    Unstable causes({9});
    Mending one = causes.mending(0);
    one.declare = [stage](MechanismFactory& factory) { factory.stage = stage; };
    causes.add(one);
    causes.close();
    return causes.explanation().verdict;
  };
  EXPECT_EQ(verdict_of(Stage::invariants), Verdict::named);
  EXPECT_EQ(verdict_of(Stage::energy), Verdict::named);
  EXPECT_EQ(verdict_of(Stage::stress), Verdict::unknown);
}

TEST(RestoredStability, LeavesOutWhatTheDataDoNotSee) {
  Unstable causes({9, 16});
  causes.add(causes.mending(0));
  causes.add(causes.mending(1));
  causes.close();
  std::erase_if(causes.analysis.hypotheses.directions, [](const Direction& one) { return one.candidate == 0; });
  EXPECT_THAT(causes.explanation().claim.ambiguity_set, ElementsAre("m1"));
}

/// One mechanism that leaves |r|² of 109 + `near` and mends, or not, at the amplitude of 10 that its score says, and
/// 109 + `far` where its amplitude is large. Nothing is of use close to the null.
struct NearOrFar {
  double near = 0;
  bool near_mends = true;
  double far = 0;
  bool far_mends = true;

  /// The |r|² of what is named, beyond that of the base; or not a number.
  [[nodiscard]] double named() const {
    Unstable causes({100, 9});
    Mending one = causes.mending(0);
    one.mends = [*this](double d) { return d > 20 ? far_mends : d > 2 && near_mends; };
    one.by = [*this](double d) {
      const double more = d > 20 ? far : d > 2 ? near : 1e6;
      return std::isnan(more) ? more : 10 - std::sqrt(100 + more);
    };
    one.declare = [](MechanismFactory& factory) { factory.plausible_max = 400; };
    causes.add(one);
    causes.close();
    const Explanation found = causes.explanation();
    return found.claim.causes.empty() ? NAN : -found.claim.causes[0].gain;
  }
};

TEST(RestoredStability, ByAFitThatIsAsGoodAsTheBase) {
  EXPECT_NEAR((NearOrFar{5.9, true, 50, true}.named()), 5.9, 1e-9);
  EXPECT_TRUE(std::isnan(NearOrFar{6.1, true, 50, true}.named()));
}

TEST(RestoredStability, TakesTheBetterOfTwoFitsThatMend) {
  EXPECT_NEAR((NearOrFar{-4, true, 3, true}.named()), -4, 1e-9);
  EXPECT_NEAR((NearOrFar{3, true, -4, true}.named()), -4, 1e-9);
}

TEST(RestoredStability, TakesAFitThatMendsBeforeOneThatDoesNot) {
  EXPECT_NEAR((NearOrFar{-4, false, 3, true}.named()), 3, 1e-9);
  EXPECT_NEAR((NearOrFar{3, true, -4, false}.named()), 3, 1e-9);
  EXPECT_TRUE(std::isnan(NearOrFar{3, false, -4, false}.named()));
}

TEST(RestoredStability, DoesWithoutAFitThatCannotBeMade) {
  EXPECT_NEAR((NearOrFar{NAN, true, 3, true}.named()), 3, 1e-9);
  EXPECT_NEAR((NearOrFar{3, true, NAN, true}.named()), 3, 1e-9);
}

// At three tenths of the plausible range, on the side to which it goes.
TEST(RestoredStability, IsLookedForAtLargeAmplitudesToo) {
  for (const double sign : {1.0, -1.0}) {
    Unstable causes({9});
    Mending one = causes.mending(0);
    one.declare = [sign](MechanismFactory& factory) {
      factory.null = 2;
      factory.plausible_min = std::min(2.0, 2 + sign * 400);
      factory.plausible_max = std::max(2.0, 2 + sign * 400);
    };
    causes.add(one);
    causes.close();
    EXPECT_EQ(causes.explanation().verdict, Verdict::named);
    EXPECT_THAT(causes.asked["m0"], Contains(DoubleNear(2 + sign * 120, 1e-9)));
    EXPECT_THAT(causes.asked["m0"], Contains(DoubleNear(2 + 3, 1e-9))) << "where the score says";
  }
}

}  // namespace
}  // namespace tunica::diagnosis
