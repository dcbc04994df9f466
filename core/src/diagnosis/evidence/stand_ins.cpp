// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/stand_ins.hpp"

#include <algorithm>
#include <utility>

#include "assembly/assembly.hpp"
#include "assembly/guide.hpp"

namespace tunica::diagnosis {
namespace {

template <class Tests, class OptionsOf>
experiment::Experiment with(experiment::Experiment experiment, const Tests& tests, const OptionsOf& options_of) {
  for (experiment::TestEntry& entry : experiment.tests)
    for (const auto& test : tests)
      if (test.name == entry.name) entry.options = options_of(test);
  return experiment;
}

}  // namespace

StandIns::StandIns(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                   const plugins::Catalogue& catalogue) {
  for (const experiment::TestEntry& entry : experiment.tests) {
    if (std::find(run.tests.begin(), run.tests.end(), entry.name) == run.tests.end()) continue;
    auto found = assembly::stand_in(entry, catalogue);
    if (found && found->type == entry.type) tests_.push_back({entry.name, entry.options, std::move(found->options)});
  }
}

std::vector<std::string> StandIns::names() const {
  std::vector<std::string> all;
  for (const Test& test : tests_) all.push_back(test.name);
  return all;
}

bool StandIns::suffice(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                       const plugins::Catalogue& catalogue) const {
  return !empty() && !assembly::Assembly(cheaper(experiment), run, catalogue).layout().has_costly_tests;
}

experiment::Experiment StandIns::cheaper(experiment::Experiment experiment) const {
  return with(std::move(experiment), tests_, [](const Test& test) { return test.cheaper; });
}

experiment::Experiment StandIns::restored(experiment::Experiment experiment) const {
  return with(std::move(experiment), tests_, [](const Test& test) { return test.own; });
}

}  // namespace tunica::diagnosis
