// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include "cache.hpp"
#include "curve.hpp"
#include "execution/folder.hpp"
#include "results.hpp"
#include "text_template.hpp"

using namespace tunica;
using namespace tunica::external;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

namespace {

std::variant<std::vector<double>, std::string> read(const std::string& text, ResultPlace::Kind kind,
                                                    const std::string& what, double factor = 1) {
  const trial::Folder folder;
  folder.write("out", text);
  return read_result({"force", "out", kind, what, factor, {}}, folder.path());
}

std::vector<double> values(const std::variant<std::vector<double>, std::string>& found) {
  if (const auto* problem = std::get_if<std::string>(&found)) ADD_FAILURE() << *problem;
  return std::holds_alternative<std::string>(found) ? std::vector<double>{} : std::get<0>(found);
}

std::string problem(const std::variant<std::vector<double>, std::string>& found) {
  return std::holds_alternative<std::string>(found) ? std::get<1>(found) : "";
}

}  // namespace

TEST(TextTemplate, FillsPlacesAndLeavesOtherBraces) {
  const TextTemplate text("a {{mu}} b {{ c10 MPa }} {{1}} { x } {{card}}}}");
  ASSERT_EQ(text.places().size(), 3U);
  EXPECT_EQ(text.places()[1].name, "c10");
  EXPECT_EQ(text.places()[1].unit, "MPa");
  EXPECT_EQ(text.filled([](const TextTemplate::Place& place) { return "<" + place.name + ">"; }),
            "a <mu> b <c10> {{1}} { x } <card>}}");
}

TEST(TextTemplate, NumbersFitIntoTwentyColumns) {
  for (const double value : {1 / 3.0, -1.23456789012345e-200, 1e300, -0.000123456789012345, 5.0})
    EXPECT_LE(number(value).size(), 19U);
  EXPECT_EQ(number(5), "5");
}

TEST(Results, TablesWithNamesNumbersAndFortransExponents) {
  using enum ResultPlace::Kind;
  EXPECT_THAT(values(read("u;F\n1;2\n3;4\n", column, "F", 1000)), ElementsAre(2000, 4000));
  EXPECT_THAT(values(read("# comment\n 1  2.5D-01\n 2  +3\n\n", column, "2")), ElementsAre(0.25, 3));
  EXPECT_THAT(values(read("\"u\",\"F\"\n1,2\n", column, "2")), ElementsAre(2));
  EXPECT_THAT(problem(read("u,F\n1,2\n", column, "G")), HasSubstr("names u, F"));
  EXPECT_THAT(problem(read("u,F\n1,x\n", column, "F")), HasSubstr("'x' in column F of line 2"));
}

TEST(Results, JsonAndPatterns) {
  using enum ResultPlace::Kind;
  EXPECT_THAT(values(read(R"({"a": {"f": [1, 2]}, "b": 3})", pointer, "/a/f")), ElementsAre(1, 2));
  EXPECT_THAT(values(read(R"({"a": {"f": [1, 2]}, "b": 3})", pointer, "/b")), ElementsAre(3));
  EXPECT_THAT(problem(read(R"({"a": "x"})", pointer, "/a")), HasSubstr("at /a"));
  EXPECT_THAT(problem(read("{", pointer, "/a")), HasSubstr("no JSON"));
  const std::string text =
      " total force (fx,fy,fz) for set TOP and time 0.5\n\n 1.0E0 2.0E0 -3.0E+00\n"
      " total force (fx,fy,fz) for set TOP and time 1.0\n\n 1.0E0 2.0E0 -4.0E+00\n";
  EXPECT_THAT(values(read(text, pattern, R"(set TOP and time [^\n]*\n\s*\S+\s+\S+\s+(\S+))")), ElementsAre(-3, -4));
  EXPECT_THAT(values(read(text, pattern, R"(set TOP and time (\S+))")), ElementsAre(0.5, 1));
  EXPECT_THAT(values(read("a\nF = 3\nb", pattern, "^F = (\\S+)$")), ElementsAre(3));
  EXPECT_THAT(values(read(std::string(4'000'000, 'x') + "F = 3\n", pattern, R"(^[^F]*F = (\S+))")), ElementsAre(3));
  EXPECT_THAT(problem(read(text, pattern, "F=(.)")), HasSubstr("nothing that matches"));
  EXPECT_THAT(problem(read("F=nan", pattern, "F=(\\S+)")), HasSubstr("not finite"));
}

TEST(Curve, PassesThroughItsPointsAndFollowsASmoothFunction) {
  std::vector<double> x, y;
  for (int k = 0; k <= 40; ++k) {
    x.push_back(0.05 * k);
    y.push_back(std::exp(0.05 * k));
  }
  const Curve curve(x, y);
  ASSERT_EQ(curve.problem(), "");
  EXPECT_EQ(curve(x[7]), y[7]);
  EXPECT_NEAR(curve(1.03), std::exp(1.03), 1e-4);
  const double h = 1e-6;
  EXPECT_NEAR(curve.slope(1.03), (curve(1.03 + h) - curve(1.03 - h)) / (2 * h), 1e-6);
  std::reverse(x.begin(), x.end());
  std::reverse(y.begin(), y.end());
  EXPECT_EQ(Curve(x, y)(1.03), curve(1.03));
}

TEST(Curve, TwoPointsAreALineAndTurningsAreRefused) {
  const Curve line({0, 2}, {1, 5});
  EXPECT_EQ(line(0.5), 2);
  EXPECT_EQ(line.slope(0.5), 2);
  EXPECT_TRUE(line.reaches(2));
  EXPECT_FALSE(line.reaches(2.1));
  EXPECT_THAT(Curve({0, 1, 0.5, 2}, {0, 0, 0, 0}).problem(), HasSubstr("turns"));
}

TEST(Cache, KeepsInMemoryAndInAFolder) {
  const trial::Folder folder;
  const Numbers numbers{{1.0 / 3, 2}, {3}};
  Cache(folder.path() / "a/b", numbers.size()).keep("key", numbers);
  EXPECT_EQ(Cache(folder.path() / "a/b", numbers.size()).find("key"), numbers);
  EXPECT_EQ(Cache({}, numbers.size()).find("key"), std::nullopt);
  // A changed digit, or the result of another question, is none.
  const auto file = folder.path() / "a/b/key.json";
  const std::string text = trial::text_of(file);
  std::filesystem::copy(file, folder.path() / "a/b/other.json");
  EXPECT_EQ(Cache(folder.path() / "a/b", numbers.size()).find("other"), std::nullopt);
  for (std::size_t place = 0; place < text.size(); ++place) {
    std::string changed = text;
    changed[place] = changed[place] == '7' ? '8' : '7';
    folder.write("a/b/key.json", changed);
    EXPECT_EQ(Cache(folder.path() / "a/b", numbers.size()).find("key"), std::nullopt) << changed;
  }
  // Nothing is written through a link that somebody has planted.
  const auto victim = folder.write("victim", "mine");
  std::filesystem::create_symlink(victim, folder.path() / "a/b" / fmt::format("key.{}.part", getpid()));
  Cache(folder.path() / "a/b", numbers.size()).keep("key", numbers);
  EXPECT_EQ(trial::text_of(victim), "mine");
  EXPECT_EQ(trial::text_of(file), text);
  EXPECT_EQ(digest("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
}

TEST(TextTemplate, OfBracesAloneTakesTimeInProportion) {
  std::string text;
  for (int i = 0; i < 400'000; ++i) text += "{{";  // squared, 33 s for a tenth of it
  const TextTemplate made(text + " mu}} {{mu}}");
  EXPECT_EQ(made.places().size(), 2U);
}

TEST(Cache, AFileThatCannotBeReadIsNoAnswer) {
  const trial::Folder folder;
  const Numbers numbers{{1, 2, 3}};
  Cache(folder.path() / "c", 1).keep("key", numbers);
  const auto file = std::filesystem::directory_iterator(folder.path() / "c")->path();
  std::filesystem::remove(file);
  std::filesystem::create_directory(file);  // reading it fails, as on a faulty disk
  EXPECT_EQ(Cache(folder.path() / "c", 1).find("key"), std::nullopt);
}

TEST(Results, DeepJsonAndColumnsThatAreNoneAreRefused) {
  using Kind = ResultPlace::Kind;
  const std::string deep = R"({"force": )" + std::string(80'000, '[') + std::string(80'000, ']') + "}";
  EXPECT_THAT(problem(read(deep, Kind::pointer, "/force")), HasSubstr("more than 64 levels of nesting"));
  for (const char* column : {"1.5", "1e30", "0"})
    EXPECT_THAT(problem(read("1 2\n3 4\n", Kind::column, column)), HasSubstr("has no column")) << column;
}
