// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "experiment/experiment.hpp"

namespace tunica::assembly {

/// The place of a parameter in an experiment. FreeParameter::name is its readable name, with dots.
struct ParameterId {
  enum class Owner { model, test, state };
  Owner kind = Owner::model;
  std::string owner = {};      ///< name of the model, test or state
  std::string mechanism = {};  ///< its name there; empty = the owner's own parameter
  std::string name = {};       ///< of a state: as its entry says it

  friend bool operator==(const ParameterId&, const ParameterId&) = default;
};

inline ParameterId of_model(std::string model, std::string mechanism, std::string name) {
  return {ParameterId::Owner::model, std::move(model), std::move(mechanism), std::move(name)};
}
inline ParameterId of_test(std::string test, std::string mechanism, std::string name) {
  return {ParameterId::Owner::test, std::move(test), std::move(mechanism), std::move(name)};
}

/// Its setting in the file; an empty one if the file has none yet. Throws std::logic_error for an unknown owner.
experiment::ParameterSetting& setting_at(experiment::Experiment& experiment, const ParameterId& id);

}  // namespace tunica::assembly
