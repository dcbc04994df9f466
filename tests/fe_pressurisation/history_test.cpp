// SPDX-License-Identifier: Apache-2.0
// Walls that remember: against the long tube, which takes the same steps, and in limits that are elastic.
#include <cmath>

#include <gtest/gtest.h>

#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::history_test {
namespace {

constexpr double wall = 2.06;

std::unique_ptr<Model> with(const char* mechanism, std::unique_ptr<Model> base) {
  return plugins::wrap(catalogue().mechanisms().at(mechanism), std::move(base), {});
}
std::vector<double> joined(std::vector<double> a, const std::vector<double>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance * std::max(1., std::abs(b[i]))) << i;
}

const std::vector<double> pressure{2, 8, 14, 14, 14, 6, 1, 10}, time{1, 2, 3, 6, 40, 41, 45, 46};

struct Remembering {
  const char *name, *mechanism, *base;
  std::vector<double> parameters;
};
const std::vector<Remembering> materials{{"viscous_rubber", "viscoelasticity", "neo_hooke", {60, 0.6, 5}},
                                         {"viscous_fibres", "viscoelasticity", "gho", joined(set_s, {0.8, 4})},
                                         {"softening_rubber", "stress_softening", "neo_hooke", {60, 0.5, 0.4}},
                                         {"softening_fibres", "stress_softening", "gho", joined(set_s, {0.4, 0.6})}};

class FiniteElementHistory : public ::testing::TestWithParam<Remembering> {
 protected:
  std::unique_ptr<Model> model = with(GetParam().mechanism, make_model(GetParam().base));
};

/// Sliding ends, loading, creep, unloading and loading again; also opened, supported and stretched by turns.
TEST_P(FiniteElementHistory, ConvergesToTheLongTube) {
  const std::vector<double> own[] = {bare_tube, {70, 0.01, 6, 0.03, 1}};
  for (const auto& imperfections : own)
    for (const auto& stretches :
         {std::vector<double>{}, std::vector<double>{1.1, 1.1, 1.2, 1.2, 1.2, 1.15, 1.1, 1.2}}) {
      const Inflation exact = inflate(*make_tube(pressure, {.axial_stretches = stretches, .time = time}), *model,
                                      GetParam().parameters, imperfections);
      const Inflation found = inflate(*make_fe_tube(pressure, {.element = "quadrilateral_9",
                                                               .elements = "[12, 2]",
                                                               .ends = "sliding",
                                                               .axial_stretches = stretches,
                                                               .time = time}),
                                      *model, GetParam().parameters, imperfections);
      ASSERT_TRUE(exact.status.ok() && found.status.ok()) << exact.status.reason() << found.status.reason();
      double worst[2] = {0, 0};
      for (std::size_t i = 0; i < 2 * pressure.size(); ++i)
        worst[i / pressure.size()] = std::max(worst[i / pressure.size()], std::abs(found.values[i] - exact.values[i]));
      std::printf("  %s: %.1e in D/D0, %.1e mN\n", GetParam().name, worst[0], worst[1]);
      EXPECT_LT(worst[0], 2e-5);
      EXPECT_LT(worst[1], 0.1);
    }
}

/// Held ends, where the wall shears: two prediction are the same bits, and the clamp is felt.
TEST_P(FiniteElementHistory, FollowsTheClampedTube) {
  const auto tube = make_fe_tube(pressure, {.elements = "[6, 10]", .time = time});
  const Inflation once = inflate(*tube, *model, GetParam().parameters);
  ASSERT_TRUE(once.status.ok()) << once.status.reason();
  EXPECT_EQ(inflate(*tube, *model, GetParam().parameters).values, once.values);
  const Inflation free = inflate(*make_fe_tube(pressure, {.elements = "[6, 10]", .ends = "sliding", .time = time}),
                                 *model, GetParam().parameters);
  for (std::size_t i = 0; i < pressure.size(); ++i) EXPECT_LT(once.values[i], free.values[i] + 1e-3) << i;
  const Inflation late =
      inflate(*make_fe_tube(pressure, {.elements = "[6, 10]", .ends = "clamped_after_stretch", .time = time}), *model,
              GetParam().parameters);
  ASSERT_TRUE(late.status.ok()) << late.status.reason();
}

INSTANTIATE_TEST_SUITE_P(All, FiniteElementHistory, ::testing::ValuesIn(materials),
                         [](const auto& at) { return std::string(at.param.name); });

/// At the null of the amplitude, without a clock, and after a very long time: the elastic tube.
TEST(FiniteElementHistory, IsElasticInItsLimits) {
  for (const char* ends : {"clamped", "clamped_after_stretch"})
    for (const std::vector<double>& own : {bare_fe, {60, 0.01, 5, 0.02, 1}}) {
      FeSetup setup{.elements = "[5, 8]", .ends = ends};
      const auto elastic = make_model("gho"), viscous = with("viscoelasticity", make_model("gho"));
      const std::vector<double> rise{1, 6, 12};
      const std::vector<double> bare = inflate(*make_fe_tube(rise, setup), *elastic, set_s, own).values;
      expect_near(inflate(*make_fe_tube(rise, setup), *viscous, joined(set_s, {0.7, 3}), own).values, bare, 1e-9);
      setup.time = {1e9, 2e9, 3e9};
      expect_near(inflate(*make_fe_tube(rise, setup), *viscous, joined(set_s, {0.7, 3}), own).values, bare, 1e-7);
      setup.time = {1, 2, 3};
      expect_near(inflate(*make_fe_tube(rise, setup), *viscous, joined(set_s, {0, 3}), own).values, bare, 1e-9);
      const auto soft = with("stress_softening", make_model("gho"));
      expect_near(inflate(*make_fe_tube(rise, setup), *soft, joined(set_s, {0, 0.4}), own).values, bare, 1e-9);
    }
}

/// Within a time far below τ every stress is that of an elastic material 1 + g times as stiff, up to what the volume
/// varies within an element: the overstress is a deviator, the elastic stress is not.
TEST(FiniteElementHistory, IsStifferElasticWhereLoadingIsFast) {
  const auto elastic = make_model("neo_hooke"), viscous = with("viscoelasticity", make_model("neo_hooke"));
  const std::vector<double> rise{1, 6, 12};
  const auto difference = [&](const char* elements) {
    FeSetup setup{.element = "quadrilateral_9", .elements = elements, .channels = {"outer_diameter_stretch"}};
    const std::vector<double> stiff = inflate(*make_fe_tube(rise, setup), *elastic, {60 * 1.7}, bare_fe).values;
    setup.time = {1e-9, 2e-9, 3e-9};
    const std::vector<double> fast = inflate(*make_fe_tube(rise, setup), *viscous, {60, 0.7, 5}, bare_fe).values;
    double worst = 0;
    for (std::size_t i = 0; i < rise.size(); ++i) worst = std::max(worst, std::abs(fast[i] - stiff[i]));
    return worst;
  };
  const double coarse = difference("[2, 4]"), fine = difference("[4, 8]");
  std::printf("  fast: %.1e, with half the elements %.1e\n", fine, coarse);
  EXPECT_LT(fine, 1e-5);
  EXPECT_LT(fine, coarse / 4);
}

/// A layer that creeps beside one that does not.
TEST(FiniteElementHistory, LayersRememberOnTheirOwn) {
  const auto viscous = with("viscoelasticity", make_model("neo_hooke")), elastic = make_model("gho");
  const std::vector<double> memory{60, 0.8, 5}, loads{2, 8, 8, 8, 3}, own{0, 0, 0, 0};
  const std::vector<double> clock{0.1, 0.2, 2, 1e7, 1e7 + 0.1};
  const std::vector<const Model*> mixed{elastic.get(), viscous.get()}, twice{viscous.get(), viscous.get()};
  FeSetup setup{.element = "quadrilateral_9", .elements = "[12, 2]", .ends = "sliding", .layers = {0.8, wall - 0.8}};
  setup.time = clock;
  const Inflation found = inflate(*make_fe_tube(loads, setup), *elastic, joined(set_s, memory), own, mixed);
  const Inflation exact = inflate(*make_tube(loads, {.time = clock, .layers = {0.8, wall - 0.8}}), *elastic,
                                  joined(set_s, memory), own, mixed);
  ASSERT_TRUE(found.status.ok() && exact.status.ok()) << found.status.reason() << exact.status.reason();
  for (std::size_t i = 0; i < loads.size(); ++i) EXPECT_NEAR(found.values[i], exact.values[i], 2e-5) << i;
  EXPECT_GT(found.values[2], found.values[1] + 1e-4);
  setup = {.elements = "[5, 8]", .layers = {0.4 * wall, 0.6 * wall}, .time = clock};
  const Inflation halves = inflate(*make_fe_tube(loads, setup), *viscous, joined(memory, memory), own, twice);
  setup.layers = {};
  const Inflation whole = inflate(*make_fe_tube(loads, setup), *viscous, memory);
  ASSERT_TRUE(halves.status.ok() && whole.status.ok()) << halves.status.reason();
  expect_near(halves.values, whole.values, 1e-8);
}

}  // namespace
}  // namespace tunica::testing::history_test
