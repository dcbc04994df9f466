// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/strip.hpp"
#include "support/tensors_only.hpp"
#include "support/tube.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

std::string refusal(const std::vector<double>& pressure, const TubeSetup& setup) {
  try {
    make_tube(pressure, setup);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
Options lengths(double inside, double outside, double thickness) {
  Options options;
  options.set("inner_radius", inside);
  options.set("outer_radius", outside);
  options.set("thickness", thickness);
  return options;
}
#define EXPECT_SAYS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST(TubeMessages, TwoOfTheThreeLengthsAreNeeded) {
  EXPECT_SAYS(refusal({1}, {.options = lengths(3, 0, 0)}), "give two of \"inner_radius\", \"outer_radius\" and");
  EXPECT_SAYS(refusal({1}, {.options = lengths(3, 5, 2)}), "give two of");
  EXPECT_SAYS(refusal({1}, {.options = lengths(5, 3, 0)}), "an inner radius of 5 mm and an outer one of 3 mm leave no");
  EXPECT_SAYS(refusal({1}, {.options = lengths(0, 3, 4)}), "leave no wall");
  const auto model = make_model("gho");
  const auto values = inflate(*make_tube({9}), *model, set_s).values;
  for (const Options& same : {lengths(3.71, 5.77, 0), lengths(0, 5.77, 2.06)})
    EXPECT_NEAR(inflate(*make_tube({9}, {.options = same}), *model, set_s).values[0], values[0], 1e-14);
}

TEST(TubeMessages, TheAxialStretchComesFromOnePlace) {
  EXPECT_SAYS(refusal({1}, {.axial_stretch = 0}), "the axial stretch is missing; give \"axial_stretch\": 1.2");
  Options held;
  held.set("axial_stretch", 1.2);
  EXPECT_SAYS(refusal({1}, {.axial_stretches = {1.2}, .options = held}), "given twice, as an option and as a column");
}

TEST(TubeMessages, RowsThatCannotBeSimulatedAreRefused) {
  EXPECT_SAYS(refusal({}, {}), "there are no rows");
  EXPECT_SAYS(refusal({1, 2}, {.axial_stretches = {1.2, -1}}), "row 2 has axial stretch -1; a stretch is positive");
  EXPECT_SAYS(refusal({1, std::numeric_limits<double>::infinity()}, {}), "the pressure of row 2 is no number");
  Options one_point;
  one_point.set("gauss_points", std::int64_t{1});
  EXPECT_SAYS(refusal({1}, {.options = one_point}), "\"gauss_points\" is 1, which integrates nothing well");
  EXPECT_SAYS(refusal({1, 2, 3}, {.time = {0, 2, 1}}),
              "time runs backwards at row 3; give the rows in the order in which they were measured");
  TestSetup no_pressure;
  no_pressure.options = defaults(catalogue().tests().at("thick_wall_pressurisation").factory.options);
  no_pressure.options.set("inner_radius", 3.);
  no_pressure.options.set("thickness", 1.);
  try {
    plugins::create(catalogue().tests().at("thick_wall_pressurisation"), no_pressure);
    FAIL() << "a tube without pressure was accepted";
  } catch (const InputError& error) {
    EXPECT_SAYS(error.what(), "no column is mapped to 'pressure'");
  }
}

TEST(TubeMessages, OverflowIsAStatusThatNamesTheRow) {
  const auto tube = make_tube(evenly(0, 20, 5), {.axial_stretch = 3});
  EXPECT_EQ(overflow_is_a_status({*tube, *make_model("gho"), {10, 0.1, 500, 100, 0}, bare_tube}).counter_example, "");
  EXPECT_SAYS(inflate(*tube, *make_model("gho"), {10, 0.1, 500, 100, 0}).status.reason(), "the energy overflows");
  EXPECT_SAYS(inflate(*make_tube({5}, {.axial_stretch = 2}), *make_model("gent"), {60, 1}).status.reason(),
              "the energy overflows or is undefined on the path from rest, beyond");
}

TEST(TubeMessages, PathsWithHistoryOnTensorsHaveNoJacobian) {
  const auto viscous = plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {});
  const TensorsOnly tensors(plugins::wrap(catalogue().mechanisms().at("viscoelasticity"), make_model("neo_hooke"), {}));
  std::vector<double> jacobian(8 * 2);
  const Status status = make_tube({1})->predict({tensors, {{60, 0.8, 5}}, bare_tube}, {{}, jacobian, {}, {}});
  EXPECT_EQ(status.kind(), Status::Kind::failed);
  EXPECT_SAYS(status.reason(), "no exact Jacobian along the path of a model with history");
  const Inflation burst = inflate(*make_tube({1, 400}), *viscous, {60, 0.8, 5});
  EXPECT_SAYS(burst.status.reason(), "no equilibrium at row 2 (pressure 400 kPa, axial stretch 1.2)");
}

}  // namespace
}  // namespace tunica::testing
