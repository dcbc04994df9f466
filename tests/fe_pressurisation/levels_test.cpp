// SPDX-License-Identifier: Apache-2.0
#include "levels.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "kernel.hpp"
#include "simulation.hpp"
#include "support/strip.hpp"

namespace tunica::testing::levels_test {
namespace {

std::vector<fe::Sample> curve(const Model& model, const std::vector<double>& parameters, std::size_t order) {
  const fe::Material material(model, parameters);
  fe::Simulation simulation({.order = order,
                             .radial = order == 1 ? 9u : 5u,
                             .axial = order == 1 ? 14u : 7u,
                             .inner = 3.71,
                             .outer = 5.77,
                             .length = 14});
  std::vector<fe::Load> loads;
  for (const double pressure : evenly(0, 18, 5)) loads.push_back({1.2, pressure});
  std::vector<fe::Sample> samples;
  std::size_t failed_at = 0;
  const Status status = simulation.run(material, loads, {true, true, true}, samples, failed_at);
  EXPECT_TRUE(status.ok()) << status.reason();
  return samples;
}

/// An energy that sees no shear and one that does, elements in numbers that no vector divides.
TEST(FiniteElementLevels, ACurveIsTheSameOnEveryVectorLevel) {
  struct Wall {
    const char* model;
    std::vector<double> parameters;
  };
  for (const Wall& wall : {Wall{"gho", set_s}, Wall{"mooney_rivlin", {25, 15}}})
    for (const std::size_t order : {1u, 2u}) {
      const auto model = make_model(wall.model);
      std::vector<fe::Sample> first;
      double values = 0, derivatives = 0;
      for_every_level([&] {
        const std::vector<fe::Sample> found = curve(*model, wall.parameters, order),
                                      again = curve(*model, wall.parameters, order);
        if (first.empty()) first = found;
        for (std::size_t c = 0; c < 3; ++c)
          for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].value[c], again[i].value[c]);
            values = std::max(values, std::abs(found[i].value[c] / first[i].value[c] - 1));
            for (std::size_t j = 0; j < found[i].by.size(); ++j) {
              EXPECT_EQ(found[i].by[j][c], again[i].by[j][c]);
              double scale = 0;
              for (const fe::Sample& sample : first) scale = std::max(scale, std::abs(sample.by[j][c]));
              derivatives = std::max(derivatives, std::abs(found[i].by[j][c] - first[i].by[j][c]) / scale);
            }
          }
      });
      std::printf("  %s, order %zu: levels differ by %.1e, in derivatives by %.1e\n", wall.model, order, values,
                  derivatives);
      EXPECT_LT(values, 1e-12);
      EXPECT_LT(derivatives, 1e-11);
    }
}

}  // namespace
}  // namespace tunica::testing::levels_test
