// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::robustness_test {
namespace {

/// The number after `words` in a reason.
double number_after(const std::string& reason, const std::string& words) {
  const auto at = reason.find(words);
  EXPECT_NE(at, std::string::npos) << reason;
  return at == std::string::npos ? NAN : std::stod(reason.substr(at + words.size()));
}

/// p → (μ/λz) ln(Ro/Ri) as the long tube widens, from below: there is no state beyond.
TEST(FiniteElementRobustness, TheLimitPressureOfANeoHookeanTubeIsNoticed) {
  constexpr double mu = 60, lz = 1.2;
  const double limit = mu / lz * std::log(5.77 / 3.71);
  const auto model = make_model("neo_hooke");
  for (const char* element : {"quadrilateral_4", "quadrilateral_9"}) {
    const FeSetup setup{.element = element, .elements = "[12, 2]", .ends = "sliding"};
    const Inflation below = inflate(*make_fe_tube({0.5 * limit, 0.9 * limit}, setup), *model, {mu}, bare_fe);
    EXPECT_TRUE(below.status.ok()) << below.status.reason();
    const Inflation beyond = inflate(*make_fe_tube({0.5 * limit, 1.1 * limit}, setup), *model, {mu}, bare_fe);
    EXPECT_EQ(beyond.status.kind(), Status::Kind::failed);
    EXPECT_NE(beyond.status.reason().find("row 2 (pressure 24.2"), std::string::npos) << beyond.status.reason();
    const double reached = number_after(beyond.status.reason(), " after pressure ");
    EXPECT_GT(reached, 0.95 * limit) << beyond.status.reason();
    EXPECT_LT(reached, 1.01 * limit) << beyond.status.reason();
    // The same on the interpolated line.
    const Inflation line = inflate(*make_fe_tube(evenly(0, 1.1 * limit, 40), setup), *model, {mu}, bare_fe);
    EXPECT_EQ(line.status.kind(), Status::Kind::failed);
    EXPECT_GT(number_after(line.status.reason(), " after pressure "), 0.95 * limit) << line.status.reason();
  }
}

/// A thousand clamped tubes over the whole box of the gho (seed 5, deterministic: no false alarm). Every one of them
/// converges or says why not; those that converge agree with steps between, on the other way of solving, to 1e-6.
TEST(FiniteElementRobustness, AnyAdmissibleTubeConvergesOrSaysWhyNot) {
  const auto model = make_model("gho");
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) { return low + (high - low) * unit(engine); };
  std::size_t failed = 0, compared = 0, finer_failed = 0;
  double worst = 0, longest = 0;
  std::map<std::string, int> reasons;
  for (int draw = 0; draw < 1000; ++draw) {
    std::vector<double> p;
    for (const Parameter& parameter : model->describe().parameters)
      p.push_back(parameter.scale == Scale::log ? parameter.min * std::pow(parameter.max / parameter.min, unit(engine))
                                                : between(parameter.min, parameter.max));
    const double lz = between(0.9, 1.6), top = between(1, 30);
    const FeSetup setup{.elements = "[4, 8]", .axial_stretch = lz};
    const auto start = std::chrono::steady_clock::now();
    const Inflation out = inflate(*make_fe_tube({0, 0.5 * top, top}, setup), *model, p, bare_fe);
    longest = std::max(longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    if (!out.status.ok()) {
      ++failed;
      const std::string& reason = out.status.reason();
      EXPECT_EQ(out.status.kind(), Status::Kind::failed);
      EXPECT_NE(reason.find("row "), std::string::npos) << reason;
      EXPECT_NE(reason.find(" after pressure "), std::string::npos) << reason;
      const auto why = reason.find("reached: ");
      ++reasons[why == std::string::npos ? reason : reason.substr(why + 9, reason.find(" after pressure ") - why - 9)];
      continue;
    }
    for (const double value : out.values) ASSERT_TRUE(std::isfinite(value)) << draw;
    if (draw % 4 != 0) continue;
    // Steps between, and (every other time) the line that is interpolated.
    const std::size_t rows = draw % 8 == 0 ? 13 : 41;
    const Inflation finer = inflate(*make_fe_tube(evenly(0, top, rows), setup), *model, p, bare_fe);
    if (!finer.status.ok()) {
      ++finer_failed;
      std::printf("  draw %d: %s\n", draw, finer.status.reason().c_str());
      continue;
    }
    ++compared;
    for (std::size_t i = 0; i < 3; ++i) {
      const double off = std::abs(finer.values[i * (rows - 1) / 2] - out.values[i]);
      worst = std::max(worst, off);
      EXPECT_LE(off, 1e-6) << "draw " << draw << ", row " << i + 1 << ": " << out.values[i] << ", λz " << lz << ", top "
                           << top;
    }
  }
  for (const auto& [reason, count] : reasons) std::printf("  %4d %s\n", count, reason.c_str());
  std::printf("  failed %zu, compared %zu, worst %.1e, longest %.0f ms\n", failed, compared, worst, 1e3 * longest);
  EXPECT_EQ(finer_failed, 0u);
  EXPECT_GT(compared, 150u);
  // Soft walls that balloon, or elements at the clamp that degenerate beyond twice the diameter.
  EXPECT_LT(failed, 180u);
  for (const char* known : {"the pressure stops rising (limit pressure)", "the state jumps", "Newton's method diverges",
                            "Newton's method did not converge in 14 iterations"})
    EXPECT_GT(reasons[known], 0) << known;
}

}  // namespace
}  // namespace tunica::testing::robustness_test
