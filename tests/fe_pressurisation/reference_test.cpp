// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/fe_tube.hpp"
#include "support/strip.hpp"

namespace tunica::testing::reference_test {
namespace {

constexpr double most = 22.66474;  // kPa, 170 mmHg

struct Deviation {
  double stretch = 0;  ///< largest of D/D0
  double force = 0;    ///< largest of the reduced force, over its largest value
};

Deviation from_long_tube(const std::string& element, const std::string& elements, const std::vector<double>& pressure,
                         const Options& options = {}) {
  const auto gho = make_model("gho");
  const auto tube =
      make_fe_tube(pressure, {.element = element, .elements = elements, .ends = "sliding", .options = options});
  const Inflation found = inflate(*tube, *gho, set_s, bare_fe), exact = inflate(*make_tube(pressure), *gho, set_s);
  EXPECT_TRUE(found.status.ok()) << found.status.reason();
  Deviation deviation;
  double largest = 0;
  const std::size_t n = pressure.size();
  for (std::size_t i = 0; i < n; ++i) {
    deviation.stretch = std::max(deviation.stretch, std::abs(found.values[i] - exact.values[i]));
    deviation.force = std::max(deviation.force, std::abs(found.values[n + i] - exact.values[n + i]));
    largest = std::max(largest, std::abs(exact.values[n + i]));
  }
  deviation.force /= largest;
  return deviation;
}

TEST(FiniteElementReference, SlidingEndsAreTheLongTube) {
  for (const auto& [element, elements] : {std::pair{"quadrilateral_4", "[25, 50]"}, {"quadrilateral_9", "[12, 25]"}}) {
    const Deviation off = from_long_tube(element, elements, evenly(0, most, 35));
    std::printf("  sliding %s %s: %.2e in D/D0, %.2e in force\n", element, elements, off.stretch, off.force);
    EXPECT_LE(off.stretch, 3e-5);
    EXPECT_LE(off.force, 3e-4);
  }
}

/// Uniform meshes, halved; the state does not vary along the tube.
TEST(FiniteElementReference, ConvergesToTheLongTubeWithItsOrder) {
  Options uniform;
  uniform.set("grading", 1.);
  for (const auto& [element, least] : {std::pair{"quadrilateral_4", 1.9}, {"quadrilateral_9", 2.8}}) {
    std::vector<Deviation> off;
    for (const char* elements : {"[8, 2]", "[16, 2]", "[32, 2]"})
      off.push_back(from_long_tube(element, elements, {0, 8, 16, most}, uniform));
    for (std::size_t k = 1; k < 3; ++k) {
      const double stretch = std::log2(off[k - 1].stretch / off[k].stretch),
                   force = std::log2(off[k - 1].force / off[k].force);
      std::printf("  sliding %s: order %.2f in D/D0, %.2f in force\n", element, stretch, force);
      EXPECT_GE(stretch, least) << element;
      EXPECT_GE(force, least) << element;
    }
  }
}

/// The clamp is a singular corner, so that no order is promised: against a fine mesh of nine-node elements.
TEST(FiniteElementReference, ConvergesWithClampedEnds) {
  const auto gho = make_model("gho");
  const std::vector<double> pressure{0, 8, 16, most};
  const auto curve = [&](const char* element, const char* elements) {
    Options uniform;
    uniform.set("grading", 1.);
    const Inflation out = inflate(
        *make_fe_tube(pressure, {.element = element, .elements = elements, .options = uniform}), *gho, set_s, bare_fe);
    EXPECT_TRUE(out.status.ok()) << out.status.reason();
    return out.values;
  };
  const std::vector<double> fine = curve("quadrilateral_9", "[24, 64]");
  for (const auto& [element, meshes] : {std::pair{"quadrilateral_4", std::vector{"[4, 8]", "[8, 16]", "[16, 32]"}},
                                        {"quadrilateral_9", std::vector{"[3, 8]", "[6, 16]", "[12, 32]"}}}) {
    std::vector<double> off;
    for (const char* elements : meshes) {
      const std::vector<double> found = curve(element, elements);
      off.push_back(0);
      for (std::size_t i = 0; i < pressure.size(); ++i) off.back() = std::max(off.back(), std::abs(found[i] - fine[i]));
    }
    std::printf("  clamped %s: deviations %.2e %.2e %.2e, orders %.2f %.2f\n", element, off[0], off[1], off[2],
                std::log2(off[0] / off[1]), std::log2(off[1] / off[2]));
    EXPECT_LT(off[1], 0.5 * off[0]) << element;
    EXPECT_LT(off[2], 0.5 * off[1]) << element;
  }
}

TEST(FiniteElementReference, ClampedEndsGiveTheReferenceCurve) {
  const auto columns = columns_of(TUNICA_SOURCE_DIR "/tests/support/tube_set_s.csv");
  ASSERT_EQ(columns.size(), 6u);
  const auto gho = make_model("gho");
  struct Case {
    const char *element, *elements;
    double allowed;
  };
  for (const Case& mesh : {Case{"quadrilateral_4", "[25, 50]", 7e-5}, Case{"quadrilateral_4", "[25, 100]", 7e-5},
                           Case{"quadrilateral_9", "[12, 25]", 1.5e-5}}) {
    const Inflation out =
        inflate(*make_fe_tube(columns[0], {.element = mesh.element, .elements = mesh.elements}), *gho, set_s, bare_fe);
    ASSERT_TRUE(out.status.ok()) << out.status.reason();
    double worst = 0;
    for (std::size_t i = 0; i < columns[0].size(); ++i)
      worst = std::max(worst, std::abs(out.values[i] - columns[5][i]));
    std::printf("  clamped %s %s: %.2e from the reference\n", mesh.element, mesh.elements, worst);
    EXPECT_LE(worst, mesh.allowed) << mesh.element;
  }
}

/// The end of a tube that is stretched free and then held has no clamp to feel before pressure comes, and feels it
/// then.
TEST(FiniteElementReference, EndsHeldAfterStretchingLieBetweenFreeAndClamped) {
  const auto gho = make_model("gho");
  const auto curve = [&](const char* ends) {
    return inflate(*make_fe_tube({0, 10, 20}, {.elements = "[8, 16]", .ends = ends}), *gho, set_s, bare_fe).values;
  };
  const auto clamped = curve("clamped"), later = curve("clamped_after_stretch"), sliding = curve("sliding");
  EXPECT_NEAR(later[0], sliding[0], 1e-9);
  EXPECT_NEAR(later[3], sliding[3], 1e-6);
  for (const std::size_t i : {1u, 2u}) EXPECT_LT(later[i], sliding[i] - 0.005);
  EXPECT_GT(std::abs(later[1] - clamped[1]), 1e-4);
}

}  // namespace
}  // namespace tunica::testing::reference_test
