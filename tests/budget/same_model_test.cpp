// SPDX-License-Identifier: Apache-2.0
// A base and its cause that together are a registered model are named as that model.
#include "budget/same_model.hpp"

#include <gmock/gmock.h>

#include "diagnosis/measured.hpp"
#include "diagnosis/naming/refits.hpp"

namespace tunica::trial {
namespace {

/// The registered model that the base is with a mechanism of this id, fitted to the data.
std::string model_with(const Measured& measured, const std::string& id, double amplitude) {
  const auto found = measured.diagnose();
  const auto experiment = experiment::measured_only(measured.read());
  const diagnosis::Inquiry inquiry{experiment, found.request, testing::catalogue(), {}};
  const auto refit =
      diagnosis::fit_with(inquiry, found.analysis, {candidate(found, id).hypotheses.front().addition}, {{amplitude}});
  const diagnosis::Evidence& evidence = found.analysis.evidence;
  const discovery::Subject subject{evidence.experiment, evidence.run, found.request.model, false, testing::catalogue()};
  return budget::same_model(subject, evidence, refit.value().extension->assembly(), refit->fit, refit->additions);
}

/// A strip of rubber, and a sheet pulled equally along both directions.
struct StripAndSheet : Measured {
  StripAndSheet()
      : Measured({{"circumferential", testing::evenly(1.1, 3.0, 25), 3},
                  {"equibiaxial", testing::evenly(1.1, 2.2, 25), 3}}) {
    experiment["models"] = {{"rubber", {{"type", "neo_hooke"}, {"parameters", {{"mu", {{"initial", 300}}}}}}}};
    experiment["runs"] = {{{"model", "rubber"}, {"optimizer", "lm"}}};
    nlohmann::json& test = experiment["tests"]["equibiaxial"];
    test["type"] = "biaxial";
    test["protocol"] = "equibiaxial";
    test.erase("direction");
  }
};

Measured::Hide part_of_rubber(nlohmann::json part) {
  return [part = std::move(part)](nlohmann::json& truth) {
    truth["models"]["rubber"]["mechanisms"] = nlohmann::json::array({part});
  };
}

TEST(SameModel, OfFibresThatAreDispersed) {
  Measured measured;
  measured.experiment["models"]["gho"]["type"] = "hgo";
  measured.experiment["models"]["gho"]["parameters"].erase("kappa");
  measured.measure(7, [](nlohmann::json& truth) {
    truth["models"]["gho"]["mechanisms"] = {mechanism("fibre_dispersion", "kappa", 0.2)};
  });
  EXPECT_EQ(model_with(measured, "fibre_dispersion", 0.1), "gho");
}

TEST(SameModel, OfRubberThatStiffensAsItsChainsEnd) {
  const StripAndSheet measured;
  measured.measure(7, part_of_rubber(mechanism("chain_extensibility", "inverse_limit", 0.02)));
  EXPECT_EQ(model_with(measured, "chain_extensibility", 0.01), "gent");
}

TEST(SameModel, OfRubberThatDependsOnTheSecondInvariant) {
  const StripAndSheet measured;
  measured.measure(7, part_of_rubber(mechanism("second_invariant", "c2", 40)));
  EXPECT_EQ(model_with(measured, "second_invariant", 20), "mooney_rivlin");
}

TEST(SameModel, NoneOfAnErrorOfTheRig) {
  const StripAndSheet measured;
  measured.measure(7, {}, [](const Strip&, double) { return 60; });
  EXPECT_EQ(model_with(measured, "force_offset", 1), "");
}

}  // namespace
}  // namespace tunica::trial
