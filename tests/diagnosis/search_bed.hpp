// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "calibration/fakes.hpp"
#include "diagnosis/hypotheses/candidates.hpp"

namespace tunica::diagnosis {

/// What a mechanism adds to a row at x, by its own parameters, the amplitude first.
using Effect = std::function<double(double x, std::span<const double> own, const Options& options)>;

/// A test with that; on one channel where the options name it. Where the effect is above 1e6 nothing can be evaluated.
class WithEffect : public Test {
 public:
  WithEffect(std::unique_ptr<Test> base, Effect effect, const std::vector<Parameter>& own, Options options)
      : base_(std::move(base)), effect_(std::move(effect)), options_(std::move(options)), own_(own.size()) {
    description_ = base_->describe();
    for (const Parameter& parameter : own) {
      description_.parameters.push_back(parameter);
      description_.nulls.push_back(parameter.initial);
    }
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t first = input.test_parameters.size() - own_;
    TestInput inner = input;
    inner.test_parameters = input.test_parameters.first(first);
    if (Status status = base_->predict(inner, output); !status.ok()) return status;
    const std::span<const double> x = rows().abscissae.front().values;
    const std::size_t count = rows().count, size = count * rows().channels.size();
    const std::string channel = options_.has("channel") ? options_.text("channel") : std::string();
    for (std::size_t i = 0; i < size; ++i) {
      const auto slope = [&](std::size_t k) -> double& {
        return output.jacobian[(input.model_parameters.size() + first + k) * size + i];
      };
      for (std::size_t k = 0; k < own_ && !output.jacobian.empty(); ++k) slope(k) = 0;
      if (!channel.empty() && rows().channels[i / count] != channel) continue;
      std::vector<double> own(input.test_parameters.begin() + static_cast<std::ptrdiff_t>(first),
                              input.test_parameters.end());
      const double now = effect_(x[i % count], own, options_);
      if (now > 1e6) return Status::failed("too much");
      if (!output.values.empty()) output.values[i] += now;
      if (output.jacobian.empty()) continue;
      for (std::size_t k = 0; k < own_; ++k) {
        constexpr double step = 1e-5;
        std::vector<double> up = own, down = own;
        up[k] += step;
        down[k] -= step;
        slope(k) = (effect_(x[i % count], up, options_) - effect_(x[i % count], down, options_)) / (2 * step);
      }
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  Effect effect_;
  Options options_;
  std::size_t own_;
  TestDescription description_;
};

/// A two-sided mechanism of a test, plausible from −1 to 1, with an amplitude "v" from −10 to 10.
inline MechanismFactory acting(const std::string& id, Effect effect) {
  MechanismFactory factory;
  factory.id = id;
  factory.cause = "Something is added.";
  factory.stage = Stage::test;
  factory.side = MechanismFactory::Side::both;
  factory.plausible_min = -1;
  factory.plausible_max = 1;
  factory.parameters = {{"v", "kPa", 0, -10, 10, Scale::linear, "", ""}};
  factory.wrap_test = [effect](std::unique_ptr<Test> base, const Options& options) {
    // The parameters are known when it is called: those of the factory that is on the shelf.
    return std::make_unique<WithEffect>(
        std::move(base), effect, std::vector<Parameter>{{"v", "kPa", 0, -10, 10, Scale::linear, "", ""}}, options);
  };
  return factory;
}

/// The same with one nuisance parameter "w", 1 unless a setting says otherwise.
inline MechanismFactory acting_with_nuisance(const std::string& id, const Effect& effect, const std::string& unit) {
  MechanismFactory factory = acting(id, effect);
  factory.parameters.push_back({"w", unit, 1, 0, 100, Scale::linear, "", ""});
  factory.wrap_test = [effect, parameters = factory.parameters](std::unique_ptr<Test> base, const Options& options) {
    return std::make_unique<WithEffect>(std::move(base), effect, parameters, options);
  };
  return factory;
}

/// σ = 0.5 in every row of y; the base shows 1 + x/10 and has no free parameters, unless a test frees them.
struct SearchBed : fakes::Bench {
  SearchBed() {
    run.objective = experiment::ObjectiveType::least_squares;
    parameter("a").fixed = 1;
    parameter("b").fixed = 0.1;
    parameter("c").fixed = 0;
  }
  experiment::TestEntry& add(const std::string& name, const std::vector<double>& x, bool second = false) {
    auto& entry = add_test(name, x, fakes::map(x, [](double at) { return 1 + 0.1 * at; }), second);
    entry.data.noise = {{"y", {.absolute = 0.5}}};
    if (second) entry.data.noise.push_back({"z", {.absolute = 5}});
    return entry;
  }
  void put(MechanismFactory factory) {
    plugins::Catalogue::Registration stage;
    const std::string id = factory.id;
    stage.add(std::move(factory));
    shelf.commit(std::move(stage), "search bed, " + id);
  }
  /// The evidence at these values of the free parameters.
  void close(const std::vector<double>& free = {}) {
    evidence.experiment = experiment;
    evidence.run = run;
    evidence.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
    evidence.curves = curves_of(*evidence.base, evidence.noise);
    evidence.fit.free = free;
    const auto n = static_cast<Eigen::Index>(evidence.base->layout().residual_count);
    evidence.fit.residuals = Eigen::VectorXd::Zero(n);
  }
  std::vector<Candidate> all(const Projection& projection = {}) const {
    return candidates({experiment, request, shelf, progress}, evidence, projection);
  }
  Candidate find(const std::string& id, const Projection& projection = {}) const {
    for (const Candidate& one : all(projection))
      if (one.id == id) return one;
    throw std::runtime_error("no candidate " + id);
  }

  Evidence evidence;
  Request request;
  Progress progress;
};

}  // namespace tunica::diagnosis
