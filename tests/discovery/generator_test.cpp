// SPDX-License-Identifier: Apache-2.0
// The generator from outside, and what its cases promise.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "bases.hpp"
#include "cli/process.hpp"
#include "execution/folder.hpp"
#include "oracle.hpp"
#include "seal.hpp"

using ::testing::HasSubstr;
using tunica::trial::Ended;
using tunica::trial::Folder;
using tunica::trial::text_of;

namespace {

Ended generator(std::vector<std::string> arguments, const Folder& folder) {
  arguments.insert(arguments.begin(), DISCOVERY_GENERATOR);
  return tunica::trial::Process(std::move(arguments), folder.path()).wait();
}

std::map<std::string, std::string> everything_in(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) all[std::filesystem::relative(entry.path(), folder).string()] = text_of(entry.path());
  return all;
}

double lambda_of(const blind::SealedCase& made) {
  return blind::refit_with(made.specimen, made.noise, {made.hidden.at(0).hidden}, made.specimen.tissue).misfit;
}

}  // namespace

TEST(Generator, MakesTheSameCasesFromTheSameOrdersAndLeavesThemAlone) {
  const Folder folder;
  const std::vector<std::string> order{"--out", "a",       "--set", "singles", "--effect", "active_tone", "--lambda",
                                       "25",    "--cases", "0:2",   "--noise", "white",    "ar1"};
  auto elsewhere = order;
  elsewhere[1] = "b";
  EXPECT_EQ(generator(order, folder).out, "2 cases in a, 2 of them new\n");
  EXPECT_EQ(generator(elsewhere, folder).code, 0);
  const auto first = everything_in(folder.path() / "a");
  EXPECT_EQ(first, everything_in(folder.path() / "b"));
  EXPECT_EQ(generator(order, folder).out, "2 cases in a, 0 of them new\n");
  for (const auto& [file, text] : first) {
    const bool told = text.find("active_tone") != text.npos;
    EXPECT_EQ(told, file.starts_with("sealed")) << file;
  }
}

TEST(Generator, SealsTheTruthWithItsHash) {
  const Folder folder;
  ASSERT_EQ(generator({"--out", ".", "--set", "nulls", "--cases", "0:1", "--oracle"}, folder).code, 0);
  std::size_t seals = 0;
  for (const auto& [file, text] : everything_in(folder.path())) {
    if (!file.ends_with("truth.sha256")) continue;
    const std::string name = file.substr(0, file.find('/'));
    EXPECT_EQ(text, blind::sha256(text_of(folder.path() / "sealed" / (name + ".json"))) + "\n");
    EXPECT_TRUE(
        nlohmann::json::parse(text_of(folder.path() / "sealed" / (name + ".oracle.json"))).contains("detected"));
    ++seals;
  }
  EXPECT_EQ(seals, 1U);
  EXPECT_EQ(blind::sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
}

TEST(Generator, IncludesNothingOfTheProgramItTests) {
  const std::filesystem::path folder = std::filesystem::path(TUNICA_SOURCE_DIR) / "tests/discovery/generator";
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".cpp" && entry.path().extension() != ".hpp") continue;
    const std::string text = text_of(entry.path());
    EXPECT_EQ(text.find("tunica/"), text.npos) << entry.path();
    EXPECT_EQ(text.find("tunica::"), text.npos) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 20U);
}

TEST(Generator, SaysWhatItCannotDo) {
  const Folder folder;
  const auto message = [&](const std::vector<std::string>& arguments) {
    const Ended ended = generator(arguments, folder);
    EXPECT_EQ(ended.code, 2);
    return ended.err + ended.out;
  };
  EXPECT_THAT(message({"--set", "nulls"}), HasSubstr("--out is required"));
  EXPECT_THAT(message({"--out", "a", "--cases", "5"}), HasSubstr("found '5', expected \"first:last\""));
  EXPECT_THAT(message({"--out", "a", "--set", "singles", "--effect", "active_ton"}),
              HasSubstr("no effect 'active_ton'; known: fibre_dispersion"));
  EXPECT_THAT(message({"--out", "a", "--noise", "pink"}), HasSubstr("pink"));
}

TEST(Generator, DialsEveryEffectToTheMisfitThatWasAsked) {
  for (const char* id : {"viscoelasticity", "specimen_misalignment", "layered_wall", "outliers"}) {
    const blind::SealedCase made = blind::make({3, "singles", id, 25, 0, {"relative"}});
    ASSERT_TRUE(made.hidden.at(0).reached) << id;
    EXPECT_NEAR(lambda_of(made) / 25, 1, 0.02) << id;
  }
}

// The opening angle is almost invisible in these tests: no plausible one shows this much.
TEST(Generator, SaysWhereNoPlausibleAmplitudeShowsEnough) {
  const blind::SealedCase made = blind::make({3, "singles", "residual_stress", 1e5, 0, {"white"}});
  EXPECT_FALSE(made.hidden.at(0).reached);
  EXPECT_LT(made.hidden.at(0).lambda, 1e5);
  EXPECT_LE(made.hidden.at(0).hidden.distance, made.hidden.at(0).hidden.largest);
}

TEST(Generator, SolvesTheTubeToATenThousandthOfTheNoise) {
  const blind::SealedCase made = blind::make({3, "singles", "layered_wall", 60, 1, {"white"}});
  const blind::World world = blind::world_with(made.specimen, {made.hidden.at(0).hidden});
  const auto layout = blind::channels(made.specimen.protocol);
  const blind::Noise noise = made.noise.about(made.specimen.protocol, made.truth);
  for (std::size_t i = 0; i < made.specimen.protocol.tubes.size(); ++i) {
    const auto fine = blind::record(made.specimen.protocol.tubes[i], world.tissue, world.tubes[i], 400);
    const blind::Channel& force = layout[made.specimen.protocol.strips.size() + 2 * i + 1];
    for (std::size_t row = 0; row < force.count; ++row)
      EXPECT_NEAR(made.truth[force.first + row], fine.force[row],
                  1e-4 * noise.sd[static_cast<Eigen::Index>(force.first + row)]);
  }
}

// 20 nulls of 204 whitened observations, seed 3: their sum of squares is χ² with 4080 degrees of freedom, sd 90; within
// 360 of its mean with probability 0.99994.
TEST(Generator, AddsTheNoiseThatItStates) {
  for (const char* kind : {"white", "relative", "quantised", "ar1"}) {
    double squares = 0;
    for (std::size_t index = 0; index < 20; ++index) {
      const blind::SealedCase made = blind::make({3, "nulls", "", 0, index, {kind}});
      std::vector<double> error(made.truth.size(), 0.0);
      for (const auto& replicate : made.records.replicates)
        for (std::size_t i = 0; i < error.size(); ++i)
          error[i] += (replicate[i] - made.truth[i]) / static_cast<double>(made.records.replicates.size());
      const auto noise = made.noise.about(made.specimen.protocol, made.truth);
      squares += blind::whiten(made.specimen.protocol, noise, error).squaredNorm();
    }
    EXPECT_NEAR(squares, 4080, 360) << kind;
  }
}

// 20 nulls of 220 (sheets) and 89 (rubber) observations, seed 3: χ² with 4400 and 1780 degrees of freedom, sd 94 and
// 60; within four of them with probability 0.99994.
TEST(Generator, AddsTheNoiseThatItStatesToSheetsAndRubber) {
  for (const auto& [base, protocol, count] :
       {std::tuple(blind::Base::gho, "sheets", 220), {blind::Base::ogden, "rubber", 89}}) {
    double squares = 0;
    for (std::size_t index = 0; index < 20; ++index) {
      const blind::SealedCase made = blind::make({3, "nulls", "", 0, index, {"white"}, base, protocol});
      ASSERT_EQ(made.truth.size(), static_cast<std::size_t>(count));
      std::vector<double> error = made.records.replicates.at(0);
      for (std::size_t i = 0; i < error.size(); ++i) error[i] -= made.truth[i];
      squares += blind::whiten(made.specimen.protocol, made.noise.about(made.specimen.protocol, made.truth), error)
                     .squaredNorm();
    }
    EXPECT_NEAR(squares, 20 * count, 4 * std::sqrt(40.0 * count)) << protocol;
  }
}

TEST(Generator, LeavesOutNothingButTheNoiseWhereItIsNotStated) {
  const Folder folder;
  const std::vector<std::string> order{"--out", "a", "--set", "singles", "--effect", "active_tone", "--lambda", "60"};
  auto silent = order;
  silent.insert(silent.end(), {"--noise-not-stated"});
  ASSERT_EQ(generator(order, folder).code, 0);
  ASSERT_EQ(generator(silent, folder).code, 0);
  blind::CaseOrder stated{1, "singles", "active_tone", 60, 0, {"white", "relative", "quantised"}};
  blind::CaseOrder unstated = stated;
  unstated.noise_stated = false;
  ASSERT_NE(stated.name(), unstated.name());
  const auto place = folder.path() / "a";
  const auto of = [&](const blind::CaseOrder& one, const char* file) { return text_of(place / one.name() / file); };
  for (const char* file : {"axial_strip.csv", "inflation_low.csv"}) EXPECT_EQ(of(stated, file), of(unstated, file));
  EXPECT_THAT(of(stated, "experiment.json"), HasSubstr("\"noise\""));
  EXPECT_THAT(of(unstated, "experiment.json"), ::testing::Not(HasSubstr("\"noise\"")));
  const auto truth = nlohmann::json::parse(text_of(place / "sealed" / (unstated.name() + ".json")));
  EXPECT_EQ(truth.at("stated_twin"), stated.name());
  EXPECT_EQ(truth.at("class").at("noise_stated"), false);
  EXPECT_GT(truth.at("noise").at("channels").at(0).at("absolute").get<double>(), 0) << "the sealed truth knows";
}

TEST(Generator, MixesTheRowsWhereNobodyRecordedTheirOrder) {
  blind::CaseOrder order{3, "nulls", "", 0, 0, {"white"}};
  order.order_recorded = false;
  const blind::SealedCase made = blind::make(order);
  std::size_t reversed = 0;
  for (const auto& [test, rows] : made.rows) {
    EXPECT_EQ((std::set<std::size_t>(rows.begin(), rows.end())).size(), rows.size()) << "every row once";
    EXPECT_FALSE(std::is_sorted(rows.begin(), rows.end()));
    reversed += std::is_sorted(rows.rbegin(), rows.rend());
  }
  EXPECT_EQ(made.rows.size(), 5U);
  EXPECT_LE(reversed, 5U);
  const Folder folder;
  blind::write(order, folder.path());
  EXPECT_EQ(text_of(folder.path() / order.name() / "axial_strip.csv").find("time"), std::string::npos);
  EXPECT_EQ(text_of(folder.path() / order.name() / "experiment.json").find("time"), std::string::npos);
  order.set = "singles";
  order.effect = "viscoelasticity";
  EXPECT_THROW((void)blind::make(order), std::invalid_argument);
}

TEST(Generator, HidesOnlyWhatMakesSense) {
  const auto offered = [](blind::Base base, const char* protocol) {
    std::mt19937_64 random(1);
    const blind::Specimen specimen = blind::draw_specimen(random, base, protocol);
    std::set<std::string> ids;
    for (const blind::Effect& effect : blind::catalogue())
      if (blind::makes_sense(effect, specimen)) ids.insert(effect.id);
    return ids;
  };
  EXPECT_EQ(offered(blind::Base::yeoh, "rubber"),
            (std::set<std::string>{"second_invariant", "stress_softening", "viscoelasticity", "reference_length_error",
                                   "force_scale_error", "force_offset", "permanent_set", "signal_drift", "outliers"}));
  EXPECT_EQ(offered(blind::Base::gho, "sheets"),
            (std::set<std::string>{"axial_fibres", "circumferential_fibres", "matrix_stiffening", "chain_extensibility",
                                   "second_invariant", "fibre_recruitment", "active_tone", "stress_softening",
                                   "viscoelasticity", "signal_drift", "outliers"}));
  EXPECT_EQ(offered(blind::Base::hgo, "artery").size(), blind::catalogue().size());
  std::mt19937_64 random(1);
  EXPECT_THROW((void)blind::draw_specimen(random, blind::Base::yeoh, "artery"), std::invalid_argument);
}

// Closed forms of Holzapfel et al. 2015, eqs. 2.13 and 2.16 have Bessel and error functions: here those of two
// densities that need none. No scatter out of the wall for b → ∞; the whole circle of the wall for a = 0.
TEST(Generator, IntegratesScatterInTheWallAndOutOfIt) {
  const blind::Scatter flat = blind::scatter_in_and_out(0, 1e4);
  EXPECT_NEAR(flat.along, 0.5, 1e-4);
  EXPECT_NEAR(flat.across, 0.5, 1e-4);
  EXPECT_NEAR(flat.normal, 1 / (4e4 + 0.0), 2e-8) << "1/(4b) for large b";
  const blind::Scatter sphere = blind::scatter_in_and_out(0, 0);
  EXPECT_NEAR(sphere.along, 1. / 3, 1e-6);
  EXPECT_NEAR(sphere.across, 1. / 3, 1e-6);
  EXPECT_NEAR(sphere.normal, 1. / 3, 1e-6);
  const blind::Scatter both = blind::scatter_in_and_out(2, 10);
  // κ_ip = ½ − I1(a)/(2 I0(a)); κ_op = ½ − 1/(8b) + √(2/(πb)) exp(−2b)/(4 erf √(2b)).
  const double in = 0.5 - std::cyl_bessel_i(1., 2.) / (2 * std::cyl_bessel_i(0., 2.)),
               out = 0.5 - 1. / 80 +
                     0.25 * std::sqrt(2 / (std::numbers::pi * 10)) * std::exp(-20.) / std::erf(std::sqrt(20.));
  EXPECT_NEAR(both.across, 2 * out * in, 1e-6);
  EXPECT_NEAR(both.along - both.across, 2 * out * (1 - 2 * in), 1e-6);
}

// κ of von Mises fibres comes out of the angular integration; the trace of H is 1.
TEST(Generator, FindsTheScatterThatHasTheDispersionAskedFor) {
  for (const double kappa : {1e-12, 1e-6, 1e-3, 0.1, 0.226, 0.33}) {
    const blind::Scatter found = blind::scatter(kappa);
    EXPECT_NEAR(found.across, kappa, 1e-10 * (1 + 1 / kappa) * kappa);
    EXPECT_NEAR(found.along + 2 * found.across, 1, 1e-12);
  }
}

TEST(Generator, KeepsTheEffectsOfAPairApart) {
  const blind::SealedCase made = blind::make({3, "pairs", "", 60, 0, {"white"}});
  ASSERT_EQ(made.hidden.size(), 2U);
  EXPECT_NE(made.hidden[0].hidden.effect->id, made.hidden[1].hidden.effect->id);
  EXPECT_GE(60 * (1 - made.correlation * made.correlation), 25);
}

// At Λ = 150 the power of a score at 5 % among some 400 exceeds 0.999.
TEST(Oracle, FindsWhatIsPlain) {
  const blind::OracleVerdict verdict = blind::ask_oracle(blind::make({3, "singles", "active_tone", 150, 0, {"white"}}));
  EXPECT_TRUE(verdict.detected);
  EXPECT_EQ(verdict.first, "active_tone");
}

// r is the sum of the first two, of which alone the third, between them, scores most.
TEST(Oracle, TakesTheTwoThatExplainMostTogether) {
  const auto& effects = blind::catalogue();
  Eigen::MatrixXd shapes = Eigen::MatrixXd::Zero(4, 4);
  shapes.col(0) << 1, 0, 0, 0;
  shapes.col(1) << 0.8, 0.6, 0, 0;
  shapes.col(2) << 0.95, 0.3, std::sqrt(0.0075), 0;
  shapes.col(3) << 0, 0, 0, 1;
  std::vector<blind::Signature> all;
  for (std::size_t k = 0; k < 4; ++k)
    all.push_back({&effects[k], {}, false, shapes.col(static_cast<Eigen::Index>(k)), 1});
  const Eigen::VectorXd r = 8 * shapes.col(0) + 8 * shapes.col(1);
  EXPECT_EQ(blind::likeliest_pair(all, shapes, r), (std::pair<std::size_t, std::size_t>(0, 1)));
  all[1].one_sided = true;
  EXPECT_EQ(blind::likeliest_pair(all, shapes, -r), (std::pair<std::size_t, std::size_t>(0, 2))) << "the wrong side";
  const auto likeness = blind::likeness_to(all, shapes, 2);
  ASSERT_EQ(likeness.size(), 2U);
  EXPECT_NEAR(likeness.at(effects[0].id), 0.95, 1e-12);
  EXPECT_NEAR(likeness.at(effects[1].id), 0.94, 1e-12);
}

// At Λ = 400 each, in one fixed case: linear scores, true parameters.
TEST(Oracle, NamesTwoThatArePlain) {
  const blind::SealedCase made = blind::make({3, "pairs", "", 400, 0, {"white"}});
  const blind::OracleVerdict verdict = blind::ask_oracle(made);
  ASSERT_EQ(verdict.pair.size(), 2U);
  EXPECT_EQ((std::set<std::string>{verdict.pair[0], verdict.pair[1]}),
            (std::set<std::string>{made.hidden[0].hidden.effect->id, made.hidden[1].hidden.effect->id}));
}
