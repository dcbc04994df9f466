// SPDX-License-Identifier: Apache-2.0
// What is promised of terms whose effect depends on the others, and growth where not everything can be evaluated.
#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/QR>
#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discover/made_up_terms.hpp"
#include "discovery/curves.hpp"

namespace tunica::discovery::set_growth_limits_test {
namespace {

using trial::FittedRubber;
using trial::hidden;
using trial::MadeUpTerms;
using trial::ToFit;

double squares_left(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y) {
  return (y - columns * columns.colPivHouseholderQr().solve(y)).squaredNorm();
}

/// By how much |r|² falls by linear least squares with one more term, of which there is so much; the best of its first
/// shapes.
double promised(const FittedRubber& rubber, const SetFit& from, const KindPointer& kind, double amplitude) {
  std::vector<KindPointer> kinds = from.kinds;
  kinds.push_back(kind);
  std::ranges::sort(kinds, {}, [](const KindPointer& one) { return one->name; });
  const BoundSet set(rubber.subject, kinds);
  const auto& parameters = set.assembly().layout().parameters;
  const auto own = static_cast<std::size_t>(std::ranges::find(kinds, kind) - kinds.begin());
  const BoundTerm& term = set.terms()[own];
  std::vector<double> free(parameters.size());
  if (from.set) {
    const auto& known = from.set->assembly().layout().parameters;
    for (std::size_t k = 0; k < known.size(); ++k)
      free[trial::index_named(set.assembly(), known[k].name)] = from.fit.free[k];
  }
  free[term.amplitude] = amplitude;
  double best = 0;
  for (const auto& shapes : combinations(*kind)) {
    for (std::size_t k = 0; k < shapes.size(); ++k) free[term.shapes[k]] = shapes[k];
    const SetFit here = rubber.at(kinds, free);
    const Eigen::MatrixXd& before = from.fit.jacobian;
    Eigen::MatrixXd with(before.rows(), before.cols() + 1);
    with << before, here.fit.jacobian.col(static_cast<Eigen::Index>(term.amplitude));
    for (const std::size_t height : term.heights)
      with.rightCols(1) += here.fit.jacobian.col(static_cast<Eigen::Index>(height));
    best = std::max(best, squares_left(before, from.fit.residuals) - squares_left(with, from.fit.residuals));
  }
  return best;
}

/// A term is tried if the evidence can come to what it has to with three times the gain that is promised.
void expect_promise(const FittedRubber& rubber, const SetFit& from, const KindPointer& kind, double amplitude) {
  const double most = from.log_evidence + 1.5 * promised(rubber, from, kind, amplitude);
  const double a_little = 1e-6 * std::abs(most - from.log_evidence);
  EXPECT_TRUE(rubber.fitter.grown(from, kind, most - a_little)) << kind->name;
  EXPECT_FALSE(rubber.fitter.grown(from, kind, most + a_little)) << kind->name;
}

/// Hides two terms.
trial::Measured::Hide both(const trial::Measured::Hide& one, const trial::Measured::Hide& other) {
  return [=](nlohmann::json& experiment) {
    auto& mechanisms = experiment["models"]["rubber"]["mechanisms"];
    one(experiment);
    nlohmann::json all = mechanisms;
    other(experiment);
    all.push_back(mechanisms[0]);
    all.back()["as"] = "other";
    mechanisms = all;
  };
}

ToFit with_fibres() { return {.hide = hidden("fibre", "quadratic", {{"k", 8}, {"theta", 50}}, "diagonal")}; }

TEST(PromiseOfATerm, IsWithoutAnyOfItBesideABase) {
  const FittedRubber rubber(with_fibres());
  expect_promise(rubber, rubber.fitter.root(), rubber.kind("fibre_diagonal_quadratic"), 0);
}

TEST(PromiseOfATerm, FromNothingIsWithATenThousandthOfTheMost) {
  ToFit what = with_fibres();
  what.from_nothing = true;
  const FittedRubber rubber(what);
  const KindPointer fibres = rubber.kind("fibre_diagonal_quadratic");
  const SetFit first = rubber.at({rubber.kind("I1_linear")}, {300});
  expect_promise(rubber, first, fibres, 1e-4 * fibres->largest);
}

TEST(PromiseOfATerm, OfANegativeOneIsWithALittleOfIt) {
  const FittedRubber rubber({.hide = both(hidden("fibre", "quadratic", {{"k", 8}, {"theta", 50}}, "diagonal"),
                                          hidden("stretches", "power", {{"mu", -40}, {"alpha", -3}}))});
  const SetFit from = rubber.at({rubber.kind("fibre_diagonal_quadratic")}, {300, 8, 50});
  const KindPointer falling = rubber.kind("stretches_falling");
  expect_promise(rubber, from, falling, 1e-4 * falling->largest);
}

TEST(PromiseOfATerm, OfACurveIsOfNoneOfItsHeights) {
  const FittedRubber rubber({.hide = hidden("fibre", "quadratic", {{"k", 8}, {"theta", 50}}, "diagonal")});
  Kind curve = curve_of(*rubber.kind("fibre_diagonal_quadratic"), 3);
  curve.largest = rubber.fitter.largest_amplitude(curve);
  expect_promise(rubber, rubber.fitter.root(), std::make_shared<const Kind>(curve), 0);
}

/// What a term can do is asked of next to none of it.
TEST(LargestAmplitudeOfFibres, BesideABaseIsWithoutAnyOfThem) {
  const FittedRubber rubber;
  const KindPointer fibres = rubber.kind("fibre_diagonal_quadratic");
  double least = INFINITY;
  for (const auto& shapes : combinations(*fibres)) {
    std::vector<double> free{rubber.evidence.fit.free.front(), 0};
    free.insert(free.end(), shapes.begin(), shapes.end());
    least = std::min(least, rubber.at({fibres}, free).fit.jacobian.col(1).norm());
  }
  EXPECT_NEAR(fibres->largest, 20 * rubber.measured() / least, 1e-7 * fibres->largest);
}

TEST(LargestAmplitudeOfFibres, FromNothingIsWithNextToNoneOfThem) {
  ToFit what;
  what.from_nothing = true;
  const FittedRubber rubber(what);
  const KindPointer fibres = rubber.kind("fibre_diagonal_quadratic");
  double least = INFINITY;
  for (const auto& shapes : combinations(*fibres)) {
    std::vector<double> free{rubber.evidence.fit.free.front(), 1e-3};
    free.insert(free.end(), shapes.begin(), shapes.end());
    const std::vector<KindPointer> kinds{rubber.kind("I1_linear"), fibres};
    const auto amplitude = static_cast<Eigen::Index>(BoundSet(rubber.subject, kinds).terms()[1].amplitude);
    ASSERT_EQ(amplitude, 1);
    least = std::min(least, rubber.at(kinds, free).fit.jacobian.col(1).norm());
  }
  EXPECT_NEAR(fibres->largest, 20 * rubber.measured() / least, 1e-8 * fibres->largest);
}

/// Beside fibres, for which it matters what there is of a term already.
TEST(LargestAmplitude, OfANegativeOneIsWithNextToNoneOfIt) {
  const FittedRubber rubber({.with = [](nlohmann::json& experiment) {
    experiment["models"]["rubber"] = {{"type", "gho"},
                                      {"parameters",
                                       {{"mu", {{"initial", 10}}},
                                        {"k1", {{"fixed", 0.2}}},
                                        {"k2", {{"fixed", 0.1}}},
                                        {"kappa", {{"fixed", 0}}},
                                        {"theta", {{"fixed", 40}}}}}};
  }});
  const KindPointer falling = rubber.kind("stretches_falling");
  double least = INFINITY;
  for (const auto& shapes : combinations(*falling)) {
    std::vector<double> free{rubber.evidence.fit.free.front(), -1e-4};
    free.insert(free.end(), shapes.begin(), shapes.end());
    least = std::min(least, rubber.at({falling}, free).fit.jacobian.col(1).norm());
  }
  ASSERT_GT(falling->largest, -5000) << "which is the most of all";
  EXPECT_NEAR(falling->largest, -20 * rubber.measured() / least, -1e-10 * falling->largest);
}

/// Terms that are all linear in their parameters move each other to where the fit ends.
TEST(Growth, IsExactInOneStepBesideTermsThatAreAlike) {
  const FittedRubber rubber({.hide = both(hidden("I2", "linear", {{"mu", 40}}), hidden("I2", "quadratic", {{"k", 3}})),
                             .with = [](nlohmann::json& experiment) {
                               experiment["models"]["rubber"]["parameters"]["mu"] = {
                                   {"initial", 300}, {"min", 1}, {"max", 900}, {"scale", "linear"}};
                             }});
  const auto linear = rubber.fitter.grown(rubber.fitter.root(), rubber.kind("I2_linear"), -INFINITY);
  ASSERT_TRUE(linear);
  const auto pair = rubber.fitter.grown(*linear, rubber.kind("I2_quadratic"), -INFINITY);
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->fit.evaluations, 1U);
  EXPECT_NEAR(pair->fit.free[trial::place_of(*pair, "I2_linear.mu")], 40, 1e-3);
  EXPECT_NEAR(pair->fit.free[trial::place_of(*pair, "I2_quadratic.k")], 3, 1e-3);
}

/// Two effects of which one is a part in 10⁸ off the other are still two: rounding is 10⁸ times less.
TEST(Growth, TellsWhatIsNearlyTheSameApart) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}})});
  const KindPointer second = rubber.kind("I2_linear");
  SetFit from = rubber.fitter.root();
  const Eigen::VectorXd signature = rubber.at({second}, {from.fit.free[0], 0}).fit.jacobian.col(1);
  Eigen::VectorXd across = from.fit.residuals;
  across -= signature * (signature.dot(across) / signature.squaredNorm());
  across *= signature.norm() / across.norm();
  from.fit.jacobian.col(0) = signature + 1e-8 * across;
  // The term without what the base does points against `across`; 100² is what that much less of it takes away.
  from.fit.residuals = 100 * across / across.norm();
  EXPECT_TRUE(rubber.fitter.grown(from, second, -INFINITY));
}

/// A law of two first shapes that does the same with both, and data that ask for 50 of it.
struct TwoStarts : MadeUpTerms {
  TwoStarts()
      : MadeUpTerms({50, 0}, {{"even", {[](std::size_t block, double) { return block == 0 ? 1.0 : 0.0; }, "s"}}}) {}
  [[nodiscard]] KindPointer law() const {
    Kind one = *kind("even", "even");
    one.shapes[0].starts = {-1, 1};
    return std::make_shared<const Kind>(one);
  }
};

TEST(Growth, GoesOnFromTheSecondStartWhereTheFirstCannotBeEvaluated) {
  const TwoStarts terms;
  fakes::set_behaviour([](double amplitude, std::span<double>, Status& status) {
    if (amplitude > 40) status = Status::failed("too much");
  });
  const auto grown = terms.fitter->grown(terms.fitter->root(), terms.law(), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_GT(grown->fit.free[0], 14);
  EXPECT_LE(grown->fit.free[0], 40);
  EXPECT_NEAR(grown->chi2(), 10 * std::pow(50 - grown->fit.free[0], 2), 1e-6);
}

TEST(Growth, IsNoneWhereNoStartCanBeEvaluated) {
  const TwoStarts terms;
  fakes::set_behaviour([](double amplitude, std::span<double>, Status& status) {
    if (amplitude > 1) status = Status::failed("too much");
  });
  EXPECT_FALSE(terms.fitter->grown(terms.fitter->root(), terms.law(), -INFINITY));
  fakes::set_behaviour([](double, std::span<double>, Status& status) { status = Status::failed("nothing at all"); });
  EXPECT_FALSE(terms.fitter->grown(terms.fitter->root(), terms.law(), -INFINITY));
}

/// The unit of an amplitude does not matter: here 5 · 10⁹ of it make 50 kPa.
TEST(Growth, IsByTermsOfAnyUnit) {
  const MadeUpTerms terms({50, 0}, {{"tiny", trial::over_blocks({1e-8})}});
  Kind tiny = *terms.kind("tiny", "tiny");
  tiny.largest = 1e10;
  const auto grown = terms.fitter->grown(terms.fitter->root(), std::make_shared<const Kind>(tiny), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_NEAR(grown->fit.free[0], 5e9, 1e3);
}

/// From nothing there is no fit that knows where parameters of the tests are: they begin where they are declared to.
TEST(Growth, FromNothingBeginsWithTheInitialValuesOfTests) {
  MadeUpTerms terms({50, 0}, {{"own", trial::in_blocks({0})}});
  terms.experiment.tests.front().parameters["gain"].fixed.reset();
  diagnosis::Evidence evidence = terms.evidence;
  evidence.experiment = terms.experiment;
  evidence.base = std::make_shared<const assembly::Assembly>(terms.experiment, terms.run, terms.shelf);
  ASSERT_EQ(evidence.base->layout().parameters.size(), 2U);
  evidence.fit.free = {1, 1};
  const Subject subject{terms.experiment, terms.run, "m", true, terms.shelf};
  const Fitter fitter(subject, evidence);
  const auto grown = fitter.grown(fitter.root(), terms.kind("own", "own"), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_NEAR(grown->chi2(), 0, 1e-3);
}

/// A law that adds amplitude · e^(steep − s) to the rows of block 1, where nothing was measured: every step of a fit
/// takes most of it away, and as much of what is left then. It begins with an amplitude of 1 at s = 0.
struct SlowDescent : MadeUpTerms {
  explicit SlowDescent(double steep, double unexplained = 0)
      : MadeUpTerms(
            {0, 0, unexplained, 50},
            {{"slow", {[=](std::size_t block, double s) { return block == 1 ? std::exp(steep - s) : 0.0; }, "s"}},
             {"alpha", {[](std::size_t block, double) { return block == 3 ? 1.0 : 0.0; }, "alpha"}},
             {"linear", trial::in_blocks({3})}}) {}
  [[nodiscard]] KindPointer law() const {
    Kind one = *kind("slow", "slow");
    one.shapes[0].low = -10;
    one.shapes[0].high = 1000;
    return std::make_shared<const Kind>(one);
  }
  /// Nothing, which misses the data by as much as an amplitude of 1 would add.
  [[nodiscard]] SetFit root() const {
    SetFit from = fitter->root();
    from.fit.residuals = -at({law()}, {1, 0}).fit.jacobian.col(0);
    from.fit.chi2 = INFINITY;
    from.log_evidence = 0;
    return from;
  }
  /// Evaluations of a fit of which that |r|² is wanted.
  [[nodiscard]] std::size_t evaluations(double wanted) const {
    const BoundSet set(*subject, {law()});
    const auto workspace = set.assembly().evaluator().make_workspace();
    return diagnosis::least_squares(set.assembly(), diagnosis::all_variables(set.assembly()), std::vector{1.0, 0.0},
                                    *workspace, 60, {.wanted = wanted, .negligible = diagnosis::says_nothing})
        .evaluations;
  }
};

TEST(FitOfASet, MayTakeSixtyEvaluations) {
  const SlowDescent terms(90);
  const auto grown = terms.fitter->grown(terms.root(), terms.law(), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_EQ(grown->fit.evaluations, 60U);
  const SetFit from = terms.at({terms.power("power", false), terms.law()}, {10, 3, 1, 0});
  const auto exchanged = terms.fitter->with_linear(from, 0, terms.kind("linear", "linear"));
  ASSERT_TRUE(exchanged);
  EXPECT_EQ(exchanged->fit.evaluations, 60U);
}

/// An evidence that is to come to `worth` needs a |r|² of no more than −2 worth.
TEST(FitOfASet, EndsWhereItCannotComeToWhatItIsWorth) {
  const SlowDescent terms(9, 1000);
  const double unexplained = 10 * (1000 * 1000 + 50 * 50);  // by this law
  const double wanted = 0.9 * unexplained;
  const auto grown = terms.fitter->grown(terms.root(), terms.law(), -wanted / 2);
  ASSERT_TRUE(grown);
  EXPECT_EQ(grown->fit.evaluations, terms.evaluations(wanted));
  for (const double other : {0.0, wanted / 2, 1.5 * wanted})
    EXPECT_NE(terms.evaluations(wanted), terms.evaluations(other)) << other << " would end elsewhere";
}

}  // namespace
}  // namespace tunica::discovery::set_growth_limits_test
