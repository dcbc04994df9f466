// SPDX-License-Identifier: Apache-2.0
// Sets that grow by a term: where the fit begins, what is refused, and what is found.
#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/QR>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "discover/fitting.hpp"
#include "discovery/curves.hpp"

namespace tunica::discovery::set_growth_test {
namespace {

using trial::FittedRubber;
using trial::hidden;
using trial::place_of;
using trial::ToFit;

/// What the linearisation at a set says of one more term with these shapes: by linear least squares of the set's own
/// columns and that of the term together.
struct Linear {
  double amplitude = 0, gain = 0;  ///< fall of |r|²
  std::vector<double> start;       ///< of a fit, the base moved as the term asks for
};

Linear promise(const FittedRubber& rubber, const SetFit& from, const KindPointer& kind,
               const std::vector<double>& shapes, double share = 1) {
  const BoundSet set(rubber.subject, {kind});
  const auto& parameters = set.assembly().layout().parameters;
  const BoundTerm& term = set.terms().front();
  Linear found;
  found.start = from.fit.free;
  found.start.resize(parameters.size());
  found.start[term.amplitude] = kind->negative ? -1e-4 * std::abs(kind->largest) : 0;
  for (const std::size_t height : term.heights) found.start[height] = parameters[height].min;
  for (std::size_t k = 0; k < shapes.size(); ++k) found.start[term.shapes[k]] = shapes[k];
  const SetFit here = rubber.at({kind}, found.start);
  Eigen::VectorXd own = here.fit.jacobian.col(static_cast<Eigen::Index>(term.amplitude));
  for (const std::size_t height : term.heights) own += here.fit.jacobian.col(static_cast<Eigen::Index>(height));
  const Eigen::VectorXd base = from.fit.jacobian.col(0);
  Eigen::MatrixXd both(own.size(), 2);
  both << base, own;
  const Eigen::Vector2d best = both.colPivHouseholderQr().solve(-from.fit.residuals);
  const Eigen::VectorXd alone = from.fit.residuals - base * (base.dot(from.fit.residuals) / base.squaredNorm());
  found.amplitude = best[1];
  found.gain = alone.squaredNorm() - (from.fit.residuals + both * best).squaredNorm();
  const double amplitude = share * found.amplitude;
  found.start[term.amplitude] = amplitude;
  for (const std::size_t height : term.heights) found.start[height] = amplitude;
  const double shift = -base.dot(own) / base.squaredNorm() * amplitude;
  double& mu = found.start[0];
  const auto& parameter = parameters[0];
  const double most = 0.3 * (parameter.max - parameter.min);
  mu = parameter.scale == Scale::log ? mu * std::exp(std::clamp(shift / mu, -1.0, 1.0))
                                     : mu + std::clamp(shift, -most, most);
  mu = std::clamp(mu, parameter.min, parameter.max);
  return found;
}

diagnosis::Fit fit_from(const FittedRubber& rubber, const KindPointer& kind, const std::vector<double>& start) {
  const BoundSet set(rubber.subject, {kind});
  const assembly::Assembly& assembly = set.assembly();
  return diagnosis::least_squares(assembly, diagnosis::all_variables(assembly), start,
                                  *assembly.evaluator().make_workspace(), 60, {.negligible = diagnosis::says_nothing});
}

void expect_same(const std::optional<SetFit>& found, const diagnosis::Fit& expected, const std::string& what = "") {
  ASSERT_TRUE(found) << what;
  EXPECT_EQ(found->fit.evaluations, expected.evaluations) << what;
  ASSERT_EQ(found->fit.free.size(), expected.free.size());
  for (std::size_t j = 0; j < expected.free.size(); ++j)
    EXPECT_NEAR(found->fit.free[j], expected.free[j], 1e-9 * std::abs(expected.free[j])) << what << j;
}

ToFit with_noise(const trial::Measured::Hide& hide) { return {.hide = hide, .sd = 3}; }

void on_a_linear_scale(nlohmann::json& experiment) {
  experiment["models"]["rubber"]["parameters"]["mu"] = {
      {"initial", 300}, {"min", 1}, {"max", 900}, {"scale", "linear"}};
}

/// With the amplitude that the linearisation promises, and the base where the term leaves it.
TEST(Growth, BeginsWhereTheLinearisationEnds) {
  const FittedRubber rubber(with_noise(hidden("I2", "linear", {{"mu", 40}})));
  const SetFit& root = rubber.fitter.root();
  const KindPointer second = rubber.kind("I2_linear");
  const auto grown = rubber.fitter.grown(root, second, -INFINITY);
  expect_same(grown, fit_from(rubber, second, promise(rubber, root, second, {}).start));
  EXPECT_EQ(grown->log_evidence, rubber.fitter.log_evidence(*grown));
  EXPECT_EQ(grown->parameter_count(), 2U);
}

/// Without noise, two terms that are both linear in their parameters end where they begin.
TEST(Growth, IsExactInOneStepWhereAllIsLinear) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}}), .with = on_a_linear_scale});
  const auto grown = rubber.fitter.grown(rubber.fitter.root(), rubber.kind("I2_linear"), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_NEAR(grown->fit.free[0], 300, 1e-4);
  EXPECT_NEAR(grown->fit.free[1], 40, 1e-4);
  EXPECT_EQ(grown->fit.evaluations, 1U);
}

/// A step of the base ends at a factor of e, on a linear scale at 0.3 of the range, and at its bounds.
TEST(Growth, MovesTheBaseWithinLimits) {
  const auto hide = hidden("I2", "linear", {{"mu", 40}});
  for (const bool log : {true, false}) {
    const FittedRubber rubber(
        {.hide = hide,
         .with =
             [log](nlohmann::json& experiment) {
               experiment["models"]["rubber"]["parameters"]["mu"] = {
                   {"initial", 300}, {"min", log ? 5 : 200}, {"max", 900}, {"scale", log ? "log" : "linear"}};
             },
         .sd = 3});
    const KindPointer second = rubber.kind("I2_linear");
    for (const double mu : {log ? 10. : 210., 550., 850.})
      for (const double effect : {1., -1., 0.1, -0.1, 0.01, -0.01}) {
        SetFit from = rubber.at({}, {mu});
        from.fit.jacobian *= effect;  // as if the base did less, or the contrary
        const Linear expected = promise(rubber, from, second, {});
        if (expected.amplitude <= 0) continue;
        expect_same(rubber.fitter.grown(from, second, -INFINITY), fit_from(rubber, second, expected.start),
                    fmt::format("{} {} {}: ", log, mu, effect));
      }
  }
}

/// Of the first shapes the one that promises most.
TEST(Growth, BeginsAtTheBestOfTheFirstShapes) {
  for (const std::size_t best : {0U, 1U, 2U}) {
    const FittedRubber plain;
    const double b = plain.kind("I2_exponential")->shapes[0].starts[best];
    const double mu = std::array{20., 5., 0.1}[best];
    const FittedRubber rubber({.hide = hidden("I2", "exponential", {{"mu", mu}, {"b", b}}), .with = on_a_linear_scale});
    const KindPointer law = rubber.kind("I2_exponential");
    const auto grown = rubber.fitter.grown(rubber.fitter.root(), law, -INFINITY);
    ASSERT_TRUE(grown) << best;
    EXPECT_NEAR(grown->fit.free[place_of(*grown, "I2_exponential.b")], b, 1e-4 * b);
    EXPECT_EQ(grown->fit.evaluations, 1U) << best;
  }
}

/// Where the first start falls short of 0.7 of what it promised, a second one is tried with 0.3 of its amplitude; what
/// fits better stays. A third is not tried.
TEST(Growth, TriesASecondStartWhereTheFirstFallsShort) {
  int second_is_better = 0, third_would_be = 0;
  for (const double b : {0.03, 0.08, 0.11, 0.15, 0.2}) {
    const FittedRubber rubber(with_noise(hidden("I2", "exponential", {{"mu", 20}, {"b", b}})));
    const KindPointer law = rubber.kind("I2_exponential");
    SetFit root = rubber.fitter.root();
    std::vector<std::pair<double, double>> gains;
    for (const double start : law->shapes[0].starts)
      gains.emplace_back(promise(rubber, root, law, {start}).gain, start);
    std::sort(gains.rbegin(), gains.rend());
    std::vector<diagnosis::Fit> fits;
    for (std::size_t k = 0; k < 3; ++k)
      fits.push_back(fit_from(rubber, law, promise(rubber, root, law, {gains[k].second}, k == 0 ? 1 : 0.3).start));
    const bool later = fits[1].chi2 < fits[0].chi2;
    second_is_better += later;
    third_would_be += fits[2].chi2 < std::min(fits[0].chi2, fits[1].chi2);
    const std::string what = fmt::format("b = {}: ", b);
    root.fit.chi2 = fits[0].chi2 + 0.7 * gains[0].first * (1 + 1e-6);
    expect_same(rubber.fitter.grown(root, law, -INFINITY), fits[0], what + "as promised: ");
    root.fit.chi2 = fits[0].chi2 + 0.7 * gains[0].first * (1 - 1e-6);
    expect_same(rubber.fitter.grown(root, law, -INFINITY), later ? fits[1] : fits[0], what + "short: ");
  }
  EXPECT_GT(second_is_better, 0);
  EXPECT_LT(second_is_better, 5);
  EXPECT_GT(third_would_be, 0);
}

/// Fibres at an angle change the width of a strip: the linearisation is that of next to no fibres.
TEST(Growth, OfFibresIsLinearisedWhereThereAreNone) {
  const FittedRubber rubber(with_noise(hidden("fibre", "quadratic", {{"k", 8}, {"theta", 50}}, "diagonal")));
  const SetFit& root = rubber.fitter.root();
  const KindPointer fibres = rubber.kind("fibre_diagonal_quadratic");
  double most = 0, angle = 0;
  for (const double theta : fibres->shapes[0].starts)
    if (const double gain = promise(rubber, root, fibres, {theta}).gain; gain > most) {
      most = gain;
      angle = theta;
    }
  const diagnosis::Fit first = fit_from(rubber, fibres, promise(rubber, root, fibres, {angle}).start);
  ASSERT_LT(first.chi2, root.chi2() - 0.7 * most);
  expect_same(rubber.fitter.grown(root, fibres, -INFINITY), first);
}

/// What the base has already is nothing new, whatever rounding leaves of it.
TEST(Growth, IsNoneByWhatTheBaseHas) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    ToFit what = with_noise(hidden("I2", "linear", {{"mu", 40}}));
    what.seed = seed;
    const FittedRubber rubber(what);
    EXPECT_FALSE(rubber.fitter.grown(rubber.fitter.root(), rubber.kind("I1_linear"), -INFINITY));
  }
}

/// A curve begins with one slope everywhere.
TEST(Growth, BeginsACurveAsAStraightLine) {
  const FittedRubber rubber(with_noise(hidden("I2", "quadratic", {{"k", 20}})));
  const SetFit& root = rubber.fitter.root();
  Kind kind = curve_of(*rubber.kind("I2_linear"), 3);
  kind.largest = rubber.fitter.largest_amplitude(kind);
  const auto curve = std::make_shared<const Kind>(kind);
  const auto grown = rubber.fitter.grown(root, curve, -INFINITY);
  expect_same(grown, fit_from(rubber, curve, promise(rubber, root, curve, {}).start));
  EXPECT_LT(grown->chi2(), 120) << "75 rows";
}

/// The evidence cannot come to more than three times what is promised; of less than 4 of |r|² nothing is tried.
TEST(Growth, IsTriedWhereItMayBeWorthIt) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}})});
  SetFit root = rubber.fitter.root();
  const KindPointer second = rubber.kind("I2_linear");
  const double most = root.log_evidence + 1.5 * promise(rubber, root, second, {}).gain;
  EXPECT_TRUE(rubber.fitter.grown(root, second, most - 1e-3));
  EXPECT_FALSE(rubber.fitter.grown(root, second, most + 1e-3));
  const Eigen::VectorXd unexplained = root.fit.residuals;
  root.fit.residuals = unexplained * std::sqrt(4.01 / promise(rubber, root, second, {}).gain);
  EXPECT_TRUE(rubber.fitter.grown(root, second, -INFINITY));
  root.fit.residuals = root.fit.residuals * std::sqrt(3.99 / 4.01);
  EXPECT_FALSE(rubber.fitter.grown(root, second, -INFINITY));
}

/// Terms act in the direction that their amplitude may go: moduli stiffen, and powers below 0 have amplitudes below 0.
TEST(Growth, GoesTheWayTheAmplitudeMay) {
  const FittedRubber stiffer({.hide = hidden("stretches", "power", {{"mu", -20}, {"alpha", -3}})});
  const auto falling = stiffer.fitter.grown(stiffer.fitter.root(), stiffer.kind("stretches_falling"), -INFINITY);
  ASSERT_TRUE(falling);
  EXPECT_NEAR(falling->fit.free[place_of(*falling, "stretches_falling.mu")], -20, 0.2);
  EXPECT_NEAR(falling->fit.free[place_of(*falling, "stretches_falling.alpha")], -3, 0.02);
  const FittedRubber softer({.hide = hidden("stretches", "power", {{"mu", 5}, {"alpha", -2}})});
  EXPECT_FALSE(softer.fitter.grown(softer.fitter.root(), softer.kind("stretches_falling"), -INFINITY));
  EXPECT_FALSE(softer.fitter.grown(softer.fitter.root(), softer.kind("I2_linear"), -INFINITY));
}

/// A shape that the data drive to the end of its range means another law.
TEST(Growth, RefusesAShapeAtItsBound) {
  const FittedRubber rubber({.hide = hidden("I2", "exponential", {{"mu", 20}, {"b", 0.1}})});
  const auto within = [&](double low, double high) {
    return rubber.kind("I2_exponential", [=](Kind& kind) {
      kind.shapes[0].low = low;
      kind.shapes[0].high = high;
      kind.shapes[0].starts = {std::sqrt(low * high)};
    });
  };
  EXPECT_TRUE(rubber.fitter.grown(rubber.fitter.root(), within(0.05, 0.2), -INFINITY));
  EXPECT_FALSE(rubber.fitter.grown(rubber.fitter.root(), within(0.02, 0.08), -INFINITY));
  EXPECT_FALSE(rubber.fitter.grown(rubber.fitter.root(), within(0.12, 0.5), -INFINITY));
}

/// Starts at which the law has no value are passed over: chains of full length within the data.
TEST(Growth, PassesOverStartsWithoutAValue) {
  const FittedRubber rubber({.hide = hidden("I1", "gent", {{"mu", 20}, {"Jm", 10}})});
  const auto from = [&](std::vector<double> starts) {
    return rubber.kind("I1_gent", [&](Kind& kind) {
      kind.shapes[0].low = 2;
      kind.shapes[0].starts = starts;
      kind.largest = rubber.fitter.largest_amplitude(kind);
    });
  };
  EXPECT_EQ(from({3})->largest, 0);
  EXPECT_EQ(from({3, 11})->largest, from({11})->largest);
  const auto grown = rubber.fitter.grown(rubber.fitter.root(), from({3, 11}), -INFINITY);
  ASSERT_TRUE(grown);
  EXPECT_NEAR(grown->fit.free[place_of(*grown, "I1_gent.Jm")], 10, 0.01);
  EXPECT_FALSE(rubber.fitter.grown(rubber.fitter.root(), from({3}), -INFINITY));
}

/// A steep law that a last row or two ask for is no property of the tissue.
TEST(Growth, NeedsATenthOfTheRows) {
  const auto weak = [](double k) { return hidden("I1", "power", {{"k", k}, {"m", 12}}); };
  const auto grown_of = [&](double k) {
    const FittedRubber rubber({.hide = weak(k)});
    SetFit root = rubber.fitter.root();
    root.fit.residuals *= 100;  // the term is tried
    return rubber.fitter.grown(root, rubber.kind("I1_power", [](Kind& kind) { kind.shapes[0].high = 20; }), -INFINITY)
        .has_value();
  };
  EXPECT_TRUE(grown_of(1e-7));
  EXPECT_FALSE(grown_of(2e-10));
}

TEST(Growth, IsNoneByALawThatCannotAct) {
  const FittedRubber rubber({.hide = hidden("I2", "linear", {{"mu", 40}})});
  const auto wrong = std::make_shared<const Kind>(Kind{"fibre", "axial", "linear", "fibre_axial_linear"});
  EXPECT_FALSE(rubber.fitter.grown(rubber.fitter.root(), wrong, -INFINITY));
}

/// From nothing, in whatever order: the first term takes all that it can in one step, and sets are sorted by name.
TEST(Growth, FromNothingEndsAtTheSameSet) {
  ToFit what{.hide = hidden("I2", "linear", {{"mu", 40}})};
  what.from_nothing = true;
  const FittedRubber rubber(what);
  const KindPointer first = rubber.kind("I1_linear"), second = rubber.kind("I2_linear");
  std::vector<SetFit> both;
  for (const auto& [one, other] : {std::pair(first, second), std::pair(second, first)}) {
    const auto single = rubber.fitter.grown(rubber.fitter.root(), one, -INFINITY);
    ASSERT_TRUE(single);
    EXPECT_EQ(single->fit.evaluations, 1U);
    auto pair = rubber.fitter.grown(*single, other, -INFINITY);
    ASSERT_TRUE(pair);
    both.push_back(*pair);
  }
  for (const SetFit& set : both) {
    ASSERT_EQ(set.kinds.size(), 2U);
    EXPECT_EQ(set.kinds[0], first);
    EXPECT_EQ(set.kinds[1], second);
    EXPECT_NEAR(set.fit.free[place_of(set, "I1_linear_mu")], 300, 1e-3);
    EXPECT_NEAR(set.fit.free[place_of(set, "I2_linear_mu")], 40, 1e-3);
    EXPECT_EQ(set.fit.evaluations, 1U);
  }
}

}  // namespace
}  // namespace tunica::discovery::set_growth_test
