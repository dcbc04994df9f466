// SPDX-License-Identifier: Apache-2.0
// A sphere on layers against Hertz, the published corrections and each other where both hold, and differences.
#include <cmath>

#include <gmock/gmock.h>

#include "data/written_file.hpp"
#include "rigs/rigs.hpp"

namespace tunica::testing::indentation_test {
namespace {

using ::testing::HasSubstr;

std::unique_ptr<Test> make_indentation(double radius, double thickness, const std::string& law,
                                       const std::vector<double>& depths) {
  return make_rig("indentation", {{"radius", radius}, {"thickness", thickness}, {"law", law}}, {{"depth", depths}},
                  {"force"});
}

// 16/9 E √R δ^(3/2) with E = 3μ; μ is 2 (c10 + c01) of Mooney's rubber and Σ μ_i α_i/2 of Ogden's.
TEST(Indentation, OfAHalfSpaceIsHertzs) {
  const std::vector<double> depths{0.05, 0.1, 0.2};
  const auto test = make_indentation(2, 0, "half_space", depths);
  Options one;
  one.set("terms", std::int64_t{1});
  for (const auto& [model, p, mu] : {std::tuple(make_model("neo_hooke"), std::vector<double>{30}, 30.),
                                     std::tuple(make_model("mooney_rivlin"), std::vector<double>{10, 4}, 28.),
                                     std::tuple(make_model("yeoh"), std::vector<double>{9, 2, 0.5}, 18.),
                                     std::tuple(make_model("ogden", one), std::vector<double>{12, 3}, 18.)}) {
    const auto force = predicted(*test, *model, p);
    for (std::size_t i = 0; i < depths.size(); ++i)
      EXPECT_NEAR(force[i] / (16. / 3 * mu * std::sqrt(2 * depths[i]) * depths[i]), 1, 1e-9);
  }
}

// The polynomials of Dimitriadis et al. at χ = 0.5, and that a thick layer is a half-space.
TEST(Indentation, OfALayerIsStiffer) {
  const auto model = make_model("neo_hooke");
  const double R = 8, h = 1, depth = 0.03125, hertz = 16. / 3 * 30 * std::sqrt(R * depth) * depth;  // χ = 0.5
  EXPECT_NEAR(predicted(*make_indentation(R, h, "bonded", {depth}), *model, {30})[0] / hertz,
              1 + 1.133 * 0.5 + 1.283 * 0.25 + 0.769 * 0.125 + 0.0975 * 0.0625, 1e-9);
  EXPECT_NEAR(predicted(*make_indentation(R, h, "sliding", {depth}), *model, {30})[0] / hertz,
              1 + 0.884 * 0.5 + 0.781 * 0.25 + 0.386 * 0.125 + 0.0048 * 0.0625, 1e-9);
  const double half = predicted(*make_indentation(1, 0, "half_space", {0.001}), *model, {30})[0];
  EXPECT_NEAR(predicted(*make_indentation(1, 12, "bonded", {0.001}), *model, {30})[0] / half, 1, 4e-3);
}

// Two groups, two ways, the same layer. Up to R/h = 2 they agree to a few per cent. There α and β of the deep law jump,
// as published, and beyond it lies up to 15 % above the other.
TEST(Indentation, HasTwoLawsOfABondedLayerThatAgree) {
  const auto model = make_model("neo_hooke");
  for (const auto& [h, apart] : {std::pair(0.6, 0.05), std::pair(1., 0.05), std::pair(3., 0.05),
                                 std::pair(1. / 3, 0.13), std::pair(0.125, 0.155)}) {
    const std::vector<double> depths{0.02 * std::min(h, 1.), 0.05 * std::min(h, 1.), 0.1 * std::min(h, 1.)};
    const auto bonded = predicted(*make_indentation(1, h, "bonded", depths), *model, {30}),
               deep = predicted(*make_indentation(1, h, "deep", depths), *model, {30});
    double furthest = 0;
    for (std::size_t i = 0; i < depths.size(); ++i) furthest = std::max(furthest, std::abs(deep[i] / bonded[i] - 1));
    EXPECT_LT(furthest, apart) << h;
    if (h < 0.5) EXPECT_GT(furthest, 0.1) << h;
  }
}

TEST(Indentation, HasExactDerivatives) {
  for (const auto& [type, p] :
       {std::pair("mooney_rivlin", std::vector<double>{10, 4}), std::pair("yeoh", std::vector<double>{9, 2, 0.5})})
    for (const char* law : {"bonded", "sliding", "deep"})
      expect_exact_derivatives(*make_indentation(1, 1.5, law, {0.02, 0.05, 0.08}), *make_model(type), p, {-0.01});
}

// Before it touches, the sphere bears nothing.
TEST(Indentation, BeginsAtContact) {
  const auto test = make_indentation(1, 0, "half_space", {-0.05, 0, 0.03});
  const auto found = predicted(*test, *make_model("neo_hooke"), {30}, {0.01});
  EXPECT_EQ(found[0], 0);
  EXPECT_EQ(found[1], 0);
  EXPECT_NEAR(found[2], 16. / 3 * 30 * std::pow(0.02, 1.5), 1e-10);
}

// The depth from contact has to be within the law, wherever the actuator counts from.
TEST(Indentation, CountsItsRangeFromContact) {
  const auto model = make_model("neo_hooke");
  const auto why = [&](double radius, double depth, double contact) {
    std::vector<double> force(1);
    const std::vector<double> p{30}, own{contact};
    return make_indentation(radius, 0, "half_space", {depth})->predict({*model, p, own}, {force, {}, {}, {}}).reason();
  };
  EXPECT_EQ(why(1, 0.1, 0), "");
  EXPECT_THAT(why(1, 0.2, 0), HasSubstr("row 1 has depth 0.2 mm, 0.2 mm from contact, and the law holds to 0.1 mm"));
  EXPECT_THAT(why(1, 0.09, -0.02), HasSubstr("0.11 mm from contact"));
  EXPECT_EQ(why(1, 7.08, 7), "");
  EXPECT_THAT(why(1, 7.2, 7), HasSubstr("0.2 mm from contact"));
  for (const double radius : {0.005, 1., 20.}) {
    const Parameter contact = make_indentation(radius, 0, "half_space", {0})->describe().parameters[0];
    EXPECT_DOUBLE_EQ(contact.max, 0.1 * radius);
    EXPECT_DOUBLE_EQ(contact.min, -0.1 * radius);
  }
}

// The deep law is of a neo-Hookean layer: others have to be alike at the strains of the test.
TEST(Indentation, IsDeepOnlyInWhatIsNeoHookean) {
  const auto shallow = make_indentation(1, 1, "deep", {0.02, 0.05}), deep = make_indentation(1, 1, "deep", {0.05, 0.5});
  const auto expected = predicted(*deep, *make_model("neo_hooke"), {30});
  const auto gent = make_model("gent"), mooney = make_model("mooney_rivlin");
  EXPECT_NEAR(predicted(*deep, *gent, {30, 1e4})[1], expected[1], 1e-9);
  EXPECT_NEAR(predicted(*deep, *mooney, {15, 0})[1], expected[1], 1e-9);
  // Gent's strip bears Jm/(Jm − I1 + 3) times as much: I1 − 3 is 1.25 at 0.5, and 2 at 2.
  EXPECT_GT(predicted(*deep, *gent, {30, 2 * 1.05 / 0.05 + 1})[1], 0);
  EXPECT_THAT(failure(*deep, *gent, {30, 2 * 1.05 / 0.05 - 1}),
              HasSubstr("a strip at a stretch of 2 bears 1.05 times the stress of a neo-Hookean one"));
  EXPECT_GT(predicted(*shallow, *gent, {30, 5})[1], 0);
  // Mooney's (c10 + c01/λ)/(c10 + c01).
  EXPECT_THAT(failure(*deep, *mooney, {12, 3}), HasSubstr("a strip at a stretch of 0.5 bears 1.2 times"));
  EXPECT_GT(predicted(*shallow, *mooney, {12, 3})[1], 0);
}

TEST(Indentation, RefusesWhatItsLawsAreNotOf) {
  const auto refusal = [](double radius, double thickness, const std::string& law, double depth) {
    return message_of<InputError>([&] { (void)make_indentation(radius, thickness, law, {depth}); });
  };
  EXPECT_THAT(refusal(0, 0, "half_space", 0.1), HasSubstr("\"radius\" is 0 mm"));
  EXPECT_THAT(refusal(1, 0, "bonded", 0.1), HasSubstr("give the thickness of the unloaded layer"));
  EXPECT_THAT(refusal(1, 2, "half_space", 0.1), HasSubstr("or take the thickness out"));
  EXPECT_THAT(refusal(20, 1, "bonded", 0.05), HasSubstr("20 times the thickness of the layer, and the law holds from"));
  EXPECT_THAT(message_of<InputError>([] {
                (void)make_rig("indentation", {{"radius", 1.}}, {}, {"force"});
              }),
              HasSubstr("no column is mapped to 'depth'"));
  EXPECT_THAT(failure(*make_indentation(1, 0, "half_space", {0.05}), *make_model("gho"), {20, 0.1, 30, 1, 40}),
              HasSubstr("the material has directions"));
}

}  // namespace
}  // namespace tunica::testing::indentation_test
