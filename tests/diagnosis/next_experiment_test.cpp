// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/next_experiment.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <gmock/gmock.h>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/measured.hpp"
#include "diagnosis/naming/refits.hpp"
#include "diagnosis/prospects/designs.hpp"

namespace tunica::diagnosis {
namespace {

using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;

const std::vector<Addition> second_invariant{{"second_invariant", {}, {}}};

/// A quick diagnosis of the gho wall that was measured.
struct Asked {
  explicit Asked(const trial::Measured& measured) : experiment(measured.read()) {
    request.model = "gho";
    request.quick = true;
  }
  [[nodiscard]] Inquiry inquiry() const { return {experiment, request, testing::catalogue(), silent}; }

  experiment::Experiment experiment;
  Request request;
  Progress silent;
};

/// A circumferential strip alone, of a wall with more circumferential fibres than gho has.
struct MoreFibres : trial::Measured {
  MoreFibres() : Measured({trial::Strip{}}) {
    measure(41, [](nlohmann::json& truth) {
      truth["models"]["gho"]["mechanisms"] = {trial::mechanism("circumferential_fibres", "k", 5)};
    });
  }
};

/// These explanations of it.
struct Rivals {
  explicit Rivals(const std::vector<Addition>& additions) : asked(measured) {
    analysis.evidence = evidence_of(asked.inquiry(), {});
    for (const Addition& addition : additions) {
      auto refit = fit_with(asked.inquiry(), analysis, {addition}, std::array{1.0});
      if (!refit) throw std::runtime_error(addition.id);
      explanation.claim.rivals.push_back(*refit);
      explanation.claim.ambiguity_set.push_back(addition.id);
    }
  }
  [[nodiscard]] NextExperiment next() const {
    return *next_experiment(asked.inquiry(), analysis.evidence, explanation);
  }
  [[nodiscard]] const Refit& first() const { return explanation.claim.rivals.front(); }

  MoreFibres measured;
  Asked asked;
  Analysis analysis;
  Explanation explanation;
};

TEST(NextExperiment, IsOneInWhichTheRivalsDiffer) {
  const Rivals rivals({{"circumferential_fibres", {}, {}}, {"second_invariant", {}, {}}});
  const NextExperiment next = rivals.next();
  ASSERT_TRUE(next.repeats);
  EXPECT_GE(*next.repeats, 1u);
  EXPECT_LE(*next.repeats, 20u);
  EXPECT_EQ(next.separates, (std::vector<std::string>{"circumferential_fibres", "second_invariant"}));
  const auto at = next.description.find("the rivals differ by ");
  ASSERT_NE(at, std::string::npos) << next.description;
  const double distance = std::stod(next.description.substr(at + 21));
  EXPECT_GT(distance, 0);
  // (2 · 1.645)² in all the repeats together; the distance is printed to 0.1.
  EXPECT_GE(static_cast<double>(*next.repeats) * (distance + 0.05) * (distance + 0.05), 10.8);
  EXPECT_THAT(next.description, HasSubstr("equibiaxial beside uniaxial extension"));
}

TEST(NextExperiment, IsNotDecidedByWhatNobodyBelieves) {
  const Addition offset{"force_offset", {{"circumferential"}}, {}};
  Rivals rivals({{"circumferential_fibres", {}, {}}, {"second_invariant", {}, {}}, offset});
  rivals.explanation.claim.doubted = {{"force_offset"}};
  const NextExperiment next = rivals.next(),
                       without = Rivals({{"circumferential_fibres", {}, {}}, {"second_invariant", {}, {}}}).next();
  EXPECT_EQ(next.description, without.description);
  EXPECT_EQ(next.separates, rivals.explanation.claim.ambiguity_set) << "it is still of the set";
  rivals.explanation.claim.doubted = {{"second_invariant"}, {"force_offset"}};
  EXPECT_THAT(rivals.next().description, Not(HasSubstr("second_invariant: "))) << "no two are left to decide";
}

TEST(NextExperiment, IsNoneOfTheLibraryWhereTheRivalsSayTheSameOfTheMaterial) {
  const Addition offset{"force_offset", {{"circumferential"}}, {}};
  const NextExperiment next = Rivals({offset, offset}).next();
  EXPECT_FALSE(next.repeats);
  EXPECT_THAT(next.description,
              AllOf(HasSubstr("No strip, sheet or inflation of the library tells them apart in 20 repeats"),
                    HasSubstr("force_offset: a reading of the load cell without specimen")));
}

// A cause that is sure needs no confirmation; what determines the parameters better is said all the same.
TEST(NextExperiment, OfASureCauseDeterminesItsParameters) {
  const NextExperiment next = Rivals(second_invariant).next();
  EXPECT_THAT(next.description, Not(HasSubstr("To confirm")));
  EXPECT_THAT(next.description, HasSubstr("would reduce that to a factor of"));
  EXPECT_TRUE(next.repeats);
}

TEST(NextExperiment, IsNotAskedForWithoutACause) {
  Explanation unknown;
  unknown.verdict = Verdict::unknown;
  const MoreFibres measured;
  const Asked asked(measured);
  EXPECT_FALSE(next_experiment(asked.inquiry(), {}, unknown));
}

/// What the data leave of every parameter, in ln p or in shares of its box, with the box as a prior.
double loosest(const trial::Measured& measured) {
  const Asked asked(measured);
  const Evidence evidence = evidence_of(asked.inquiry(), {});
  Eigen::MatrixXd J = evidence.fit.jacobian, precision = Eigen::MatrixXd::Zero(J.cols(), J.cols());
  for (Eigen::Index k = 0; k < J.cols(); ++k) {
    const auto& parameter = evidence.base->layout().parameters[static_cast<std::size_t>(k)];
    J.col(k) *= evidence.fit.free[static_cast<std::size_t>(k)];
    precision(k, k) = 12 / std::pow(std::log(parameter.max / parameter.min), 2);
  }
  precision += J.transpose() * J;
  return std::sqrt(precision.inverse().diagonal().maxCoeff());
}

// One strip, hardly pulled: of its fibres it tells nothing; pulled further, little.
TEST(NextExperiment, DeterminesWhatTheDataLeaveOpen) {
  const auto described = [](double longest) {
    trial::Measured measured({trial::Strip{.stretch = testing::evenly(1.01, longest, 15)}});
    measured.measure(45);
    EXPECT_GT(loosest(measured), 0.25);
    const Diagnosis found = measured.diagnose();
    EXPECT_EQ(found.explanation.verdict, Verdict::nothing_detected);
    return found.prospects.next.value();
  };
  const diagnosis::NextExperiment little = described(1.6), found = described(1.15);
  ASSERT_EQ(found.separates.size(), 1u);
  EXPECT_THAT(found.description,
              HasSubstr(found.separates.front() + " is fixed only by its bounds, not by these data; "));
  EXPECT_THAT(little.description, HasSubstr(little.separates.at(0) + " is uncertain by a factor of "));
  // Fibres that are hardly pulled: no library of strips that go no further tells.
  EXPECT_FALSE(found.repeats);
  EXPECT_THAT(found.description, HasSubstr("no strip, sheet or inflation of the library determines it"));
}

TEST(NextExperiment, IsNotAskedForWhereNothingIsOpen) {
  trial::Measured measured({{.sd = 0.03}, {.name = "axial", .sd = 0.03}});
  measured.measure(46);
  ASSERT_LT(loosest(measured), 0.25);
  const Diagnosis found = measured.diagnose();
  ASSERT_EQ(found.explanation.verdict, Verdict::nothing_detected);
  EXPECT_FALSE(found.prospects.next) << found.prospects.next->description;
}

/// The strip along the circumference whose width is measured too.
const Design& strip_of(const std::vector<Design>& library) {
  return *std::find_if(library.begin(), library.end(), [](const Design& one) {
    return one.description.starts_with("a strip pulled along the circumferential direction");
  });
}

TEST(Designs, ReachAsFarAsTheDataAndKnowTheirNoise) {
  const Rivals rivals(second_invariant);
  const auto library = designs(rivals.asked.inquiry(), rivals.analysis.evidence, rivals.first().extension->assembly(),
                               rivals.first().fit.free);
  ASSERT_GE(library.size(), 6u);
  EXPECT_THAT(strip_of(library).description, HasSubstr("to a stretch of 1.6"));
  EXPECT_DOUBLE_EQ(strip_of(library).sd.front(), 0.3);
  // P with 0.3 kPa and 2 % is known as a Cauchy stress λ P to λ times as much.
  Evidence nominal = rivals.analysis.evidence;
  for (auto& test : nominal.experiment.tests) test.data.stress_measure = "first_piola_kirchhoff";
  for (Curve& curve : nominal.curves) curve.noise.noise.relative = 0.02;
  const auto wider =
      designs(rivals.asked.inquiry(), nominal, rivals.first().extension->assembly(), rivals.first().fit.free);
  std::vector<double> values;
  ASSERT_TRUE(predict(strip_of(wider), rivals.first().extension->assembly(), rivals.first().fit.free, values));
  EXPECT_DOUBLE_EQ(strip_of(wider).sd[19], 1.6 * std::hypot(0.3, 0.02 * values[19] / 1.6));
  // The second Piola–Kirchhoff stress is S = σ/λ².
  for (auto& test : nominal.experiment.tests) test.data.stress_measure = "second_piola_kirchhoff";
  const auto widest =
      designs(rivals.asked.inquiry(), nominal, rivals.first().extension->assembly(), rivals.first().fit.free);
  EXPECT_DOUBLE_EQ(strip_of(widest).sd[19], 1.6 * 1.6 * std::hypot(0.3, 0.02 * values[19] / (1.6 * 1.6)));
  for (const Design& design : library) {
    EXPECT_EQ(design.sd.size(), design.test->rows().count * design.test->rows().channels.size());
    for (const double sd : design.sd) EXPECT_GT(sd, 0) << design.description;
    // The data have no time: no cycle, no hold.
    EXPECT_THAT(design.description, Not(AnyOf(HasSubstr("cycle"), HasSubstr("held"))));
  }
}

}  // namespace
}  // namespace tunica::diagnosis
