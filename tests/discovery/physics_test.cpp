// SPDX-License-Identifier: Apache-2.0
// Generator and program share no line, and yet mean the same physics: noise-free cases of the one are simulated by the
// other, base model and every mechanism of the catalogue at the true amplitude.
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bases.hpp"
#include "cli/process.hpp"
#include "execution/folder.hpp"
#include "sealed_case.hpp"

using nlohmann::json;
using tunica::trial::Folder;
using tunica::trial::text_of;

namespace {

/// What the experiment file calls a mechanism's parameters; "channel" and "rows" are filled in from the target.
struct MechanismNames {
  std::string amplitude;
  std::map<std::string, std::string> nuisances = {};  ///< the generator's name → parameter
  std::map<std::string, std::string> options = {};    ///< the generator's name → option
};
const std::map<std::string, MechanismNames>& words() {
  static const std::map<std::string, MechanismNames> all{
      {"fibre_dispersion", {"kappa"}},
      {"axial_fibres", {"k", {{"k2", "k2"}}}},
      {"circumferential_fibres", {"k", {{"k2", "k2"}}}},
      {"matrix_stiffening", {"b"}},
      {"chain_extensibility", {"inverse_limit"}},
      {"second_invariant", {"c2"}},
      {"fibre_recruitment", {"stretch"}},
      {"active_tone", {"tone"}},
      {"stress_softening", {"s", {{"m", "m"}}}},
      {"viscoelasticity", {"g", {{"tau", "tau"}}}},
      {"residual_stress", {"opening_angle"}},
      {"axial_stretch_error", {"value"}},
      {"tethering", {"stiffness"}},
      {"geometry_error", {"gain"}},
      {"layered_wall", {"ratio", {}, {{"interface", "layer_interface"}}}},
      {"pressure_offset", {"value"}},
      {"pressure_scale_error", {"gain"}},
      {"diameter_scale_error", {"gain"}},
      {"axial_force_offset", {"value"}},
      {"axial_force_scale_error", {"gain"}},
      {"reference_length_error", {"strain"}},
      {"force_scale_error", {"gain"}},
      {"force_offset", {"value"}},
      {"specimen_misalignment", {"angle"}},
      {"permanent_set", {"s"}},
      {"signal_drift", {"value"}},
      {"outliers", {"value"}}};
  return all;
}

/// Numbers of a CSV file's column.
std::vector<double> column(const std::filesystem::path& file, const std::string& name) {
  std::istringstream stream(text_of(file));
  std::string line, cell;
  std::getline(stream, line);
  std::istringstream header(line);
  std::size_t at = 0;
  while (std::getline(header, cell, ',') && cell.substr(0, cell.find(' ')) != name) ++at;
  std::vector<double> values;
  while (std::getline(stream, line)) {
    std::istringstream row(line);
    for (std::size_t k = 0; k <= at; ++k) std::getline(row, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

/// The experiment of a case with the base parameters held at the truth, and the effects added.
json experiment_of(const blind::SealedCase& made, const std::filesystem::path& folder) {
  json experiment = json::parse(text_of(folder / "experiment.json"));
  const blind::Tissue& base = made.specimen.tissue;
  json& model = experiment["models"][blind::name_of(base.base)];
  for (const auto* list : {&blind::fitted(base.base), &blind::held(base.base)})
    for (const blind::BaseParameter& one : *list) model["parameters"][one.name] = {{"fixed", base.*one.member}};
  for (const blind::ScaledEffect& one : made.hidden) {
    const blind::HiddenEffect& hidden = one.hidden;
    const MechanismNames& of = words().at(hidden.effect->id);
    json entry{{"type", hidden.effect->id}};
    entry["parameters"][of.amplitude]["fixed"] = hidden.amplitude();
    for (const auto& [name, parameter] : of.nuisances)
      entry["parameters"][parameter]["fixed"] = hidden.nuisance.at(name);
    for (const auto& [name, option] : of.options) entry[option] = hidden.nuisance.at(name);
    const auto into_test = [&](const std::string& test) { experiment["tests"][test]["mechanisms"].push_back(entry); };
    using enum blind::Effect::Where;
    switch (hidden.effect->where) {
      case material:
        model["mechanisms"].push_back(entry);
        break;
      case strip:
        into_test(made.specimen.protocol.strips[*hidden.target.strip].name);
        break;
      case all_tubes:
      case tube_or_all:
        for (std::size_t i = 0; i < made.specimen.protocol.tubes.size(); ++i)
          if (hidden.target.tube.value_or(i) == i) into_test(made.specimen.protocol.tubes[i].name);
        break;
      case channel:
      case points: {
        const auto where = blind::channels(made.specimen.protocol)[*hidden.target.channel];
        entry["channel"] = where.name;
        if (hidden.target.row)
          entry["rows"] = std::to_string(*hidden.target.row) + ":" + std::to_string(*hidden.target.row + 1);
        into_test(where.test);
      }
    }
  }
  return experiment;
}

/// Largest difference between what the program simulates and the truth of the case, in standard deviations.
double largest_difference(const blind::CaseOrder& order) {
  const Folder folder;
  blind::write(order, folder.path());
  const blind::SealedCase made = blind::make(order);
  const auto place = folder.path() / order.name();
  std::ofstream(place / "known.json") << experiment_of(made, place).dump(1);
  const auto ended =
      tunica::trial::tunica({"simulate", "known.json", "--model", blind::name_of(order.base), "-o", "out"}, place);
  EXPECT_EQ(ended.code, 0) << ended.err;
  if (ended.code != 0) return std::numeric_limits<double>::infinity();
  const blind::Noise noise = made.noise.about(made.specimen.protocol, made.truth);
  double largest = 0;
  for (const blind::Channel& channel : blind::channels(made.specimen.protocol)) {
    const auto simulated = column(place / "out" / (channel.test + ".csv"), channel.name);
    EXPECT_EQ(simulated.size(), channel.count);
    for (std::size_t i = 0; i < simulated.size(); ++i) {
      const std::size_t at = channel.first + i;
      const double off = std::abs(simulated[i] - made.truth[at]) / noise.sd[static_cast<Eigen::Index>(at)];
      if (!(off <= largest)) largest = off;
    }
  }
  return largest;
}

class Physics : public ::testing::TestWithParam<std::string> {};

TEST(GeneratorPhysics, BaseCurvesAgreeToAHundredthOfTheNoise) {
  for (std::size_t index = 0; index < 5; ++index) {
    const double off = largest_difference({11, "nulls", "", 0, index, {"none"}});
    EXPECT_LT(off, 0.01) << "case " << index;
  }
}

using OtherClass = std::pair<blind::Base, std::string>;
class OtherPhysics : public ::testing::TestWithParam<OtherClass> {};

TEST_P(OtherPhysics, AgreesWithTheProgramInTheBaseAndInEveryEffectThatMakesSense) {
  const auto& [base, protocol] = GetParam();
  for (std::size_t index = 0; index < 3; ++index)
    EXPECT_LT(largest_difference({11, "nulls", "", 0, index, {"none"}, base, protocol}), 0.01) << "case " << index;
  std::mt19937_64 random(1);
  const blind::Specimen like = blind::draw_specimen(random, base, protocol);
  for (const blind::Effect& effect : blind::catalogue()) {
    if (!blind::makes_sense(effect, like)) continue;
    const double off = largest_difference({11, "singles", effect.id, 60, 0, {"none"}, base, protocol});
    // The program takes one step a row, whose error falls as the square of the step: rows of rubber are far apart.
    EXPECT_LT(off, effect.id == "viscoelasticity" ? 0.4 : 0.05) << effect.id;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Every, OtherPhysics,
    ::testing::Values(OtherClass{blind::Base::gho, "artery"}, OtherClass{blind::Base::holzapfel_2015, "artery"},
                      OtherClass{blind::Base::four_fibre, "artery"}, OtherClass{blind::Base::hgo, "sheets"},
                      OtherClass{blind::Base::gho, "sheets"}, OtherClass{blind::Base::yeoh, "rubber"},
                      OtherClass{blind::Base::ogden, "rubber"}),
    [](const auto& test) { return blind::name_of(test.param.first) + "_" + test.param.second; });

// physics.md, section 9: strips of set S, the lateral stretch found by an independent implementation.
TEST(GeneratorPhysics, GivesTheReferenceValuesOfSetS) {
  blind::Tissue tissue;
  tissue.base = blind::Base::gho;
  tissue.mu = 18.668;
  tissue.k1 = 24.905;
  tissue.k2 = 0.2912;
  tissue.kappa = 0.1367;
  tissue.theta = 46.44;
  using enum blind::Material::First;
  const std::vector<double> stretches{1.1, 1.3, 1.5, 1.8};
  const auto around = blind::recorded_stress({circumferential, {0, 1, 2, 3}, stretches}, tissue, {}),
             along = blind::recorded_stress({axial, {0, 1, 2, 3}, stretches}, tissue, {});
  const std::vector<double> expected_around{6.68600383, 26.03758025, 59.13356144, 159.17183865},
      expected_along{6.29738969, 23.65781361, 52.36950158, 136.00590423};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(around[i] / expected_around[i], 1, 1e-6);
    EXPECT_NEAR(along[i] / expected_along[i], 1, 1e-6);
  }
}

// σ = (λ² − 1/λ) · 2 W1 of Yeoh; Σ μ (λ^α − λ^(−α/2)) of Ogden; equibiaxial and pure shear likewise.
TEST(GeneratorPhysics, GivesTheClosedFormsOfRubber) {
  blind::Tissue yeoh, ogden;
  yeoh.base = blind::Base::yeoh;
  yeoh.c10 = 200;
  yeoh.c20 = -2;
  yeoh.c30 = 0.1;
  ogden.base = blind::Base::ogden;
  ogden.mu_1 = 600;
  ogden.alpha_1 = 1.3;
  ogden.mu_2 = -10;
  ogden.alpha_2 = -2;
  const double l = 2.5;
  const auto strip = [&](const blind::Tissue& rubber) {
    return blind::recorded_stress({blind::Material::First::circumferential, {1}, {l}}, rubber, {}).at(0);
  };
  const auto sheet = [&](const blind::Tissue& rubber, blind::Sheet::Kind kind, double along) {
    return blind::recorded_stresses({"", kind, {1}, {l}, {along}}, rubber).at(0).at(0);
  };
  const auto of_yeoh = [&](double thinnest, double middle) {
    const double x = l * l + middle * middle + thinnest * thinnest - 3;
    return 2 * (l * l - thinnest * thinnest) * (200 - 4 * x + 0.3 * x * x);
  };
  const auto of_ogden = [&](double thinnest) {
    return 600 * (std::pow(l, 1.3) - std::pow(thinnest, 1.3)) - 10 * (std::pow(l, -2) - std::pow(thinnest, -2));
  };
  const double lateral = 1 / std::sqrt(l);
  using enum blind::Sheet::Kind;
  EXPECT_NEAR(strip(yeoh), of_yeoh(lateral, lateral), 1e-7);
  EXPECT_NEAR(sheet(yeoh, equibiaxial, l), of_yeoh(1 / (l * l), l), 1e-7);
  EXPECT_NEAR(sheet(yeoh, pure_shear, 1), of_yeoh(1 / l, 1), 1e-7);
  EXPECT_NEAR(strip(ogden), of_ogden(lateral), 1e-7);
  EXPECT_NEAR(sheet(ogden, equibiaxial, l), of_ogden(1 / (l * l)), 1e-7);
  EXPECT_NEAR(sheet(ogden, pure_shear, 1), of_ogden(1 / l), 1e-7);
}

TEST(GeneratorPhysics, BothSidesListTheSameMechanisms) {
  const auto ended = tunica::trial::tunica({"list", "mechanisms"}, std::filesystem::temp_directory_path());
  ASSERT_EQ(ended.code, 0) << ended.err;
  std::set<std::string> listed, hidden;
  std::istringstream lines(ended.out);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("  ") && line.size() > 2 && line[2] != ' ')
      listed.insert(line.substr(2, line.find(' ', 2) - 2));
  for (const blind::Effect& effect : blind::catalogue()) hidden.insert(effect.id);
  EXPECT_EQ(listed.erase("added_term"), 1u);       // for discovery, whose blind benchmark is bench/terms.py
  EXPECT_EQ(listed.erase("damage"), 1u);           // diagnosis does not look for it
  EXPECT_EQ(listed.erase("compressibility"), 1u);  // the generator's specimens keep their volume
  EXPECT_EQ(listed.erase("clamped_ends"), 1u);     // and have no sizes
  // Flaws of a sheet under a camera are hidden by bench/fields/causes.py.
  for (const char* id : {"clamp_slip", "grip_tilt", "oblique_pull", "thickness_gradient", "stiffer_half"})
    EXPECT_EQ(listed.erase(id), 1u) << id;
  // Errors of the record are hidden by bench/wrong_files.py.
  for (const char* id : {"channel_lag", "displacement_offset", "machine_compliance", "sheet_force_offset",
                         "sheet_force_scale_error", "sheet_prestretch", "zeroed_at_preload"})
    EXPECT_EQ(listed.erase(id), 1u) << id;
  EXPECT_EQ(listed, hidden);
  EXPECT_EQ(words().size(), hidden.size());
}

TEST_P(Physics, AgreesWithTheProgramAtTheTrueAmplitude) {
  for (std::size_t index = 0; index < 3; ++index) {
    const double off = largest_difference({11, "singles", GetParam(), 60, index, {"none"}});
    RecordProperty("case_" + std::to_string(index), std::to_string(off));
    EXPECT_LT(off, 0.05) << GetParam() << ", case " << index;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Physics, ::testing::ValuesIn([] {
                           std::vector<std::string> ids;
                           for (const blind::Effect& effect : blind::catalogue()) ids.push_back(effect.id);
                           return ids;
                         }()),
                         [](const auto& test) { return test.param; });

}  // namespace
