// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assembly/layout.hpp"
#include "assembly/parameter_vector.hpp"
#include "experiment/experiment.hpp"
#include "tunica/parameter.hpp"

namespace tunica::assembly {

/// One parameter at its place in the parameter vector of its owner, the model or a test.
struct Slot {
  Parameter declaration;                                   ///< under its name outside the plugin
  const experiment::ParameterSetting* setting = nullptr;   ///< the entry in the file; null = none
  double null = std::numeric_limits<double>::quiet_NaN();  ///< a native imperfection is held here unless mentioned
  /// The slot of an earlier owner that supplies its value: {owner, position}.
  struct Same {
    std::size_t owner, position;
  };
  std::optional<Same> same_as = {};
  ParameterId id = {};
};

struct Binding {
  std::vector<FreeParameter> free;  ///< in the order of their first slot
  std::vector<FixedParameter> fixed;
  std::vector<ParameterVector> owners;  ///< as the slots were given
};

/// Sorts the parameters of a run into free and held ones. The file overrides what the plugin declares; a default
/// initial value is clamped into narrowed bounds. Parameters with the same `share` become one free parameter of that
/// name, within the intersection of their bounds. Throws InputError with the JSON pointer of the setting.
Binding bind_parameters(const std::vector<std::vector<Slot>>& owners);

/// Throws InputError for the first setting whose name is not in `known`; `owner` reads like "test 'strip'".
void refuse_unknown(const experiment::ParameterSettings& settings, const std::vector<std::string>& known,
                    const std::string& owner);

}  // namespace tunica::assembly
