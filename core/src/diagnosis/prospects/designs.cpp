// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/prospects/designs.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include <fmt/format.h>

#include "data/nearest.hpp"
#include "plugins/default_options.hpp"
#include "plugins/guarded.hpp"
#include "text/lists.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double relative_noise = 0.015;

/// σ_Cauchy = λ P = λ² S of a face that is stretched by λ: by how much the Cauchy stress is larger than the measured
/// one.
double cauchy_factor(const std::string& measure, double stretch) {
  if (measure == "first_piola_kirchhoff") return stretch;
  return measure == "second_piola_kirchhoff" ? stretch * stretch : 1;
}

/// Noise of an observable: the smallest at this value that the data state for it; none where it was not measured.
/// Stresses are Cauchy stresses here, at this stretch.
std::optional<double> known_sd(const Evidence& evidence, const std::string& observable, double value, double stretch) {
  std::optional<double> sd;
  for (const Curve& curve : evidence.curves) {
    if (curve.channel != observable) continue;
    const double factor = cauchy_factor(evidence.experiment.test(curve.test).data.stress_measure, stretch);
    const data::Noise& noise = curve.noise.noise;
    const double own = factor * std::hypot(noise.absolute, noise.relative * value / factor);
    if (own > 0) sd = std::min(sd.value_or(own), own);
  }
  return sd;
}

/// What all types of test are told; `made` is for each its own.
PlanningScope scope_of(const Evidence& evidence, const plugins::Catalogue& catalogue) {
  PlanningScope scope;
  scope.reach = std::clamp(evidence.base->models().largest_stretch(), 1.15, 8.0);
  for (const std::string& name : evidence.run.tests) {
    const auto& entry = evidence.experiment.test(name);
    const auto data = data::read_dataset(entry.data, catalogue.tests().find(entry.type)->second.factory.observables);
    if (data.time.size() < 2) continue;
    const double duration = data.time.back() - data.time.front();
    scope.longest_time = std::max(scope.longest_time, duration);
    scope.shortest_time = scope.shortest_time == 0 ? duration : std::min(scope.shortest_time, duration);
  }
  return scope;
}

std::vector<PlanningScope::Made> made_of(const std::string& type, const Evidence& evidence) {
  std::vector<PlanningScope::Made> made;
  for (const std::string& name : evidence.run.tests) {
    const auto& entry = evidence.experiment.test(name);
    if (entry.type != type || !entry.layers.empty()) continue;
    double largest = 0;
    for (const Curve& curve : evidence.curves)
      if (curve.test == name)
        largest = std::max(largest, *std::max_element(curve.abscissa.begin(), curve.abscissa.end()));
    made.push_back({name, entry.options, largest});
  }
  return made;
}

using TestInCatalogue = plugins::Catalogue::Entry<TestFactory>;

[[noreturn]] void refuse(const TestInCatalogue& type, const PlannedTest& plan, const std::string& problem) {
  throw plugins::PluginFailure(
      fmt::format("plugin '{}': its plan '{}' for tests '{}' {}; correct what its plan returns", type.plugin,
                  plan.description, type.factory.type, problem));
}

/// `Declared` has a name: an option or a parameter.
template <class Value, class Declared>
void check_names(const char* kind, const std::vector<std::pair<std::string, Value>>& given,
                 const std::vector<Declared>& declared, const TestInCatalogue& type, const PlannedTest& plan) {
  std::vector<std::string> known;
  for (const Declared& one : declared) known.push_back(one.name);
  for (const auto& [name, value] : given)
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(type, plan,
             fmt::format("sets the {0} '{1}', and the test has no such {0}. {2}", kind, name,
                         data::suggestion(name, known)));
}

/// The rows of a plan: all columns must have them.
std::size_t row_count(const PlannedTest& plan, const TestInCatalogue& type) {
  if (plan.abscissae.empty()) refuse(type, plan, "has no abscissa, expected at least one");
  const std::size_t rows = plan.abscissae.front().second.size();
  const auto check_length = [&](const std::string& column, std::size_t found) {
    if (found == 0 || found != rows)
      refuse(
          type, plan,
          fmt::format("has {} in '{}', expected {}", text::counted(found, "value", "values"), column,
                      rows == 0 ? "one or more" : fmt::format("{}, as in '{}'", rows, plan.abscissae.front().first)));
  };
  for (const auto& [name, column] : plan.abscissae) check_length(name, column.size());
  if (!plan.time.empty()) check_length("time", plan.time.size());
  return rows;
}

/// The design of a plan without its noise; nothing where the type wants more than the plan says.
std::optional<Design> design_of(const PlannedTest& plan, const TestInCatalogue& type) {
  const std::size_t rows = row_count(plan, type);
  check_names("option", plan.options, type.factory.options, type, plan);
  Options options = plugins::default_options(type.factory.options);
  for (const auto& [name, value] : plan.options) options.set(name, value);
  TestSetup setup{options, {rows, {}, plan.channels, plan.time}, "cauchy"};
  for (const auto& [name, column] : plan.abscissae) setup.rows.abscissae.push_back({name, column});
  Design design{plan.description, {}, {}, {}};
  try {
    design.test = plugins::create(type, setup);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return std::nullopt;
  }
  const TestDescription& description = design.test->describe();
  check_names("parameter", plan.parameters, description.parameters, type, plan);
  for (std::size_t k = 0; k < description.parameters.size(); ++k) {
    double value = std::isnan(description.nulls[k]) ? description.parameters[k].initial : description.nulls[k];
    for (const auto& [name, own] : plan.parameters)
      if (name == description.parameters[k].name) value = own;
    design.parameters.push_back(value);
  }
  return design;
}

/// σ of each predicted value. Relative noise alone would make rows near zero exact: no row is known better than one of
/// a tenth of the largest.
std::vector<double> noise_of(const PlannedTest& plan, const std::vector<double>& values, const Evidence& evidence) {
  std::vector<double> sd;
  const std::size_t n = plan.abscissae.front().second.size();
  for (std::size_t k = 0; k < plan.channels.size(); ++k) {
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(values[k * n + i]));
    const bool plain_stretch = plan.channels[k] == "transverse_stretch";
    for (std::size_t i = 0; i < n; ++i) {
      const double value = std::max(std::abs(values[k * n + i]), 0.1 * largest);
      const auto& [along, stretches] = plan.abscissae[std::min(k, plan.abscissae.size() - 1)];
      const bool stress = plan.channels[k].starts_with("stress") && along.starts_with("stretch");
      const auto known = known_sd(evidence, plan.channels[k], value, stress ? stretches[i] : 1);
      sd.push_back(std::max(known.value_or(plain_stretch ? 0.005 : relative_noise * largest), 1e-12));
    }
  }
  return sd;
}

}  // namespace

bool predict(const Design& design, const assembly::Assembly& assembly, std::span<const double> free,
             std::vector<double>& values) {
  const std::vector<double> parameters = assembly.models().parameters(0, free);
  values.assign(design.test->rows().count * design.test->rows().channels.size(), 0.0);
  try {
    return design.test->predict({assembly.models().model(0), parameters, design.parameters}, {values, {}, {}, {}}).ok();
  } catch (const std::exception&) {
    return false;
  }
}

std::vector<Design> designs(const Inquiry& inquiry, const Evidence& evidence, const assembly::Assembly& scale,
                            std::span<const double> free) {
  std::vector<Design> library;
  PlanningScope scope = scope_of(evidence, inquiry.catalogue);
  for (const auto& [type, entry] : inquiry.catalogue.tests()) {
    if (!entry.factory.plan) continue;
    scope.made = made_of(type, evidence);
    for (const PlannedTest& plan : plugins::guarded(entry.plugin, "plan", [&] { return entry.factory.plan(scope); })) {
      std::optional<Design> design = design_of(plan, entry);
      std::vector<double> values;
      if (!design || !predict(*design, scale, free, values)) continue;
      design->sd = noise_of(plan, values, evidence);
      library.push_back(std::move(*design));
    }
  }
  return library;
}

}  // namespace tunica::diagnosis
