// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "experiment/experiment.hpp"

namespace tunica::assembly {

/// Where a parameter is in an experiment. Its name for people, with dots, is FreeParameter::name.
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

/// What the file says of it: an empty setting where it says nothing yet. std::logic_error: there is no such owner.
experiment::ParameterSetting& setting_at(experiment::Experiment& experiment, const ParameterId& id);

}  // namespace tunica::assembly
