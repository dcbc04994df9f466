// SPDX-License-Identifier: Apache-2.0
#include "report/page.hpp"

#include <gmock/gmock.h>

#include "report/page_parts.hpp"
#include "report/pieces.hpp"
#include "report/report.hpp"
#include "scratch.hpp"

using namespace tunica;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

const std::string hostile =
    "</script><script>window.hacked=1</script><img src=x onerror=window.hacked=1>\"'&\xE2\x80\xA8";

/// The page without what every page carries.
std::string own_part(std::string text) {
  for (const auto part : {report::page_library, report::page_script, report::page_style}) {
    const auto at = text.find(part);
    if (at != text.npos) text.erase(at, part.size());
  }
  return text;
}

}  // namespace

TEST(Page, HostileNamesAreText) {
  report::Page page(hostile);
  page.section(hostile);
  page.heading(hostile);
  page.paragraph(hostile);
  page.box("bad", hostile, {hostile});
  page.words({{hostile, hostile}});
  page.command(hostile);
  page.html(report::table_html({hostile}, {{{hostile}}}));
  report::Chart chart;
  chart.id = chart.title = chart.about = chart.note = chart.x.title = chart.y.title = hostile;
  chart.files = {hostile};
  chart.series.push_back({hostile, "line", 0, {1, 2}, {1, 2}});
  page.chart(std::move(chart), hostile);
  const std::string text = own_part(page.document());
  EXPECT_THAT(text, Not(HasSubstr("<img")));
  EXPECT_THAT(text, Not(HasSubstr("<script>window")));
  const std::string data = text.substr(text.find("id=\"charts\">"));
  EXPECT_THAT(data, Not(HasSubstr("\xE2\x80\xA8")));
  EXPECT_THAT(data, HasSubstr("\\u2028"));
  EXPECT_THAT(text, HasSubstr("&lt;img src=x"));
}

TEST(Page, AsksNoneButItselfAndRunsNoScriptButItsOwn) {
  const std::string text = report::Page("a").document();
  EXPECT_THAT(text, HasSubstr("default-src &#39;none&#39;; script-src &#39;sha256-"));
  EXPECT_THAT(own_part(text), Not(HasSubstr("://")));
}

TEST(Page, EmptyChartsAreLeftOut) {
  report::Page page("a");
  page.chart({});
  EXPECT_EQ(page.chart_count(), 0u);
  EXPECT_THAT(own_part(page.document()), Not(HasSubstr("<figure")));
}

TEST(Report, OfAnEmptyResultSaysThatThereIsNone) {
  const trial::Scratch scratch;
  scratch.write("result.json", R"({"format": 1})");
  EXPECT_THAT(report::report({scratch.path()}, scratch.path()), HasSubstr("No run has a result."));
}

TEST(Report, TakesWrongTypesEverywhere) {
  const trial::Scratch scratch;
  for (
      const char* text :
      {R"({"format": 1, "name": 3, "runs": {"a": 1}, "ranking": [1, null, {"run": 2, "rank": "x"}], "warnings": "w", "provenance": []})",
       R"({"format": 1, "runs": [{"run": "a", "best": {"parameters": {"k": 1}, "per_test": [1], "stability": 3}}],
            "ranking": [{"run": "a", "rank": 1, "group": "g"}]})",
       R"({"format": 1, "diagnosis": {"verdict": 1, "causes": [{"amplitude": [1]}], "misfit": [null], "gain": {"held_out": [1]},
            "scores": [{}], "detectable": [[]], "noise": {"a": 1}, "alternatives": [3]}})"}) {
    scratch.write("result.json", text);
    EXPECT_THAT(report::report({scratch.path()}, scratch.path()), HasSubstr("</html>")) << text;
  }
}

TEST(Report, SaysHowManyRealisationsItDraws) {
  const trial::Scratch scratch;
  std::string convergence = "run,realisation,evaluation,objective\n";
  for (int k = 1; k <= 300; ++k)
    convergence += "m/o," + std::to_string(k) + ",1,9\nm/o," + std::to_string(k) + ",50," + std::to_string(k) + '\n';
  scratch.write("convergence.csv", convergence);
  scratch.write(
      "result.json",
      R"({"format": 1, "runs": [{"run": "m/o", "model": "m", "optimizer": "o", "best": {"objective": 1, "parameters": {}}}],
                    "ranking": [{"run": "m/o", "rank": 1, "group": "g", "objective": 1}]})");
  EXPECT_THAT(report::report({scratch.path()}, scratch.path()), HasSubstr("100 of 300 realisations are drawn"));
}

TEST(Report, LinksTablesOfFoldersElsewhere) {
  const trial::Scratch scratch;
  scratch.write("tube.csv", "pressure [kPa],diameter [1]\n0,1\n1,2\n");
  EXPECT_THAT(report::report({scratch.path(), scratch.path()}, scratch.path().parent_path()),
              HasSubstr("href=\"" + scratch.path().filename().string() + "/tube.csv\""));
}

TEST(Figures, AreShortAndCountsAreWhole) {
  EXPECT_EQ(report::figure(30000), "30000");
  EXPECT_EQ(report::figure(0.123456), "0.1235");
  EXPECT_EQ(report::figure(11003.7), "11004");
  EXPECT_EQ(report::figure(1.234567e10), "1.235e+10");
  EXPECT_EQ(report::figure(NAN), "–");
  EXPECT_EQ(report::amount(2.5, "kPa"), "2.5 kPa");
  EXPECT_EQ(report::amount(2.5, "1"), "2.5");
  EXPECT_EQ(report::chance(1e-9), "p < 0.0001");
  EXPECT_EQ(report::chance(5e-4), "p = 0.0005");
  EXPECT_EQ(report::chance(5e-4, true), "p ≤ 0.0005");
  EXPECT_EQ(report::chance(NAN, true), "–");
  EXPECT_EQ(report::share(0.5), "0.5");
}
