// SPDX-License-Identifier: Apache-2.0
// One step of memory in principal axes, as axis_step.hpp defines it, against the formulas: rows of a value and its
// derivatives by given directions. What goes in is made up, so that every number can be told from every other.
#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "shelf.hpp"

namespace tunica::testing::memory_rows_test {
namespace {

using Values = std::vector<double>;

/// Numbers along a line: everything that goes into a step, moved by `e`. Its derivatives by e are the directions.
struct Inputs {
  std::array<double, 3> c, g;
  double W;
};

/// A model with memory, fed row by row with rows of width 1 + directions + parameters.
class Rows {
 public:
  Rows(const Model& model, Values parameters, std::size_t directions)
      : model_(model),
        parameters_(std::move(parameters)),
        place_(1 + directions),
        width_(place_ + parameters_.size()),
        state_(model.describe().axis_history_size * width_, 0.0) {}

  void fill_state(double value) { state_.assign(state_.size(), value); }

  /// `of` at e = 0, direction 1 its derivative by e; by the parameters of the elastic model nothing.
  Values step(const std::function<Inputs(double)>& of, double time_step, bool at_rest = false, bool first = false) {
    constexpr double h = 1e-4;
    const Inputs here = of(0), up = of(h), down = of(-h);
    Values c(3 * width_), g(3 * width_), W(width_);
    W[0] = here.W;
    for (std::size_t a = 0; a < 3; ++a) {
      c[a * width_] = here.c[a];
      g[a * width_] = here.g[a];
    }
    if (place_ > 1) {
      W[1] = (up.W - down.W) / (2 * h);
      for (std::size_t a = 0; a < 3; ++a) {
        c[a * width_ + 1] = (up.c[a] - down.c[a]) / (2 * h);
        g[a * width_ + 1] = (up.g[a] - down.g[a]) / (2 * h);
      }
    }
    model_.remember(
        {width_, place_, parameters_, time_step, true, at_rest, first, c.data(), W.data(), g.data(), state_.data()});
    return g;
  }
  [[nodiscard]] std::size_t width() const { return width_; }
  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] const Values& state() const { return state_; }

 private:
  const Model& model_;
  Values parameters_;
  std::size_t place_, width_;
  Values state_;
};

/// At rest, and three rows after it; nothing in them is a response of a material.
std::function<Inputs(double)> inputs(std::size_t row) {
  static const std::array<Inputs, 4> at{{{{1, 1, 1}, {10, 10, 10}, 2},
                                         {{1.5, 0.8, 0.9}, {12, 9, 11}, 7},
                                         {{1.3, 0.9, 0.85}, {11.5, 9.5, 10.5}, 4.5},
                                         {{1.2, 0.7, 1.1}, {14, 8, 9}, 5.2}}};
  static const std::array<Inputs, 4> by{{{{0, 0, 0}, {1, 1, 1}, 0.3},
                                         {{0.4, -0.2, 0.1}, {2, 1, -1}, 0.9},
                                         {{-0.3, 0.2, 0.5}, {-1, 3, 2}, -0.7},
                                         {{0.1, 0.6, -0.2}, {0.5, -2, 1}, 1.1}}};
  return [row](double e) {
    Inputs moved = at[row];
    for (std::size_t a = 0; a < 3; ++a) {
      moved.c[a] += e * by[row].c[a];
      moved.g[a] += e * by[row].g[a];
    }
    moved.W += e * by[row].W;
    return moved;
  };
}

/// g with memory at the third row, by the formulas alone: amplitude and nuisance as given, everything moved by e.
std::array<double, 3> viscous(double e, double amplitude, double tau) {
  const double step[] = {0, 0.5, 3, 1.2};
  std::array<double, 3> h{}, before{}, g{};
  for (std::size_t row = 0; row < 4; ++row) {
    const Inputs at = inputs(row)(e);
    const double work = (at.g[0] * at.c[0] + at.g[1] * at.c[1] + at.g[2] * at.c[2]) / 3, x = step[row] / tau;
    for (std::size_t a = 0; a < 3; ++a) {
      const double now = at.g[a] - work / at.c[a];
      if (row > 0) h[a] = std::exp(-x) * h[a] + amplitude * (1 - std::exp(-x)) / x * (now - before[a]);
      before[a] = now;
      g[a] = at.g[a] + h[a];
    }
  }
  return g;
}
std::array<double, 3> softened(double e, double s, double m) {
  const double at_rest = inputs(0)(e).W, largest = inputs(1)(e).W - at_rest;
  const Inputs at = inputs(3)(e);
  const double eta = 1 - s * std::erf((largest - (at.W - at_rest)) / (m * largest));
  return {eta * at.g[0], eta * at.g[1], eta * at.g[2]};
}

using Formula = std::array<double, 3> (*)(double e, double amplitude, double nuisance);

/// Value, derivative by the direction (unless there is none), by amplitude and by nuisance, of each axis.
void expect_formula(Rows& rows, Formula formula, double amplitude, double nuisance) {
  rows.step(inputs(0), 0, true);
  rows.step(inputs(1), 0.5, false, true);
  rows.step(inputs(2), 3);
  const Values g = rows.step(inputs(3), 1.2);
  constexpr double h = 1e-5;
  const auto value = formula(0, amplitude, nuisance);
  const auto difference = [&](double e, double a, double n, std::size_t axis) {
    return (formula(e, amplitude + a, nuisance + n)[axis] - formula(-e, amplitude - a, nuisance - n)[axis]) / (2 * h);
  };
  for (std::size_t a = 0; a < 3; ++a) {
    const double* const row = g.data() + a * rows.width();
    EXPECT_NEAR(row[0], value[a], 1e-12) << a;
    if (rows.place() > 1) {
      EXPECT_NEAR(row[1], difference(h, 0, 0, a), 1e-7) << a;
    }
    EXPECT_EQ(row[rows.place()], 0) << "by mu";
    EXPECT_NEAR(row[rows.place() + 1], difference(0, h, 0, a), 1e-7) << a;
    EXPECT_NEAR(row[rows.place() + 2], difference(0, 0, h, a), 1e-7) << a;
  }
}

constexpr double mu = 20;

TEST(MemoryRows, OfABranchAreItsFormulaWithAndWithoutADirection) {
  const auto made = wrapped("viscoelasticity", model("neo_hooke"));
  for (const std::size_t directions : {0u, 1u}) {
    Rows rows(*made, {mu, 0.8, 2.5}, directions);
    expect_formula(rows, viscous, 0.8, 2.5);
  }
}

/// A branch beside another one relaxes from the same elastic response, so that what each adds adds up.
TEST(MemoryRows, OfTwoBranchesAreTheSumOfWhatEachAdds) {
  const auto made = wrapped("viscoelasticity", wrapped("viscoelasticity", model("neo_hooke")));
  Rows rows(*made, {mu, 0.8, 2.5, 0.3, 9}, 1);
  rows.step(inputs(0), 0, true);
  rows.step(inputs(1), 0.5, false, true);
  rows.step(inputs(2), 3);
  const Values g = rows.step(inputs(3), 1.2);
  const auto one = viscous(0, 0.8, 2.5), other = viscous(0, 0.3, 9);
  constexpr double h = 1e-5;
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_NEAR(g[a * rows.width()], one[a] + other[a] - inputs(3)(0).g[a], 1e-12) << a;
    EXPECT_NEAR(g[a * rows.width() + rows.place() + 4],
                (viscous(0, 0.3, 9 + h)[a] - viscous(0, 0.3, 9 - h)[a]) / (2 * h), 1e-7)
        << a;
  }
}

TEST(MemoryRows, OfSofteningAreItsFormulaWithAndWithoutADirection) {
  const auto made = wrapped("stress_softening", model("neo_hooke"));
  EXPECT_EQ(made->describe().axis_history_size, 2u) << "the energy at rest and the largest one";
  for (const std::size_t directions : {0u, 1u}) {
    Rows rows(*made, {mu, 0.4, 0.6}, directions);
    expect_formula(rows, softened, 0.4, 0.6);
  }
}

/// The call at rest and the first row set the state up, whatever stood there before.
TEST(MemoryRows, OfSofteningBeginWithoutAPast) {
  const auto made = wrapped("stress_softening", model("neo_hooke"));
  Rows rows(*made, {mu, 0.4, 0.6}, 1);
  rows.fill_state(99);
  expect_formula(rows, softened, 0.4, 0.6);
}

/// Constant stress on one axis, energies as given; nothing moves.
class Pull {
 public:
  Pull(const Model& model, std::size_t axis, double stress) : rows_(model, {mu, 0.5, 0.1}, 1), axis_(axis) {
    now_ = {{1.1, 1.1, 1.1}, {1, 1, 1}, 0};
    now_.g[axis] = stress / 2;  // g is half of S
    rows_.step([](double) { return Inputs{{1, 1, 1}, {1, 1, 1}, 0}; }, 0, true);
  }
  /// η on the axis.
  double at(double energy, bool first = false) {
    now_.W = energy;
    return rows_.step([this](double) { return now_; }, 1, false, first)[axis_ * rows_.width()] / now_.g[axis_];
  }
  [[nodiscard]] double largest() const { return rows_.state()[rows_.width()]; }

 private:
  Rows rows_;
  std::size_t axis_;
  Inputs now_;
};

TEST(MemoryRows, OfSofteningTakeNoRoundingForAMemory) {
  const auto made = wrapped("stress_softening", model("neo_hooke"));
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double stress : {100.0, -100.0}) {
      Pull rounding(*made, axis, stress), stored(*made, axis, stress);
      rounding.at(0.8e-12 * 100, true);
      EXPECT_EQ(rounding.at(0.1e-12 * 100), 1) << axis;
      EXPECT_EQ(rounding.largest(), 0.8e-12 * 100) << "the largest so far stays";
      stored.at(1.25e-12 * 100, true);
      EXPECT_NEAR(stored.at(0.1e-12 * 100), 0.5, 1e-9) << axis;
    }
}

TEST(MemoryRows, OfSofteningKeepWhatIsUndefinedAndNothingBelowRest) {
  const auto made = wrapped("stress_softening", model("neo_hooke"));
  Pull below(*made, 0, 10), undefined(*made, 0, 10);
  below.at(-2, true);
  EXPECT_EQ(below.largest(), 0);
  undefined.at(3, true);
  undefined.at(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(std::isnan(undefined.largest()));
}

}  // namespace
}  // namespace tunica::testing::memory_rows_test
