// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/made_up_causes.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace tunica::diagnosis {
namespace {

/// A test with what a MadeUp adds.
class WithMadeUp : public Test {
 public:
  WithMadeUp(std::unique_ptr<Test> base, std::shared_ptr<const MadeUp> added, const std::vector<Parameter>& parameters)
      : base_(std::move(base)), added_(std::move(added)), description_(base_->describe()) {
    for (const Parameter& parameter : parameters) {
      description_.parameters.push_back(parameter);
      description_.nulls.push_back(description_.nulls.size() == base_->describe().nulls.size() ? added_->null : NAN);
    }
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t own = 1 + added_->nuisance.size(), first = input.test_parameters.size() - own;
    if (added_->watch)
      if (Status status = added_->watch(input.model_parameters, input.test_parameters.subspan(first)); !status.ok())
        return status;
    TestInput inner = input;
    inner.test_parameters = input.test_parameters.first(first);
    if (Status status = base_->predict(inner, output); !status.ok()) return status;
    const std::span<const double> x = rows().abscissae.front().values;
    const std::size_t size = rows().count * rows().channels.size();
    const std::size_t slot = input.model_parameters.size() + first;
    const double d = input.test_parameters[first] - added_->null;
    const bool even = added_->side == MechanismFactory::Side::even;
    const auto effect = [&](double distance) {
      return added_->by ? added_->by(distance) : even ? distance * distance : distance;
    };
    const double now = effect(d), slope = (effect(d + 1e-4) - effect(d - 1e-4)) / 2e-4;
    for (std::size_t i = 0; i < size; ++i) {
      const auto row = static_cast<Eigen::Index>(std::lround(x[i % rows().count]));
      const double shape = added_->shape[row];
      if (!output.values.empty()) output.values[i] += shape * now;
      if (!output.jacobian.empty()) output.jacobian[slot * size + i] = shape * slope;
      for (std::size_t k = 1; k < own; ++k) {
        const double other = added_->nuisance[k - 1].second[row];
        if (!output.values.empty()) output.values[i] += other * input.test_parameters[first + k];
        if (!output.jacobian.empty()) output.jacobian[(slot + k) * size + i] = other;
      }
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  std::shared_ptr<const MadeUp> added_;
  TestDescription description_;
};

MechanismFactory factory_of(const MadeUp& added) {
  MechanismFactory factory;
  factory.id = added.id;
  factory.cause = "Something is added.";
  factory.stage = Stage::test;
  factory.null = added.null;
  factory.side = added.side;
  factory.plausible_min = added.null - 500;
  factory.plausible_max = added.null + 500;
  factory.parameters = {{"v", "kPa", added.null, added.null - 1000, added.null + 1000, Scale::linear, "", ""}};
  for (const auto& [name, shape] : added.nuisance)
    factory.parameters.push_back({name, "s", 0, -1000, 1000, Scale::linear, "", ""});
  if (added.declare) added.declare(factory);
  const auto kept = std::make_shared<const MadeUp>(added);
  factory.wrap_test = [kept, parameters = factory.parameters](std::unique_ptr<Test> base, const Options&) {
    return std::make_unique<WithMadeUp>(std::move(base), kept, parameters);
  };
  return factory;
}

}  // namespace

Eigen::VectorXd at_rows(Eigen::Index size, const std::vector<std::pair<Eigen::Index, double>>& values) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  for (const auto& [row, value] : values) all[row] = value;
  return all;
}

MadeUpCauses::MadeUpCauses(const std::vector<int>& rows, const Eigen::VectorXd& beyond) {
  run.objective = experiment::ObjectiveType::least_squares;
  parameter("a").fixed = 1;
  parameter("b").fixed = 0.1;
  parameter("c").fixed = 0;
  int first = 0;
  for (std::size_t t = 0; t < rows.size(); ++t) {
    std::vector<double> x, y;
    for (int i = first; i < first + rows[t]; ++i) {
      x.push_back(i);
      y.push_back(1 + 0.1 * i + beyond[i]);
    }
    first += rows[t];
    add_test(std::string(1, static_cast<char>('a' + t)), x, y).data.noise = {{"y", {.absolute = 1}}};
  }
}

void MadeUpCauses::add(MadeUp mechanism) { mechanisms_.push_back(std::move(mechanism)); }

void MadeUpCauses::free(const std::string& name, double min, double max) {
  experiment::ParameterSetting& setting = parameter(name);
  setting.initial = setting.fixed;
  setting.fixed.reset();
  setting.min = min;
  setting.max = max;
}

void MadeUpCauses::close() {
  plugins::Catalogue::Registration stage;
  for (const MadeUp& one : mechanisms_) stage.add(factory_of(one));
  shelf.commit(std::move(stage), "made_up 1");
  Evidence& evidence = analysis.evidence;
  evidence.experiment = experiment;
  evidence.run = run;
  evidence.base = std::make_shared<const assembly::Assembly>(experiment, run, shelf);
  for (const experiment::TestEntry& test : experiment.tests)
    evidence.noise.push_back({test.name, "y", "kPa", NoiseSource::Kind::differences, {.absolute = 1}});
  evidence.curves = curves_of(*evidence.base, evidence.noise);
  std::vector<double> start;
  for (const auto& parameter : evidence.base->layout().parameters) start.push_back(parameter.initial);
  evidence.fit =
      least_squares(*evidence.base, all_variables(*evidence.base), start, *evidence.base->evaluator().make_workspace());

  Hypotheses& hypotheses = analysis.hypotheses;
  hypotheses.projection = Projection(interior(evidence.fit));
  for (const MadeUp& one : mechanisms_) {
    Candidate candidate{one.id, &shelf.mechanisms().at(one.id).factory, {}, {}};
    for (const auto& tests : one.places) {
      Hypothesis hypothesis{candidate.mechanism, {one.id, {tests}, {}}, {}, one.side, one.sign};
      hypothesis.signature = Eigen::VectorXd::Zero(evidence.fit.residuals.size());
      for (const Curve& curve : evidence.curves)
        if (std::find(tests.begin(), tests.end(), curve.test) != tests.end())
          for (Eigen::Index k = 0; k < curve.count; ++k)
            hypothesis.signature[curve.first + k] =
                one.sign * one.shape[std::lround(curve.abscissa[static_cast<std::size_t>(k)])];
      candidate.hypotheses.push_back(std::move(hypothesis));
    }
    hypotheses.candidates.push_back(std::move(candidate));
  }
  hypotheses.directions = directions(hypotheses.candidates, hypotheses.projection);

  // Draws of nothing at all: any loss is enough for a member of a group to be needed.
  Draws draws;
  draws.residuals = Eigen::MatrixXf::Zero(evidence.fit.residuals.size(), 100);
  calibrate(draws);
}

void MadeUpCauses::calibrate(const Draws& draws) {
  const Hypotheses& hypotheses = analysis.hypotheses;
  const Shapes none{Eigen::MatrixXd(draws.residuals.rows(), 0), {}};
  analysis.alarm.draws = draws;
  analysis.alarm.shapes = none;
  analysis.alarm.detector = std::make_shared<const Detector>(hypotheses.projection, hypotheses.directions,
                                                             hypotheses.candidates.size(), none, draws);
}

void MadeUpCauses::calibrate_by_noise() {
  std::mt19937 generator(7);
  std::normal_distribution<float> normal;
  Draws draws;
  draws.residuals =
      Eigen::MatrixXf::NullaryExpr(analysis.evidence.fit.residuals.size(), 500, [&] { return normal(generator); });
  calibrate(draws);
}

std::size_t MadeUpCauses::direction(const std::string& id, std::size_t place) const {
  const std::vector<Direction>& all = analysis.hypotheses.directions;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (id_of(k) == id && all[k].hypothesis == place) return k;
  throw std::runtime_error("no direction of " + id);
}

const std::string& MadeUpCauses::id_of(std::size_t direction) const {
  return analysis.hypotheses.candidates[analysis.hypotheses.directions[direction].candidate].id;
}

std::string MadeUpCauses::names_of(const Group& group) const {
  std::string names;
  for (const std::size_t k : group.directions) names += (names.empty() ? "" : " ") + id_of(k);
  return names;
}

std::vector<std::string> MadeUpCauses::names_of(const std::vector<Group>& groups) const {
  std::vector<std::string> all;
  for (const Group& group : groups) all.push_back(names_of(group));
  return all;
}

const Group& MadeUpCauses::group_named(const std::vector<Group>& groups, const std::string& names) const {
  for (const Group& group : groups)
    if (names_of(group) == names) return group;
  throw std::runtime_error("no group " + names);
}

Group MadeUpCauses::group_of(const std::vector<std::size_t>& directions, const std::vector<std::string>& as) const {
  Group group;
  group.directions = directions;
  for (const std::size_t k : directions) {
    const Score at_null = score(analysis.hypotheses.directions[k], -analysis.evidence.fit.residuals);
    group.additions.push_back(analysis.hypotheses.hypothesis(k).addition);
    if (!as.empty()) group.additions.back().as = as[group.additions.size() - 1];
    group.amplitudes.push_back(at_null.amplitude);
    group.linear_gain += at_null.T;
    group.losses.push_back(at_null.T);
  }
  group.refit = fit_with(inquiry(), analysis, group.additions, group.amplitudes).value();
  return group;
}

Single MadeUpCauses::single(const std::string& id, std::size_t place) const {
  const std::size_t k = direction(id, place);
  const Group alone = group_of({k});
  return {analysis.hypotheses.directions[k].candidate, alone.linear_gain / 2, k, alone.refit};
}

OneRowEach::OneRowEach(const std::vector<double>& squares)
    : MadeUpCauses(
          std::vector<int>(squares.size(), 1),
          Eigen::Map<const Eigen::VectorXd>(squares.data(), static_cast<Eigen::Index>(squares.size())).cwiseSqrt()) {}

void OneRowEach::add_everywhere(const std::string& id, const std::vector<double>& shape, double bound) {
  const auto size = static_cast<Eigen::Index>(shape.size());
  MadeUp one{id, Eigen::Map<const Eigen::VectorXd>(shape.data(), size), {}};
  for (Eigen::Index k = 0; k < size; ++k) one.places.push_back({test_of(k)});
  one.declare = [bound](MechanismFactory& factory) {
    factory.parameters.front().min = -bound;
    factory.parameters.front().max = bound;
  };
  add(one);
}

void OneRowEach::add_each(Eigen::Index size) {
  for (Eigen::Index k = 0; k < size; ++k) add({"m" + std::to_string(k), at_rows(size, {{k, 1}}), {{test_of(k)}}});
}

std::vector<Single> OneRowEach::run() {
  reports.clear();
  return fit_singles(inquiry(), analysis);
}

}  // namespace tunica::diagnosis
