// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "kernel.hpp"
#include "support/fe_tube.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"

namespace tunica::testing::messages_test {
namespace {

std::string refusal(const std::vector<double>& pressure, const FeSetup& setup) {
  try {
    make_fe_tube(pressure, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
template <class T>
Options option(const char* name, T value) {
  Options options;
  options.set(name, value);
  return options;
}
std::string reason(const Test& tube, const char* model, const std::vector<double>& p,
                   const std::vector<double>& own = bare_fe) {
  return inflate(tube, *make_model(model), p, own).status.reason();
}
#define EXPECT_SAYS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST(FiniteElementMessages, TheMeshIsTwoNumbers) {
  for (const char* wrong : {"[25]", "[25, 50, 3]", "[0, 50]", "[25, 1]", "[201, 50]", "[25, 2001]", "\"fine\"",
                            "[2.5, 50]", "[-3, 50]", "7"}) {
    EXPECT_SAYS(refusal({1}, {.elements = wrong}), "\"elements\" is " + std::string(wrong));
    EXPECT_SAYS(refusal({1}, {.elements = wrong}), "give two numbers, [radial, axial over half the length]");
  }
  EXPECT_EQ(refusal({1}, {.elements = "[1, 2]"}), "");
  EXPECT_EQ(refusal({1}, {.elements = "[200, 2000]"}), "");
}

/// Before anything of the kind is allocated.
TEST(FiniteElementMessages, AMeshThatTakesTooMuchMemoryIsRefusedWithTheFigure) {
  EXPECT_SAYS(refusal({1}, {.element = "quadrilateral_9", .elements = "[200, 2000]"}),
              "fe_pressurisation: a mesh of 200 × 2000 elements of 9 nodes needs 5.4 GiB of memory, and 4 GiB are "
              "allowed; take fewer elements across the wall");
  const fe::Mesh mesh(1, 20, 40, 3.71, 5.77, 7, 1.5, fe::Ends::clamped);
  fe::Stencil matrix;
  matrix.resize(mesh);
  fe::Banded factor;
  matrix.spread(factor);
  const double columns = static_cast<double>((factor.column(factor.size() - 1) - factor.column(0)) +
                                             (matrix.column(factor.size() - 1) - matrix.column(0)));
  const double weight = 4. * static_cast<double>(2 * mesh.nodes()) + 3. * static_cast<double>(mesh.radial * mesh.axial);
  const double expected = 8 * (columns + static_cast<double>(fe::Solver::together(mesh)) * weight);
  EXPECT_NEAR(fe::Solver::bytes(mesh), expected, 0.1 * expected);
}

TEST(FiniteElementMessages, TheLengthIsNeeded) {
  EXPECT_SAYS(refusal({1}, {.options = option("length", 0.)}),
              "fe_pressurisation: \"length\" is 0; give the unloaded length between the ends");
}

TEST(FiniteElementMessages, TubesThatAreNoneAreRefusedByTheirName) {
  EXPECT_SAYS(refusal({1}, {.options = option("inner_radius", 0.)}), "fe_pressurisation: give two of");
  EXPECT_SAYS(refusal({1}, {.axial_stretch = 0}), "fe_pressurisation: the axial stretch is missing");
  EXPECT_SAYS(refusal({}, {}), "fe_pressurisation: there are no rows");
  EXPECT_SAYS(refusal({1, 2}, {.axial_stretches = {1.2, -1}}), "row 2 has axial stretch -1; a stretch is positive");
}

TEST(FiniteElementMessages, WithHistoryThereIsNoJacobianAndNoPicture) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const auto tube = make_fe_tube({1}, {.elements = "[2, 2]"});
  const std::vector<double> parameters{60, 0.8, 5};
  std::vector<double> jacobian(8 * 2);
  EXPECT_SAYS(tube->predict({*viscous, parameters, bare_fe}, {{}, jacobian, {}, {}}).reason(),
              "fe_pressurisation: no exact Jacobian along the path of a model with history");
  std::vector<Snapshot> snapshots;
  const std::vector<std::size_t> rows{0};
  EXPECT_SAYS(tube->snapshots({*viscous, parameters, bare_fe}, rows, snapshots).reason(),
              "fe_pressurisation shows the wall of a material without history only; take the model without its "
              "mechanisms of history");
}

TEST(FiniteElementMessages, WallsThatAreNoneAreRefused) {
  EXPECT_SAYS(
      refusal({1}, {.elements = "[2, 4]", .layers = {0.5, 0.5, 1.06}}),
      "fe_pressurisation: \"elements\" begins with 2, and the wall has 3 layers, each of which takes one element "
      "across at least; raise that number");
  EXPECT_EQ(refusal({1}, {.elements = "[3, 4]", .layers = {0.5, 0.5, 1.06}}), "");
  EXPECT_SAYS(refusal({1}, {.layers = {0.97, 2}}),
              "fe_pressurisation: the layers are 2.97 mm thick together, and the wall is 2.06 mm");
  EXPECT_SAYS(refusal({1}, {.options = option("layer_interface", 0.4), .layers = {1, 1.06}}),
              "fe_pressurisation: \"layer_interface\" says where layer_ratio parts a wall of one model");
  const auto tube = make_fe_tube({1}, {.elements = "[2, 2]"});
  EXPECT_SAYS(reason(*tube, "neo_hooke", {60}, {380, 0, 0, 0, 1}),
              "fe_pressurisation: thickness error and opening angle leave no wall, at row 1");
}

TEST(FiniteElementMessages, WithoutParameterDerivativesThereIsNoJacobian) {
  class Bare final : public TensorsOnly {
   public:
    Bare() : TensorsOnly(make_model("neo_hooke")) { description_.parameter_derivatives = false; }
  } const bare;
  const auto tube = make_fe_tube({1}, {.elements = "[2, 2]"});
  std::vector<double> jacobian(6 * 2);
  EXPECT_SAYS(tube->predict({bare, std::vector<double>{60}, bare_fe}, {{}, jacobian, {}, {}}).reason(),
              "the model has no parameter derivatives");
  EXPECT_TRUE(inflate(*tube, bare, {60}, bare_fe).status.ok());
}

TEST(FiniteElementMessages, ImperfectionsThatLeaveNoTubeAreAStatus) {
  Options thick = option("inner_radius", 1.);
  thick.set("thickness", 3.);
  const auto tube = make_fe_tube({1}, {.elements = "[2, 2]", .options = thick});
  EXPECT_SAYS(reason(*tube, "neo_hooke", {60}, {0, 0, 0, 0.4, 1}), "the thickness error leaves no wall or no lumen");
  EXPECT_SAYS(reason(*tube, "neo_hooke", {60}, {0, 0, 0, -1, 1}), "the thickness error leaves no wall or no lumen");
  EXPECT_SAYS(reason(*tube, "neo_hooke", {60}, {0, -1.3, 0, 0, 1}),
              "fe_pressurisation: no such tube at row 1 (pressure 1 kPa");
}

TEST(FiniteElementMessages, TheTimeLimitIsKept) {
  const auto tube = make_fe_tube({5, 20}, {.elements = "[25, 100]", .options = option("time_limit", 0.004)});
  const auto start = std::chrono::steady_clock::now();
  const std::string late = reason(*tube, "gho", set_s);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1);
  EXPECT_SAYS(late, "row 1 (pressure 5 kPa");
  EXPECT_SAYS(late, "the time limit is reached");
}

// One factorisation of this mesh takes seconds, so the limit has to be looked at within it.
TEST(FiniteElementMessages, TheTimeLimitIsKeptWithinASecondOnALargeMesh) {
  const auto tube = make_fe_tube({5, 20}, {.elements = "[200, 500]", .options = option("time_limit", 1.)});
  const auto start = std::chrono::steady_clock::now();
  const std::string late = reason(*tube, "gho", set_s);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(seconds, 1);
  EXPECT_LT(seconds, 2);
  EXPECT_SAYS(late, "the time limit is reached");
}

TEST(FiniteElementMessages, TheStepsAreCounted) {
  const auto tube = make_fe_tube({2, 8, 20}, {.elements = "[2, 3]", .options = option("max_steps", std::int64_t{2})});
  EXPECT_SAYS(reason(*tube, "gho", set_s), "2 load steps were not enough");
  EXPECT_SAYS(reason(*tube, "gho", set_s), "row 2 (pressure 8 kPa");
}

/// On a line that is interpolated, with rows on both sides of zero: first up, then down.
TEST(FiniteElementMessages, TheRowThatWasNotReachedIsOnItsSideOfZero) {
  std::vector<double> pressures = evenly(0, 20, 21);
  for (const double below : evenly(-0.5, -15, 30)) pressures.push_back(below);
  const auto stopped = [&](std::int64_t steps) {
    return reason(*make_fe_tube(pressures, {.elements = "[2, 3]", .options = option("max_steps", steps)}), "gho",
                  set_s);
  };
  EXPECT_SAYS(stopped(3), "row 8 (pressure 7 kPa");
  for (const std::int64_t steps : {10, 12, 14}) EXPECT_SAYS(stopped(steps), "(pressure -");
}

TEST(FiniteElementMessages, AnOverflowNamesItsRow) {
  const std::string text =
      reason(*make_fe_tube({1, 2}, {.elements = "[2, 3]", .axial_stretch = 4}), "gho", {10, 0.1, 500, 100, 0});
  EXPECT_SAYS(text, "row 1 (pressure 1 kPa, axial stretch 4)");
  EXPECT_SAYS(text, " is not reached: the stress overflows");
  EXPECT_SAYS(text, " after pressure ");
}

/// From the reasons of a thousand tubes (robustness_test.cpp) the path takes its own; here the solver's, without a
/// path.
TEST(FiniteElementMessages, NewtonsMethodSaysHowItFails) {
  const auto reason_at = [](double pressure, double disturbance) {
    Kernel kernel(small_mesh(1, fe::Ends::clamped), make_model("gho"), set_s);
    fe::State state = disturbed(kernel.solver, disturbance, 0, 3);
    return kernel.solver.solve({1.2, pressure}, state, fe::Aim::factor).reason();
  };
  EXPECT_EQ(reason_at(1000, 0), "Newton's method runs away");
  EXPECT_EQ(reason_at(30, 30), "the stiffness is singular");
}

/// Beyond the limit pressure of a rubber tube lie equilibria that are unstable, and none that loading leads to.
TEST(FiniteElementMessages, TheEquilibriaOfATubeThatBalloonsAreNotPassedBy) {
  const double limit = 60 / 1.2 * std::log(5.77 / 3.71);
  for (const double beyond : {1.001, 1.01, 1.05}) {
    const std::string text =
        reason(*make_fe_tube({beyond * limit}, {.elements = "[4, 6]", .ends = "sliding"}), "neo_hooke", {60});
    EXPECT_SAYS(text, "the equilibrium becomes unstable, by a bulge or a buckle, after pressure 21.8");
  }
}

}  // namespace
}  // namespace tunica::testing::messages_test
