// SPDX-License-Identifier: Apache-2.0
#include "execution/fake_optimizers.hpp"

#include <algorithm>
#include <memory>
#include <random>
#include <vector>

#include "calibration/fakes.hpp"

namespace tunica::fakes {

namespace {

class Walk final : public Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    std::mt19937_64 generator(problem.seed("walk"));
    constexpr std::size_t batch = 8;
    std::vector<double> xs(batch * problem.dimension()), objectives(batch);
    std::vector<Status> statuses(batch);
    while (!problem.should_stop()) {
      for (double& x : xs) x = static_cast<double>(generator() >> 11) * 0x1p-53;
      problem.evaluate_batch(xs, objectives, statuses);
    }
    return {false, "stopped"};
  }

 private:
  Needs needs_{.batch = true, .random = true};
};

class Compass final : public Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    std::vector<double> x(problem.start().begin(), problem.start().end());
    double best = 0;
    if (problem.evaluate(x, best).kind() == Status::Kind::failed) return {false, "the start failed"};
    for (double step = 0.1; step > 1e-4 && !problem.should_stop(); step /= 2) {
      for (bool moved = true; moved && !problem.should_stop();) {
        moved = false;
        for (std::size_t j = 0; j < x.size(); ++j)
          for (const double sign : {-1.0, 1.0}) {
            auto trial = x;
            trial[j] = std::clamp(trial[j] + sign * step, 0.0, 1.0);
            double objective = 0;
            if (!problem.evaluate(trial, objective).ok() || objective >= best) continue;
            x = trial;
            best = objective;
            moved = true;
          }
      }
    }
    if (problem.should_stop()) return {false, "stopped"};
    return {true, "step below tolerance"};
  }

 private:
  Needs needs_;
};

class Residual : public Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    std::vector<double> residuals(problem.residual_count()), jacobian(residuals.size() * problem.dimension());
    double objective = 0;
    static_cast<void>(problem.linearise(problem.start(), objective, residuals, jacobian));
    return {true, "looked once"};
  }

 protected:
  Needs needs_{.residuals = true, .gradient = true};
};

class Descent final : public Residual {
 public:
  Descent() { needs_.constraints = true; }
};

class Thrower final : public Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    double objective = 0;
    static_cast<void>(problem.evaluate(problem.start(), objective));
    throw std::runtime_error("the population is too small");
  }

 private:
  Needs needs_;
};

class Narrow final : public Residual {
 public:
  Narrow() { needs_.most_parameters = 2; }
};

template <class Made>
OptimizerFactory factory(const std::string& type) {
  return {type, "a fake", "", {}, [](const Options&) { return std::make_unique<Made>(); }};
}

}  // namespace

void register_optimizers(plugins::Catalogue::Registration& stage) {
  stage.add(factory<Walk>("walk"));
  stage.add(factory<Compass>("compass"));
  stage.add(factory<Residual>("residual"));
  stage.add(factory<Descent>("descent"));
  stage.add(factory<Thrower>("thrower"));
  stage.add(factory<Narrow>("narrow"));
}

plugins::Catalogue full_catalogue() {
  plugins::Catalogue catalogue;
  plugins::Catalogue::Registration stage;
  register_all(stage);
  register_optimizers(stage);
  catalogue.commit(std::move(stage), "fakes 1");
  return catalogue;
}

experiment::OptimizerEntry optimizer_entry(const std::string& type) {
  experiment::OptimizerEntry entry;
  entry.name = entry.type = type;
  return entry;
}

}  // namespace tunica::fakes
