// SPDX-License-Identifier: Apache-2.0
// Every card is read back and put into the energy that its program publishes. At J = 1 that is the energy of tunica's
// model, computed by the plugin.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cards/card.hpp"
#include "cards/given.hpp"
#include "cards/reading.hpp"
#include "conformance/material_point.hpp"

namespace tunica::testing {
namespace {

using cards::Target;
using trial::State;
using Energy = std::function<double(const State&)>;
using boost::property_tree::ptree;

/// Few digits, so that they fit into ten columns.
const std::vector<Given> materials = {
    {.type = "neo_hooke", .values = {{"mu", 412.5}}},
    {.type = "mooney_rivlin", .values = {{"c10", 180.25}, {"c01", 20.5}}},
    {.type = "mooney_rivlin",
     .values = {{"c10", 180.25}, {"c01", 20.5}, {"c11", -1.25}},
     .options = option("terms", std::int64_t{3})},
    {.type = "mooney_rivlin",
     .values = {{"c10", 180.25}, {"c01", 20.5}, {"c20", 3.25}, {"c11", -1.25}, {"c02", 0.5}},
     .options = option("terms", std::int64_t{5})},
    {.type = "mooney_rivlin",
     .values = {{"c10", 180.25},
                {"c01", 20.5},
                {"c20", 3.25},
                {"c11", -1.25},
                {"c02", 0.5},
                {"c30", 0.125},
                {"c21", -0.25},
                {"c12", 0.0625},
                {"c03", 0.03125}},
     .options = option("terms", std::int64_t{9})},
    {.type = "yeoh", .values = {{"c10", 170.5}, {"c20", -1.25}, {"c30", 0.0375}}},
    {.type = "gent", .values = {{"mu", 300.5}, {"Jm", 80.25}}},
    {.type = "ogden",
     .values =
         {{"mu_1", 630.5}, {"alpha_1", 1.3}, {"mu_2", 1.25}, {"alpha_2", 5}, {"mu_3", -10.5}, {"alpha_3", -2.25}}},
    {.type = "hgo", .values = {{"mu", 18.5}, {"k1", 24.5}, {"k2", 0.875}, {"theta", 36.5}}},
    {.type = "gho", .values = {{"mu", 18.5}, {"kappa", 0.1375}, {"k1", 24.5}, {"k2", 0.875}, {"theta", 36.5}}},
    {.type = "four_fibre",
     .values = {{"mu", 18.5},
                {"k1", 24.5},
                {"k2", 0.875},
                {"theta", 36.5},
                {"k1_axial", 8.25},
                {"k2_axial", 0.375},
                {"k1_circumferential", 11.5},
                {"k2_circumferential", 0.625}}}};

const Eigen::Vector3d circumferential(1, 0, 0), axial(0, 1, 0);

/// The energy of one family whose squared stretch is I4, silent where E < 0.
double family(double k1, double k2, double kappa, double i1, double i4) {
  const double e = kappa * (i1 - 3) + (1 - 3 * kappa) * (i4 - 1);
  return e < 0 ? 0 : k1 / (2 * k2) * (std::exp(k2 * e * e) - 1);
}

/// Σ v_k x^m y^n with x = I1 − 3 and y = I2 − 3, in the order of these powers.
Energy polynomial(const std::vector<double>& v, const std::vector<std::pair<int, int>>& powers) {
  return [v, powers](const State& s) {
    double sum = 0;
    for (std::size_t k = 0; k < powers.size(); ++k)
      sum += v.at(k) * std::pow(s.i1() - 3, powers[k].first) * std::pow(s.i2() - 3, powers[k].second);
    return sum;
  };
}
const std::vector<std::pair<int, int>> second_degree{{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}},
    third_degree{{1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}, {3, 0}, {2, 1}, {1, 2}, {0, 3}};

/// Abaqus and CalculiX, *HYPERELASTIC.
Energy hyperelastic(const std::string& type, const std::vector<double>& v) {
  if (type == "neo_hooke") return [v](const State& s) { return v.at(0) * (s.i1() - 3); };
  // Constants and one D a degree: 7 or 12 numbers.
  if (type == "mooney_rivlin" && v.size() == 7) return polynomial(v, second_degree);
  if (type == "mooney_rivlin" && v.size() == 12) return polynomial(v, third_degree);
  if (type == "mooney_rivlin") return [v](const State& s) { return v.at(0) * (s.i1() - 3) + v.at(1) * (s.i2() - 3); };
  if (type == "yeoh")
    return [v](const State& s) {
      return v.at(0) * (s.i1() - 3) + v.at(1) * std::pow(s.i1() - 3, 2) + v.at(2) * std::pow(s.i1() - 3, 3);
    };
  return [v](const State& s) {
    double sum = 0;
    for (std::size_t k = 0; k < v.size() / 3; ++k)
      sum += 2 * v[2 * k] / (v[2 * k + 1] * v[2 * k + 1]) * s.powers(v[2 * k + 1]);
    return sum;
  };
}

Energy of_abaqus(const Given& material, const std::string& card) {
  if (card.find("ANISOTROPIC") == std::string::npos)
    return hyperelastic(material.type, trial::data_of(card, "*HYPERELASTIC"));
  const auto v = trial::data_of(card, "HOLZAPFEL");
  const auto directions = trial::directions_of(card);
  EXPECT_EQ(directions.size(), 2U);
  return [v, directions](const State& s) {
    double sum = v.at(0) * (s.i1() - 3);
    for (const auto& direction : directions) sum += family(v.at(2), v.at(3), v.at(4), s.i1(), s.along(direction));
    return sum;
  };
}

Energy of_calculix(const Given& material, const std::string& card) {
  if (card.find("USER MATERIAL") == std::string::npos)
    return hyperelastic(material.type, trial::data_of(card, "*HYPERELASTIC"));
  const auto v = trial::data_of(card, "*USER MATERIAL");
  return [v](const State& s) {
    double sum = v.at(0) * (s.i1() - 3);
    for (std::size_t k = 2; k + 3 < v.size(); k += 4) {
      const double third = std::sqrt(1 - v[k] * v[k] - v[k + 1] * v[k + 1]);
      sum += family(v[k + 2], v[k + 3], 0, s.i1(), s.along({v[k], v[k + 1], third}));
    }
    return sum;
  };
}

Energy of_ansys(const Given& material, const std::string& card) {
  std::vector<double> v;
  for (const auto& line : trial::lines_of(card, "!"))
    if (line.starts_with("TBDATA,")) {
      const auto row = trial::numbers(line.substr(7));
      EXPECT_EQ(row.at(0), v.size() + 1) << "TBDATA says where its constants begin";
      v.insert(v.end(), row.begin() + 1, row.end());
      EXPECT_LE(row.size(), 7U);
    }
  const auto& type = material.type;
  if (type == "neo_hooke") return [v](const State& s) { return v.at(0) / 2 * (s.i1() - 3); };
  if (type == "gent") return [v](const State& s) { return -v.at(0) * v.at(1) / 2 * std::log(1 - (s.i1() - 3) / v[1]); };
  if (type == "mooney_rivlin" && v.size() == 4) return polynomial(v, {{1, 0}, {0, 1}, {1, 1}});
  if (type == "mooney_rivlin" && v.size() > 4) return polynomial(v, v.size() == 6 ? second_degree : third_degree);
  if (type != "ogden") return hyperelastic(type, v);
  return [v](const State& s) {
    double sum = 0;
    for (std::size_t k = 0; k < v.size() / 3; ++k) sum += v[2 * k] / v[2 * k + 1] * s.powers(v[2 * k + 1]);
    return sum;
  };
}

/// Fields of ten columns.
std::vector<double> fields(const std::string& line) {
  std::vector<double> found;
  for (std::size_t at = 0; at < line.size(); at += 10) found.push_back(std::stod(line.substr(at, 10)));
  return found;
}

Energy of_lsdyna(const Given&, const std::string& card) {
  const auto lines = trial::lines_of(card, "$");
  const auto first = fields(lines.at(2)), v = fields(lines.at(3));
  EXPECT_NEAR(first.at(1), 1e-12 * 1e3 * 1e3, 1e-20) << "1000 kg/m3 in mN s2/mm4";
  EXPECT_NEAR(first.at(2), (3e3 - 2) / (6e3 + 2), 1e-8) << "K = 1000 G";
  EXPECT_EQ(first.at(3), 0) << "the constants are given";
  if (lines.at(0) == "*MAT_OGDEN_RUBBER_TITLE") {
    const auto alpha = fields(lines.at(4));
    return [v, alpha](const State& s) {
      double sum = 0;
      for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] / alpha.at(k) * s.powers(alpha[k]);
      return sum;
    };
  }
  EXPECT_EQ(lines.at(0), "*MAT_HYPERELASTIC_RUBBER_TITLE");
  return [v](const State& s) {
    const double x = s.i1() - 3, y = s.i2() - 3;
    return v.at(0) * x + v.at(1) * y + v.at(2) * x * y + v.at(3) * x * x + v.at(4) * y * y + v.at(5) * x * x * x;
  };
}

double febio_solid(const ptree& solid, const State& s) {
  const auto type = solid.get<std::string>("<xmlattr>.type");
  const auto value = [&](const std::string& name) { return solid.get<double>(name, 0); };
  if (type == "Mooney-Rivlin") return value("c1") * (s.i1() - 3) + value("c2") * (s.i2() - 3);
  if (type == "Yeoh")
    return value("c1") * (s.i1() - 3) + value("c2") * std::pow(s.i1() - 3, 2) + value("c3") * std::pow(s.i1() - 3, 3);
  if (type == "Gent") return -value("G") * value("Jm") / 2 * std::log(1 - (s.i1() - 3) / value("Jm"));
  if (type == "Ogden") {
    double sum = 0;
    for (int k = 1; k <= 6; ++k)
      if (const double m = value(fmt::format("m{}", k)); m != 0)
        sum += value(fmt::format("c{}", k)) / (m * m) * s.powers(m);
    return sum;
  }
  if (type == "Holzapfel-Gasser-Ogden") {
    const double gamma = value("gamma") * std::numbers::pi / 180;
    double sum = value("c") / 2 * (s.i1() - 3);
    for (const double sign : {1.0, -1.0}) {
      const Eigen::Vector3d direction = std::cos(gamma) * circumferential + sign * std::sin(gamma) * axial;
      sum += family(value("k1"), value("k2"), value("kappa"), s.i1(), s.along(direction));
    }
    return sum;
  }
  if (type == "fiber-exp-pow-uncoupled") {
    const auto v = trial::numbers(solid.get<std::string>("fiber"));
    const double stretched = s.along({v.at(0), v.at(1), v.at(2)}) - 1, beta = value("beta");
    return stretched < 0
               ? 0
               : value("ksi") / (value("alpha") * beta) * (std::exp(value("alpha") * std::pow(stretched, beta)) - 1);
  }
  double sum = 0;
  EXPECT_EQ(type, "uncoupled solid mixture");
  for (const auto& [name, part] : solid)
    if (name == "solid") sum += febio_solid(part, s);
  return sum;
}

Energy of_febio(const Given&, const std::string& card) {
  std::istringstream stream(card);
  ptree document;
  boost::property_tree::read_xml(stream, document);
  const ptree material = document.get_child("material");
  EXPECT_GT(material.get<double>("k"), 0);
  EXPECT_NEAR(material.get<double>("density"), 1e-6, 1e-16);
  return [material](const State& s) { return febio_solid(material, s); };
}

void expect_the_energy(Target target, Energy (*reader)(const Given&, const std::string&),
                       const std::vector<std::string>& types, double limit = 1e-9) {
  conformance::Sampler sampler(17);  // deterministic
  for (const auto& given : materials) {
    if (std::find(types.begin(), types.end(), given.type) == types.end()) continue;
    const bool written = target != Target::febio && !(target == Target::lsdyna && given.values.size() == 9);
    if (given.type == "mooney_rivlin" && given.values.size() > 2 && !written) continue;  // refused
    const auto model = make_model(given.type, given.options);
    const std::vector<double> p = values_of(given);
    const Energy energy = reader(given, cards::write_card(target, material(given),
                                                          {.name = "WALL",
                                                           .units = cards::unit_system("mm-mN-kPa"),
                                                           .density = 1000,
                                                           .remarks = {"A remark -- with 3, 2, 1."}}));
    for (int draw = 0; draw < 40; ++draw) {
      Eigen::Matrix3d C = conformance::to_matrix(sampler.right_cauchy_green());
      C /= std::cbrt(C.determinant());
      const double expected = conformance::evaluate(*model, conformance::to_tensor(C), p).energy;
      EXPECT_NEAR(energy({C}), expected, limit * std::abs(expected)) << given.type;
    }
  }
}

}  // namespace

TEST(CardReaders, FindTheEnergyInCardsOfFebio) {
  expect_the_energy(Target::febio, of_febio,
                    {"neo_hooke", "mooney_rivlin", "yeoh", "gent", "ogden", "hgo", "gho", "four_fibre"});
}

TEST(CardReaders, FindTheEnergyInCardsOfAbaqus) {
  expect_the_energy(Target::abaqus, of_abaqus, {"neo_hooke", "mooney_rivlin", "yeoh", "ogden", "hgo", "gho"});
}

TEST(CardReaders, FindTheEnergyInCardsOfCalculix) {
  expect_the_energy(Target::calculix, of_calculix, {"neo_hooke", "mooney_rivlin", "yeoh", "ogden", "hgo", "four_fibre"},
                    1e-6);
}

TEST(CardReaders, FindTheEnergyInCardsOfAnsys) {
  expect_the_energy(Target::ansys, of_ansys, {"neo_hooke", "mooney_rivlin", "yeoh", "gent", "ogden"});
}

TEST(CardReaders, FindTheEnergyInCardsOfLsDyna) {
  expect_the_energy(Target::lsdyna, of_lsdyna, {"neo_hooke", "mooney_rivlin", "yeoh", "ogden"});
}

}  // namespace tunica::testing
