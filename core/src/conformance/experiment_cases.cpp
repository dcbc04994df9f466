// SPDX-License-Identifier: Apache-2.0
// Tests and models as an experiment has them.
#include <algorithm>

#include "assembly/composition.hpp"
#include "conformance/test_cases.hpp"

namespace tunica::conformance {
namespace {

std::vector<double> values_of(const std::vector<assembly::Slot>& slots, const std::vector<double>& otherwise) {
  std::vector<double> values = otherwise;
  for (std::size_t k = 0; k < slots.size() && k < values.size(); ++k) {
    const experiment::ParameterSetting* setting = slots[k].setting;
    if (setting == nullptr) continue;
    if (setting->fixed)
      values[k] = *setting->fixed;
    else if (setting->initial)
      values[k] = *setting->initial;
    else  // a default begins within narrowed bounds
      values[k] = std::clamp(values[k], setting->min.value_or(values[k]), setting->max.value_or(values[k]));
  }
  return values;
}

Material composed(const experiment::ModelEntry& entry, const plugins::Catalogue& catalogue) {
  assembly::ComposedModel made = assembly::compose_model(entry, catalogue, "");
  std::vector<double> values = values_of(made.slots, initial_values(made.model->describe().parameters));
  return {entry.name, std::move(made.model), std::move(values)};
}

/// The model of the first run that has the test.
std::string model_for(const experiment::Experiment& experiment, const std::string& test) {
  for (const experiment::RunEntry& run : experiment.runs)
    if (!run.model.empty() && std::find(run.tests.begin(), run.tests.end(), test) != run.tests.end()) return run.model;
  return experiment.models.front().name;
}

}  // namespace

std::vector<Material> models_of(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  std::vector<Material> all;
  for (const experiment::ModelEntry& entry : experiment.models) all.push_back(composed(entry, catalogue));
  return all;
}

std::vector<TestCase> experiment_cases(const experiment::Experiment& experiment, const std::vector<std::string>& types,
                                       const plugins::Catalogue& catalogue) {
  std::vector<TestCase> all;
  for (const experiment::TestEntry& entry : experiment.tests) {
    if (std::find(types.begin(), types.end(), entry.type) == types.end()) continue;
    assembly::ComposedTest made = assembly::compose_test(entry, catalogue);
    TestCase test_case{entry.name, std::move(made.test), {}, {}, {}, {}};
    test_case.own = values_of(made.slots, own_values(test_case.test->describe()));
    if (entry.layers.empty()) {
      test_case.material = composed(experiment.model(model_for(experiment, entry.name)), catalogue);
    } else {
      for (const experiment::LayerEntry& layer : entry.layers) {
        Material one = composed(experiment.model(layer.model), catalogue);
        test_case.layers.push_back(one.model);
        if (!test_case.material.model) test_case.material.model = one.model;
        test_case.material.name += (test_case.material.name.empty() ? "" : "+") + one.name;
        test_case.material.parameters.insert(test_case.material.parameters.end(), one.parameters.begin(),
                                             one.parameters.end());
      }
    }
    all.push_back(std::move(test_case));
  }
  return all;
}

}  // namespace tunica::conformance
