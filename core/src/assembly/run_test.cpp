// SPDX-License-Identifier: Apache-2.0
#include "assembly/run_test.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

/// Whether a parameter is free, or held away from its null, although exact derivatives along a path require the null.
bool off_the_path(const RunTest& test) {
  const TestDescription& description = test.test->describe();
  for (const std::string& name : description.path_exceptions)
    for (std::size_t j = 0; j < description.parameters.size(); ++j) {
      if (description.parameters[j].name != name) continue;
      if (test.own.values[j] != description.nulls[j] ||
          std::any_of(test.own.links.begin(), test.own.links.end(),
                      [j](const Link& link) { return link.position == j; }))
        return true;
    }
  return false;
}

bool has_derivatives(const RunTest& test, const ModelDescription& model) {
  if (test.test->describe().differencing) return false;
  if (model.history_size == 0) return model.parameter_derivatives;
  return model.axis_history_size > 0 && test.test->describe().path_derivatives && !off_the_path(test);
}

/// A test that simulates J = 1 takes only incompressible models; a test whose load changes the volume takes only
/// compressible ones. Other tests take both.
void refuse_volume(const RunTest& test, const RunModel& model) {
  using Volume = TestDescription::Volume;
  const ModelDescription& description = model.model->describe();
  const Volume volume = test.test->describe().volume;
  if (volume == Volume::kept && description.compressible)
    throw InputError(fmt::format(
        "test '{}': it simulates a specimen that keeps its volume, and the model '{}' ('{}') changes it. Choose an "
        "incompressible model, or a test that solves for the volume: 'uniaxial', 'biaxial', 'simple_shear', "
        "'plane_specimen', 'bulge', 'confined_compression', 'volumetric'",
        test.name, model.name, description.type));
  if (volume == Volume::free && !description.compressible)
    throw InputError(
        fmt::format("test '{}': its load changes the volume, and the model '{}' ('{}') keeps it. Choose a compressible "
                    "model, or give the model \"mechanisms\": [{{\"type\": \"compressibility\"}}]",
                    test.name, model.name, description.type));
  if (description.compressible && description.history_size > 0)
    throw InputError(
        fmt::format("model '{}': it changes its volume and remembers, which no test simulates; take one of "
                    "the two out",
                    model.name));
}

}  // namespace

void assign_models(RunTest& test, const experiment::TestEntry& entry, const std::vector<RunModel>& models) {
  const auto add = [&test](const RunModel& model) {
    refuse_volume(test, model);
    const std::size_t first = test.materials.values.size();
    const std::vector<double>& values = model.parameters.values;
    test.materials.values.insert(test.materials.values.end(), values.begin(), values.end());
    for (const Link& link : model.parameters.links) test.materials.links.push_back({first + link.position, link.index});
    test.differenced = test.differenced || !has_derivatives(test, model.model->describe());
  };
  const auto first = std::find_if(models.begin(), models.end(),
                                  [&entry](const RunModel& candidate) { return candidate.state == entry.state; });
  if (entry.layers.empty()) add(*first);
  for (const experiment::LayerEntry& layer : entry.layers) {
    const auto named = std::find_if(models.begin(), models.end(),
                                    [&layer](const RunModel& candidate) { return candidate.name == layer.model; });
    test.layers.push_back(named->model.get());
    test.layer_names.push_back(named->name);
    add(*(first + (named - models.begin())));
  }
  test.model = test.layers.empty() ? models.front().model.get() : test.layers.front();
}

void chain_parameters(RunTest& test, std::size_t free_count) {
  std::vector<std::optional<std::size_t>> first(free_count);
  const auto visit = [&](const Link& link, std::size_t slot) {
    if (first[link.index]) {
      test.sums.emplace_back(*first[link.index], slot);
    } else {
      first[link.index] = slot;
    }
  };
  for (const Link& link : test.materials.links) visit(link, link.position);
  for (const Link& link : test.own.links) visit(link, test.materials.values.size() + link.position);
  for (std::size_t index = 0; index < free_count; ++index) {
    if (!first[index]) {
      test.untouched.push_back(index);
    } else {
      // Differences fill rows in the order of free parameters, not of slots; there are never more rows than slots.
      test.columns.emplace_back(index, test.differenced ? test.columns.size() : *first[index]);
    }
  }
}

}  // namespace tunica::assembly
