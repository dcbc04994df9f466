// SPDX-License-Identifier: Apache-2.0
#include "calibration/fakes.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace tunica::fakes {
namespace {

Behaviour behaviour;
std::string stand_in = "rough_curve";

/// S_tt = Σ p_j basis_j(x).
class LinearModel : public Model {
 public:
  using Basis = std::function<double(std::size_t j, double x)>;
  LinearModel(ModelDescription description, Basis basis)
      : description_(std::move(description)), basis_(std::move(basis)) {}
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const std::size_t n = points.count;
    std::fill(response.stress.begin(), response.stress.end(), 0);
    std::fill(response.stress_dp.begin(), response.stress_dp.end(), 0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < points.parameters.size(); ++j) {
        const double value = basis_(j, points.C[i]);
        if (!response.stress.empty()) response.stress[i] += points.parameters[j] * value;
        if (!response.stress_dp.empty()) response.stress_dp[6 * j * n + i] = value;
      }
    }
    return {};
  }

 private:
  ModelDescription description_;
  Basis basis_;
};

std::unique_ptr<Model> parabola_with(std::vector<Combination> admissible) {
  ModelDescription description{"parabola", {}, 0, false, true, {}};
  description.admissible = std::move(admissible);
  description.parameters = {{"a", "kPa", 1, 0, 10, Scale::linear, "constant", ""},
                            {"b", "kPa", 1, 0.1, 10, Scale::log, "slope", ""},
                            {"c", "kPa", 0, -5, 5, Scale::linear, "curvature", ""}};
  return std::make_unique<LinearModel>(std::move(description), [](std::size_t j, double x) {
    return j == 0 ? 1 : j == 1 ? x : x * x;
  });
}

std::unique_ptr<Model> parabola(const Options&) { return parabola_with({}); }

std::unique_ptr<Model> bordered(const Options&) {
  return parabola_with({{"a - b", "kPa", {0, 1}, [](std::span<const double> v) { return v[0] - v[1] + 1; }, ""}});
}

/// Its inequality has a value at the initial parameters, and nowhere near.
std::unique_ptr<Model> jagged(const Options&) {
  return parabola_with({{"a", "kPa", {0}, [](std::span<const double> v) { return v[0] == 1 ? 1 : std::nan(""); }, ""}});
}

std::unique_ptr<Model> valley(const Options&) {
  ModelDescription description{"valley", {}, 0, false, true, {}};
  description.parameters = {{"p", "kPa", 1, 0, 10, Scale::linear, "half of the slope", ""},
                            {"q", "kPa", 1, 0, 10, Scale::linear, "the rest of it", ""},
                            {"r", "kPa", 1, 0, 10, Scale::linear, "curvature", ""}};
  description.combinations = {{"2p + q",
                               "kPa",
                               {0, 1},
                               [](std::span<const double> v) { return 2 * v[0] + v[1]; },
                               "a test along another axis"}};
  return std::make_unique<LinearModel>(std::move(description), [](std::size_t j, double x) {
    return j == 0 ? 2 * x : j == 1 ? x : x * x;
  });
}

/// A model in a mechanism with one parameter v: S + v x³, S·v, or a memory: S + v·(the S of the row before).
class WrappedModel : public Model {
 public:
  enum class Kind { cubic, doubling, memory };
  WrappedModel(std::unique_ptr<Model> base, Kind kind, const Parameter& parameter)
      : base_(std::move(base)), kind_(kind), description_(base_->describe()) {
    description_.parameters.push_back(parameter);
    if (kind == Kind::memory) description_.parameter_derivatives = false;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    MaterialPoints inner = points;
    const std::size_t last = points.parameters.size() - 1, n = points.count;
    inner.parameters = points.parameters.first(last);
    if (kind_ == Kind::memory && !response.stress_dp.empty()) return Status::failed("no parameter derivatives");
    if (Status status = base_->evaluate(inner, response); !status.ok()) return status;
    if (!response.stress_dp.empty())
      std::fill(response.stress_dp.begin() + static_cast<std::ptrdiff_t>(6 * last * n), response.stress_dp.end(), 0);
    const double v = points.parameters[last];
    double before = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = points.C[i], stress = response.stress[i];
      response.stress[i] = kind_ == Kind::cubic      ? stress + v * x * x * x
                           : kind_ == Kind::doubling ? stress * v
                                                     : stress + v * before;
      before = stress;
      if (response.stress_dp.empty()) continue;
      response.stress_dp[6 * last * n + i] = kind_ == Kind::cubic ? x * x * x : stress;
      if (kind_ != Kind::doubling) continue;
      for (std::size_t j = 0; j < last; ++j) response.stress_dp[6 * j * n + i] *= v;
    }
    return {};
  }

 private:
  std::unique_ptr<Model> base_;
  Kind kind_;
  ModelDescription description_;
};

class Curve : public Test {
 public:
  explicit Curve(const TestSetup& setup, bool costly = false) {
    description_.costly = costly;
    x_.assign(setup.rows.abscissae.front().values.begin(), setup.rows.abscissae.front().values.end());
    rows_.count = setup.rows.count;
    rows_.abscissae = {{"x", x_}};
    rows_.channels = setup.rows.channels;
    description_.parameters = {{"gain", "1", 1, 0.5, 2, Scale::linear, "gain", ""},
                               {"tilt", "kPa", 0, -1, 1, Scale::linear, "a native imperfection", ""}};
    description_.nulls = {std::numeric_limits<double>::quiet_NaN(), 0};
    description_.diagnostics = {"twice_x"};
    description_.diagnostic_units = {"1"};
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    constexpr std::size_t most = 256;  // on the stack: the tests count allocations of the host
    const std::size_t n = rows_.count, models = input.model_parameters.size(), size = n * rows_.channels.size();
    if (6 * n > most * 6 || models > 6) return Status::failed("too large for the fake");
    double C[6 * most] = {}, stress[6 * most], stress_dp[6 * 6 * most];
    for (std::size_t i = 0; i < n; ++i) C[i] = x_[i];
    const bool derivatives = !output.jacobian.empty();
    Status status = input.model.evaluate(
        {n, {C, 6 * n}, input.model_parameters, {}, {}},
        {{}, {stress, 6 * n}, {}, derivatives ? std::span(stress_dp, 6 * models * n) : std::span<double>{}, {}});
    if (!status.ok()) return status;
    const double gain = input.test_parameters[0], tilt = input.test_parameters[1];
    for (std::size_t k = 0; k < rows_.channels.size(); ++k) {
      const double factor = rows_.channels[k] == "z" ? 10 : 1;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t at = k * n + i;
        if (!output.values.empty()) output.values[at] = factor * (gain * stress[i] + tilt * x_[i]);
        if (!derivatives) continue;
        for (std::size_t j = 0; j < models; ++j)
          output.jacobian[j * size + at] = factor * gain * stress_dp[6 * j * n + i];
        output.jacobian[models * size + at] = factor * stress[i];
        output.jacobian[(models + 1) * size + at] = factor * x_[i];
      }
    }
    for (std::size_t i = 0; i < output.diagnostics.size(); ++i) output.diagnostics[i] = 2 * x_[i];
    if (behaviour && !output.values.empty()) behaviour(input.model_parameters[0], output.values, status);
    return status;
  }

 private:
  std::vector<double> x_;
  TestRows rows_;
  TestDescription description_;
};

/// y = gain Σ thickness S(x) over layers, each with its model.
/// A curve that is 3 % too high, and bends a little with what it is made of.
class RoughCurve final : public Curve {
 public:
  using Curve::Curve;
  Status predict(const TestInput& input, const TestOutput& output) const override {
    Status status = Curve::predict(input, output);
    for (double& value : output.values) value = 1.03 * value + 0.002 * value * value;
    if (!output.jacobian.empty()) {
      const std::size_t size = output.values.size();
      for (std::size_t i = 0; i < output.jacobian.size(); ++i) {
        // value = 1.03 v + 0.002 v², so that ∂value/∂v = √(1.03² + 0.008 value).
        output.jacobian[i] *= std::sqrt(1.03 * 1.03 + 0.008 * output.values[i % size]);
      }
    }
    return status;
  }
};

class Stack final : public Test {
 public:
  explicit Stack(const TestSetup& setup) : thickness_(setup.layers) {
    x_.assign(setup.rows.abscissae.front().values.begin(), setup.rows.abscissae.front().values.end());
    rows_ = {setup.rows.count, {{"x", x_}}, setup.rows.channels, {}};
    description_.parameters = {{"gain", "1", 1, 0.5, 2, Scale::linear, "gain", ""}};
    if (thickness_.empty())
      description_.parameters.push_back({"bend", "1", 0, 0, 1, Scale::linear, "of one layer", ""});
    description_.nulls = {std::numeric_limits<double>::quiet_NaN(), 0};
    description_.nulls.resize(description_.parameters.size());
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t n = rows_.count, models = input.model_parameters.size();
    const Model* const one = &input.model;
    const auto layers = input.layers.empty() ? std::span(&one, 1) : input.layers;
    std::vector<double> sum(n, 0.0), C(6 * n, 0.0), stress(6 * n);
    std::copy(x_.begin(), x_.end(), C.begin());
    std::size_t first = 0;
    for (std::size_t layer = 0; layer < layers.size(); ++layer) {
      const std::size_t count = layers[layer]->describe().parameters.size();
      const double factor = input.test_parameters[0] * (thickness_.empty() ? 1 : thickness_[layer]);
      std::vector<double> by(output.jacobian.empty() ? 0 : 6 * count * n);
      Status status = layers[layer]->evaluate({n, C, input.model_parameters.subspan(first, count), {}, {}},
                                              {{}, stress, {}, by, {}});
      if (!status.ok()) return status;
      for (std::size_t i = 0; i < n; ++i) {
        sum[i] += factor * stress[i];
        for (std::size_t j = 0; j < by.size() / (6 * n); ++j)
          output.jacobian[(first + j) * n + i] = factor * by[6 * j * n + i];
      }
      first += count;
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!output.values.empty()) output.values[i] = sum[i];
      if (output.jacobian.empty()) continue;
      output.jacobian[models * n + i] = sum[i] / input.test_parameters[0];
      if (thickness_.empty()) output.jacobian[(models + 1) * n + i] = 0;  // it bends nothing
    }
    return {};
  }

 private:
  std::vector<double> x_, thickness_;
  TestRows rows_;
  TestDescription description_;
};

/// A test in a mechanism: y + v, or y·(1 + v).
class WrappedTest : public Test {
 public:
  WrappedTest(std::unique_ptr<Test> base, bool scales, const Parameter& parameter)
      : base_(std::move(base)), scales_(scales), description_(base_->describe()) {
    description_.parameters.push_back(parameter);
    description_.nulls.push_back(0);
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return base_->rows(); }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    const std::size_t last = input.test_parameters.size() - 1, size = output.values.size();
    TestInput inner = input;
    inner.test_parameters = input.test_parameters.first(last);
    if (Status status = base_->predict(inner, output); !status.ok()) return status;
    const double v = input.test_parameters[last];
    const std::size_t slots = input.model_parameters.size() + last;
    for (std::size_t i = 0; i < size; ++i) {
      const double base = output.values[i];
      output.values[i] = scales_ ? base * (1 + v) : base + v;
      if (output.jacobian.empty()) continue;
      output.jacobian[slots * size + i] = scales_ ? base : 1;
      for (std::size_t j = 0; scales_ && j < slots; ++j) output.jacobian[j * size + i] *= 1 + v;
    }
    return {};
  }

 private:
  std::unique_ptr<Test> base_;
  bool scales_;
  TestDescription description_;
};

MechanismFactory mechanism(const std::string& id, Stage stage, Parameter parameter) {
  MechanismFactory factory;
  factory.id = id;
  factory.cause = "a fake";
  factory.stage = stage;
  factory.parameters = {std::move(parameter)};
  factory.side = MechanismFactory::Side::both;
  factory.plausible_min = -1;
  factory.plausible_max = 1;
  return factory;
}

void add_model_mechanism(plugins::Catalogue::Registration& stage, const std::string& id, Stage at,
                         const Parameter& parameter, WrappedModel::Kind kind) {
  MechanismFactory factory = mechanism(id, at, parameter);
  factory.wrap_model = [kind, parameter](std::unique_ptr<Model> base, const Options&) {
    return std::make_unique<WrappedModel>(std::move(base), kind, parameter);
  };
  stage.add(std::move(factory));
}

void add_test_mechanism(plugins::Catalogue::Registration& stage, const std::string& id, Stage at, bool scales,
                        std::vector<std::string> applies_to) {
  const Parameter parameter{"value", scales ? "1" : "kPa", 0, -1, 1, Scale::linear, "amplitude", ""};
  MechanismFactory factory = mechanism(id, at, parameter);
  factory.applies_to = std::move(applies_to);
  factory.wrap_test = [scales, parameter](std::unique_ptr<Test> base, const Options&) {
    return std::make_unique<WrappedTest>(std::move(base), scales, parameter);
  };
  stage.add(std::move(factory));
}

}  // namespace

void set_behaviour(Behaviour wanted) { behaviour = std::move(wanted); }
void set_stand_in(std::string type) { stand_in = std::move(type); }

void register_all(plugins::Catalogue::Registration& stage) {
  stage.add(ModelFactory{"parabola", "", "", {}, parabola});
  stage.add(ModelFactory{"bordered", "", "", {}, bordered});
  stage.add(ModelFactory{"jagged", "", "", {}, jagged});
  stage.add(ModelFactory{"valley", "", "", {}, valley});
  stage.add(ModelFactory{
      "broken", "", "", {}, [](const Options&) -> std::unique_ptr<Model> { throw InputError("no such luck"); }});
  const std::vector<Observable> observables = {{"x", "1", Observable::Role::abscissa, true, "position"},
                                               {"y", "kPa", Observable::Role::channel, true, "height"},
                                               {"z", "kPa", Observable::Role::channel, false, "ten times the height"}};
  stage.add(TestFactory{
      "curve", "", "", {}, observables, [](const TestSetup& setup) { return std::make_unique<Curve>(setup); }});
  TestFactory costly{"costly_curve",
                     "",
                     "",
                     {},
                     observables,
                     [](const TestSetup& setup) {
                       return std::make_unique<Curve>(setup, true); }};
  costly.stand_in = [](const Options&) -> std::optional<StandIn> {
    if (stand_in.empty()) return std::nullopt;
    return StandIn{stand_in, {}};
  };
  stage.add(std::move(costly));
  stage.add(TestFactory{"rough_curve", "", "", {}, observables, [](const TestSetup& setup) {
                          return std::make_unique<RoughCurve>(setup);
                        }});
  stage.add(TestFactory{
      "stack",
      "",
      "",
      {},
      {observables[0], observables[1]},
      [](const TestSetup& setup) { return std::make_unique<Stack>(setup); },
      {{"gain", "1", 1, 0.5, 2, Scale::linear, "gain", ""}, {"bend", "1", 0, 0, 1, Scale::linear, "of one layer", ""}},
      true});
  add_model_mechanism(stage, "cubic", Stage::energy, {"beta", "kPa", 0, -1, 1, Scale::linear, "cubic term", ""},
                      WrappedModel::Kind::cubic);
  add_model_mechanism(stage, "doubling", Stage::stress, {"factor", "1", 1, 0, 4, Scale::linear, "factor", ""},
                      WrappedModel::Kind::doubling);
  add_model_mechanism(stage, "memory", Stage::history,
                      {"g", "1", 0.1, 0, 1, Scale::linear, "share of the row before", ""}, WrappedModel::Kind::memory);
  add_test_mechanism(stage, "offset", Stage::test, false, {});
  add_test_mechanism(stage, "scale_error", Stage::data, true, {"curve"});
  add_test_mechanism(stage, "strip_only", Stage::test, false, {"strip"});
}

plugins::Catalogue catalogue() {
  plugins::Catalogue catalogue;
  plugins::Catalogue::Registration stage;
  register_all(stage);
  catalogue.commit(std::move(stage), "fakes 1");
  return catalogue;
}

Bench::Bench(std::string model_type) {
  static std::atomic<int> number = 0;
  folder_ = std::filesystem::temp_directory_path() / fmt::format("tunica_calibration_{}_{}", getpid(), number++);
  std::filesystem::create_directories(folder_);
  experiment.name = "fake";
  experiment.models.push_back({"m", std::move(model_type), {}, {}, {}});
  run.model = "m";
  run.optimizer = "none";
}

Bench::~Bench() {
  std::filesystem::remove_all(folder_);
  // Only what was changed: benches may end side by side.
  if (behaviour) set_behaviour({});
  if (stand_in != "rough_curve") set_stand_in("rough_curve");
}

experiment::ParameterSetting& Bench::parameter(const std::string& name) {
  experiment::ParameterSetting& setting = model().parameters[name];
  setting.pointer = "/models/m/parameters/" + name;
  return setting;
}

experiment::TestEntry& Bench::add_test(const std::string& name, const std::vector<double>& x,
                                       const std::vector<double>& y, bool second) {
  const auto file = folder_ / (name + ".csv");
  std::ofstream out(file);
  out << "x [1],y [kPa],z [kPa]\n";
  for (std::size_t i = 0; i < x.size(); ++i) out << fmt::format("{:.17g},{:.17g},{:.17g}\n", x[i], y[i], 10 * y[i]);
  experiment::TestEntry entry;
  entry.name = name;
  entry.type = "curve";
  entry.data.files = {file};
  entry.data.columns = {{"x", "x"}, {"y", "y"}};
  if (second) entry.data.columns.emplace_back("z", "z");
  entry.weights.assign(second ? 2 : 1, 1.0);
  entry.parameters["gain"].fixed = 1;
  experiment.tests.push_back(std::move(entry));
  run.tests.push_back(name);
  return experiment.tests.back();
}

std::vector<double> grid(double first, double last, std::size_t count) {
  std::vector<double> points;
  for (std::size_t i = 0; i < count; ++i) {
    points.push_back(first + (last - first) * static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return points;
}

std::vector<double> map(const std::vector<double>& x, const std::function<double(double)>& f) {
  std::vector<double> y;
  for (const double value : x) y.push_back(f(value));
  return y;
}

std::string message_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const std::exception& problem) {
    return problem.what();
  }
  ADD_FAILURE() << "no exception";
  return "";
}

}  // namespace tunica::fakes
