// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "tissue.hpp"

namespace blind {

/// A number of the base model that is fitted: as experiment files call it, within the bounds that they state.
struct BaseParameter {
  std::string name;
  double Tissue::*member;
  double low, high;
  bool logarithmic = true;
  double unit = 1;  ///< by which a linear one is divided, so that one is a large step
};

/// What is fitted of each base, and what is held at its true value because no aligned test can tell it.
const std::vector<BaseParameter>& fitted(Base base);
const std::vector<BaseParameter>& held(Base base);

const std::vector<std::string>& base_names();
const std::string& name_of(Base base);
/// Throws std::invalid_argument with the known names.
Base base_called(const std::string& name);
bool isotropic(Base base);

}  // namespace blind
