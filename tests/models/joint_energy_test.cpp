// SPDX-License-Identifier: Apache-2.0
// One energy twice: as a sum of parts, and as one function of several invariants that branches where fibres switch on.
// A joint energy is evaluated several points at a time; what is in the other lanes must not matter.
#include "tunica/models/joint_energy.hpp"

#include <cmath>
#include <span>

#include "on_levels.hpp"
#include "tunica/detail/solve_strip.hpp"

namespace tunica::testing {
namespace {

/// As models()[3]: a matrix, two families that bear tension only, at rest too, and an exponential of I2.
struct Joint {
  static constexpr auto type = "joint", doc = "", reference = "";
  static constexpr std::size_t parameter_count = count, invariant_count = 4;
  static std::vector<Parameter> parameters() { return five_parameters().parameters; }

  template <class T>
  static InvariantOf<T> family(std::span<const T> p, double side) {
    InvariantOf<T> x = Dispersed::invariant(p);
    x.angle = side * x.angle;
    return x;
  }
  template <class T>
  static std::array<InvariantOf<T>, invariant_count> invariants(std::span<const T> p) {
    return {{{.i1 = T(1), .offset = T(-3)}, family(p, 1), family(p, -1), {.i2 = T(1), .offset = T(-3)}}};
  }
  template <class T>
  static T energy(std::span<const T> x, std::span<const T> p) {
    T sum = 0.5 * p[mu] * x[0] + laws::Exponential::energy(x[3], p.subspan(k1, 2));
    for (const T& strain : {x[1], x[2]})
      if (strain > -1e-12) sum += laws::Exponential::energy(strain, p.subspan(k1, 2));
    return sum;
  }
};

/// Squared stretches at which the fibres of some points are on, and of their neighbours off.
std::vector<double> mixed_points(std::size_t n) {
  std::vector<double> c(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    c[i] = i % 3 == 0 ? 0.8 : 1.2 + 0.001 * static_cast<double>(i);
    c[n + i] = i % 3 == 1 ? 1.1 : 0.85;
    c[2 * n + i] = 1 / (c[i] * c[n + i]);
  }
  return c;
}
Rows at(const Model& model, std::span<const double> c) {
  const std::size_t n = c.size() / 3;
  Rows rows{std::vector<double>(n), std::vector<double>(3 * n), std::vector<double>(6 * n),
            std::vector<double>(3 * count * n), std::vector<double>(count * n)};
  EXPECT_TRUE(model.evaluate_axes({n, c, parameters}, {rows[0], rows[1], rows[2], rows[3], rows[4]}).ok());
  return rows;
}

template <class Answer>
void expect_same(const Answer& answers, double tolerance) {
  const auto all = models();
  const Model& parts = *all[3];
  const JointEnergy<Joint> joint;
  for (const std::size_t n : {1, 3, 7, 64, 65}) {
    const OnLevel baseline(VectorLevel::baseline);
    const Rows reference = answers(parts, n);
    for (const auto level : levels()) {
      const OnLevel here(level);
      const Rows rows = answers(joint, n), again = answers(joint, n);
      for (std::size_t k = 0; k < rows.size(); ++k) {
        EXPECT_LT(difference(rows[k], reference[k]), tolerance) << name(level) << ", n = " << n << ", row " << k;
        EXPECT_TRUE(same_bits(rows[k], again[k])) << name(level);
      }
    }
  }
}

// The formula takes 1 from an exponential, which costs digits that the derivatives by hand of the part keep.
TEST(JointEnergies, AreTheSumOfTheirPartsInPrincipalAxes) { expect_same(along_axes, 1e-12); }
TEST(JointEnergies, AreTheSumOfTheirPartsOnTensors) { expect_same(on_tensors, 1e-12); }
TEST(JointEnergies, AreTheSumOfTheirPartsWhereNeighboursBranch) {
  expect_same([](const Model& model, std::size_t n) { return at(model, mixed_points(n)); }, 1e-12);
}

// The last step of Newton's method is applied to first order, which leaves its square, 1e-12.
TEST(JointEnergies, SolveTheFreeStripsOfTheirParts) {
  for (const std::size_t loaded : {0, 1})
    expect_same([loaded](const Model& model, std::size_t n) { return along_strip(model, n, loaded); }, 2e-12);
}

// Where nobody asks for y by parameters, one pass along the path does for two by its coordinates.
TEST(JointEnergies, DifferentiateTheStressOfFreeStripsAlone) {
  const JointEnergy<Joint> joint;
  for (const std::size_t loaded : {0, 1})
    for (const auto level : levels()) {
      const OnLevel here(level);
      const Rows all = along_strip(joint, 40, loaded);
      EXPECT_LT(difference(all[6], all[2]), 1e-13) << name(level);
    }
}

// With κ = 1/3 the families have no direction: λ2 = λ3 is the answer, also where it is no minimum of the energy (µ <
// 0).
TEST(JointEnergies, LeaveIsotropicStripsToSymmetry) {
  const JointEnergy<Joint> joint;
  const std::vector<double> p{-200, 15, 0.4, 57, 1. / 3};
  const std::vector<double> stretch{0.7, 0.9, 1.0, 1.3, 1.6};
  std::vector<double> stress(5), lateral(5);
  StripPath path{.loaded = 0, .parameters = p, .stretch = stretch, .stress = stress};
  path.lateral = lateral;
  Status status;
  EXPECT_FALSE(joint.solve_strip(path, status));
  free_strip::Scratch scratch;
  status = free_strip::solve(joint, path, scratch);
  ASSERT_TRUE(status.ok()) << status.reason();
  const auto slope = [&p](double x) { return p[k1] * x * std::exp(p[k2] * x * x); };
  for (std::size_t i = 0; i < 5; ++i) {
    const double l = stretch[i], w1 = 0.5 * p[mu] + 2. / 3 * slope((l * l + 2 / l - 3) / 3),
                 w2 = slope(2 * l + 1 / (l * l) - 3);
    EXPECT_NEAR(stress[i], 2 * (l * l - 1 / l) * (w1 + w2 / l), 1e-11 * 200) << l;
    EXPECT_EQ(lateral[i], -std::log(l));
  }
}

TEST(JointEnergies, DoNotDependOnTheirNeighbours) {
  const JointEnergy<Joint> joint;
  constexpr std::size_t n = 29;
  const std::vector<double> c = mixed_points(n);
  for (const auto level : levels()) {
    const OnLevel here(level);
    const Rows rows = at(joint, c);
    for (std::size_t i = 0; i < n; ++i) {
      const Rows alone = at(joint, std::vector<double>{c[i], c[n + i], c[2 * n + i]});
      for (std::size_t k = 0; k < rows.size(); ++k)
        for (std::size_t m = 0; m < alone[k].size(); ++m)
          EXPECT_EQ(alone[k][m], rows[k][m * n + i]) << name(level) << ", point " << i << ", row " << k;
    }
  }
}

// Where a stretch overflows, only its own point does.
TEST(JointEnergies, OverflowStaysInItsPoint) {
  const JointEnergy<Joint> joint;
  std::vector<double> c = mixed_points(8);
  c[3] = 1e3;
  for (const auto level : levels()) {
    const OnLevel here(level);
    const Rows rows = at(joint, c);
    for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(std::isfinite(rows[0][i]), i != 3) << name(level) << ", point " << i;
  }
}

}  // namespace
}  // namespace tunica::testing
