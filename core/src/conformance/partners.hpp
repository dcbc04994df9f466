// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "plugins/catalogue.hpp"
#include "tunica/model.hpp"
#include "tunica/options.hpp"

/// The partners in the check of a plugin: reliable materials, and realistic options.
namespace tunica::conformance {

/// A material and parameters at which tests are simulated.
struct Material {
  std::string name;
  std::shared_ptr<const Model> model;
  std::vector<double> parameters;
};

/// Neo-Hookean rubber.
std::unique_ptr<Model> rubber();
/// A neo-Hookean matrix and fibres at ±45° that carry load always, so that everything is smooth. Shear between fibres
/// and the normal of the wall stiffens it, so that no two planes of shear are alike.
std::unique_ptr<Model> fibrous();
/// The same with fibres that carry load while stretched.
std::unique_ptr<Model> slack_fibrous();
/// A compressible rubber, for loads that change the volume.
std::unique_ptr<Model> compressible_rubber();
/// The first three, at moderate parameters.
std::vector<Material> materials();

/// Every declared default; where the user must give an option, what its bounds and choices allow.
Options plausible_options(const std::vector<Option>& declared);

/// Initial values as declared.
std::vector<double> initial_values(const std::vector<Parameter>& parameters);

}  // namespace tunica::conformance
