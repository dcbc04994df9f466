// SPDX-License-Identifier: Apache-2.0
// The experiment for what the data determine least. What the data say is a Jacobian made by hand; what a design would
// add is worked out here again, from its predictions by central differences.
#include "diagnosis/prospects/undetermined.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/LU>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/prospects/designs.hpp"

namespace tunica::diagnosis::undetermined_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double box_sd = 0.28867513459481287;  ///< 1/√12

/// A strip of a wall with mu, k1 and k2 (on a logarithmic scale), and kappa and theta (on a linear one).
struct Wall {
  explicit Wall(double sd = 0.3) : measured(std::vector<trial::Strip>{{.sd = sd}}) {
    auto& parameters = measured.experiment["models"]["gho"]["parameters"];
    parameters["kappa"] = {{"min", 0}, {"max", 0.3}, {"initial", 0.1367}};
    parameters["theta"] = {{"min", 10}, {"max", 80}, {"initial", 46.44}};
    measured.measure(41);
    read = measured.read();
    request = request_of(read);
    request.quick = true;
    evidence = evidence_of(inquiry(), {});
    model = bare_refit(inquiry(), evidence);
    const auto& layout = model.extension->assembly().layout();
    for (std::size_t j = 0; j < layout.parameters.size(); ++j)
      model.fit.free[j] = initial.at(layout.parameters[j].name);
    model.fit.jacobian.setZero(30, static_cast<Eigen::Index>(layout.parameters.size()));
  }
  [[nodiscard]] Inquiry inquiry() const { return {read, request, testing::catalogue(), silent}; }
  [[nodiscard]] std::size_t place(const std::string& name) const {
    const auto& parameters = model.extension->assembly().layout().parameters;
    for (std::size_t j = 0; j < parameters.size(); ++j)
      if (parameters[j].name.ends_with(name)) return j;
    throw std::out_of_range(name);
  }
  [[nodiscard]] bool logarithmic(std::size_t j) const {
    return model.extension->assembly().layout().parameters[j].scale == Scale::log;
  }
  /// dp/du, and the standard deviation of u over the box.
  [[nodiscard]] double slope(std::size_t j) const {
    const auto& parameter = model.extension->assembly().layout().parameters[j];
    return logarithmic(j) ? model.fit.free[j] : parameter.max - parameter.min;
  }
  [[nodiscard]] double prior(std::size_t j) const {
    const auto& parameter = model.extension->assembly().layout().parameters[j];
    return logarithmic(j) ? std::log(parameter.max / parameter.min) * box_sd : box_sd;
  }
  /// Data and box together leave this standard deviation of u.
  void leave(const std::string& name, double sd) {
    const std::size_t j = place(name);
    const double precision = 1 / (sd * sd) - 1 / std::pow(prior(j), 2);
    const auto k = static_cast<Eigen::Index>(j);
    model.fit.jacobian(k + 3, k) = std::sqrt(std::max(precision, 0.0)) / slope(j);
  }
  void leave_all(double sd) {
    for (const auto& [name, value] : initial) leave(name, sd);
  }
  [[nodiscard]] std::optional<NextExperiment> next() const {
    return determining_experiment(inquiry(), evidence, model);
  }

  /// The experiment again: of all designs the fewest repeats, up to 20, then the smallest standard deviation.
  struct Best {
    std::string design;
    std::size_t repeats = 21;
    double sd = std::numeric_limits<double>::infinity();
  };
  [[nodiscard]] Best best_for(const std::string& name, double wanted) const {
    const assembly::Assembly& assembly = model.extension->assembly();
    const auto n = static_cast<Eigen::Index>(model.fit.free.size()), which = static_cast<Eigen::Index>(place(name));
    Eigen::MatrixXd J = model.fit.jacobian, prior_precision = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index k = 0; k < n; ++k) {
      J.col(k) *= slope(static_cast<std::size_t>(k));
      prior_precision(k, k) = std::pow(prior(static_cast<std::size_t>(k)), -2);
    }
    Best best;
    for (const Design& design : designs(inquiry(), evidence, assembly, model.fit.free)) {
      Eigen::MatrixXd D(static_cast<Eigen::Index>(design.sd.size()), n);
      for (Eigen::Index k = 0; k < n; ++k) {
        std::vector<double> up = model.fit.free, down = up, ahead, behind;
        const auto j = static_cast<std::size_t>(k);
        up[j] += 1e-4 * slope(j);
        down[j] -= 1e-4 * slope(j);
        EXPECT_TRUE(predict(design, assembly, up, ahead) && predict(design, assembly, down, behind));
        for (std::size_t i = 0; i < ahead.size(); ++i)
          D(static_cast<Eigen::Index>(i), k) = (ahead[i] - behind[i]) / 2e-4 / design.sd[i];
      }
      Best own{design.description};
      for (std::size_t m = 1; m <= 20 && own.repeats > 20; ++m) {
        const Eigen::MatrixXd precision =
            J.transpose() * J + prior_precision + static_cast<double>(m) * D.transpose() * D;
        own.sd = std::sqrt(precision.inverse()(which, which));
        if (own.sd <= wanted) own.repeats = m;
      }
      if (std::pair(own.repeats, own.sd) < std::pair(best.repeats, best.sd)) best = own;
    }
    return best;
  }

  trial::Measured measured;
  experiment::Experiment read;
  Request request;
  Progress silent;
  Evidence evidence;
  Refit model;
  const std::map<std::string, double> initial{
      {"mu", 18.668}, {"k1", 24.905}, {"k2", 0.2912}, {"kappa", 0.1367}, {"theta", 46.44}};
};

/// The number behind these words.
double number_after(const std::string& text, const std::string& words) {
  const auto at = text.find(words);
  if (at == std::string::npos) throw std::out_of_range(words + " in: " + text);
  return std::stod(text.substr(at + words.size()));
}

TEST(Undetermined, IsNothingBelowAQuarterOfALogarithmAndATenthOfABox) {
  Wall wall;
  wall.leave_all(0.01);
  wall.leave("k2", 0.249);
  wall.leave("kappa", 0.099);
  EXPECT_FALSE(wall.next());
  wall.leave("k2", 0.251);
  ASSERT_TRUE(wall.next());
  EXPECT_THAT(wall.next()->separates, ElementsAre(HasSubstr("k2")));
  wall.leave("kappa", 0.102);
  EXPECT_THAT(wall.next()->separates, ElementsAre(HasSubstr("kappa")));
}

TEST(Undetermined, IsWhatIsFarthestFromThatAndSaysHowFarInItsUnit) {
  Wall wall;
  wall.leave_all(0.01);
  wall.leave("mu", 0.5);      // twice
  wall.leave("theta", 0.22);  // 2.2 times
  wall.leave("k1", 0.4);
  const std::string name = wall.model.extension->assembly().layout().parameters[wall.place("theta")].name;
  // 1.96 · 0.22 · 70 deg
  EXPECT_THAT(wall.next()->description, StartsWith(name + " is uncertain by ± 30 deg; "));
  wall.leave("kappa", 0.25);  // 1.96 · 0.25 · 0.3
  EXPECT_THAT(wall.next()->description, HasSubstr("kappa is uncertain by ± 0.15; "));
  wall.leave("kappa", 0.01);
  wall.leave("theta", 0.19);
  EXPECT_THAT(wall.next()->description, HasSubstr("mu is uncertain by a factor of 2.66; "));  // exp(1.96 · 0.5)
  wall.leave("mu", 0.01);
  wall.leave("theta", 0.01);
  wall.leave("k1", 1.1);
  EXPECT_THAT(wall.next()->description, HasSubstr("k1 is uncertain by a factor of 8.64; "));
}

TEST(Undetermined, IsSaidToBeFixedByItsBoundsAbove90PercentOfTheirSpread) {
  Wall wall;
  wall.leave_all(0.01);
  const double bounds = std::log(500) / std::sqrt(12.0);  // of k2, 0.01 … 5
  wall.leave("k2", 0.91 * bounds);
  EXPECT_THAT(wall.next()->description, HasSubstr("k2 is fixed only by its bounds, not by these data; "));
  wall.leave("k2", 0.89 * bounds);
  EXPECT_THAT(wall.next()->description, HasSubstr("k2 is uncertain by a factor of 22.9; "));
}

// The smaller k2 is, the less does any design see of its logarithm: one does it at once, in some repeats, in part, or
// not at all.
TEST(Undetermined, GetsTheDesignThatNeedsTheFewestRepeats) {
  bool once = false, twenty = false, in_part = false, never = false;
  for (const double k2 : {0.3, 0.1, 0.054, 0.045, 0.02, 0.0105}) {
    Wall wall;
    for (const auto& [name, value] : std::map<std::string, double>{{"mu", 60}, {"k1", 6}, {"k2", k2}})
      wall.model.fit.free[wall.place(name)] = value;
    wall.leave_all(0.05);
    wall.leave("k2", 1.2);
    const Wall::Best best = wall.best_for("k2", 0.25);
    const NextExperiment next = *wall.next();
    if (best.sd > 0.5 * 1.2) {
      EXPECT_THAT(next.description, HasSubstr("k2 is uncertain by a factor of 10.5; no strip, sheet or inflation of "
                                              "the library determines it in 20 repeats."))
          << k2;
      EXPECT_FALSE(next.repeats);
      never = true;
      continue;
    }
    const std::size_t repeats = std::min<std::size_t>(best.repeats, 20);
    EXPECT_EQ(next.repeats, best.repeats > 20 ? std::nullopt : std::optional(best.repeats)) << k2;
    EXPECT_THAT(next.description, HasSubstr(fmt::format("; {}, {}, would reduce that to ", best.design,
                                                        repeats == 1 ? "once" : fmt::format("{} times", repeats))))
        << k2;
    const double factor = std::exp(1.96 * best.sd);
    if (factor < 1.1)
      EXPECT_NEAR(number_after(next.description, "would reduce that to "), 100 * (factor - 1), 0.06) << k2;
    else
      EXPECT_NEAR(number_after(next.description, "would reduce that to a factor of "), factor, 0.006) << k2;
    once = once || repeats == 1;
    twenty = twenty || best.repeats == 20;
    in_part = in_part || best.repeats > 20;
  }
  EXPECT_TRUE(once && twenty && in_part && never) << once << twenty << in_part << never;
}

TEST(Undetermined, GetsPercentWhereThatIsMoreThanAFactorSays) {
  Wall wall;
  wall.leave_all(0.02);
  wall.leave("mu", 0.5);
  const Wall::Best best = wall.best_for("mu", 0.25);
  const double percent = 100 * std::expm1(1.96 * best.sd);
  ASSERT_LT(percent, 9);
  const std::string text = wall.next()->description;
  EXPECT_THAT(text, HasSubstr(best.design + ", once, would reduce that to "));
  EXPECT_NEAR(number_after(text, "would reduce that to "), percent, 0.06);
  EXPECT_THAT(text, ::testing::EndsWith(" %."));
}

// Steps up would leave the box at an upper bound, where no model is asked for its values.
TEST(Undetermined, IsLookedForFromAnUpperBoundToo) {
  Wall wall;
  wall.leave_all(0.02);
  wall.leave("kappa", 0.25);
  wall.model.fit.free[wall.place("kappa")] = 0.2999;
  const auto next = wall.next();
  ASSERT_TRUE(next);
  EXPECT_THAT(next->separates, ElementsAre(HasSubstr("kappa")));
  EXPECT_THAT(next->description, HasSubstr("would reduce that to ± "));
}

TEST(BareRefit, IsTheFitOfTheBase) {
  const Wall wall;
  const Refit bare = bare_refit(wall.inquiry(), wall.evidence);
  EXPECT_TRUE(bare.additions.empty());
  EXPECT_EQ(bare.fit.free, wall.evidence.fit.free);
  EXPECT_EQ(bare.extension->assembly().layout().parameters.size(), 5u);
}

}  // namespace
}  // namespace tunica::diagnosis::undetermined_test
