// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "assembly/binding.hpp"
#include "data/dataset.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "tunica/model.hpp"
#include "tunica/test.hpp"

namespace tunica::assembly {

/// A model inside its mechanisms, in the canonical order of Stage, whatever the order in the file. Mechanisms of one
/// stage keep the file's order. A mechanism's parameters follow those of the object that it wraps.
struct ComposedModel {
  std::unique_ptr<Model> model;
  std::string plugin;       ///< "gho 0.1.0"
  std::vector<Slot> slots;  ///< one per parameter of the outermost description
};
/// The outside names of its parameters begin with `prefix`.
ComposedModel compose_model(const experiment::ModelEntry& entry, const plugins::Catalogue& catalogue,
                            const std::string& prefix);

/// A test bound to its data, inside its mechanisms; the outside names of parameters begin with the test's name.
struct ComposedTest {
  std::unique_ptr<Test> test;
  std::string plugin;
  std::vector<Slot> slots;
  data::Dataset dataset;
};
/// The test writes material cards of `model`; nullptr = it can write none.
ComposedTest compose_test(const experiment::TestEntry& entry, const plugins::Catalogue& catalogue,
                          const experiment::ModelEntry* model = nullptr);

}  // namespace tunica::assembly
