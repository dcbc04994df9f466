// SPDX-License-Identifier: Apache-2.0
// The means of comparison: a suite that is wrong itself would blame the plugins.
#include <array>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>

#include "conformance/concurrency.hpp"
#include "conformance/declarations.hpp"
#include "conformance/differences.hpp"
#include "conformance/model_properties.hpp"
#include "conformance/partners.hpp"
#include "conformance/test_cases.hpp"
#include "conformance/test_properties.hpp"
#include "support/loaded.hpp"

namespace tunica::conformance {
namespace {

using ::testing::HasSubstr;

TEST(Differences, AreAsGoodAsTheySay) {
  const auto f = [](double t) { return std::vector<double>{std::exp(3 * t), std::sin(t), 5.0, std::exp(300 * t)}; };
  const std::vector<Difference> slope = differentiate(f, 1e-2);
  const double exact[] = {3, 1, 0, 300};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(slope[i].value, exact[i], 4 * slope[i].uncertainty) << i;
    EXPECT_LT(slope[i].uncertainty, 1e-6 * (1 + exact[i])) << i;
  }
}

TEST(Differences, SaySoAtAJumpAtAKinkAndWhereThereIsNothing) {
  const auto jump = differentiate([](double t) { return std::vector<double>{t > 0 ? 1.0 : 0.0}; }, 1e-2);
  EXPECT_GT(jump[0].uncertainty, 10);
  // Slopes 1 and 3: central differences find their mean exactly.
  const auto kink = differentiate([](double t) { return std::vector<double>{t > 0 ? t + t * t : 3 * t}; }, 1e-2);
  EXPECT_NEAR(kink[0].uncertainty, 1, 1e-3);
  const auto none = differentiate([](double) { return std::vector<double>{std::nan("")}; }, 1e-2);
  EXPECT_EQ(none[0].uncertainty, std::numeric_limits<double>::infinity());
}

TEST(Meter, KeepsTheWorstAndTakesWhatIsNoNumberForTheWorstOfAll) {
  Meter meter("a with b", 1e-6);
  meter.see(1e-7, [] { return "small"; });
  EXPECT_TRUE(meter.verdict().held());
  meter.see(1e-3, [] { return "large"; });
  meter.see(1e-5, [] { return "less"; });
  EXPECT_EQ(meter.verdict().counter_example, "large");
  EXPECT_EQ(meter.verdict().worst, 1e-3);
  meter.see(std::nan(""), [] { return "no number"; });
  EXPECT_EQ(meter.verdict().counter_example, "no number");
}

TEST(Race, IsLostByACallThatAnswersOtherwiseAndThrowsWhatACallThrows) {
  EXPECT_FALSE(race_threads(
                   3, [](std::size_t) { return true; }, 0.01)
                   .lost);
  EXPECT_EQ(race_threads(
                3, [](std::size_t input) { return input != 1; }, 0.01)
                .input,
            1u);
  EXPECT_THROW(race_threads(
                   1, [](std::size_t) -> bool { throw std::runtime_error("no"); }, 0.01),
               std::runtime_error);
}

/// The materials that tests and mechanisms are checked with, by the properties of models.
TEST(Partners, AreInOrderThemselves) {
  for (const Material& material : materials())
    for (const ModelProperty& property : model_properties())
      EXPECT_EQ(property.check(*material.model, 3).counter_example, "") << material.name << ": " << property.name;
}

TEST(Declarations, NameWhatIsMissing) {
  const Parameter good{"mu", "kPa", 10, 1, 100, Scale::log, "Shear modulus.", ""};
  const auto complaint = [&](auto change) {
    Parameter changed = good;
    change(changed);
    return parameters_are_declared({changed}).counter_example;
  };
  EXPECT_EQ(complaint([](Parameter&) {}), "");
  EXPECT_THAT(complaint([](Parameter& p) { p.name = "mu.1"; }), HasSubstr("no plain name"));
  EXPECT_THAT(complaint([](Parameter& p) { p.unit = "stiffs"; }), HasSubstr("'stiffs', which is no unit"));
  EXPECT_THAT(complaint([](Parameter& p) { p.doc = ""; }), HasSubstr("has no doc"));
  EXPECT_THAT(complaint([](Parameter& p) { p.max = std::numeric_limits<double>::infinity(); }), HasSubstr("finite"));
  EXPECT_THAT(complaint([](Parameter& p) { p.initial = 0.5; }), HasSubstr("outside its bounds"));
  EXPECT_THAT(complaint([](Parameter& p) {
                p.min = 0;
                p.initial = 1;
              }),
              HasSubstr("expected min > 0"));
  EXPECT_THAT(parameters_are_declared({good, good}).counter_example, HasSubstr("declared twice"));
}

/// Rows are made up for every built-in test, without a word about any of them in the module. A test of which something
/// has to be known, such as the program that it runs, says that it needs an experiment.
TEST(TestBench, MakesUpRowsForEveryTestThatIsLoaded) {
  for (const auto& [type, entry] : testing::catalogue().tests()) {
    const auto& options = entry.factory.options;
    const auto is_anything = [](const Option& option) {  // no number, no choice: nothing that could be guessed
      return !option.fallback && (option.kind == Option::Kind::json || option.kind == Option::Kind::text);
    };
    if (std::any_of(options.begin(), options.end(), is_anything)) {
      EXPECT_THAT(trial::message_of<std::runtime_error>([&] { (void)synthetic_case(entry, 1); }),
                  ::testing::HasSubstr("--experiment"))
          << type;
      continue;
    }
    const TestCase bench = synthetic_case(entry, 1);
    ASSERT_TRUE(bench.test) << type;
    EXPECT_GE(bench.test->rows().channels.size(), 1u) << type;
    EXPECT_EQ(bench.own.size(), bench.test->describe().parameters.size()) << type;
  }
}

/// A test without derivatives, the rows of which have a time and no abscissa: relaxation at a held stretch.
class Held final : public Test {
 public:
  explicit Held(const TestSetup& setup) : time_(setup.rows.time.begin(), setup.rows.time.end()) {
    if (time_.empty() || setup.rows.count != time_.size())
      throw InputError("held: " + std::to_string(setup.rows.count) + " rows, and " + std::to_string(time_.size()) +
                       " times");
    rows_ = {time_.size(), {}, setup.rows.channels, time_};
    description_.differencing = Differencing{};
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& out) const override {
    if (!out.jacobian.empty() || !out.abscissa_derivative.empty()) return Status::failed("held: no derivatives");
    const std::array<double, 6> C{1.21, 1 / 1.1, 1 / 1.1, 0, 0, 0};
    std::array<double, 6> S{};
    if (Status status = input.model.evaluate({1, C, input.model_parameters, {}, {}}, {{}, S, {}, {}, {}}); !status.ok())
      return status;
    if (!std::isfinite(S[0] - S[2])) return Status::failed("held: the stress is no number at row 1");
    for (std::size_t i = 0; i < out.values.size(); ++i) out.values[i] = (S[0] - S[2]) * (1 + std::exp(-time_[i]));
    return {};
  }

 private:
  std::vector<double> time_;
  TestRows rows_;
  TestDescription description_;
};

TEST(TestBench, HoldsNoWantOfDerivativesAgainstATestWhoseRowsHaveATimeOnly) {
  using Role = Observable::Role;
  for (const bool required : {true, false}) {
    plugins::Catalogue::Entry<TestFactory> entry;
    entry.factory = {"held",
                     "Relaxation.",
                     "",
                     {},
                     {{"time", "s", Role::time, required, "Since the stretch was set."},
                      {"stress", "kPa", Role::channel, true, "Along the strip.", Observable::Kind::stress}},
                     [](const TestSetup& setup) { return std::make_unique<Held>(setup); }};
    const TestCase bench = synthetic_case(entry, 1);
    EXPECT_EQ(bench.test->rows().count, 6u);
    const Simulation simulation{*bench.test, *bench.material.model, bench.material.parameters, bench.own};
    for (const TestProperty& property : test_properties())
      EXPECT_EQ(property.check(simulation, 1).counter_example, "") << property.name;
  }
}

}  // namespace
}  // namespace tunica::conformance
