// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/strip.hpp"

namespace tunica::data {
namespace {

using testing::by_force;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::read_strip;

/// "record_jump: strip.csv, line 2 …", one a finding.
std::vector<std::string> found(std::string_view text, const testing::Mapping& columns = {},
                               const DataRequest& request = {}) {
  std::vector<std::string> all;
  for (const Finding& finding : read_strip(text, columns, request).findings)
    all.push_back(fmt::format("{}: {}", text::code_of(finding_codes, finding.kind), finding.text));
  return all;
}

/// A pull to stretch 1.5 in 51 rows of a hardening strip, with a last digit that scatters.
std::string pull(const std::function<std::string(int, double, double)>& row) {
  std::string text = "stretch,stress [kPa]\n";
  for (int k = 0; k <= 50; ++k) text += row(k, 1 + 0.01 * k, std::expm1(0.06 * k) + 1e-3 * std::sin(7.0 * k));
  return text;
}

std::string plain(int, double stretch, double stress) { return fmt::format("{:.4f},{:.5f}\n", stretch, stress); }

TEST(Record, OfAnHonestPullRaisesNothing) { EXPECT_THAT(found(pull(plain)), IsEmpty()); }

TEST(Record, AfterABreakIsAskedAbout) {
  const std::string text = pull([](int k, double stretch, double stress) {
    return fmt::format("{:.4f},{:.5f}\n", stretch, k < 40 ? stress : 0.01 * (k % 3));
  });
  EXPECT_THAT(found(text), ElementsAre(::testing::AllOf(HasSubstr("record_broken: "), HasSubstr("line 42"),
                                                        HasSubstr("The 11 rows"), HasSubstr("\"rows\": \"0:40\""))));
  DataRequest cut;
  cut.rows.last = 40;
  EXPECT_THAT(found(text, {}, cut), IsEmpty());
}

/// A strip whose stiffness rises, and from the row `yields` on falls to `left` of what it was.
std::string yielding(int yields, double left) {
  std::string text = "stretch,stress [kPa]\n";
  double stress = 0, tangent = 0;
  for (int k = 0; k <= 80; ++k) {
    tangent = k < yields ? 1 + 0.1 * k : tangent;
    stress += (k < yields ? 1 : left) * tangent;
    text += fmt::format("{:.4f},{:.5f}\n", 1 + 0.005 * k, stress + 0.02 * std::sin(7.0 * k));
  }
  return text;
}

TEST(Record, WhoseStiffnessFallsIsAskedAbout) {
  EXPECT_THAT(found(yielding(60, 0.1)), ElementsAre(::testing::AllOf(HasSubstr("record_softening: "),
                                                                     HasSubstr("slip, yield or begin to tear"))));
  EXPECT_THAT(found(yielding(60, 0.8)), IsEmpty());
  EXPECT_THAT(found(yielding(100, 1)), IsEmpty());
  // Rubber softens first, and then stiffens; a spike of noise is no stiffness.
  std::string rubber = "stretch,stress [kPa]\n";
  for (int k = 0; k <= 80; ++k) {
    const double stretch = 1 + 0.05 * k;
    rubber += fmt::format("{:.4f},{:.5f}\n", stretch, 400 * (stretch - std::pow(stretch, -2)) + 3 * std::sin(7.0 * k));
  }
  EXPECT_THAT(found(rubber), IsEmpty());
}

TEST(Record, OfUnloadingAndOfRelaxationIsNoBreak) {
  std::string loop = "stretch,stress [kPa]\n", hold = loop;
  for (int k = 0; k <= 40; ++k) {
    const int up = k <= 20 ? k : 40 - k;
    loop += fmt::format("{:.4f},{:.5f}\n", 1 + 0.02 * up, (k <= 20 ? 1 : 0.6) * std::expm1(0.1 * up));
    hold += fmt::format("{:.4f},{:.5f}\n", 1 + 0.02 * std::min(k, 10),
                        k <= 10 ? 10.0 * k + 0.1 * std::sin(k) : 30 + 70 * std::exp(-0.2 * (k - 10)));
  }
  EXPECT_THAT(found(loop), IsEmpty());
  EXPECT_THAT(found(hold), IsEmpty());
}

TEST(Record, ThatBeginsWithASpikeIsAskedAbout) {
  const std::string text =
      pull([](int k, double stretch, double stress) { return plain(k, stretch, k == 0 ? 4.61 : stress); });
  EXPECT_THAT(found(text), ElementsAre(::testing::AllOf(HasSubstr("record_jump: "), HasSubstr("4.61 kPa"),
                                                        HasSubstr("spike"), HasSubstr("\"rows\": \"1:\""))));
}

TEST(Record, WithALoadAtRestIsAskedAbout) {
  const std::string text = pull([](int k, double stretch, double stress) { return plain(k, stretch, stress + 4); });
  EXPECT_THAT(found(text), ElementsAre(HasSubstr("Was the load not tared")));
}

TEST(Record, ThatWasAppendedToItselfIsAskedAbout) {
  std::string text = pull(plain);
  text += text.substr(text.find('\n') + 1);
  EXPECT_THAT(found(text), ElementsAre(::testing::AllOf(HasSubstr("record_repeated: "), HasSubstr("lines 53 to 103"),
                                                        HasSubstr("the same 51 rows"), HasSubstr("lines 2 to 52"))));
}

TEST(Record, OnACoarseGridIsAskedAbout) {
  std::string text = "stretch,stress [kPa]\n";
  for (int k = 0; k <= 80; ++k) text += fmt::format("{:.4f},{:.1f}\n", 1 + 0.005 * k, 0.5 * std::round(0.0016 * k * k));
  EXPECT_THAT(found(text), ElementsAre(::testing::AllOf(HasSubstr("record_coarse: "), HasSubstr("0.5 kPa apart"))));
}

TEST(Record, WhereCompressionMayBePositiveIsAskedAbout) {
  std::string cylinder = "Way [mm],Force [N]\n", text = "stretch,stress [kPa]\n";
  for (int k = 0; k <= 20; ++k) {
    cylinder += fmt::format("{:.2f},{:.4f}\n", 0.4 * k, 0.2 * std::expm1(0.15 * k));
    text += fmt::format("{:.3f},{:.4f}\n", 1 - 0.02 * k, 2 * std::expm1(0.15 * k));
  }
  DataRequest request = testing::strip_of(14, 11, 21);
  EXPECT_THAT(found(cylinder, by_force, request),
              ElementsAre(::testing::AllOf(HasSubstr("record_sign: "), HasSubstr("21 mm long and 11 mm thick"),
                                           HasSubstr("\"compression\": \"positive\""))));
  EXPECT_THAT(found(text), ElementsAre(HasSubstr("rows in compression ('stretch' below 1) have a positive stress")));
  request.compression.all = request.compression.said = true;
  EXPECT_THAT(found(cylinder, by_force, request), IsEmpty());
  const Dataset pressed = read_strip(cylinder, by_force, request);
  EXPECT_NEAR(pressed.abscissae[0].second.back(), 1 - 8.0 / 21, 1e-12);
  EXPECT_NEAR(pressed.channels[0].values.back(), -200 * std::expm1(3.0) / 154, 1e-3);
  EXPECT_THAT(found(cylinder, by_force, testing::strip_of(10, 1, 40)), IsEmpty()) << "slender, as a strip";
}

TEST(Record, OfAStrainThatLooksLikePercentIsAskedAbout) {
  const testing::Mapping columns = {{"strain", "Strain"}, {"stress", "Stress"}};
  std::string text = "Strain,Stress [kPa]\n", with_unit = "Strain [%],Stress [kPa]\n", rows;
  for (int k = 0; k <= 20; ++k) rows += fmt::format("{:.4f},{:.4f}\n", 0.3749 + 0.5 * k, 14 * std::expm1(0.1 * k));
  EXPECT_THAT(found(text + rows, columns),
              ElementsAre(::testing::AllOf(HasSubstr("record_percent: "), HasSubstr("{\"Strain\": \"%\"}"))));
  EXPECT_THAT(found(with_unit + rows, columns), IsEmpty());
  // Percent that stays low: 1.6 % is read as a stretch of 2.6, and 0.8 as one of 1.8, which many specimens have.
  const auto to = [&](double largest) {
    std::string low = text;
    for (int k = 0; k <= 20; ++k) low += fmt::format("{:.4f},{:.4f}\n", largest * k / 20, 14 * std::expm1(0.1 * k));
    return low;
  };
  EXPECT_THAT(found(to(1.6), columns), ElementsAre(HasSubstr("the stretch goes to 2.6. Is it percent?")));
  EXPECT_THAT(found(to(0.8), columns), IsEmpty());
  EXPECT_THAT(found(to(1.6), {{"green_strain", "Strain"}, {"stress", "Stress"}}),
              ElementsAre(HasSubstr("Is it percent?")));
}

TEST(Record, ThatTakesNoTimeOrHardlyDeformsIsAskedAbout) {
  const testing::Mapping columns = {{"stretch", "stretch"}, {"stress", "stress"}, {"time", "time"}};
  std::string fast = "time [s],stretch,stress [kPa]\n", slow = fast, stiff = "stretch,stress [kPa]\n";
  for (int k = 0; k <= 50; ++k) {
    const std::string row = plain(k, 1 + 0.01 * k, std::expm1(0.06 * k));
    fast += fmt::format("{:.3f},{}", 0.014 * k, row);
    slow += fmt::format("{:.3f},{}", 1.4 * k, row);
    stiff += plain(k, 1 + 0.0004 * k, std::expm1(0.06 * k));
  }
  EXPECT_THAT(found(fast, columns), ElementsAre(::testing::AllOf(HasSubstr("record_time: "), HasSubstr("0.7 s"))));
  EXPECT_THAT(found(slow, columns), IsEmpty());
  EXPECT_THAT(found(stiff), ElementsAre(::testing::AllOf(HasSubstr("record_short: "), HasSubstr("within 2 % of 1"))));
}

TEST(Record, SaysWhatEveryColumnIsTakenFor) {
  EXPECT_THAT(read_strip("stretch,stress [kPa]\n1,0\n1.1,2\n").understood,
              ElementsAre("stretch: 1 at rest, from 'stretch'", "stress: Cauchy stress (true), from 'stress' in kPa"));
  DataRequest request = testing::strip_of(10, 1, 20);
  request.rows.first = 1;
  EXPECT_THAT(read_strip("Way [mm],Force [N]\n0,0\n1,1\n2,3\n", by_force, request).understood,
              ElementsAre("stretch = 1 + displacement / 20 mm, from 'Way' in mm",
                          "stress = force / (10 mm × 1 mm): first Piola-Kirchhoff stress (nominal), from 'Force' in N",
                          "rows: 2 of the 3 in the file"));
}

}  // namespace
}  // namespace tunica::data
