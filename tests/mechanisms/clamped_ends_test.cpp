// SPDX-License-Identifier: Apache-2.0
// A strip whose clamps hold its ends, against the finite elements of plane_specimen on a finer mesh and differences.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelf.hpp"
#include "support/strip.hpp"

namespace tunica::testing::clamped_ends_test {
namespace {

using ::testing::HasSubstr;
using Values = std::vector<double>;

struct Strip {
  double length = 20, width = 10, gauge_length = 0, angle = 0;
  std::string direction = "axial", measure = "first_piola_kirchhoff";
  std::vector<std::string> channels = {"stress", "transverse_stretch"};
};
const Values pulled{1.02, 1.15, 1.3, 1.5, 1.25};
const Values wall{20, 0.1, 30, 1.2, 40};

std::unique_ptr<Test> clamped(const Strip& of, const Values& rows) {
  Options options;
  for (const auto& [name, value] : {std::pair("length", of.length), std::pair("width", of.width),
                                    std::pair("gauge_length", of.gauge_length), std::pair("angle", of.angle)})
    options.set(name, value);
  options.set("direction", of.direction);
  return plugins::wrap(
      catalogue().mechanisms().at("clamped_ends"),
      make_strip(rows, {.direction = of.direction, .channels = of.channels, .measure = of.measure, .angle = of.angle}),
      options);
}

/// Another mesh, twice as fine, with marks on the edges of the strip.
Values by_elements(const Strip& of, const Model& model, const Values& p, const Values& rows) {
  TestSetup setup;
  setup.options = defaults(catalogue().tests().at("plane_specimen").factory.options);
  for (const auto& [name, value] :
       {std::pair("length", of.length), std::pair("width", of.width), std::pair("angle", of.angle),
        std::pair("marks_across", of.width), std::pair("marks_along", of.gauge_length > 0 ? of.gauge_length : 1.0)})
    setup.options.set(name, value);
  setup.options.set("direction", of.direction);
  setup.rows.count = rows.size();
  setup.rows.abscissae = {{of.gauge_length > 0 ? "gauge_stretch" : "stretch", rows}};
  setup.rows.channels = {"stress", "mark_transverse_stretch"};
  setup.stress_measure = "first_piola_kirchhoff";
  const auto test = plugins::create(catalogue().tests().at("plane_specimen"), setup);
  Values values(2 * rows.size());
  const Status status = test->predict({model, p, {}}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}

Values values_of(const Test& test, const Model& model, const Values& p, double share) {
  Values values(test.rows().count * test.rows().channels.size());
  const Values own{0, share};
  const Status status = test.predict({model, p, own}, {values, {}, {}, {}});
  EXPECT_TRUE(status.ok()) << status.reason();
  return values;
}

/// What the clamps change is a few per cent of the force; the small mesh and the polynomial give it to a twentieth.
TEST(ClampedEnds, AreThoseOfAFineMesh) {
  for (const Strip& of : {Strip{}, Strip{.length = 40}, Strip{.gauge_length = 4}, Strip{.angle = 20},
                          Strip{.direction = "circumferential"}})
    for (const auto& [model, p] :
         {std::pair(make_model("neo_hooke"), Values{100}), std::pair(make_model("gho"), wall)}) {
      const auto test = clamped(of, pulled);
      const Values found = values_of(*test, *model, p, 1), free = values_of(*test, *model, p, 0),
                   expected = by_elements(of, *model, p, pulled);
      const std::size_t n = pulled.size();
      for (std::size_t i = 0; i < 2 * n; ++i) {
        const double rounding = i < n ? 2e-3 * expected[i] : 2e-4;
        EXPECT_NEAR(found[i] - free[i], expected[i] - free[i], 0.05 * std::abs(expected[i] - free[i]) + rounding)
            << model->describe().type << " length " << of.length << " angle " << of.angle << " value " << i;
      }
    }
}

TEST(ClampedEnds, KeepTheMeasureOfTheStress) {
  const auto model = make_model("neo_hooke");
  const Values p{100};
  const Values force = values_of(*clamped({}, pulled), *model, p, 0.7);
  for (const auto& [measure, power] : {std::pair("cauchy", 1), std::pair("second_piola_kirchhoff", -1)}) {
    const Values found = values_of(*clamped({.measure = measure}, pulled), *model, p, 0.7);
    for (std::size_t i = 0; i < pulled.size(); ++i)
      EXPECT_NEAR(found[i], force[i] * std::pow(pulled[i], power), 1e-9 * found[i]) << measure;
  }
}

/// By the model's parameters, by the share, and by the stretch.
TEST(ClampedEnds, DerivativesAreThoseOfDifferences) {
  const auto model = testing::model("gho", "none");  // fibres that begin to pull are a kink to differences
  for (const Strip& of : {Strip{.measure = "cauchy"}, Strip{.gauge_length = 4}, Strip{.angle = 20}}) {
    const auto test = clamped(of, pulled);
    const std::size_t n = pulled.size(), size = 2 * n, count = wall.size();
    for (const double share : {0.0, 0.8}) {
      const Values own{0, share};
      Values values(size), jacobian((count + 2) * size), along(size);
      ASSERT_TRUE(test->predict({*model, wall, own}, {values, jacobian, along, {}}).ok());
      for (std::size_t j = 0; j <= count + 1; ++j) {
        const auto at = [&](double step) {
          Values p = wall, rows = pulled;
          double s = share;
          if (j < count) p[j] += step * p[j];
          if (j == count) s += step;
          if (j > count)
            for (double& x : rows) x += step;
          const std::vector<std::span<const double>> x{rows};
          Values found(size);
          const Values moved{0, s};
          EXPECT_TRUE(test->predict({*model, p, moved, x}, {found, {}, {}, {}}).ok());
          return found;
        };
        const double h = 1e-3;
        const Values a = at(-2 * h), b = at(-h), c = at(h), d = at(2 * h);
        const double unit = j < count ? wall[j] : 1;
        const double* const exact = j < count    ? &jacobian[j * size]
                                    : j == count ? &jacobian[(count + 1) * size]
                                                 : along.data();
        for (std::size_t i = 0; i < size; ++i) {
          const double scale = i < n ? 1 : 1e-3;
          EXPECT_NEAR(unit * exact[i], (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h),
                      1e-6 * (scale + std::abs(unit * exact[i])))
              << "column " << j << " value " << i << " share " << share;
        }
      }
    }
  }
}

/// Without the mechanism's share nothing is simulated.
TEST(ClampedEnds, AtTheNullTheBareStripAnswers) {
  const auto model = make_model("gho");
  const auto bare = make_strip(pulled, {"axial", {"stress", "transverse_stretch"}, "first_piola_kirchhoff"});
  EXPECT_EQ(values_of(*clamped({}, pulled), *model, wall, 0), predict(*bare, *model, wall).values);
}

/// A model that remembers is corrected by its elastic part.
TEST(ClampedEnds, GoWithModelsThatRemember) {
  const auto& entry = catalogue().mechanisms().at("viscoelasticity");
  const auto model = plugins::wrap(entry, make_model("neo_hooke"), defaults(entry.factory.options));
  Values p{100};
  for (const Parameter& one : entry.factory.parameters) p.push_back(one.name == "g" ? 0.3 : one.initial);
  const auto elastic = make_model("neo_hooke");
  const auto test = clamped({}, pulled);
  const Values with = values_of(*test, *model, p, 1), without = values_of(*test, *model, p, 0),
               clamps = values_of(*test, *elastic, {100}, 1), free = values_of(*test, *elastic, {100}, 0);
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(with[i] - without[i], clamps[i] - free[i], 1e-9);
}

TEST(ClampedEnds, NeedTheSizesOfAStripInItsPlane) {
  const auto refuses = [](const Strip& of, const char* words) {
    try {
      clamped(of, pulled);
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const InputError& problem) {
      EXPECT_THAT(problem.what(), HasSubstr(words));
    }
  };
  refuses({.length = 0}, "how long and how wide");
  refuses({.width = 0}, "how long and how wide");
  refuses({.gauge_length = 25}, "is above \"length\"");
  refuses({.direction = "radial"}, "through the thickness");
  refuses({.channels = {"stress", "normal_stretch"}}, "take that channel out");
}

}  // namespace
}  // namespace tunica::testing::clamped_ends_test
