// SPDX-License-Identifier: Apache-2.0
// A specimen between grips by finite elements in plane stress, against closed forms, finer meshes and differences.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugins/guarded.hpp"
#include "support/loaded.hpp"
#include "support/strip.hpp"

namespace tunica::testing::plane_test {
namespace {

using ::testing::HasSubstr;

struct Specimen {
  std::string shape = "strip";
  double length = 20, width = 10;
  std::string ends = "clamped", elements = "null", abscissa = "stretch";
  double angle = 0, marks_along = 5, marks_across = 4;
  double gauge_section = 0, gauge_width = 0, fillet = 0, hole_radius = 0;
  std::string direction = "axial", measure = "first_piola_kirchhoff";
  std::vector<std::string> channels = {"stress", "mark_stretch", "mark_transverse_stretch"};
};
const Specimen bone{.shape = "dog_bone",
                    .length = 40,
                    .width = 12,
                    .marks_across = 3,
                    .gauge_section = 16,
                    .gauge_width = 4,
                    .fillet = 8};
const Specimen plate{.shape = "plate_with_hole", .marks_along = 8, .marks_across = 6, .hole_radius = 2};

std::unique_ptr<Test> make(const Specimen& of, const std::vector<double>& rows) {
  TestSetup setup;
  for (const auto& [name, value] : {std::pair("shape", of.shape), std::pair("ends", of.ends),
                                    std::pair("elements", of.elements), std::pair("direction", of.direction)})
    setup.options.set(name, value);
  for (const auto& [name, value] :
       {std::pair("length", of.length), std::pair("width", of.width), std::pair("angle", of.angle),
        std::pair("marks_along", of.marks_along), std::pair("marks_across", of.marks_across),
        std::pair("gauge_section", of.gauge_section), std::pair("gauge_width", of.gauge_width),
        std::pair("fillet", of.fillet), std::pair("hole_radius", of.hole_radius)})
    setup.options.set(name, value);
  setup.rows.count = rows.size();
  setup.rows.abscissae = {{of.abscissa, rows}};
  setup.rows.channels = of.channels;
  setup.stress_measure = of.measure;
  return plugins::create(catalogue().tests().at("plane_specimen"), setup);
}

std::vector<double> values_of(const Test& test, const Model& model, const std::vector<double>& p) {
  std::vector<double> values(test.rows().count * test.rows().channels.size());
  const Status status = test.predict({model, p, {}}, {values, {}, {}, {}});
  if (!status.ok()) throw std::runtime_error(status.reason());
  return values;
}

std::unique_ptr<Model> hyperfoam() {
  Options options;
  options.set("terms", std::int64_t{1});
  options.set("poisson", std::string("shared"));
  return make_model("hyperfoam", options);
}

const std::vector<double> wall{20, 0.1, 30, 1.2, 40}, foam{25, 6, 0.18}, pulled{1.1, 1.3, 1.5};

/// All shapes of the patch test: where the ends slide, the state is homogeneous whatever the mesh.
TEST(PlaneSpecimen, SlidingEndsGiveTheHomogeneousStrip) {
  for (const double angle : {0.0, 90.0}) {
    const auto strip = make_strip(
        pulled, {angle == 0 ? "axial" : "circumferential", {"stress", "transverse_stretch"}, "first_piola_kirchhoff"});
    Options terms;
    terms.set("terms", std::string(R"([{"name": "m", "invariant": "I1bar", "law": "linear"},
                                       {"name": "n", "invariant": "I2", "law": "linear"},
                                       {"name": "v", "invariant": "J", "law": "quadratic"}])"));
    for (const auto& [model, p] : {std::pair(make_model("gho"), wall), std::pair(hyperfoam(), foam),
                                   std::pair(make_model("composed", terms), std::vector{20., 5., 60.})}) {
      const auto found = values_of(*make({.ends = "sliding", .elements = "[3, 5]", .angle = angle}, pulled), *model, p);
      const Prediction expected = predict(*strip, *model, p);
      ASSERT_TRUE(expected.status.ok());
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found[i], expected.values[i], 1e-8 * (1 + std::abs(expected.values[i])));
        EXPECT_NEAR(found[3 + i], pulled[i], 1e-9);
        EXPECT_NEAR(found[6 + i], expected.values[3 + i], 1e-8);
      }
    }
  }
}

// Smooth but for the corners of clamped ends: the error of the force falls at least as h^1.2, and sixteen times as many
// elements change it by less than a thousandth.
TEST(PlaneSpecimen, ConvergesWithTheMesh) {
  const auto model = make_model("neo_hooke");
  for (Specimen of : {Specimen{}, bone, plate}) {
    std::vector<double> force;
    const bool hole = of.shape == "plate_with_hole";
    for (const char* elements : {"[8, 4]", "[16, 8]", "[32, 16]", "[64, 32]"}) {
      of.elements = hole && std::string(elements) == "[64, 32]" ? "[48, 32]" : elements;
      force.push_back(values_of(*make(of, {1.3}), *model, {100})[0]);
    }
    const double coarse = std::abs(force[0] - force[2]), fine = std::abs(force[1] - force[2]);
    EXPECT_GT(coarse / fine, 2.2) << of.shape;
    EXPECT_NEAR(force[1] / force[3], 1, 1e-3) << of.shape;
  }
}

/// A material without symmetry about the axes goes over the whole mesh, and agrees with its mirror image.
TEST(PlaneSpecimen, TheWholeIsWhatAQuarterIs) {
  const auto model = make_model("gho");
  for (const Specimen& of : {Specimen{}, plate}) {
    Specimen turned = of;
    turned.angle = 1e-7;  // not along an axis, so that the whole is simulated; the effect is below 1e-6
    const auto quarter = values_of(*make(of, pulled), *model, wall),
               whole = values_of(*make(turned, pulled), *model, wall);
    for (std::size_t i = 0; i < quarter.size(); ++i)
      EXPECT_NEAR(whole[i], quarter[i], 2e-6 * (1 + std::abs(quarter[i]))) << of.shape << i;
    Specimen left = of, right = of;
    left.angle = 25;
    right.angle = -25;
    const auto one = values_of(*make(left, pulled), *model, wall),
               other = values_of(*make(right, pulled), *model, wall);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_NEAR(one[i], other[i], 1e-7 * (1 + std::abs(one[i])));
  }
}

TEST(PlaneSpecimen, DerivativesAreThoseOfDifferences) {
  struct Case {
    Specimen specimen;
    std::unique_ptr<Model> model;
    std::vector<double> p;
  };
  std::vector<Case> cases;
  cases.push_back({{.elements = "[6, 4]"}, make_model("gho"), wall});
  cases.push_back({{.elements = "[6, 4]", .angle = 20}, make_model("gho"), wall});
  cases.push_back({{.elements = "[6, 4]", .abscissa = "gauge_stretch"}, make_model("gho"), wall});
  cases.push_back({{.elements = "[6, 4]", .abscissa = "gauge_stretch"}, hyperfoam(), foam});
  cases.push_back({plate, make_model("neo_hooke"), {100}});
  for (const Case& one : cases) {
    const std::vector<double> rows{1.08, 1.22};
    const auto test = make(one.specimen, rows);
    const std::size_t size = 6, count = one.p.size();
    std::vector<double> values(size), jacobian(count * size), along(size);
    const Status status = test->predict({*one.model, one.p, {}}, {values, jacobian, along, {}});
    ASSERT_TRUE(status.ok()) << status.reason();
    for (std::size_t j = 0; j <= count; ++j) {
      const double h = j < count ? 1e-4 * one.p[j] : 1e-4;
      const auto at = [&](double steps) {
        if (j == count) {
          std::vector<double> moved = rows;
          for (double& x : moved) x += steps * h;
          return values_of(*make(one.specimen, moved), *one.model, one.p);
        }
        std::vector<double> q = one.p;
        q[j] += steps * h;
        return values_of(*test, *one.model, q);
      };
      const auto a = at(-2), b = at(-1), c = at(1), d = at(2);
      const double* const exact = j < count ? &jacobian[j * size] : along.data();
      for (std::size_t k = 0; k < 3; ++k) {
        const double scale = std::max({1e-3, std::abs(exact[2 * k]), std::abs(exact[2 * k + 1])});
        for (std::size_t i = 2 * k; i < 2 * k + 2; ++i)
          EXPECT_NEAR(exact[i], (a[i] - 8 * b[i] + 8 * c[i] - d[i]) / (12 * h), 1e-7 * scale)
              << one.specimen.shape << ", column " << j << ", value " << i;
      }
    }
  }
}

/// Whether derivatives are wanted changes no bit of the values.
TEST(PlaneSpecimen, ValuesDoNotDependOnWhatElseIsWanted) {
  for (const auto& [model, p] : {std::pair(make_model("gho"), wall), std::pair(hyperfoam(), foam)})
    for (const char* abscissa : {"stretch", "gauge_stretch"}) {
      const auto test = make({.elements = "[8, 4]", .abscissa = abscissa}, pulled);
      std::vector<double> values(9), jacobian(9 * p.size()), along(9);
      ASSERT_TRUE(test->predict({*model, p, {}}, {values, jacobian, along, {}}).ok());
      EXPECT_EQ(values, values_of(*test, *model, p)) << abscissa;
    }
}

/// With sliding ends the derivative by a compressibility of 0 is that of the strip.
TEST(PlaneSpecimen, DerivativesWhereACompressibilityVanishesAreThoseOfTheStrip) {
  Options options;
  options.set("invariants", std::string("full"));
  options.set("law", std::string("logarithmic"));
  const auto model = plugins::wrap(catalogue().mechanisms().at("compressibility"), make_model("neo_hooke"), options);
  const auto test = make({.ends = "sliding", .elements = "[4, 4]", .channels = {"stress"}}, pulled);
  const std::vector<double> p{30, 0};
  std::vector<double> values(3), jacobian(6);
  ASSERT_TRUE(test->predict({*model, p, {}}, {values, jacobian, {}, {}}).ok());
  const Prediction strip =
      predict(*make_strip(pulled, {"axial", {"stress"}, "first_piola_kirchhoff"}), *model, p, 0, true);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(jacobian[i], strip.jacobian[i], 1e-5 * std::abs(strip.jacobian[i]));
  EXPECT_LT(jacobian[5], -100);
  EXPECT_EQ(values, values_of(*test, *make_model("neo_hooke"), {30}));
}

/// What a gauge is driven to is what its marks show, and the same state as with the grips there.
TEST(PlaneSpecimen, AGaugeMayBeDriven) {
  const auto model = make_model("neo_hooke");
  const auto by_grips = values_of(*make({}, {1.3}), *model, {100});
  const auto by_gauge = values_of(*make({.abscissa = "gauge_stretch"}, {by_grips[1]}), *model, {100});
  EXPECT_NEAR(by_gauge[1], by_grips[1], 1e-10);
  EXPECT_NEAR(by_gauge[0] / by_grips[0], 1, 1e-8);
}

TEST(PlaneSpecimen, RefusesWhatIsNoSpecimen) {
  const auto refuses = [](const Specimen& of, const char* words) {
    try {
      make(of, pulled);
      ADD_FAILURE() << "accepted, expected: " << words;
    } catch (const InputError& problem) {
      EXPECT_THAT(problem.what(), HasSubstr(words));
    }
  };
  refuses({.width = 0}, "give a length above 0");
  refuses({.hole_radius = 2}, "has none; leave it out");
  refuses({.shape = "plate_with_hole", .hole_radius = 6}, "does not fit into");
  refuses({.shape = "dog_bone", .gauge_section = 5, .gauge_width = 4, .fillet = 1}, "do not rise");
  refuses({.shape = "dog_bone", .gauge_section = 18, .gauge_width = 4, .fillet = 5}, "a shorter gauge section");
  refuses({.shape = "dog_bone", .gauge_section = 5, .gauge_width = 12, .fillet = 5}, "give a gauge width below it");
  refuses({.elements = "[8589934592, 8589934592]"}, "at most");
  refuses({.elements = "[0, 4]"}, "two numbers from 2 on");
  refuses({.elements = "[4000, 4000]"}, "at most");
  refuses({.marks_along = 0}, "distance of the marks");
  refuses({.marks_along = 30}, "not on the specimen");
  refuses({.measure = "cauchy"}, "first_piola_kirchhoff");
  Specimen inside = plate;
  inside.marks_along = 3;
  refuses(inside, "not on the specimen");
}

}  // namespace
}  // namespace tunica::testing::plane_test
