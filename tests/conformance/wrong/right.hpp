// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tunica/models/hyperelastic.hpp"
#include "tunica/models/isotropic.hpp"
#include "tunica/models/rubber_laws.hpp"
#include "tunica/plugin.hpp"

namespace tunica::wrong {

/// Yeoh's rubber, in order but for what a class derived from it does to the answers.
class Right : public Model {
 public:
  explicit Right(const std::string& type) : right_(described(type), cubic()), description_(right_.describe()) {
    description_.principal_axes = false;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    return right_.evaluate(points, response);
  }

 private:
  static ModelDescription described(const std::string& type) {
    ModelDescription description;
    description.type = type;
    for (const char* name : {"c10", "c20", "c30"})
      description.parameters.push_back({name, "kPa", 1, 0.1, 10, Scale::log, "A coefficient.", ""});
    return description;
  }
  static std::vector<std::unique_ptr<EnergyPart>> cubic() {
    std::vector<std::unique_ptr<EnergyPart>> all;
    all.push_back(isotropic::part<laws::Cubic, isotropic::FirstInvariant, 3>("matrix", {0, 1, 2}));
    return all;
  }
  Hyperelastic right_;
  ModelDescription description_;
};

/// A factory of such a model.
template <class Wrong>
ModelFactory factory(const std::string& type, const std::string& doc) {
  return {type, doc, "", {}, [type](const Options&) { return std::make_unique<Wrong>(type); }};
}

}  // namespace tunica::wrong
