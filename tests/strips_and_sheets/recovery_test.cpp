// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "controlled.hpp"
#include "support/strip.hpp"

// The permanent set of strips under a load and under stated loadings: closed forms, the mechanism of the same name, and
// differences.
namespace tunica::testing::recovery_test {
namespace {

/// λ with μ (λ_f² − 1/λ_f)/λ = P and λ = p λ_f, by bisection; p = 1 + s (λ − 1) where λ leads.
double leading_stretch(double mu, double s, double nominal) {
  double low = 1, high = 3;  // where the load still rises
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2, felt = middle / (1 + s * (middle - 1));
    (mu * (felt * felt - 1 / felt) / middle > nominal ? high : low) = middle;
  }
  return low;
}

TEST(Recovery, OfARubberBandLeavesItsPermanentSet) {
  constexpr double mu = 12, s = 0.2;
  const auto test = make_creep({5, 10, 0, 10, 13, 0}, {}, {.measure = "first_piola_kirchhoff", .permanent_set = true});
  const auto values = predicted(*test, *make_model("neo_hooke"), {mu}, false, {s}).values;
  const double first = leading_stretch(mu, s, 10), second = leading_stretch(mu, s, 13);
  EXPECT_NEAR(values[0], leading_stretch(mu, s, 5), 1e-9);
  EXPECT_NEAR(values[1], first, 1e-9);
  EXPECT_NEAR(values[2], 1 + s * (first - 1), 1e-9) << "unloaded, it is longer than it was";
  EXPECT_NEAR(values[3], first, 1e-9) << "and bears the load as before";
  EXPECT_NEAR(values[4], second, 1e-9);
  EXPECT_NEAR(values[5], 1 + s * (second - 1), 1e-9);
}

TEST(Recovery, IsThatOfTheMechanismWhereTheStretchIsPrescribed) {
  const std::vector<double> stretch{1.1, 1.3, 1.2, 1.02, 1.05, 1.4, 1.25, 0.98},
      time{1, 3, 4, 5.8, 6.1, 9.6, 11.1, 13.8};
  std::string json = "[";
  for (std::size_t i = 0; i < stretch.size(); ++i)
    json += (i > 0 ? ", " : "") + std::string("{\"ramp\": {\"stretch\": ") + std::to_string(stretch[i]) +
            "}, \"duration\": " + std::to_string(time[i] - (i > 0 ? time[i - 1] : 0)) + "}";
  const std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44};
  for (const std::string measure : {"cauchy", "first_piola_kirchhoff", "second_piola_kirchhoff"}) {
    const std::vector<std::string> channels{"stress", "transverse_stretch", "normal_stretch"};
    const auto& set = catalogue().mechanisms().at("permanent_set");
    const auto strip = plugins::wrap(set, make_strip(stretch, {.channels = channels, .measure = measure, .time = time}),
                                     defaults(set.factory.options));
    const std::vector<double> own{0, 0.25};
    std::vector<double> expected(3 * stretch.size());
    ASSERT_TRUE(strip->predict({*make_model("gho"), p, own}, {expected, {}, {}, {}}).ok());
    const auto found =
        predicted(*make_segments(json + "]", time, channels, 1, measure, true), *make_model("gho"), p, false, {0.25});
    ASSERT_TRUE(found.status.ok()) << found.status.reason();
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_NEAR(found.values[i], expected[i], 1e-9) << measure << ", row " << i;
      if (i == 3 || i == 4) continue;  // slack: a loose strip has no width to speak of
      for (const std::size_t k : {1u, 2u}) EXPECT_NEAR(found.values[8 * k + i], expected[8 * k + i], 1e-9) << i;
    }
    EXPECT_EQ(found.values[3], 0) << "slack";
  }
}

TEST(Recovery, WithoutASetIsWhatItWas) {
  const std::vector<double> p{12, 0.8, 5}, stress{3, 9, 9, 0, 0}, time{1, 2, 10, 11, 40};
  const auto model = viscous("neo_hooke", 1);
  EXPECT_EQ(predicted(*make_creep(stress, time, {.permanent_set = true}), *model, p, false, {0}).values,
            predicted(*make_creep(stress, time), *model, p).values);
}

TEST(Recovery, CarriesDerivativesByTheSetThroughMemory) {
  const std::vector<double> p{18.668, 0.1367, 24.905, 0.2912, 46.44, 0.8, 5};
  const auto model = viscous("gho", 1);
  const std::string json = R"([{"ramp": {"nominal_stress": 12}, "duration": 1}, {"hold": 10},
      {"ramp": {"nominal_stress": 0}, "duration": 1}, {"hold": 30}, {"ramp": {"stretch": 1.35}, "duration": 2},
      {"ramp": {"stretch": 1.2}, "duration": 1}, {"hold": 5}, {"ramp": {"cauchy_stress": 20}, "duration": 2}])";
  const auto test = make_segments(json, {0.5, 1, 6, 11.5, 12, 20, 42, 43, 44, 44.5, 48, 51, 52},
                                  {"stress", "stretch", "transverse_stretch"}, 5, "first_piola_kirchhoff", true);
  const auto all = [&](std::size_t j, double by) {
    std::vector<double> moved = p;
    std::vector<double> own{0.15};
    (j < p.size() ? moved[j] : own[0]) += by;
    return predicted(*test, *model, moved, false, own).values;
  };
  const auto exact = predicted(*test, *model, p, true, {0.15});
  ASSERT_TRUE(exact.status.ok()) << exact.status.reason();
  const std::size_t size = exact.values.size();
  for (std::size_t j = 0; j <= p.size(); ++j) {
    const double at = j < p.size() ? p[j] : 0.15, h = 1e-4 * at;
    const auto a = all(j, h), b = all(j, -h), c = all(j, 2 * h), d = all(j, -2 * h);
    for (std::size_t i = 0; i < size; ++i) {
      const double difference = (8 * (a[i] - b[i]) - (c[i] - d[i])) / (12 * h);
      EXPECT_NEAR(exact.jacobian[j * size + i], difference, 1e-7 / at + 1e-7 * std::abs(difference))
          << "parameter " << j << ", value " << i;
    }
  }
}

}  // namespace
}  // namespace tunica::testing::recovery_test
