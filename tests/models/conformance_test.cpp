// SPDX-License-Identifier: Apache-2.0
// Every property of conformance/model_properties.hpp on every built-in model. Seed 20230211, the same on every run: the
// outcome is deterministic, so the false-alarm probability is 0 or 1 and known to be 0 when this was committed.
#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "conformance/model_properties.hpp"
#include "support/loaded.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

struct Case {
  std::string model, fibre_switch;
  ModelProperty property;
  std::int64_t terms = 0;
};

class ModelConformance : public ::testing::TestWithParam<Case> {};

TEST_P(ModelConformance, Holds) {
  const Case& c = GetParam();
  Options options;
  if (!c.fibre_switch.empty()) options.set("fibre_switch", c.fibre_switch);
  if (c.terms > 0) options.set("terms", c.terms);
  const auto model = make_model(c.model, options);
  EXPECT_EQ(c.property.check(*model, 20230211).counter_example, "");
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const ModelProperty& property : model_properties()) {
    for (const char* model : {"neo_hooke", "mooney_rivlin", "yeoh", "gent", "arruda_boyce"})
      all.push_back({model, "", property});
    for (const std::int64_t terms : {1, 3, 6}) all.push_back({"ogden", "", property, terms});
    for (const std::int64_t terms : {3, 5, 9}) all.push_back({"mooney_rivlin", "", property, terms});
    for (const char* model : {"gho", "hgo", "holzapfel_2015", "four_fibre"}) {
      all.push_back({model, "strain", property});
      all.push_back({model, "none", property});
    }
    // `stretch` makes W jump where κ > 0 (physics): only the aligned model keeps W differentiable.
    all.push_back({"hgo", "stretch", property});
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Models, ModelConformance, ::testing::ValuesIn(cases()), [](const auto& at) {
  return at.param.model + (at.param.fibre_switch.empty() ? "" : "_" + at.param.fibre_switch) + "_" +
         (at.param.terms > 0 ? std::to_string(at.param.terms) + "_" : "") + at.param.property.name;
});

}  // namespace
}  // namespace tunica::testing
