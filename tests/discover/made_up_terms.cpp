// SPDX-License-Identifier: Apache-2.0
#include "discover/made_up_terms.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

namespace tunica::trial {
namespace {

using nlohmann::json;

constexpr std::size_t rows_of_block = 10;

/// A term of the energy, and where its parameters begin among all.
struct Placed {
  const MadeUpLaw* law;
  std::size_t first;
};

/// dψ/dx of a term alone: its amplitude, whatever the law.
class Alone : public EnergyPart {
 public:
  [[nodiscard]] const Description& describe() const override { return description_; }
  void invariant(std::span<const double> /*parameters*/, Invariant& /*value*/,
                 std::span<Invariant> /*derivatives*/) const override {}
  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    std::fill(batch.first.begin(), batch.first.end(), parameters.front());
  }

 private:
  Description description_ = {};
};

/// The sum of terms: what a test at "strain" x measures in row x.
class Sum : public Model {
 public:
  Sum(ModelDescription description, std::vector<Placed> terms)
      : description_(std::move(description)), terms_(std::move(terms)) {
    parts_.push_back(std::make_unique<Alone>());
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return parts_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    std::fill(response.stress.begin(), response.stress.end(), 0);
    std::fill(response.stress_dp.begin(), response.stress_dp.end(), 0);
    for (std::size_t i = 0; i < n; ++i)
      for (const Placed& term : terms_) {
        const auto block = static_cast<std::size_t>(std::lround(points.C[i])) / rows_of_block;
        const auto add = [&](std::size_t j, double value, double slope) {
          response.stress[i] += value;
          if (!response.stress_dp.empty()) response.stress_dp[6 * (term.first + j) * n + i] = slope;
        };
        const std::span<const double> own = points.parameters.subspan(term.first);
        const std::size_t heights = term.law->heights.size();
        const double shape = term.law->shape.empty() ? 0 : own[1 + heights];
        const double effect = term.law->effect(block, shape);
        add(0, own[0] * effect, effect);
        for (std::size_t h = 0; h < heights; ++h)
          add(1 + h, own[1 + h] * term.law->heights[h](block), term.law->heights[h](block));
        constexpr double step = 1e-5;
        if (!term.law->shape.empty())
          add(1 + heights, 0,
              own[0] * (term.law->effect(block, shape + step) - term.law->effect(block, shape - step)) / (2 * step));
      }
    return {};
  }

 private:
  ModelDescription description_;
  std::vector<Placed> terms_;
  std::vector<std::unique_ptr<EnergyPart>> parts_;
};

}  // namespace

MadeUpTerms::MadeUpTerms(const std::vector<double>& levels, std::map<std::string, MadeUpLaw> laws,
                         const std::vector<double>& back)
    : Bench("composed"), laws_(std::move(laws)) {
  laws_["linear"].effect = [](std::size_t, double) { return 1; };
  plugins::Catalogue::Registration stage;
  stage.add(ModelFactory{
      "composed", "", "", {Option::json("terms", "[]", "What it is made of.")}, [this](const Options& options) {
        return make(options);
      }});
  shelf.commit(std::move(stage), "made_up 1");
  std::vector<double> x, y;
  for (std::size_t i = 0; i < levels.size() * rows_of_block; ++i) {
    x.push_back(static_cast<double>(i));
    y.push_back(levels[i / rows_of_block]);
  }
  for (std::size_t i = back.size() * rows_of_block; i-- > 0;) {
    x.push_back(static_cast<double>(i));
    y.push_back(back[i / rows_of_block]);
  }
  add_test("a", x, y).data.noise = {{"y", {.absolute = 1}}};
  run.objective = experiment::ObjectiveType::least_squares;
  experiment = discovery::with_first_term(std::move(experiment), "m");
  evidence.experiment = experiment;
  evidence.run = run;
  evidence.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
  evidence.noise = {{"a", "y", "kPa", diagnosis::NoiseSource::Kind::stated, {.absolute = 1}}};
  evidence.curves = diagnosis::curves_of(*evidence.base, evidence.noise);
  evidence.fit.free = {1};
  evidence.fit.at_bound = {false};
  (void)diagnosis::whitened(*evidence.base, evidence.fit.free, *evidence.base->evaluator().make_workspace(),
                            evidence.fit.residuals, &evidence.fit.jacobian);
  evidence.fit.chi2 = evidence.fit.residuals.squaredNorm();
  subject = std::make_shared<const discovery::Subject>(discovery::Subject{experiment, run, "m", true, shelf});
  fitter = std::make_unique<const discovery::Fitter>(*subject, evidence);
  forget();
}

std::unique_ptr<Model> MadeUpTerms::make(const Options& options) const {
  ModelDescription description{"composed", {}, 0, false, true, {}};
  std::vector<Placed> terms;
  std::vector<std::string> names;
  for (const json& term : json::parse(options.text("terms"))) {
    const bool power = term["invariant"] == "stretches";
    const MadeUpLaw& law = laws_.at(power ? "alpha" : term["law"].get<std::string>());
    terms.push_back({&law, description.parameters.size()});
    const std::string name = names.emplace_back(term["name"]);
    const auto declare = [&](const std::string& own, double initial, double min, double max) {
      description.parameters.push_back({name + "_" + own, "kPa", initial, min, max, Scale::linear, "", ""});
    };
    declare("mu", 1, power ? -1e4 : 0, 1e4);
    for (std::size_t h = 0; h < law.heights.size(); ++h) declare("c_" + std::to_string(h + 2), 1, 0, 1e4);
    if (!law.shape.empty()) declare(law.shape, 1, -30, 30);
  }
  {
    const std::scoped_lock lock(mutex_);
    ++made_[names];
  }
  return std::make_unique<Sum>(std::move(description), std::move(terms));
}

discovery::KindPointer MadeUpTerms::kind(const std::string& name, const std::string& law, double log_prior,
                                         const std::string& invariant, const std::string& family) const {
  discovery::Kind one{invariant, family.empty() && invariant != "I2" ? name : family, law, name};
  one.largest = 1000;
  one.log_prior = log_prior;
  one.reach = {0, 1};
  const MadeUpLaw& own = laws_.at(law);
  for (std::size_t h = 0; h < own.heights.size(); ++h) one.heights.push_back("c_" + std::to_string(h + 2));
  if (!own.shape.empty()) one.shapes = {{own.shape, -3, 3, Scale::linear, {0}}};
  return std::make_shared<const discovery::Kind>(std::move(one));
}

discovery::KindPointer MadeUpTerms::power(const std::string& name, bool negative, double log_prior) const {
  discovery::Kind one{"stretches", {}, "power", name};
  one.negative = negative;
  one.largest = negative ? -1000 : 1000;
  one.log_prior = log_prior;
  one.shapes = {negative ? discovery::Shape{"alpha", -10, -0.2, Scale::linear, {-3}}
                         : discovery::Shape{"alpha", 0.2, 10, Scale::linear, {3}}};
  return std::make_shared<const discovery::Kind>(std::move(one));
}

discovery::SetFit MadeUpTerms::at(const std::vector<discovery::KindPointer>& kinds,
                                  const std::vector<double>& free) const {
  discovery::SetFit one{kinds, std::make_shared<const discovery::BoundSet>(*subject, kinds), {}, 0};
  const assembly::Assembly& assembly = one.set->assembly();
  one.fit.status =
      diagnosis::whitened(assembly, free, *assembly.evaluator().make_workspace(), one.fit.residuals, &one.fit.jacobian);
  one.fit.free = free;
  one.fit.chi2 = one.fit.residuals.squaredNorm();
  one.fit.at_bound.assign(free.size(), false);
  one.log_evidence = fitter->log_evidence(one);
  return one;
}

std::map<std::vector<std::string>, int> MadeUpTerms::made() const {
  const std::scoped_lock lock(mutex_);
  return made_;
}

void MadeUpTerms::forget() const {
  const std::scoped_lock lock(mutex_);
  made_.clear();
}

MadeUpLaw in_blocks(const std::vector<std::size_t>& blocks) {
  return {[blocks](std::size_t block, double) {
    return std::find(blocks.begin(), blocks.end(), block) == blocks.end() ? 0.0 : 1.0;
  }};
}

MadeUpLaw over_blocks(const std::vector<double>& values) {
  return {[values](std::size_t block, double) { return block < values.size() ? values[block] : 0.0; }};
}

}  // namespace tunica::trial
