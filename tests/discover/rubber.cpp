// SPDX-License-Identifier: Apache-2.0
#include "discover/rubber.hpp"

namespace tunica::trial {

using nlohmann::json;

Rubber::Rubber()
    : Measured({{"circumferential", testing::evenly(1.1, 3.0, 25), 3},
                {"equibiaxial", testing::evenly(1.1, 2.2, 25), 3},
                {"pure_shear", testing::evenly(1.1, 2.5, 25), 3}}) {
  experiment["models"] = {{"rubber", {{"type", "neo_hooke"}, {"parameters", {{"mu", {{"initial", 300}}}}}}}};
  experiment["runs"] = {{{"model", "rubber"}, {"optimizer", "lm"}}};
  for (const char* protocol : {"equibiaxial", "pure_shear"}) {
    json& test = experiment["tests"][protocol];
    test["type"] = "biaxial";
    test["protocol"] = protocol;
    test.erase("direction");
  }
}

discovery::Discovery Rubber::discover(bool from_nothing, bool quick) const {
  const auto read = this->read();
  discovery::Request request = discovery::request_of(read);
  request.from_nothing = from_nothing;
  request.quick = quick;
  return discovery::discover(read, request, tunica::testing::catalogue());
}

Measured::Hide hidden_term(const json& term) {
  return [term](json& experiment) {
    json mechanism = term;
    mechanism["type"] = "added_term";
    for (auto& [name, model] : experiment["models"].items()) model["mechanisms"] = json::array({mechanism});
  };
}

}  // namespace tunica::trial
