// SPDX-License-Identifier: Apache-2.0
#include "discover/made_up_terms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include <nlohmann/json.hpp>

#include "discover/set_at.hpp"
#include "tunica/error.hpp"

namespace tunica::trial {
namespace {

using nlohmann::json;

constexpr std::size_t rows_of_block = 10;

/// The block of a row; those before the first show nothing.
std::optional<std::size_t> block_at(double x) {
  const auto row = static_cast<std::size_t>(std::lround(x));
  if (row < rows_of_block) return std::nullopt;
  return row / rows_of_block - 1;
}

/// A term of the energy, where its parameters begin among all, and how many heights it has.
struct Placed {
  const MadeUpLaw* law;
  std::size_t first, heights;
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

/// The sum of terms, and of a model that they are added to: what a test at "strain" x measures in row x.
class Sum : public Model {
 public:
  Sum(ModelDescription description, std::vector<Placed> terms, std::unique_ptr<Model> base = nullptr)
      : description_(std::move(description)), terms_(std::move(terms)), base_(std::move(base)) {
    parts_.push_back(std::make_unique<Alone>());
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  [[nodiscard]] std::span<const std::unique_ptr<EnergyPart>> parts() const override { return parts_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    std::fill(response.stress.begin(), response.stress.end(), 0);
    std::fill(response.stress_dp.begin(), response.stress_dp.end(), 0);
    if (base_) {
      MaterialPoints inner = points;
      const std::size_t count = base_->describe().parameters.size();
      inner.parameters = points.parameters.first(count);
      MaterialResponse of_base = response;
      if (!response.stress_dp.empty()) of_base.stress_dp = response.stress_dp.first(6 * count * n);
      if (Status status = base_->evaluate(inner, of_base); !status.ok()) return status;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const std::optional<std::size_t> block = block_at(points.C[i]);
      if (!block) continue;
      for (const Placed& term : terms_) {
        const auto add = [&](std::size_t j, double value, double slope) {
          if (!response.stress.empty()) response.stress[i] += value;
          if (!response.stress_dp.empty()) response.stress_dp[6 * (term.first + j) * n + i] = slope;
        };
        const std::span<const double> own = points.parameters.subspan(term.first);
        const double shape = term.law->shape.empty() ? 0 : own[1 + term.heights];
        const double effect = term.law->effect(*block, shape);
        add(0, own[0] * effect, effect);
        for (std::size_t h = 0; h < term.heights; ++h) {
          const double height = term.law->heights[h](*block);
          add(1 + h, own[1 + h] * height, height);
        }
        constexpr double step = 1e-5;
        if (!term.law->shape.empty())
          add(1 + term.heights, 0,
              own[0] * (term.law->effect(*block, shape + step) - term.law->effect(*block, shape - step)) / (2 * step));
      }
    }
    return {};
  }

 private:
  ModelDescription description_;
  std::vector<Placed> terms_;
  std::unique_ptr<Model> base_;
  std::vector<std::unique_ptr<EnergyPart>> parts_;
};

/// A test whose readings are off by a number times what a law says.
class Off : public Test {
 public:
  Off(std::unique_ptr<Test> base, const MadeUpLaw& law, const Parameter& parameter)
      : base_(std::move(base)), law_(law), description_(base_->describe()) {
    description_.parameters.push_back(parameter);
    description_.nulls.push_back(0);
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t last = input.test_parameters.size() - 1, size = rows().count * rows().channels.size();
    TestInput inner = input;
    inner.test_parameters = input.test_parameters.first(last);
    if (Status status = base_->predict(inner, output); !status.ok()) return status;
    const std::span<const double> x = rows().abscissae.front().values;
    for (std::size_t i = 0; i < size; ++i) {
      const std::optional<std::size_t> block = block_at(x[i % rows().count]);
      const double effect = block ? law_.effect(*block, 0) : 0;
      if (!output.values.empty()) output.values[i] += effect * input.test_parameters[last];
      if (!output.jacobian.empty()) output.jacobian[(input.model_parameters.size() + last) * size + i] = effect;
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  const MadeUpLaw& law_;
  TestDescription description_;
};

std::string amplitude_of(const std::string& law, bool fibres) {
  if (law == "spline") return fibres ? "c_1" : "slope";
  return law == "quadratic" || law == "cubic" ? "k" : "mu";
}

/// The parameters of a term, behind those that there are.
Placed declare(const MadeUpLaw& law, const std::string& law_name, const std::string& invariant, std::size_t knots,
               const std::string& prefix, std::vector<Parameter>& parameters) {
  const bool power = invariant == "stretches", fibres = invariant == "fibre", curve = law_name == "spline";
  const Placed term{&law, parameters.size(), !curve ? law.heights.size() : fibres ? knots - 1 : knots};
  const auto add = [&](const std::string& own, double initial, double min, double max) {
    parameters.push_back({prefix + own, "kPa", initial, min, max, Scale::linear, "", ""});
  };
  add(amplitude_of(law_name, fibres), 1, power ? -1e4 : 0, 1e4);
  for (std::size_t h = 0; h < term.heights; ++h) add("c_" + std::to_string(h + (curve && !fibres ? 1 : 2)), 1, 0, 1e4);
  if (!law.shape.empty()) add(law.shape, 1, -100, 100);
  return term;
}

MechanismFactory mechanism(const std::string& id, Stage stage) {
  MechanismFactory factory;
  factory.id = id;
  factory.cause = "Something is added.";
  factory.stage = stage;
  factory.side = MechanismFactory::Side::both;
  factory.plausible_min = -500;
  factory.plausible_max = 500;
  factory.parameters = {{"v", "kPa", 0, -1000, 1000, Scale::linear, "", ""}};
  return factory;
}

}  // namespace

MadeUpTerms::MadeUpTerms(const std::vector<double>& levels, std::map<std::string, MadeUpLaw> laws, const Measuring& how)
    : Bench("composed"), laws_(std::move(laws)) {
  laws_.try_emplace("linear", MadeUpLaw{[](std::size_t, double) { return 1; }});
  register_all();
  std::mt19937_64 generator(how.seed);
  std::normal_distribution<double> normal(0, 1);
  std::vector<double> x, y;
  const auto row = [&](std::size_t i, double level) {
    x.push_back(static_cast<double>(i + rows_of_block));
    y.push_back(level + how.sd * normal(generator));
  };
  for (std::size_t i = 0; i < levels.size() * rows_of_block; ++i) row(i, levels[i / rows_of_block]);
  for (std::size_t i = how.back.size() * rows_of_block; i-- > 0;) row(i, how.back[i / rows_of_block]);
  auto& noise = add_test("a", x, y, how.two_channels).data.noise;
  noise = {{"y", {.absolute = 1}}};
  if (how.two_channels) noise.push_back({"z", {.absolute = 10}});
  run.objective = experiment::ObjectiveType::least_squares;
  experiment.runs = {run};
  experiment = discovery::with_first_terms(std::move(experiment), "m", false, *shelf.term_model());
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

void MadeUpTerms::register_all() {
  plugins::Catalogue::Registration stage;
  fakes::register_all(stage);
  stage.mechanisms.clear();
  stage.add(ModelFactory{"composed",
                         "",
                         "",
                         {Option::json("terms", "[]", "What it is made of.")},
                         [this](const Options& options) { return make(options); },
                         {},
                         true});
  MechanismFactory added = mechanism("added_term", Stage::energy);
  for (const char* option : {"invariant", "law", "family", "dispersion", "fibre_switch", "knots"})
    added.options.push_back(Option::text(option, "", "Of the term."));
  const auto declared = [this](const Options& options, std::vector<Parameter>& parameters) {
    const std::string &invariant = options.text("invariant"), &law = options.text("law");
    return declare(law_of(invariant, invariant == "fibre" ? options.text("family") : "", law), law, invariant,
                   json::parse(options.text("knots")).size(), "", parameters);
  };
  added.parameters_of = [declared](const Options& options) {
    std::vector<Parameter> parameters;
    (void)declared(options, parameters);
    return parameters;
  };
  added.wrap_model = [declared](std::unique_ptr<Model> base, const Options& options) {
    ModelDescription description = base->describe();
    const Placed term = declared(options, description.parameters);
    return std::make_unique<Sum>(std::move(description), std::vector{term}, std::move(base));
  };
  added.writes_terms = true;
  stage.add(std::move(added));
  if (laws_.contains("stiffer")) {
    MechanismFactory stiffening = mechanism("stiffening", Stage::energy);
    stiffening.wrap_model = [this, own = stiffening.parameters.front()](std::unique_ptr<Model> base, const Options&) {
      ModelDescription description = base->describe();
      const Placed term{&laws_.at("stiffer"), description.parameters.size(), 0};
      description.parameters.push_back(own);
      return std::make_unique<Sum>(std::move(description), std::vector{term}, std::move(base));
    };
    stage.add(std::move(stiffening));
  }
  if (laws_.contains("rig")) {
    MechanismFactory rig = mechanism("rig_error", Stage::test);
    rig.wrap_test = [this, own = rig.parameters.front()](std::unique_ptr<Test> base, const Options&) {
      return std::make_unique<Off>(std::move(base), laws_.at("rig"), own);
    };
    stage.add(std::move(rig));
  }
  shelf = {};
  shelf.commit(std::move(stage), "made_up 1");
}

const MadeUpLaw& MadeUpTerms::law_of(const std::string& invariant, const std::string& family,
                                     const std::string& law) const {
  const auto of_family = laws_.find(family + " " + law);
  if (of_family != laws_.end()) return of_family->second;
  const auto found = laws_.find(invariant == "stretches" ? "alpha" : law);
  if (found == laws_.end()) throw InputError("no law " + law);
  return found->second;
}

std::unique_ptr<Model> MadeUpTerms::make(const Options& options) const {
  ModelDescription description{"composed", {}, 0, false, true, {}};
  std::vector<Placed> terms;
  std::vector<std::string> names;
  for (const json& term : json::parse(options.text("terms"))) {
    const std::string name = names.emplace_back(term["name"]), invariant = term["invariant"],
                      law = term.value("law", ""), family = term.value("family", "");
    terms.push_back(declare(law_of(invariant, family, law), law, invariant,
                            term.contains("knots") ? term["knots"].size() : 0, name + "_", description.parameters));
  }
  {
    const std::scoped_lock lock(mutex_);
    ++made_[names];
  }
  return std::make_unique<Sum>(std::move(description), std::move(terms));
}

experiment::Experiment MadeUpTerms::with_base(const std::string& law) const {
  experiment::Experiment plain = experiment;
  plain.models.front().options.set("terms",
                                   json::array({{{"name", "base"}, {"invariant", "base"}, {"law", law}}}).dump());
  return plain;
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
  discovery::SetFit one = set_at(*subject, kinds, free);
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
