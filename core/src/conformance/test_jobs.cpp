// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "conformance/declarations.hpp"
#include "conformance/isolated.hpp"
#include "conformance/jobs.hpp"
#include "conformance/option_values.hpp"
#include "conformance/test_bench.hpp"
#include "plugins/guarded.hpp"

namespace tunica::conformance {
namespace {

/// The simulations that a property is checked with: other materials, and imperfections that are there.
std::vector<Simulation> simulations(const Benched& bench) {
  std::vector<const Model*> layers;
  for (const auto& layer : bench.layers) layers.push_back(layer.get());
  std::vector<Simulation> all{{*bench.test, *bench.material.model, bench.material.parameters, bench.own, layers}};
  const TestDescription& description = bench.test->describe();
  if (description.costly) return all;
  std::vector<double> moved = bench.own;
  for (std::size_t k = 0; k < moved.size(); ++k) moved[k] += 0.1 * (description.parameters[k].max - moved[k]);
  if (moved != bench.own) all.push_back({*bench.test, *bench.material.model, bench.material.parameters, moved, layers});
  if (bench.from) {
    static const Material other = materials().back();
    all.push_back({*bench.test, *other.model, other.parameters, bench.own, {}});
  }
  return all;
}

/// The worst of the verdicts.
Verdict check_all(const TestProperty& property, const Benched& bench, std::uint64_t seed) {
  Verdict worst;
  bool first = true;
  for (const Simulation& simulation : simulations(bench)) {
    // Where imperfections as large as these cannot be simulated, the test has said so.
    if (!first) {
      std::vector<double> values(simulation.test.rows().count * simulation.test.rows().channels.size());
      if (!simulation.test.predict(simulation.input(), {values, {}, {}, {}}).ok()) continue;
    }
    Verdict one = property.check(simulation, seed);
    if (first || !one.counter_example.empty() || (one.held() && worst.held() && one.worst > worst.worst))
      worst = std::move(one);
    if (!worst.counter_example.empty()) return worst;
    first = false;
  }
  return worst;
}

/// A test copies what it keeps, and gives it back as rows().
Verdict rows_are_kept(const plugins::Catalogue::Entry<TestFactory>& entry, const MadeUp& from) {
  const std::string compared = "rows() with the rows the test was made from, after these are gone";
  auto given = std::make_unique<MadeUp>(from);
  const auto test = plugins::create(entry, given->setup());
  for (auto& [name, values] : given->abscissae) std::fill(values.begin(), values.end(), -1e9);
  given.reset();
  const TestRows& rows = test->rows();
  if (rows.count != from.count())
    return broken(compared, fmt::format("{} rows, {} were given", rows.count, from.count()));
  if (rows.channels != from.channels) return broken(compared, "other channels, or in another order");
  if (rows.abscissae.size() != from.abscissae.size())
    return broken(compared, fmt::format("{} abscissae, {} were given", rows.abscissae.size(), from.abscissae.size()));
  for (std::size_t k = 0; k < rows.abscissae.size(); ++k) {
    const auto& [name, values] = from.abscissae[k];
    if (rows.abscissae[k].observable != name ||
        !std::equal(values.begin(), values.end(), rows.abscissae[k].values.begin(), rows.abscissae[k].values.end()))
      return broken(compared,
                    fmt::format("the abscissa '{}' is not what was given: copy it when the test is made", name));
  }
  return {.compared = compared};
}

std::string words(const Benched& bench) {
  if (!bench.from) return fmt::format("as '{}' in the experiment, with model '{}'", bench.name, bench.material.name);
  return fmt::format("with made-up rows: {}", bench.from->words());
}

}  // namespace

Jobs test_jobs(const std::string& type, const Around& around) {
  const auto& entry = around.catalogue.tests().find(type)->second;
  const std::uint64_t seed = around.settings.seed;
  Finding head{"test", type, "", ""};
  Jobs jobs;
  add(jobs, head, "declaration_is_complete", [&entry] { return declaration_is_complete(entry.factory); });

  std::vector<std::shared_ptr<const Benched>> benches;
  std::string why = "the experiment has no test of this type";
  if (around.settings.experiment != nullptr) {
    for (Benched& bench : from_experiment(*around.settings.experiment, {type}, around.catalogue))
      benches.push_back(std::make_shared<const Benched>(std::move(bench)));
  } else {
    // First in a process of its own: what a wrong test does while it is made and asked is not known yet.
    const Verdict able = isolated(
        [&] {
          static_cast<void>(make_up(entry, seed));
          return Verdict{};
        },
        around.settings.time_limit);
    why = able.counter_example;
    if (able.held()) benches.push_back(std::make_shared<const Benched>(make_up(entry, seed)));
  }
  if (benches.empty())
    add(jobs, head, "predictions_are_numbers", [why] { return not_checked("predictions of the test with data", why); });
  for (const auto& bench : benches) {
    head.with = words(*bench);
    add(jobs, head, "parameters_are_declared",
        [bench, &entry] { return parameters_are_declared(bench->test->describe(), entry.factory); });
    if (bench->from) {
      add(jobs, head, "rows_are_kept", [bench, &entry] { return rows_are_kept(entry, *bench->from); });
      add(jobs, head, "is_made_with_every_option", [bench, &entry] {
        return made_with_every_option(entry.factory.options, [&](const Options& options) {
          MadeUp from = *bench->from;
          for (const auto& [name, value] : options.values()) from.options.set(name, value);
          plugins::create(entry, from.setup());
        });
      });
    }
    for (const TestProperty& property : test_properties()) {
      head.property = property.name, head.advisory = property.advisory;
      jobs.push_back({head, [bench, property, seed] { return check_all(property, *bench, seed); }});
    }
  }
  return jobs;
}

}  // namespace tunica::conformance
