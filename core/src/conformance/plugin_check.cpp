// SPDX-License-Identifier: Apache-2.0
#include "conformance/plugin_check.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "conformance/isolated.hpp"
#include "conformance/jobs.hpp"
#include "data/nearest.hpp"
#include "tunica/error.hpp"

namespace tunica::conformance {
namespace {

template <class Entries>
std::vector<std::string> names_of(const Entries& entries) {
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries) names.push_back(name);
  return names;
}

/// Keeps the requested items; throws for an unknown name.
Jobs chosen(Jobs all, const std::vector<std::string>& only) {
  if (only.empty()) return all;
  std::vector<std::string> known;
  for (const Job& job : all)
    for (const std::string& name : {job.head.name, job.head.property})
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  for (const std::string& name : only)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("--only {}: the plugin has no such thing, and nothing of it such a property. {}",
                                   name, data::suggestion(name, known)));
  Jobs some;
  for (Job& job : all)
    if (std::find(only.begin(), only.end(), job.head.name) != only.end() ||
        std::find(only.begin(), only.end(), job.head.property) != only.end())
      some.push_back(std::move(job));
  return some;
}

}  // namespace

Contents contents_of(const plugins::Catalogue& catalogue) {
  return {names_of(catalogue.models()), names_of(catalogue.tests()), names_of(catalogue.optimizers()),
          names_of(catalogue.mechanisms())};
}

std::vector<Finding> check_plugin(const Contents& contents, const plugins::Catalogue& catalogue,
                                  const CheckSettings& settings, const std::function<void(const Finding&)>& show) {
  const CheckContext context{catalogue, settings};
  Jobs all;
  const auto append = [&](const std::vector<std::string>& names,
                          Jobs (*make)(const std::string&, const CheckContext&)) {
    for (const std::string& name : names)
      for (Job& job : make(name, context)) all.push_back(std::move(job));
  };
  append(contents.models, model_jobs);
  append(contents.tests, test_jobs);
  append(contents.optimizers, optimizer_jobs);
  append(contents.mechanisms, mechanism_jobs);
  std::vector<Finding> findings;
  for (const Job& job : chosen(std::move(all), settings.only)) {
    const auto begin = std::chrono::steady_clock::now();
    Finding finding = job.head;
    finding.verdict = isolated(job.check, settings.time_limit);
    finding.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    show(finding);
    findings.push_back(std::move(finding));
  }
  return findings;
}

}  // namespace tunica::conformance
