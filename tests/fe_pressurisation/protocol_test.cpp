// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <thread>

#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::protocol_test {
using namespace conformance;
namespace {

void expect_long_tube(const std::vector<double>& pressure, const std::vector<double>& stretches) {
  const auto gho = make_model("gho");
  const Inflation exact = inflate(*make_tube(pressure, {.axial_stretches = stretches}), *gho, set_s);
  const Inflation found = inflate(
      *make_fe_tube(
          pressure,
          {.element = "quadrilateral_9", .elements = "[12, 2]", .ends = "sliding", .axial_stretches = stretches}),
      *gho, set_s, bare_fe);
  ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  const std::size_t n = pressure.size();
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(found.values[i], exact.values[i], 2e-6) << i;
    EXPECT_NEAR(found.values[n + i], exact.values[n + i], 1e-5 * 3000) << i;
  }
}

TEST(FiniteElementProtocol, FollowsForceLengthTestsInAnyOrder) {
  expect_long_tube({8, 8, 8, 8, 8, 16, 16, 16, 0, 3}, {1.3, 1.1, 1.2, 1.15, 1.25, 1.1, 1.2, 1.3, 1.2, 1.2});
}

TEST(FiniteElementProtocol, ShortensTubesAsWellAsItStretchesThem) {
  expect_long_tube({0, 4, 4, 4, 0, 2}, {0.97, 0.95, 1.2, 0.97, 1, 1});
}

TEST(FiniteElementProtocol, TakesNegativePressuresOnBothWaysOfSolving) {
  expect_long_tube({3, -1, 0, -2, 6}, std::vector<double>(5, 1.2));
  const std::vector<double> many = evenly(-2, 18, 45);
  expect_long_tube(many, std::vector<double>(many.size(), 1.2));
  const std::vector<double> below = evenly(-2, -0.1, 20);
  expect_long_tube(below, std::vector<double>(below.size(), 1.2));
}

TEST(FiniteElementProtocol, RepeatedRowsAreTheSameRow) {
  const auto gho = make_model("gho");
  const Inflation out = inflate(*make_fe_tube({5, 9, 5, 9, 5}, {.elements = "[4, 6]"}), *gho, set_s, bare_fe);
  ASSERT_TRUE(out.status.ok());
  for (const std::size_t i : {2u, 4u}) EXPECT_EQ(out.values[i], out.values[0]);
  EXPECT_EQ(out.values[3], out.values[1]);
}

TEST(FiniteElementProtocol, ChannelsAndDiagnosticsAreOneTube) {
  const auto gho = make_model("gho");
  const Inflation out = inflate(*make_fe_tube({5, 15}, {.elements = "[4, 6]",
                                                        .channels = {"outer_diameter", "outer_diameter_stretch",
                                                                     "inner_diameter", "inner_diameter_stretch"}}),
                                *gho, set_s, bare_fe);
  ASSERT_TRUE(out.status.ok());
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_DOUBLE_EQ(out.values[i], 2 * 5.77 * out.values[2 + i]);
    EXPECT_DOUBLE_EQ(out.values[4 + i], 2 * 3.71 * out.values[6 + i]);
    EXPECT_DOUBLE_EQ(out.diagnostics[i], out.values[6 + i]);
    EXPECT_LT(out.values[4 + i], out.values[i]);
  }
}

/// A wall that is thicker by 1+g at the same outer radius is that of another tube.
TEST(FiniteElementProtocol, ImperfectionsAreThoseOfTheLongTube) {
  const auto gho = make_model("gho");
  const Inflation exact = inflate(*make_tube({0, 6, 15}), *gho, set_s, {0, 0.03, 0, -0.1, 1});
  const Inflation found =
      inflate(*make_fe_tube({0, 6, 15}, {.element = "quadrilateral_9", .elements = "[12, 2]", .ends = "sliding"}), *gho,
              set_s, {0, 0.03, 0, -0.1, 1});
  ASSERT_TRUE(exact.status.ok() && found.status.ok());
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found.values[i], exact.values[i], i < 3 ? 2e-6 : 0.03) << i;
}

TEST(FiniteElementConformance, ValuesDoNotDependOnTheOtherOutputs) {
  const auto gho = make_model("gho"), rubber = make_model("mooney_rivlin");
  for (const char* element : {"quadrilateral_4", "quadrilateral_9"})
    for (const char* ends : {"clamped", "clamped_after_stretch", "sliding"})
      for (const auto& pressure : {std::vector<double>{1, 8, 20}, evenly(0, 22, 30)}) {
        const auto tube = make_fe_tube(pressure, {.element = element, .elements = "[3, 5]", .ends = ends});
        EXPECT_EQ(values_do_not_depend_on_the_other_outputs({*tube, *gho, set_s, bare_fe}).counter_example, "") << ends;
        EXPECT_EQ(values_do_not_depend_on_the_other_outputs({*tube, *rubber, {30, 20}, bare_fe}).counter_example, "")
            << ends;
        EXPECT_EQ(given_abscissae_replace_the_bound_ones({*tube, *gho, set_s, bare_fe}).counter_example, "") << ends;
      }
}

/// Whatever a thread simulated before: meshes, materials and derivatives in another order on each.
TEST(FiniteElementConformance, ThreadsGetTheSameNumbersBitForBit) {
  const auto gho = make_model("gho"), rubber = make_model("mooney_rivlin");
  struct Job {
    std::unique_ptr<tunica::Test> tube;
    const Model* model;
    std::vector<double> parameters;
    bool derivatives;
  };
  std::vector<Job> jobs;
  for (const char* element : {"quadrilateral_4", "quadrilateral_9"})
    for (const bool derivatives : {false, true}) {
      jobs.push_back(
          {make_fe_tube({3, 12}, {.element = element, .elements = "[4, 6]"}), gho.get(), set_s, derivatives});
      jobs.push_back(
          {make_fe_tube({3, 12}, {.element = element, .elements = "[4, 6]"}), rubber.get(), {30, 20}, derivatives});
      jobs.push_back(
          {make_fe_tube(evenly(0, 20, 20), {.element = element, .elements = "[3, 5]", .ends = "clamped_after_stretch"}),
           gho.get(), set_s, derivatives});
    }
  constexpr std::size_t threads = 4;
  std::vector<std::vector<double>> results(threads * jobs.size());
  std::vector<std::thread> running;
  for (std::size_t t = 0; t < threads; ++t)
    running.emplace_back([&, t] {
      for (int round = 0; round < 3; ++round)
        for (std::size_t k = 0; k < jobs.size(); ++k) {
          const std::size_t at = (k * (t % 2 == 0 ? 1 : 5) + 3 * t) % jobs.size();  // 5 and 12 have no common factor
          const Job& job = jobs[at];
          const std::size_t rows = 2 * job.tube->rows().count, all = job.parameters.size() + bare_fe.size();
          std::vector<double>& out = results[t * jobs.size() + at];
          std::vector<double> values(rows), jacobian(job.derivatives ? all * rows : 0);
          if (job.tube->predict({*job.model, job.parameters, bare_fe}, {values, jacobian, {}, {}}).ok()) {
            out.insert(out.end(), values.begin(), values.end());
            out.insert(out.end(), jacobian.begin(), jacobian.end());
          }
        }
    });
  for (auto& thread : running) thread.join();
  for (std::size_t k = 0; k < jobs.size(); ++k) {
    const std::size_t each = results[k].size() / 3;
    ASSERT_GT(each, 0u) << k;
    for (std::size_t i = each; i < results[k].size(); ++i) ASSERT_EQ(results[k][i], results[k][i - each]) << k;
    for (std::size_t t = 1; t < threads; ++t) EXPECT_EQ(results[t * jobs.size() + k], results[k]) << k;
  }
}

}  // namespace
}  // namespace tunica::testing::protocol_test
