// SPDX-License-Identifier: Apache-2.0
// The model that is put together in the file: every built-in energy of sum form again, and what it refuses.
#include "models/composed.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "tunica/detail/hyperelastic_tensor.hpp"

namespace tunica::testing::composed_test {
using namespace conformance;
namespace {

/// A built-in model and the same energy term by term: parameter j of the built-in is `factor` times parameter
/// `index` of the composed one.
struct Twin {
  struct Same {
    std::size_t index;
    double factor = 1;
  };
  std::string model, terms;
  std::vector<Same> same;
  std::int64_t model_terms = 0;
};

const std::string matrix = R"({"name": "m", "invariant": "I1", "law": "linear"})";
std::string fibre(const std::string& name, const std::string& family, const std::string& more = "") {
  return R"({"name": ")" + name + R"(", "invariant": "fibre", "law": "exponential_square", "family": ")" + family +
         "\"" + more + "}";
}

const std::vector<Twin>& twins() {
  static const std::vector<Twin> all{
      {"neo_hooke", "[" + matrix + "]", {{0}}},
      // c10 (I1 − 3) is mu/2 x
      {"mooney_rivlin", "[" + matrix + R"(, {"name": "n", "invariant": "I2", "law": "linear"}])", {{0, 0.5}, {1, 0.5}}},
      {"mooney_rivlin",
       "[" + matrix + R"(, {"name": "n", "invariant": "I2", "law": "linear"},
          {"name": "p", "invariant": "I1", "law": "quadratic"}, {"name": "q", "invariant": "I1*I2", "law": "linear"},
          {"name": "r", "invariant": "I2", "law": "quadratic"}, {"name": "s", "invariant": "I1", "law": "cubic"},
          {"name": "t", "invariant": "I1^2*I2", "law": "linear"}, {"name": "u", "invariant": "I1*I2^2", "law": "linear"},
          {"name": "v", "invariant": "I2", "law": "cubic"}])",
       {{0, 0.5}, {1, 0.5}, {2, 0.5}, {3, 0.5}, {4, 0.5}, {5, 1. / 3}, {6, 0.5}, {7, 0.5}, {8, 1. / 3}},
       9},
      {"yeoh",
       "[" + matrix + R"(, {"name": "q", "invariant": "I1", "law": "quadratic"},
          {"name": "c", "invariant": "I1", "law": "cubic"}])",
       {{0, 0.5}, {1, 0.5}, {2, 1. / 3}}},
      {"gent", R"([{"name": "g", "invariant": "I1", "law": "gent"}])", {{0}, {1}}},
      {"ogden",
       R"([{"name": "a", "invariant": "stretches"}, {"name": "b", "invariant": "stretches"}])",
       {{0}, {1}, {2}, {3}},
       2},
      {"hgo", "[" + matrix + ", " + fibre("f", "diagonal") + "]", {{0}, {1}, {2}, {3}}},
      {"gho",
       "[" + matrix + ", " + fibre("f", "diagonal", R"(, "dispersion": "rotational")") + "]",
       {{0}, {4}, {1}, {2}, {3}}},
      {"holzapfel_2015",
       "[" + matrix + ", " + fibre("f", "diagonal", R"(, "dispersion": "two_planes")") + "]",
       {{0}, {4}, {5}, {1}, {2}, {3}}},
      {"four_fibre",
       "[" + matrix + ", " + fibre("f", "diagonal") + ", " + fibre("a", "axial") + ", " +
           fibre("c", "circumferential") + "]",
       {{0}, {1}, {2}, {3}, {4}, {5}, {6}, {7}}},
      {"arruda_boyce", R"([{"name": "r", "invariant": "I1", "law": "inverse_langevin"}])", {{0}, {1}}},
      // sheets across the wall, the default
      {"holzapfel_ogden",
       R"([{"name": "m", "invariant": "I1", "law": "exponential"}, )" + fibre("f", "single") +
           R"(, {"name": "s", "invariant": "radial", "fibre_switch": "strain", "law": "exponential_square"},
                {"name": "c", "invariant": "across", "family": "single", "angle_of": "f", "law": "exponential_square"}])",
       {{0}, {1}, {2}, {3}, {5}, {6}, {7}, {8}, {4}}}};
  return all;
}

class ComposedTwin : public ::testing::TestWithParam<Twin> {};

// Energy, stress, tangent and derivatives by parameters at 30 seeded states, to 1e-11 of the largest entry.
TEST_P(ComposedTwin, IsTheBuiltInModel) {
  const Twin& twin = GetParam();
  Options options;
  if (twin.model_terms > 0) options.set("terms", twin.model_terms);
  const auto built_in = make_model(twin.model, options), own = composed(twin.terms);
  ASSERT_EQ(built_in->describe().parameters.size(), own->describe().parameters.size());
  Sampler sampler(19);
  for (int draw = 0; draw < 30; ++draw) {
    const auto [C, p] = sampler.point(*built_in);
    std::vector<double> q(p.size());
    for (std::size_t j = 0; j < p.size(); ++j) q[twin.same[j].index] = p[j] / twin.same[j].factor;
    const Evaluated a = evaluate(*built_in, C, p), b = evaluate(*own, C, q);
    const auto expect_near = [](double x, double y, double scale) { EXPECT_NEAR(x, y, 1e-11 * std::max(1.0, scale)); };
    expect_near(a.energy, b.energy, std::abs(a.energy));
    double largest = 0;
    for (const double entry : a.tangent) largest = std::max(largest, std::abs(entry));
    for (std::size_t k = 0; k < 36; ++k) expect_near(a.tangent[k], b.tangent[k], largest);
    for (std::size_t k = 0; k < 6; ++k) expect_near(a.stress[k], b.stress[k], largest);
    for (std::size_t j = 0; j < p.size(); ++j)
      for (std::size_t k = 0; k < 6; ++k) {
        const double mine = b.stress_dp[6 * twin.same[j].index + k] / twin.same[j].factor;
        expect_near(a.stress_dp[6 * j + k], mine, std::abs(mine) + largest);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(Composed, ComposedTwin, ::testing::ValuesIn(twins()), [](const auto& at) {
  return at.param.model + (at.param.model_terms > 2 ? "_of_many_constants" : "");
});

/// Every law of every invariant that takes it.
std::vector<std::string> single_terms() {
  std::vector<std::string> all;
  const std::string knots = R"(, "knots": [0, 0.1, 0.2, 0.3])";
  for (const std::string invariant : {"I1", "I2"})
    for (const std::string law : {"linear", "quadratic", "cubic", "power", "exponential", "exponential_square", "gent",
                                  "inverse_langevin", "logarithm", "spline"})
      all.push_back(R"("invariant": ")" + invariant + R"(", "law": ")" + law + "\"" + (law == "spline" ? knots : ""));
  for (const std::string family : {"axial", "diagonal", "single"})
    for (const std::string law : {"quadratic", "cubic", "power", "exponential_square", "spline"})
      all.push_back(R"("invariant": "fibre", "fibre_switch": "none", "family": ")" + family + R"(", "law": ")" + law +
                    "\"" + (law == "spline" ? knots : ""));
  for (const std::string law : {"quadratic", "exponential_square"})
    all.push_back(R"("invariant": "coupling", "law": ")" + law + "\"");
  for (const std::string family : {"axial", "circumferential", "diagonal", "single"})
    for (const std::string law : {"quadratic", "exponential_square"})
      all.push_back(R"("invariant": "across", "family": ")" + family + R"(", "law": ")" + law + "\"");
  all.push_back(R"("invariant": "radial", "law": "quadratic")");
  all.push_back(R"("invariant": "radial", "fibre_switch": "strain", "law": "exponential_square")");
  all.push_back(R"("invariant": "fibre", "family": "single", "dispersion": "two_planes", "law": "quadratic")");
  return all;
}

// Seed 20230211, the same on every run: the outcome is deterministic. Threads race with the splines, whose laws keep
// the most, and so with every kind of invariant that has one; a race takes 0.4 s.
TEST(Composed, KeepsEveryPropertyOfAModelWhateverTheTerm) {
  for (const std::string& term : single_terms()) {
    const auto model = composed("[" + matrix + R"(, {"name": "t", )" + term + "}]");
    // One family alone is no wall with paired fibres.
    const bool paired = term.find("single") == std::string::npos, raced = term.find("spline") != std::string::npos;
    for (const ModelProperty& property : model_properties())
      if ((paired || std::string(property.name) != "response_has_the_symmetry_of_the_wall") &&
          (raced || std::string(property.name) != "concurrent_calls_agree")) {
        EXPECT_EQ(property.check(*model, 20230211).counter_example, "") << term << ", " << property.name;
      }
  }
}

// Terms of I1, and of I2, are evaluated together as far as the limits of a part allow. Two splines are too long for
// that.
TEST(Composed, AddsUpTermsOfTheSameInvariant) {
  const std::string spline = R"("law": "spline", "knots": [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9])";
  for (const std::string& more :
       {std::string(R"({"name": "e", "invariant": "I1", "law": "exponential"})"),
        R"({"name": "r", "invariant": "I1", )" + spline + R"(}, {"name": "s", "invariant": "I1", )" + spline + "}"}) {
    const auto model =
        composed("[" + matrix + R"(, {"name": "a", "invariant": "I2", "law": "linear"}, )" + fibre("f", "diagonal") +
                 ", " + more + R"(, {"name": "b", "invariant": "I2", "law": "quadratic"}])");
    EXPECT_EQ(model->parts().size(), more.find("spline") == std::string::npos ? 5u : 6u);
    Sampler sampler(6);
    for (int draw = 0; draw < 20; ++draw) {
      const auto [C, p] = sampler.point(*model);
      const Evaluated together = evaluate(*model, C, p);
      Evaluated apart;
      apart.stress_dp.resize(6 * p.size());
      for (const auto& part : model->parts())
        for (const double side : {1., -1.})
          if (side > 0 || part->describe().mirrored)
            hyperelastic::add_part_tensor(*part, side, {1, C, p, {}, {}},
                                          {{&apart.energy, 1}, apart.stress, apart.tangent, apart.stress_dp, {}}, 0, 1);
      const auto expect_near = [](std::span<const double> found, std::span<const double> expected) {
        double largest = 1;
        for (const double one : expected) largest = std::max(largest, std::abs(one));
        for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-13 * largest) << k;
      };
      expect_near({&together.energy, 1}, {&apart.energy, 1});
      expect_near(together.stress, apart.stress);
      expect_near(together.tangent, apart.tangent);
      expect_near(together.stress_dp, apart.stress_dp);
      for (const ModelProperty& property : model_properties())
        if (draw == 0 && std::string(property.name).starts_with("axes_")) {
          EXPECT_EQ(property.check(*model, 20230211).counter_example, "") << more << ", " << property.name;
        }
    }
  }
}

// M1·C M2 of the two families, by the vectors themselves.
TEST(Composed, CouplesTheTwoFamilies) {
  const auto model = composed(R"([{"name": "c", "invariant": "coupling", "law": "quadratic"}])");
  Sampler sampler(3);
  for (int draw = 0; draw < 20; ++draw) {
    const Tensor C = sampler.right_cauchy_green();
    const double theta = 10 + 3 * draw, a = theta * M_PI / 180, k = 7;
    const Eigen::Vector3d one(std::sin(a), std::cos(a), 0), other(-std::sin(a), std::cos(a), 0);
    const double x = one.dot(to_matrix(C) * other) - std::cos(2 * a);
    EXPECT_NEAR(evaluate(*model, C, std::vector{k, theta}).energy, k / 2 * x * x, 1e-12);
  }
}

// M·C e_r of one family, and of both families of a pair.
TEST(Composed, CouplesAFamilyAndTheNormal) {
  for (const std::string family : {"single", "diagonal"}) {
    const auto model =
        composed(R"([{"name": "c", "invariant": "across", "law": "quadratic", "family": ")" + family + "\"}]");
    Sampler sampler(4);
    for (int draw = 0; draw < 20; ++draw) {
      const Tensor C = sampler.right_cauchy_green();
      const double theta = 10 + 3 * draw, a = theta * M_PI / 180, k = 7;
      const Eigen::Vector3d one(std::sin(a), std::cos(a), 0), other(-std::sin(a), std::cos(a), 0), normal(0, 0, 1);
      const auto term = [&](const Eigen::Vector3d& m) { return k / 2 * std::pow(m.dot(to_matrix(C) * normal), 2); };
      const double expected = term(one) + (family == "diagonal" ? term(other) : 0);
      EXPECT_NEAR(evaluate(*model, C, std::vector{k, theta}).energy, expected, 1e-12) << family;
    }
  }
}

TEST(Composed, SharesAnAngleBetweenTerms) {
  const auto model = composed("[" + fibre("f", "diagonal") +
                              R"(, {"name": "c", "invariant": "coupling", "law": "quadratic", "angle_of": "f"}])");
  std::vector<std::string> names;
  for (const Parameter& parameter : model->describe().parameters) names.push_back(parameter.name);
  EXPECT_THAT(names, ::testing::ElementsAre("f_k1", "f_k2", "f_theta", "c_k"));
}

// The eight chains at rest and close to their length: ψ' = μ β/(6y) with L(β) = y, β = 1/(1 − y) to first order there.
TEST(Composed, EightChainsStiffenAsTheInverseLangevinFunction) {
  const auto model = composed(R"([{"name": "r", "invariant": "I1", "law": "inverse_langevin"}])");
  const double mu = 30, links = 8;
  const auto slope = [&](double lambda) {  // of ψ by I1 from the stress in the first direction less that of the second
    const Tensor C{lambda * lambda, 1 / lambda, 1 / lambda, 0, 0, 0};
    const Tensor S = evaluate(*model, C, std::vector{mu, links}).stress;
    return S[0] / 2;
  };
  const double y0 = 1 / std::sqrt(links);
  // 3y + 9/5 y³ + 297/175 y⁵ + 1539/875 y⁷ + 126117/67375 y⁹, the series of the inverse
  const double beta0 =
      y0 * (3 + y0 * y0 * (9. / 5 + y0 * y0 * (297. / 175 + y0 * y0 * (1539. / 875 + y0 * y0 * 126117. / 67375))));
  EXPECT_NEAR(slope(1), mu * beta0 / (6 * y0), 1e-4 * mu);
  const double i1 = 3 * links * 0.99 * 0.99;  // y = 0.99
  double lambda = std::sqrt(i1);
  for (int step = 0; step < 50; ++step) lambda = std::sqrt(i1 - 2 / lambda);
  EXPECT_NEAR(slope(lambda), mu * 100 / (6 * 0.99), 1e-3 * mu * 100);
}

TEST(Composed, SaysWhichTermIsWrongAndWhatToDo) {
  using ::testing::HasSubstr;
  EXPECT_THAT(refusal("{}"), HasSubstr("no list of terms"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I3", "law": "linear"}])"),
              HasSubstr("\"terms\", term 1 ('a'): \"invariant\" is 'I3'. Write one of I1, I2"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "linar"}])"), HasSubstr("\"law\" is 'linar'"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "fibre", "family": "axial", "law": "linear"}])"),
              HasSubstr("'linear' pulls at rest"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "coupling", "law": "power"}])"), HasSubstr("both sides of 0"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "spline"}])"), HasSubstr("has no \"knots\""));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "spline", "knots": [0, 2, 1]}])"),
              HasSubstr("no rising list"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "spline", "knots": {"a": 0, "b": 1}}])"),
              HasSubstr("\"knots\" is no list"));
  EXPECT_THAT(refusal(R"([{"name": "1", "invariant": "I1", "law": "linear"}])"), HasSubstr("is not a letter"));
  EXPECT_THAT(refusal("[" + matrix + ", " + matrix + "]"), HasSubstr("two terms are called 'm'"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "linear", "angle": 3}])"),
              HasSubstr("the key 'angle' is not known"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "coupling", "law": "quadratic", "angle_of": "b"}])"),
              HasSubstr("which is no term with an angle of its own"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "law": "linear", "family": "axial"}])"),
              HasSubstr("goes with the invariant 'fibre' or 'across' only"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "across", "law": "quadratic"}])"),
              HasSubstr("\"family\" is missing"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "across", "family": "axial", "law": "cubic"}])"),
              HasSubstr("both sides of 0"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "radial", "fibre_switch": "stretch", "law": "quadratic"}])"),
              HasSubstr("the invariant 'radial' has no fibres"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "I1", "dispersion": "rotational", "law": "linear"}])"),
              HasSubstr("\"dispersion\" goes with the invariant 'fibre' only"));
}

TEST(Composed, SaysWhichKnotsMakeASpline) {
  using ::testing::HasSubstr;
  const auto spline = [](const std::string& knots) {
    return R"([{"name": "a", "invariant": "I1", "law": "spline", "knots": )" + knots + "}]";
  };
  EXPECT_THAT(refusal(spline(R"([0, "1"])")), HasSubstr("has an entry that is no number"));
  for (const char* wrong : {"[0]", "[0.1, 1]", "[0, 1, 1]", "[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14]"})
    EXPECT_THAT(refusal(spline(wrong)), HasSubstr("no rising list that begins at 0")) << wrong;
  EXPECT_NO_THROW((void)composed(spline("[0, 1]")));
  EXPECT_NO_THROW((void)composed(spline("[0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13]")));
}

TEST(Composed, TakesAListOfObjectsWithNamesInPlainLetters) {
  using ::testing::HasSubstr;
  for (const char* wrong : {"[]", "3", R"({"m": {"name": "a", "invariant": "I1", "law": "linear"}})", "[3"})
    EXPECT_THAT(refusal(wrong), HasSubstr("no list of terms")) << wrong;
  EXPECT_THAT(refusal("[" + matrix + ", 3]"), HasSubstr("\"terms\", term 2: found no object"));
  EXPECT_THAT(refusal(R"([{"name": 5, "invariant": "I1", "law": "linear"}])"), HasSubstr("\"name\" is no text"));
  const auto named = [](const std::string& name) {
    return R"([{"name": ")" + name + R"(", "invariant": "I1", "law": "linear"}])";
  };
  for (const char* wrong : {"", "_a", "a-b", "a b"}) EXPECT_THAT(refusal(named(wrong)), HasSubstr("is not a letter"));
  EXPECT_EQ(composed(named("a_1"))->describe().parameters.front().name, "a_1_mu");
}

TEST(Composed, SaysWhichKeysGoWithWhichInvariant) {
  using ::testing::HasSubstr;
  const auto of = [](const std::string& invariant, const std::string& more) {
    return R"([{"name": "a", "invariant": ")" + invariant + R"(", "law": "quadratic", )" + more + "}]";
  };
  const std::string strain = R"("fibre_switch": "strain")", axial = R"("family": "axial")";
  for (const std::string other : {"I1", "I2", "coupling"})
    EXPECT_THAT(refusal(of(other, strain)), HasSubstr("\"fibre_switch\" goes with the invariant 'fibre' or 'radial'"));
  EXPECT_THAT(refusal(of("across", axial + ", " + strain)), HasSubstr("\"fibre_switch\" goes with"));
  for (const std::string given : {"strain", "stretch", "none"})
    EXPECT_NO_THROW((void)composed(of("fibre", axial + R"(, "fibre_switch": ")" + given + "\"")));
  for (const std::string given : {"strain", "none"})
    EXPECT_NO_THROW((void)composed(of("radial", R"("fibre_switch": ")" + given + "\"")));
  EXPECT_THAT(refusal(of("I1", R"("angle_of": "a")")), HasSubstr("the term has no angle"));
  EXPECT_THAT(refusal(of("I1", R"("knots": [0, 1])")), HasSubstr("\"knots\" go with the law 'spline' only"));
}

TEST(Composed, SharesAnAngleThatIsATermsOwn) {
  using ::testing::HasSubstr;
  const auto sharing = [](const std::string& of) {
    return "[" + matrix + ", " + fibre("f", "diagonal") + ", " + fibre("g", "diagonal", R"(, "angle_of": "f")") + ", " +
           fibre("h", "diagonal", R"(, "angle_of": ")" + of + "\"") + "]";
  };
  // m_mu, three times k1 and k2, and one angle.
  EXPECT_EQ(composed(sharing("f"))->describe().parameters.size(), 8u);
  for (const std::string of : {"m", "g", "h", "nobody"})
    EXPECT_THAT(refusal(sharing(of)), HasSubstr("\"angle_of\" is '" + of + "', which is no term with an angle")) << of;
}

TEST(Composed, HasPowersOfTheStretchesOnly) {
  EXPECT_NO_THROW((void)composed(R"([{"name": "a", "invariant": "stretches", "law": "power"}])"));
  EXPECT_NO_THROW((void)composed(R"([{"name": "a", "invariant": "stretches"}])"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "stretches", "family": "axial"}])"),
              ::testing::HasSubstr("goes with the invariant 'fibre' or 'across' only"));
  EXPECT_THAT(refusal(R"([{"name": "a", "invariant": "stretches", "law": "cubic"}])"),
              ::testing::HasSubstr("a term of the principal stretches has no law but 'power'"));
}

TEST(Composed, WritesItsEnergyAsAFormula) {
  EXPECT_EQ(composed("[" + matrix + ", " + fibre("f", "diagonal") + "]")->describe().formula,
            "W = m_mu/2 (I1 - 3) + sum over +-f_theta of f_k1/(2 f_k2) (exp(f_k2 (I4 - 1)^2) - 1)");
  EXPECT_EQ(composed(R"([{"name": "a", "invariant": "across", "family": "axial", "law": "quadratic"},
                         {"name": "d", "invariant": "across", "family": "diagonal", "law": "quadratic"}])")
                ->describe()
                .formula,
            "W = a_k/2 C_zr^2 + sum over +-d_theta of d_k/2 C_fr^2");
}

}  // namespace
}  // namespace tunica::testing::composed_test
