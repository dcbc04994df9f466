// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "calibration/identifiability.hpp"
#include "calibration/profile.hpp"
#include "execution/folder.hpp"
#include "experiment/experiment.hpp"
#include "tunica/random.hpp"
#include "uncertainty/local.hpp"

using namespace tunica;

namespace {

constexpr std::uint64_t seed = 20230411;

/// gho on two strips of 40 rows each to stretch 1.6 (Cauchy stress to 90 kPa), with noise as stated; the truth is the
/// paper's set S.
class Strips {
 public:
  explicit Strips(double noise) : noise_(noise) {
    std::string rows = "stretch [1],stress [kPa]\n";
    for (int i = 1; i <= 40; ++i) rows += fmt::format("{},{}\n", 1 + 0.015 * i, i);  // replaced by predictions
    folder_.write("strip.csv", rows);
    const auto strip = [noise](const char* direction) {
      return fmt::format(R"("{0}": {{"type": "uniaxial", "direction": "{0}", "data": {{"file": "strip.csv",
        "columns": {{"stretch": "stretch", "stress": "stress"}}, "noise": {{"absolute": {1}}}}}}})",
                         direction, noise);
    };
    folder_.write("experiment.json", fmt::format(R"({{"format": 1, "models": {{"gho": {{"type": "gho"}}}},
      "tests": {{{}, {}}}, "objective": "least_squares", "optimizers": {{"lm": {{"type": "ceres_lm"}}}},
      "runs": [{{"model": "gho", "optimizer": "lm"}}]}})",
                                                 strip("circumferential"), strip("axial")));
    experiment_ = experiment::read_experiment(folder_.path() / "experiment.json", tunica::testing::catalogue());
    assembly.emplace(experiment_, experiment_.runs.front(), tunica::testing::catalogue());
    for (const auto& parameter : assembly->parameters())
      truth.push_back(parameter.name == "mu"      ? 18.668
                      : parameter.name == "k1"    ? 24.905
                      : parameter.name == "k2"    ? 0.2912
                      : parameter.name == "kappa" ? 0.1367
                                                  : 46.44);
    exact_.resize(assembly->prediction_count());
    const auto workspace = assembly->make_workspace();
    EXPECT_TRUE(assembly->predict(truth, exact_, {}, *workspace).ok());
  }

  /// Data set k.
  [[nodiscard]] std::vector<double> measured(std::size_t k) const {
    std::mt19937_64 generator(derive_seed(seed, fmt::format("data set {}", k)));
    std::normal_distribution<double> normal(0, noise_);
    std::vector<double> values = exact_;
    for (double& value : values) value += normal(generator);
    return values;
  }

  std::optional<calibration::Assembly> assembly;
  std::vector<double> truth;

 private:
  double noise_;
  trial::Folder folder_;
  experiment::Experiment experiment_;
  std::vector<double> exact_;
};

}  // namespace

// 400 data sets, each interval right with probability 0.95: between 368 and 392 with probability 0.995, so that five
// parameters give a false alarm for 2.5 % of the seeds. The seed is fixed.
//
// 0.03 kPa, because linearised intervals are for noise that leaves the parameters within a piece of the valley that is
// straight: at 0.05 kPa they still cover 95 %, at 0.1 kPa 85 %, at 0.3 kPa, where kappa is lost between its bounds, 60
// %.
TEST(Coverage, OfTheLinearisedIntervalsIsWhatTheySayWhereTheValleyIsStraight) {
  const Strips strips(0.03);
  const auto& assembly = *strips.assembly;
  constexpr std::size_t sets = 400;
  const std::size_t n = strips.truth.size();
  std::vector<std::vector<char>> covered(sets, std::vector<char>(n, 0));
  tbb::parallel_for(std::size_t{0}, sets, [&](std::size_t k) {
    const auto data = strips.measured(k);
    const auto found = calibration::likelihood_at(assembly, strips.truth, trial::local(), k, data).centre;
    ASSERT_TRUE(found.status.ok()) << found.status.reason();
    calibration::Identifiability linear;
    ASSERT_TRUE(calibration::identify(assembly, found.free, linear).ok());
    for (std::size_t j = 0; j < n; ++j)
      covered[k][j] = linear.parameters[j].lower <= strips.truth[j] && strips.truth[j] <= linear.parameters[j].upper;
  });
  for (std::size_t j = 0; j < n; ++j) {
    int count = 0;
    for (const auto& set : covered) count += set[j];
    EXPECT_GE(count, 368) << assembly.parameters()[j].name;
    EXPECT_LE(count, 392) << assembly.parameters()[j].name;
    RecordProperty(assembly.parameters()[j].name, count);
  }
}

// At ten times the noise. 60 data sets: 51 or more with probability 0.997 each.
TEST(Coverage, OfTheProfilesIsWhatTheySayWhereTheValleyIsBent) {
  const Strips strips(0.3);
  const auto& assembly = *strips.assembly;
  constexpr std::size_t sets = 60;
  const std::size_t n = strips.truth.size();
  std::vector<std::vector<char>> covered(sets, std::vector<char>(n, 0));
  tbb::parallel_for(std::size_t{0}, sets, [&](std::size_t k) {
    const auto data = strips.measured(k);
    const auto likelihood = calibration::likelihood_at(assembly, strips.truth, trial::local(), k, data);
    ASSERT_TRUE(likelihood.centre.status.ok()) << likelihood.centre.status.reason();
    std::vector<std::size_t> all(n);
    for (std::size_t j = 0; j < n; ++j) all[j] = j;
    for (const auto& profile : calibration::profiles(assembly, likelihood, trial::local(), all, k)) {
      const double truth = strips.truth[profile.parameter];
      const auto open = calibration::Profile::End::Kind::open;
      covered[k][profile.parameter] = (profile.lower.kind == open || profile.lower.value <= truth) &&
                                      (profile.upper.kind == open || truth <= profile.upper.value);
    }
  });
  for (std::size_t j = 0; j < n; ++j) {
    int count = 0;
    for (const auto& set : covered) count += set[j];
    EXPECT_GE(count, 51) << assembly.parameters()[j].name;
    RecordProperty(assembly.parameters()[j].name, count);
  }
}
