// SPDX-License-Identifier: Apache-2.0
// Relative noise as a share of what the base fit says, instead of what was measured.
#include <algorithm>
#include <cmath>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "diagnosis/evidence/base_fit.hpp"
#include "diagnosis/hand_made.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::IsEmpty;

/// y = a with errors of a size that rows near each other share.
struct Settling : HandMade {
  Settling() {
    parameter("b").fixed = 1;
    parameter("c").fixed = 0;
  }
  static std::vector<double> measured(std::size_t count, double seed) {
    std::vector<double> y;
    for (std::size_t i = 0; i < count; ++i) y.push_back(4 + 0.5 * std::sin(seed + 0.7 * static_cast<double>(i * i)));
    return y;
  }
  SettledFit settle() {
    close();
    prepared.experiment = experiment;
    prepared.run = run;
    prepared.noise = evidence.noise;
    prepared.base = evidence.base;
    start = evidence.fit;
    start.free = {3};
    start.chi2 = 77;
    return settle_noise({experiment, request, shelf, progress}, prepared, start);
  }
  /// What a row is said to be: the prediction at a = 3 and the mean of what it is off in the seven rows around.
  [[nodiscard]] std::vector<double> level(const std::string& test, const std::string& channel) const {
    const auto& views = prepared.base->layout().channels;
    const auto view =
        std::ranges::find_if(views, [&](const auto& one) { return one.test == test && one.observable == channel; });
    const auto x = view->abscissa;
    const double factor = channel == "z" ? 10 : 1;
    std::vector<double> found;
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(x.size()); ++i) {
      double sum = 0, count = 0;
      for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(x.size()); ++k) {
        const auto row = static_cast<std::size_t>(k);
        if (std::abs(k - i) > 3 || std::isnan(view->measured[row])) continue;
        sum += view->measured[row] - factor * (3 + x[row]);
        ++count;
      }
      found.push_back(factor * (3 + x[static_cast<std::size_t>(i)]) + (count > 0 ? sum / count : 0));
    }
    return found;
  }
  static const data::Noise& noise_of(const SettledFit& settled, std::size_t test, std::size_t channel) {
    return settled.experiment.tests[test].data.noise[channel].second;
  }

  Request request;
  Progress progress;
  Preparation prepared;
  Fit start;
};

void expect_near(const std::vector<double>& found, const std::vector<double>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-12) << "row " << i;
}

TEST(SettledNoise, IsAShareOfPredictionsAndTheResidualsAround) {
  Settling bed;
  const auto x = fakes::grid(0, 1, 12);
  bed.add("s", x, Settling::measured(12, 1), {0.05, 0.1, 0});
  bed.add("t", fakes::grid(0, 1, 5), Settling::measured(5, 2), {0.2, 0, 0});
  bed.add("u", fakes::grid(0, 1, 9), Settling::measured(9, 3), {0, 0.2, 0});
  const auto settled = bed.settle();
  expect_near(Settling::noise_of(settled, 0, 0).level, bed.level("s", "y"));
  EXPECT_THAT(Settling::noise_of(settled, 1, 0).level, IsEmpty()) << "absolute noise has none";
  expect_near(Settling::noise_of(settled, 2, 0).level, bed.level("u", "y"));
  EXPECT_EQ(bed.prepared.experiment.tests[0].data.noise[0].second.level.size(), 0u) << "what was prepared stays";
}

TEST(SettledNoise, IsThatOfEachChannel) {
  Settling bed;
  auto& entry = bed.add_test("s", fakes::grid(0, 1, 8), Settling::measured(8, 1), true);
  entry.data.noise = {{"y", {.absolute = 0.3}}, {"z", {.absolute = 0.5, .relative = 0.1}}};
  bed.evidence.noise = {{"s", "y", "kPa", NoiseSource::Kind::stated, {.absolute = 0.3}},
                        {"s", "z", "kPa", NoiseSource::Kind::stated, {.absolute = 0.5, .relative = 0.1}}};
  const auto settled = bed.settle();
  EXPECT_THAT(Settling::noise_of(settled, 0, 0).level, IsEmpty());
  expect_near(Settling::noise_of(settled, 0, 1).level, bed.level("s", "z"));
}

TEST(SettledNoise, AsksOnlyRowsThatWereMeasured) {
  Settling bed;
  const auto x = fakes::grid(0, 1, 20), y = Settling::measured(20, 1);
  auto& entry = bed.add_test("s", x, y, true);
  std::ofstream file(entry.data.files.front());
  file << "x [1],y [kPa],z [kPa]\n";
  for (std::size_t i = 0; i < 20; ++i) {
    const bool gap = i == 2 || (i >= 8 && i < 16);
    file << fmt::format("{:.17g},{},{:.17g}\n", x[i], gap ? "" : fmt::format("{:.17g}", y[i]), 10 * y[i]);
  }
  file.close();
  entry.data.noise = {{"y", {.absolute = 0.05, .relative = 0.1}}, {"z", {.absolute = 0.5}}};
  bed.evidence.noise = {{"s", "y", "kPa", NoiseSource::Kind::stated, {.absolute = 0.05, .relative = 0.1}}};
  const auto settled = bed.settle();
  const auto& level = Settling::noise_of(settled, 0, 0).level;
  expect_near(level, bed.level("s", "y"));
  EXPECT_NEAR(level[11], 3 + 11.0 / 19, 1e-12) << "nothing around was measured: as predicted";
}

TEST(SettledNoise, IsWhatTheModelIsFittedAgainUnder) {
  Settling bed;
  const auto x = fakes::grid(0, 1, 12), y = Settling::measured(12, 1);
  bed.add("s", x, y, {0.05, 0.1, 0});
  const auto settled = bed.settle();
  const auto level = bed.level("s", "y");
  // y − x = a, a mean by weights 1/σ².
  double sum = 0, weights = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    const double weight = 1 / (0.05 * 0.05 + std::pow(0.1 * level[i], 2));
    sum += weight * (y[i] - x[i]);
    weights += weight;
  }
  ASSERT_EQ(settled.fit.free.size(), 1u);
  EXPECT_NEAR(settled.fit.free[0], sum / weights, 1e-3);
  EXPECT_NE(settled.base, bed.prepared.base);
  std::vector<double> sd;
  for (std::size_t i = 0; i < 12; ++i) sd.push_back(std::hypot(0.05, 0.1 * level[i]));
  expect_near(settled.base->layout().channels[0].sigma.rows.sd, sd);
}

TEST(SettledNoise, ChangesNothingWhereNoneIsRelative) {
  Settling bed;
  bed.add("s", fakes::grid(0, 1, 12), Settling::measured(12, 1), {0.5, 0, 0});
  const auto settled = bed.settle();
  EXPECT_EQ(settled.base, bed.prepared.base);
  EXPECT_EQ(settled.fit.free, bed.start.free);
  EXPECT_EQ(settled.fit.chi2, 77);
  EXPECT_THAT(Settling::noise_of(settled, 0, 0).level, IsEmpty());
}

TEST(SettledNoise, KeepsTheFitWhereNothingCanBePredictedAnyMore) {
  Settling bed;
  bed.add("s", fakes::grid(0, 1, 12), Settling::measured(12, 1), {0.05, 0.1, 0});
  int calls = 0;
  fakes::set_behaviour([&](double, std::span<double>, Status& status) {
    ++calls;
    status = Status::failed("not today");
  });
  EXPECT_EQ(bed.settle().base, bed.prepared.base);
  EXPECT_EQ(calls, 1);
  fakes::set_behaviour([&](double, std::span<double>, Status& status) {
    if (++calls > 2) status = Status::failed("only once");
  });
  const auto settled = bed.settle();
  EXPECT_NE(settled.base, bed.prepared.base) << "the noise is settled";
  EXPECT_EQ(settled.fit.free, bed.start.free) << "and the fit as it was";
  EXPECT_EQ(settled.fit.chi2, 77);
}

}  // namespace
}  // namespace tunica::diagnosis
