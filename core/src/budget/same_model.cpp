// SPDX-License-Identifier: Apache-2.0
#include "budget/same_model.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "diagnosis/hypotheses/extension.hpp"
#include "plugins/default_options.hpp"
#include "tunica/error.hpp"

namespace tunica::budget {
namespace {

/// Of |r|², between two fits of one model: each ends where a step promises 1e-6.
constexpr double the_same = 1e-4;

/// The base replaced by another type: with its options where that has them, and without what is added to it.
std::optional<diagnosis::Extension> replaced(const discovery::Subject& subject, const std::string& type,
                                             const std::vector<diagnosis::Addition>& to_tests) {
  experiment::Experiment experiment = subject.experiment;
  const auto entry = std::find_if(experiment.models.begin(), experiment.models.end(),
                                  [&](const auto& one) { return one.name == subject.model; });
  entry->type = type;
  const experiment::ParameterSettings settings = entry->parameters;
  const Options options = entry->options;
  for (const bool keeps_options : {true, false})
    for (const bool keeps_settings : {true, false}) {
      entry->options = plugins::default_options(subject.catalogue.models().at(type).factory.options);
      if (keeps_options)
        for (const auto& [name, value] : options.values()) entry->options.set(name, value);
      entry->parameters = keeps_settings ? settings : experiment::ParameterSettings{};
      try {
        return diagnosis::Extension(experiment, subject.run, to_tests, subject.catalogue);
      } catch (const InputError&) {  // options or parameters of the base that this model does not have
      }
    }
  return std::nullopt;
}

/// Initial values, with those of the extension where the names are the same.
std::vector<double> start_in(const assembly::Assembly& assembly, const std::map<std::string, double>& known) {
  std::vector<double> start;
  for (const auto& parameter : assembly.layout().parameters) {
    const auto same = known.find(parameter.name);
    start.push_back(std::clamp(same == known.end() ? parameter.initial : same->second, parameter.min, parameter.max));
  }
  return start;
}

}  // namespace

std::string same_model(const discovery::Subject& subject, const diagnosis::Evidence& evidence,
                       const assembly::Assembly& extended, const diagnosis::Fit& fit,
                       const std::vector<diagnosis::Addition>& additions) {
  std::vector<diagnosis::Addition> to_tests;
  for (const diagnosis::Addition& one : additions)
    if (!one.place.tests.empty()) to_tests.push_back(one);
  std::map<std::string, double> known;
  for (std::size_t j = 0; j < fit.free.size(); ++j) known[extended.layout().parameters[j].name] = fit.free[j];
  const std::string own = evidence.experiment.model(subject.model).type;
  for (const auto& [type, factory] : subject.catalogue.models()) {
    if (type == own) continue;
    const auto other = replaced(subject, type, to_tests);
    if (!other || other->assembly().layout().parameters.size() != known.size()) continue;
    const assembly::Assembly& assembly = other->assembly();
    const auto workspace = assembly.evaluator().make_workspace();
    for (const bool from_extension : {true, false}) {
      const std::vector<double> start = start_in(assembly, from_extension ? known : std::map<std::string, double>{});
      const diagnosis::Fit found = diagnosis::least_squares(assembly, other->variables(), start, *workspace);
      if (found.status.ok() && (found.residuals - fit.residuals).squaredNorm() < the_same) return type;
    }
  }
  return "";
}

}  // namespace tunica::budget
