// SPDX-License-Identifier: Apache-2.0
#include "assembly/guide.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plugins/guarded.hpp"
#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

/// Options that the stand-in does not set take their default, as in a file.
Options completed(Options given, const std::vector<Option>& declared) {
  for (const Option& option : declared)
    if (!given.has(option.name) && option.fallback) given.set(option.name, *option.fallback);
  return given;
}

/// Whether the residuals and parameters of both runs have the same meaning.
bool alike(const Layout& a, const Layout& b) {
  const auto same_name = [](const FreeParameter& one, const FreeParameter& other) { return one.name == other.name; };
  return a.residual_count == b.residual_count && a.blocks.size() == b.blocks.size() &&
         a.parameters.size() == b.parameters.size() &&
         std::equal(a.parameters.begin(), a.parameters.end(), b.parameters.begin(), same_name);
}

}  // namespace

std::optional<StandIn> stand_in(const experiment::TestEntry& test, const plugins::Catalogue& catalogue) {
  const auto& costly = catalogue.tests().at(test.type);
  const auto& factory = costly.factory;
  auto found = factory.stand_in
                   ? plugins::guarded(costly.plugin, "stand_in", [&] { return factory.stand_in(test.options); })
                   : std::nullopt;
  if (!found) return std::nullopt;
  const auto on_shelf = catalogue.tests().find(found->type);
  if (on_shelf == catalogue.tests().end())
    throw InputError(
        fmt::format("the test '{}' would be guided by a '{}', which no loaded plugin provides; leave \"guide\" "
                    "out, or load that plugin",
                    test.name, found->type));
  found->options = completed(std::move(found->options), on_shelf->second.factory.options);
  return found;
}

std::unique_ptr<Assembly> make_guide(const experiment::Experiment& experiment, const experiment::RunEntry& run,
                                     const std::string& label, const plugins::Catalogue& catalogue,
                                     const Assembly& full) {
  if (!full.layout().has_costly_tests) return nullptr;
  experiment::Experiment cheaper = experiment;
  for (experiment::TestEntry& entry : cheaper.tests) {
    if (std::find(run.tests.begin(), run.tests.end(), entry.name) == run.tests.end()) continue;
    try {
      auto found = stand_in(entry, catalogue);
      if (!found) continue;
      entry.type = found->type;
      entry.options = std::move(found->options);
    } catch (const InputError& problem) {
      throw InputError(fmt::format("run {}: {}", label, problem.what()));
    }
  }
  std::unique_ptr<Assembly> guide;
  try {
    guide = std::make_unique<Assembly>(cheaper, run, catalogue);
  } catch (const InputError& problem) {
    throw InputError(
        fmt::format("run {}: the tests that would guide it cannot be made; leave \"guide\" out. The reason: {}", label,
                    problem.what()));
  }
  if (guide->layout().has_costly_tests)
    throw InputError(
        fmt::format("run {}: \"guide\" is true, and not each of its costly tests has a cheaper one that stands in for "
                    "it; leave \"guide\" out",
                    label));
  if (!alike(guide->layout(), full.layout()))
    throw InputError(
        fmt::format("run {}: the tests that would guide it have other free parameters or rows than its own; leave "
                    "\"guide\" out",
                    label));
  return guide;
}

}  // namespace tunica::assembly
