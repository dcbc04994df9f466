// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conformance/test_properties.hpp"
#include "support/strip.hpp"

namespace tunica::testing::uniaxial_test {
using namespace conformance;
using ::testing::HasSubstr;
namespace {

/// Set S of Canales et al. 2023: mu, kappa, k1, k2, theta.
const std::vector<double> set_s{18.668, 0.1367, 24.905, 0.2912, 46.44};

struct Reference {
  double stretch, circumferential, circumferential_transverse, axial, axial_transverse;
};
// physics, section 9: an independent implementation (60 bisections), good to 1e-8 relative.
constexpr Reference references[] = {{1.1, 6.68600383, 0.94105519, 6.29738969, 0.94282543},
                                    {1.3, 26.03758025, 0.83502600, 23.65781361, 0.83773439},
                                    {1.5, 59.13356144, 0.74734160, 52.36950158, 0.74906183},
                                    {1.8, 159.17183865, 0.64544435, 136.00590423, 0.64539388}};

TEST(Uniaxial, ReproducesTheReferenceValues) {
  const auto model = make_model("gho");
  // Four rows start cold; forty start from the interpolated Chebyshev points. Both must hit the values.
  for (const std::size_t filling : {0u, 40u}) {
    std::vector<double> stretch = filling > 0 ? evenly(1, 1.8, filling) : std::vector<double>{};
    for (const Reference& reference : references) stretch.push_back(reference.stretch);
    const Prediction circ = predict(*make_strip(stretch), *model, set_s);
    const Prediction axial = predict(*make_strip(stretch, {.direction = "axial"}), *model, set_s);
    ASSERT_TRUE(circ.status.ok() && axial.status.ok());
    for (std::size_t i = 0; i < 4; ++i) {
      const Reference& r = references[i];
      EXPECT_NEAR(circ.values[filling + i] / r.circumferential, 1, 1e-7);
      EXPECT_NEAR(axial.values[filling + i] / r.axial, 1, 1e-7);
      EXPECT_NEAR(circ.diagnostics[filling + i], r.circumferential_transverse, 1e-8);
      EXPECT_NEAR(axial.diagnostics[filling + i], r.axial_transverse, 1e-8);
    }
  }
}

/// Lateral equilibrium and stress of the gho, once more by bisection in extended precision.
struct Bisected {
  long double stress, transverse;
};
Bisected bisect(const std::vector<double>& p, double stretch, bool circumferential) {
  using std::exp;
  const long double theta = p[4] * std::acos(-1.0L) / 180, c1 = static_cast<long double>(stretch) * stretch;
  const long double s2 = std::pow(std::sin(theta), 2.0L), k = p[1];
  const long double along = circumferential ? s2 : 1 - s2;
  const auto forces = [&](long double u, long double& stress) {
    const long double c3 = 1 / (c1 * u), e = k * (c1 + u + c3) + (1 - 3 * k) * (along * c1 + (1 - along) * u) - 1;
    const long double first = e > 0 ? 2 * p[2] * e * exp(p[3] * e * e) : 0;  // both families
    const long double a1 = k + (1 - 3 * k) * along, a2 = k + (1 - 3 * k) * (1 - along);
    stress = 2 * (c1 * (p[0] / 2.0L + first * a1) - c3 * (p[0] / 2.0L + first * k));
    return p[0] / 2.0L * (u - c3) + first * (u * a2 - c3 * k);  // no ∞ − ∞
  };
  long double low = -12, high = 12, stress = 0;  // ln u
  for (int i = 0; i < 100; ++i) {
    const long double middle = (low + high) / 2;
    (forces(exp(middle), stress) > 0 ? high : low) = middle;
  }
  return {stress, exp((low + high) / 4)};
}

/// A strip through the thickness of a gho wall, by bisection over ln of the circumferential stretch squared: both
/// families are stretched by the lateral faces alone.
Bisected bisect_through_the_wall(const std::vector<double>& p, double stretch) {
  using std::exp;
  const long double theta = p[4] * std::acos(-1.0L) / 180, c3 = static_cast<long double>(stretch) * stretch;
  const long double s2 = std::pow(std::sin(theta), 2.0L), k = p[1];
  const auto forces = [&](long double t, long double& stress) {
    const long double z = 1 / (c3 * t), e = k * (c3 + t + z) + (1 - 3 * k) * (s2 * t + (1 - s2) * z) - 1;
    const long double first = e > 0 ? 2 * p[2] * e * exp(p[3] * e * e) : 0;  // both families
    const long double at = k + (1 - 3 * k) * s2, az = k + (1 - 3 * k) * (1 - s2);
    stress = 2 * (c3 * (p[0] / 2.0L + first * k) - z * (p[0] / 2.0L + first * az));
    return p[0] / 2.0L * (t - z) + first * (t * at - z * az);
  };
  long double low = -12, high = 12, stress = 0;
  for (int i = 0; i < 100; ++i) {
    const long double middle = (low + high) / 2;
    (forces(exp(middle), stress) > 0 ? high : low) = middle;
  }
  return {stress, exp((low + high) / 4)};
}

TEST(Uniaxial, AlongTheRadiusIsTheBisection) {
  const auto model = make_model("gho");
  const std::vector<double> stretch{0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.05, 1.2, 1.6, 2.5};
  const Prediction found = predict(*make_strip(stretch, {.direction = "radial"}), *model, set_s);
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const Bisected right = bisect_through_the_wall(set_s, stretch[i]);
    EXPECT_NEAR(found.values[i], static_cast<double>(right.stress), 1e-9 * std::abs(found.values[i]));
    EXPECT_NEAR(found.diagnostics[i], static_cast<double>(right.transverse), 1e-9);
  }
}

// Families at 45 deg, perpendicular to the load: λt = λz = λ^(−1/2), and E = 1/λ − 1 pulls where λ < 1:
// σ = μ (λ² − 1/λ) − 2 k1 E exp(k2 E²)/λ.
TEST(Uniaxial, AlongTheRadiusOfHgoHasAClosedForm) {
  const auto model = make_model("hgo");
  const std::vector<double> p{12, 20, 0.8, 45}, stretch{0.6, 0.75, 0.9, 1.1, 1.5};
  const Prediction found = predict(*make_strip(stretch, {.direction = "radial"}), *model, p);
  ASSERT_TRUE(found.status.ok()) << found.status.reason();
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const double l = stretch[i], e = l < 1 ? 1 / l - 1 : 0;
    const double right = p[0] * (l * l - 1 / l) - 2 * p[1] * e * std::exp(p[2] * e * e) / l;
    EXPECT_NEAR(found.values[i], right, 1e-9 * std::abs(right));
    EXPECT_NEAR(found.diagnostics[i], 1 / std::sqrt(l), 1e-9);
  }
}

TEST(Uniaxial, AlongTheRadiusOfAnIsotropicModelIsAnyStrip) {
  const std::vector<double> stretch{0.6, 0.9, 1.3, 2, 3};
  for (const char* type : {"neo_hooke", "yeoh", "mooney_rivlin", "ogden"}) {
    const auto model = make_model(type);
    std::vector<double> p;
    for (const Parameter& parameter : model->describe().parameters) p.push_back(parameter.initial);
    const Prediction radial = predict(*make_strip(stretch, {.direction = "radial"}), *model, p);
    const Prediction axial = predict(*make_strip(stretch, {.direction = "axial"}), *model, p);
    ASSERT_TRUE(radial.status.ok() && axial.status.ok()) << type;
    for (std::size_t i = 0; i < stretch.size(); ++i)
      EXPECT_NEAR(radial.values[i], axial.values[i], 1e-9 * std::abs(axial.values[i])) << type;
  }
}

TEST(Uniaxial, ConvergesForAnyAdmissibleParametersOrSaysThatItOverflows) {
  // 4000 sets over the whole box (seed 5, deterministic), stretch 0.6 to 2.5. Either the answer is bisection's to
  // 1e-9, or the evaluation failed and bisection confirms that a double cannot hold the stress.
  const auto model = make_model("gho");
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::size_t failures = 0;
  for (int draw = 0; draw < 4000; ++draw) {
    std::vector<double> p;
    for (const Parameter& parameter : model->describe().parameters)
      p.push_back(parameter.scale == Scale::log ? parameter.min * std::pow(parameter.max / parameter.min, unit(engine))
                                                : parameter.min + (parameter.max - parameter.min) * unit(engine));
    const bool circumferential = unit(engine) < 0.5;
    const std::vector<double> stretch = evenly(draw % 4 == 0 ? 0.6 : 1, 1 + 1.5 * unit(engine), draw % 2 == 0 ? 5 : 40);
    const auto strip = make_strip(stretch, {.direction = circumferential ? "circumferential" : "axial"});
    const Prediction out = predict(*strip, *model, p);
    if (!out.status.ok()) {
      ++failures;
      EXPECT_EQ(out.status.kind(), Status::Kind::failed);
      EXPECT_NE(out.status.reason().find("row "), std::string::npos) << out.status.reason();
      long double largest = 0;
      for (const double l : stretch) largest = std::max(largest, std::abs(bisect(p, l, circumferential).stress));
      EXPECT_GT(largest, 1e290L) << out.status.reason() << " p = " << p[0] << " " << p[1] << " " << p[2] << " " << p[3]
                                 << " " << p[4];
      continue;
    }
    for (std::size_t i = 0; i < stretch.size(); ++i) {
      const Bisected exact = bisect(p, stretch[i], circumferential);
      ASSERT_NEAR(out.values[i], static_cast<double>(exact.stress),
                  1e-9 * (p[0] + std::abs(static_cast<double>(exact.stress))))
          << "row " << i << " stretch " << stretch[i] << " p = " << p[0] << " " << p[1] << " " << p[2] << " " << p[3]
          << " " << p[4];
    }
  }
  EXPECT_GT(failures, 0u);  // the box does reach overflow, so that path was taken
  EXPECT_LT(failures, 400u);
}

class UniaxialConformance
    : public ::testing::TestWithParam<std::tuple<const char*, const char*, double, TestProperty>> {};

TEST_P(UniaxialConformance, Holds) {
  const auto [direction, measure, misalignment, property] = GetParam();
  const auto strip =
      make_strip(evenly(1.02, 1.7, 25), {direction, {"transverse_stretch", "stress", "normal_stretch"}, measure, {}});
  const auto gho = make_model("gho");
  EXPECT_EQ(property.check({*strip, *gho, set_s, {misalignment}}).counter_example, "") << property.name;
  const auto hgo = make_model("hgo");
  EXPECT_EQ(property.check({*strip, *hgo, {20, 15, 0.5, 40}, {misalignment}}).counter_example, "") << property.name;
}

INSTANTIATE_TEST_SUITE_P(All, UniaxialConformance,
                         ::testing::Combine(::testing::Values("circumferential", "axial", "radial"),
                                            ::testing::Values("cauchy", "first_piola_kirchhoff",
                                                              "second_piola_kirchhoff"),
                                            ::testing::Values(0., 4.), ::testing::ValuesIn(test_properties())),
                         [](const auto& at) {
                           return fmt::format("{}_{}_by_{:.0f}_degrees_{}", std::get<0>(at.param),
                                              std::get<1>(at.param), std::get<2>(at.param), std::get<3>(at.param).name);
                         });

TEST(Uniaxial, OverflowIsAStatusOnBothPaths) {
  const auto model = make_model("gho");
  const std::vector<double> stiff{10, 0.1, 500, 100, 90};
  for (const double misalignment : {0., 3.})
    for (const std::size_t rows : {5u, 40u})
      EXPECT_EQ(overflow_is_a_status({*make_strip(evenly(1, 3, rows)), *model, stiff, {misalignment}}).counter_example,
                "");
}

/// With dispersion, fibres that switch by their own stretch do so under load: at some stretches ½ ∂W/∂ln λ2² jumps from
/// below zero to above, and there is no equilibrium. At rest and behind these there is one.
TEST(Uniaxial, AJumpIsNoEquilibrium) {
  Options options;
  options.set("fibre_switch", std::string("stretch"));
  const auto model = make_model("gho", options);
  const double mu = 10, kappa = 0.2, k1 = 200, k2 = 1, theta = 35;
  const auto jumps = [&](double stretch) {
    const double s2 = std::pow(std::sin(theta * std::acos(-1) / 180), 2), c1 = stretch * stretch;
    const double u = (1 - s2 * c1) / (1 - s2), c3 = 1 / (c1 * u);  // the fibres' own stretch is 1
    const double e = kappa * (c1 + u + c3 - 3), first = 2 * k1 * e * std::exp(k2 * e * e);
    const double slack = mu / 2 * (u - c3), of_fibres = first * (u * (kappa + (1 - 3 * kappa) * (1 - s2)) - c3 * kappa);
    return u > 0 && slack < 0 && slack + of_fibres > 0;
  };
  for (const double stretch : {1.0, 1.05, 1.2, 1.29, 1.8})
    for (const double misalignment : {0., 1e-7})
      for (const std::vector<std::string>& channels :
           {std::vector<std::string>{"stress"}, std::vector<std::string>{"stress", "transverse_stretch"}}) {
        const auto strip = make_strip({stretch}, {.channels = channels});
        const Prediction found = predict(*strip, *model, {mu, kappa, k1, k2, theta}, misalignment);
        EXPECT_EQ(found.status.ok(), !jumps(stretch)) << stretch << ' ' << misalignment << ' ' << found.status.reason();
        if (jumps(stretch)) {
          EXPECT_THAT(found.status.reason(), HasSubstr("jumps from one sign to the other"));
        }
      }
  EXPECT_TRUE(jumps(1.05) && jumps(1.2));
  EXPECT_FALSE(jumps(1) || jumps(1.8));
  EXPECT_THAT(predict(*make_strip(evenly(1, 1.7, 40)), *model, {mu, kappa, k1, k2, theta}).status.reason(),
              HasSubstr("jumps from one sign to the other, at row"));
}

TEST(Uniaxial, TensorsGiveWhatTheAxesGive) {
  const auto model = make_model("holzapfel_2015");
  const std::vector<double> p{22, 0.2, 0.4, 15, 0.5, 60}, stretch = evenly(0.9, 1.8, 30);
  for (const char* direction : {"circumferential", "axial"}) {
    const auto strip = make_strip(stretch, {.direction = direction, .channels = {"stress", "transverse_stretch"}});
    const Prediction axes = predict(*strip, *model, p, 0, true), tensors = predict(*strip, *model, p, 1e-7, true);
    ASSERT_TRUE(axes.status.ok() && tensors.status.ok()) << tensors.status.reason();
    for (std::size_t i = 0; i < axes.values.size(); ++i) {
      EXPECT_NEAR(axes.values[i], tensors.values[i], 1e-9 * (1 + std::abs(axes.values[i])));
      EXPECT_NEAR(axes.abscissa_derivative[i], tensors.abscissa_derivative[i],
                  1e-8 * (1 + std::abs(axes.abscissa_derivative[i])));
    }
    for (std::size_t i = 0; i < p.size() * axes.values.size(); ++i)
      EXPECT_NEAR(axes.jacobian[i], tensors.jacobian[i], 1e-7 * (1 + std::abs(axes.jacobian[i]))) << i;
  }
}

TEST(Uniaxial, SeesTheFamiliesApartOnAMisalignedSpecimen) {
  // Even in the angle: the mirrored specimen is the same one. And turning by 90° swaps the directions.
  const auto model = make_model("gho");
  const std::vector<double> stretch = evenly(1, 1.6, 20);
  const auto circ = make_strip(stretch), axial = make_strip(stretch, {.direction = "axial"});
  const Prediction plus = predict(*circ, *model, set_s, 7), minus = predict(*circ, *model, set_s, -7);
  const Prediction straight = predict(*circ, *model, set_s), turned = predict(*circ, *model, set_s, 90),
                   other = predict(*axial, *model, set_s);
  for (std::size_t i = 1; i < stretch.size(); ++i) {
    EXPECT_NEAR(plus.values[i], minus.values[i], 1e-10 * plus.values[i]);
    EXPECT_GT(std::abs(plus.values[i] - straight.values[i]), 1e-5 * straight.values[i]);
    EXPECT_NEAR(turned.values[i], other.values[i], 1e-9 * other.values[i]);
  }
}

TEST(Uniaxial, NeoHookeHasItsClosedForm) {
  const auto model = make_model("neo_hooke");
  const std::vector<double> stretch = evenly(0.5, 4, 50);
  const Prediction cauchy = predict(*make_strip(stretch), *model, {7});
  const Prediction nominal = predict(*make_strip(stretch, {.measure = "first_piola_kirchhoff"}), *model, {7});
  const Prediction second = predict(*make_strip(stretch, {.measure = "second_piola_kirchhoff"}), *model, {7});
  for (std::size_t i = 0; i < stretch.size(); ++i) {
    const double l = stretch[i], exact = 7 * (l * l - 1 / l);
    EXPECT_NEAR(cauchy.values[i], exact, 1e-10 * (1 + std::abs(exact)));
    EXPECT_NEAR(nominal.values[i], exact / l, 1e-10 * (1 + std::abs(exact)));
    EXPECT_NEAR(second.values[i], exact / (l * l), 1e-10 * (1 + std::abs(exact)));
    EXPECT_NEAR(cauchy.diagnostics[i], 1 / std::sqrt(l), 1e-10);
  }
}

TEST(Uniaxial, TakesOtherAbscissaeThanTheBoundOnes) {
  const auto model = make_model("gho");
  const std::vector<double> bound = evenly(1, 1.5, 20), other = evenly(1.01, 1.6, 20);
  const auto strip = make_strip(bound);
  std::vector<double> values(20);
  const double zero = 0;
  const std::span<const double> abscissa[] = {other};
  ASSERT_TRUE(strip->predict({*model, set_s, {&zero, 1}, abscissa}, {values, {}, {}, {}}).ok());
  const Prediction direct = predict(*make_strip(other), *model, set_s);
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(values[i], direct.values[i], 1e-9 * (1 + direct.values[i]));
}

TEST(Uniaxial, RefusesRowsItCannotSimulate) {
  const auto message = [](const std::vector<double>& stretch, std::vector<double> time) -> std::string {
    try {
      make_strip(stretch, {.time = std::move(time)});
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message({1, -0.2}, {}).find("row 2 has stretch"), std::string::npos);
  EXPECT_NE(message({1, 1.1, 1.2}, {0, 2, 1})
                .find("uniaxial: time runs backwards at row 3; give the rows in the order in which they were measured"),
            std::string::npos);
  EXPECT_NE(message({}, {}).find("no rows"), std::string::npos);
}

}  // namespace
}  // namespace tunica::testing::uniaxial_test
