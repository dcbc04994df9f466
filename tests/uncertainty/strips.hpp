// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/assembly.hpp"
#include "execution/folder.hpp"
#include "experiment/experiment.hpp"
#include "support/loaded.hpp"
#include "tunica/random.hpp"

namespace tunica::trial {

/// gho on two strips of 40 rows each to stretch 1.6 (Cauchy stress to 90 kPa), with noise as stated; the truth is the
/// paper's set S.
class Strips {
 public:
  explicit Strips(double noise) : noise_(noise) {
    write(std::vector<double>(80, 0.0));
    read();
    for (const auto& parameter : assembly->layout().parameters)
      truth.push_back(parameter.name == "mu"      ? 18.668
                      : parameter.name == "k1"    ? 24.905
                      : parameter.name == "k2"    ? 0.2912
                      : parameter.name == "kappa" ? 0.1367
                                                  : 46.44);
    exact_.resize(assembly->layout().prediction_count);
    const auto workspace = assembly->evaluator().make_workspace();
    EXPECT_TRUE(assembly->evaluator().predict(truth, exact_, {}, *workspace).ok());
    write(exact_);
    read();
  }

  /// Data set k.
  [[nodiscard]] std::vector<double> measured(std::size_t k) const {
    std::mt19937_64 generator(derive_seed(20230411, fmt::format("data set {}", k)));
    std::normal_distribution<double> normal(0, noise_);
    std::vector<double> values = exact_;
    for (double& value : values) value += normal(generator);
    return values;
  }

  std::optional<assembly::Assembly> assembly;
  std::vector<double> truth;

 private:
  /// The strips' data: circumferential rows, then axial ones.
  void write(const std::vector<double>& stress) const {
    std::string tests;
    for (std::size_t t = 0; t < 2; ++t) {
      const char* const direction = t == 0 ? "circumferential" : "axial";
      std::string rows = "stretch [1],stress [kPa]\n";
      for (std::size_t i = 0; i < 40; ++i)
        rows += fmt::format("{},{}\n", 1 + 0.015 * static_cast<double>(i + 1), stress[40 * t + i]);
      folder_.write(fmt::format("{}.csv", direction), rows);
      tests += fmt::format(R"({2}"{0}": {{"type": "uniaxial", "direction": "{0}", "data": {{"file": "{0}.csv",
        "columns": {{"stretch": "stretch", "stress": "stress"}}, "noise": {{"absolute": {1}}}}}}})",
                           direction, noise_, t == 0 ? "" : ", ");
    }
    folder_.write("experiment.json", fmt::format(R"({{"format": 1, "models": {{"gho": {{"type": "gho"}}}},
      "tests": {{{}}}, "objective": "least_squares", "optimizers": {{"lm": {{"type": "ceres_lm"}}}},
      "runs": [{{"model": "gho", "optimizer": "lm"}}]}})",
                                                 tests));
  }
  void read() {
    experiment_ = experiment::read_experiment(folder_.path() / "experiment.json", testing::catalogue());
    assembly.emplace(experiment_, experiment_.runs.front(), testing::catalogue());
  }

  double noise_;
  trial::Folder folder_;
  experiment::Experiment experiment_;
  std::vector<double> exact_;
};

}  // namespace tunica::trial
