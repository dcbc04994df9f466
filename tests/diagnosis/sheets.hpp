// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "calibration/fakes.hpp"
#include "diagnosis/detection/analysis.hpp"

namespace tunica::diagnosis {

/// W = mu/2 (I1 − 3) + kt/2 Σ (I − 1)² + kz/2 Σ (I − 1)² + e/2 (I2 − 3), with two families 30° beside the axis t (kt)
/// or z (kz): a strip along the axis that they follow narrows so much that it grows thicker. With e < 0 ellipticity is
/// lost at λ² = mu/|e|. Nothing is known at an I1 of 8.
class Sheet : public Model {
 public:
  Sheet() {
    description_ = {"sheet", {}, 0, false, true, {}};
    for (const char* const name : {"mu", "kt", "kz", "e"})
      description_.parameters.push_back({name, "kPa", 0, -1000, 1000, Scale::linear, "a modulus", ""});
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    const std::span<const double> p = points.parameters;
    constexpr std::array<double, 6> unit{1, 1, 1, 0, 0, 0};
    for (std::size_t i = 0; i < n; ++i) {
      const auto C = [&](std::size_t a) { return points.C[a * n + i]; };
      const double trace = C(0) + C(1) + C(2);
      std::array<double, 6> S{};
      std::array<std::array<double, 6>, 6> tangent{};
      for (std::size_t a = 0; a < 6; ++a) {
        S[a] = p[0] * unit[a] + p[3] * (trace * unit[a] - C(a));
        for (std::size_t b = 0; b < 6; ++b)
          tangent[a][b] = 2 * p[3] * (unit[a] * unit[b] - (a == b ? (a < 3 ? 1 : 0.5) : 0));
      }
      for (const double angle : {30.0, -30.0, 60.0, -60.0}) {
        const double k = std::abs(angle) < 45 ? p[1] : p[2], t = std::cos(angle * std::numbers::pi / 180),
                     z = std::sin(angle * std::numbers::pi / 180);
        const std::array<double, 6> A{t * t, z * z, 0, t * z, 0, 0};
        const double stretch = A[0] * C(0) + A[1] * C(1) + 2 * A[3] * C(3);
        for (std::size_t a = 0; a < 6; ++a) {
          S[a] += 2 * k * (stretch - 1) * A[a];
          for (std::size_t b = 0; b < 6; ++b) tangent[a][b] += 4 * k * A[a] * A[b];
        }
      }
      for (std::size_t a = 0; a < 6; ++a) {
        if (!out.stress.empty()) out.stress[a * n + i] = trace < 8 ? S[a] : NAN;
        for (std::size_t b = 0; b < 6 && !out.tangent.empty(); ++b)
          out.tangent[(6 * a + b) * n + i] = trace < 8 ? tangent[a][b] : NAN;
      }
    }
    std::fill(out.energy.begin(), out.energy.end(), 0);  // nobody asks for it
    std::fill(out.stress_dp.begin(), out.stress_dp.end(), 0);
    return {};
  }

 private:
  ModelDescription description_;
};

/// A mechanism of the sheet. Its amplitude adds shape · by(amplitude − null) to the readings, and makes the fibres
/// vanish where it mends the sheet.
struct Mending {
  std::string id;
  Eigen::VectorXd shape;
  std::function<bool(double distance)> mends = [](double distance) { return std::abs(distance) > 1e-3; };
  std::function<double(double distance)> by = [](double distance) { return distance; };  ///< not a number: no answer
  std::function<void(MechanismFactory&)> declare = {};
  std::size_t hypotheses = 1;  ///< how many directions there are of it, all alike
};

/// Strips of sheets, with noise of 1 in every row; readings say nothing of the sheet but what mechanisms add.
class Sheets : public fakes::Bench {
 public:
  Sheets() : Bench("sheet") {
    run.objective = experiment::ObjectiveType::least_squares;
    plugins::Catalogue::Registration stage;
    stage.add(ModelFactory{"sheet", "", "", {}, [](const Options&) { return std::make_unique<Sheet>(); }});
    const std::vector<Observable> observables = {
        {"stretch", "1", Observable::Role::abscissa, true, "", Observable::Kind::stretch},
        {"y", "kPa", Observable::Role::channel, true, ""}};
    for (const auto& [type, axis] :
         std::map<std::string, std::optional<std::size_t>>{{"along_t", 0}, {"along_z", 1}, {"held", std::nullopt}})
      stage.add(TestFactory{
          type,
          "",
          "",
          {},
          observables,
          [this, axis = axis](const TestSetup& setup) { return std::make_unique<Readings>(*this, setup, axis); },
          {},
          true});
    shelf.commit(std::move(stage), "sheets 1");
    set("m", 10, 0, 0, 0);
  }

  /// What a model is made of.
  void set(const std::string& name, double mu, double kt, double kz, double e) {
    for (auto& entry : experiment.models)
      if (entry.name == name) {
        const std::map<std::string, double> values{{"mu", mu}, {"kt", kt}, {"kz", kz}, {"e", e}};
        for (const auto& [parameter, value] : values) entry.parameters[parameter].fixed = value;
      }
  }
  void add_model(const std::string& name) { experiment.models.push_back({name, "sheet", {}, {}, {}}); }
  /// Readings y at stretches from 1.01 up to `last`.
  experiment::TestEntry& add(const std::string& name, const std::string& type, double last,
                             const std::vector<double>& y = {0, 0, 0}) {
    auto& entry = add_test(name, fakes::grid(1.01, last, y.size()), y);
    entry.type = type;
    entry.data.columns = {{"stretch", "x"}, {"y", "y"}};
    entry.data.noise = {{"y", {.absolute = 1}}};
    entry.parameters.clear();
    return entry;
  }
  void add(Mending mechanism) { mechanisms_.push_back(std::move(mechanism)); }

  /// After all of these: the evidence and the hypotheses.
  void close() {
    plugins::Catalogue::Registration stage;
    for (const Mending& one : mechanisms_) stage.add(factory_of(one));
    shelf.commit(std::move(stage), "mending 1");
    Evidence& evidence = analysis.evidence;
    evidence.experiment = experiment;
    evidence.run = run;
    evidence.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
    evidence.fit = least_squares(*evidence.base, {}, {}, *evidence.base->evaluator().make_workspace());
    for (const Mending& one : mechanisms_) {
      Candidate candidate{one.id, &shelf.mechanisms().at(one.id).factory, {}, {}};
      for (std::size_t k = 0; k < one.hypotheses; ++k)
        candidate.hypotheses.push_back(
            {candidate.mechanism, {one.id, {}, {}}, one.shape, candidate.mechanism->side, 1.0});
      analysis.hypotheses.candidates.push_back(std::move(candidate));
      analysis.alarm.detection.by_candidate.push_back(0.01 *
                                                      static_cast<double>(analysis.hypotheses.candidates.size()));
    }
    analysis.hypotheses.directions = directions(analysis.hypotheses.candidates, analysis.hypotheses.projection);
  }
  [[nodiscard]] Inquiry inquiry() const { return {experiment, request, shelf, progress}; }

  Request request;
  Progress progress;
  Analysis analysis;
  std::map<std::string, std::vector<double>> asked;  ///< the amplitudes of predictions, in no order

 private:
  /// The sheet with a mechanism.
  class Mended : public Model {
   public:
    Mended(std::unique_ptr<Model> base, const Mending& how, const std::vector<Parameter>& own, double null)
        : base_(std::move(base)), how_(how), description_(base_->describe()), null_(null) {
      description_.parameters.insert(description_.parameters.end(), own.begin(), own.end());
    }
    [[nodiscard]] const ModelDescription& describe() const override { return description_; }
    Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
      std::vector<double> p(points.parameters.begin(), points.parameters.begin() + 4);
      if (how_.mends(points.parameters[4] - null_)) p[1] = p[2] = p[3] = 0;
      MaterialPoints inner = points;
      inner.parameters = p;
      return base_->evaluate(inner, out);
    }

   private:
    std::unique_ptr<Model> base_;
    const Mending& how_;
    ModelDescription description_;
    double null_;
  };

  /// What the mechanism of the model adds.
  class Readings : public Test {
   public:
    Readings(Sheets& bed, const TestSetup& setup, std::optional<std::size_t> axis) : bed_(bed) {
      x_.assign(setup.rows.abscissae.front().values.begin(), setup.rows.abscissae.front().values.end());
      rows_ = {setup.rows.count, {{"stretch", x_}}, setup.rows.channels, {}};
      description_.free_strip_axis = axis;
    }
    [[nodiscard]] const TestDescription& describe() const override { return description_; }
    [[nodiscard]] const TestRows& rows() const override { return rows_; }
    Status predict(const TestInput& input, const TestOutput& output) const override {
      std::fill(output.values.begin(), output.values.end(), 0);
      std::fill(output.jacobian.begin(), output.jacobian.end(), 0);
      const std::size_t n = rows_.count;
      for (const Mending& one : bed_.mechanisms_) {
        if (input.model_parameters.size() < 5 || input.model.describe().parameters[4].name != one.id) continue;
        const double null = bed_.shelf.mechanisms().at(one.id).factory.null, d = input.model_parameters[4] - null;
        {
          const std::scoped_lock lock(bed_.mutex_);
          bed_.asked[one.id].push_back(input.model_parameters[4]);
        }
        const double now = one.by(d), slope = (one.by(d + 1e-4) - one.by(d - 1e-4)) / 2e-4;
        if (std::isnan(now)) return Status::failed("no answer");
        for (std::size_t i = 0; i < n; ++i) {
          const double shape = one.shape[static_cast<Eigen::Index>(i)];
          if (!output.values.empty()) output.values[i] = shape * now;
          if (!output.jacobian.empty()) output.jacobian[4 * n + i] = shape * slope;
        }
      }
      return {};
    }

   private:
    Sheets& bed_;
    std::vector<double> x_;
    TestRows rows_;
    TestDescription description_;
  };

  MechanismFactory factory_of(const Mending& one) const {
    MechanismFactory factory;
    factory.id = one.id;
    factory.cause = "Something is mended.";
    factory.stage = Stage::energy;
    factory.side = MechanismFactory::Side::both;
    factory.plausible_min = -500;
    factory.plausible_max = 500;
    factory.parameters = {{one.id, "kPa", 0, -1000, 1000, Scale::linear, "", ""}};
    if (one.declare) one.declare(factory);
    factory.wrap_model = [&one, own = factory.parameters, null = factory.null](std::unique_ptr<Model> base,
                                                                               const Options&) {
      return std::make_unique<Mended>(std::move(base), one, own, null);
    };
    return factory;
  }

  std::vector<Mending> mechanisms_;
  std::mutex mutex_;
};

}  // namespace tunica::diagnosis
