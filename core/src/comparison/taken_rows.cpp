// SPDX-License-Identifier: Apache-2.0
#include "comparison/taken_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "assembly/channels.hpp"
#include "data/dataset.hpp"
#include "results/keys.hpp"
#include "tunica/error.hpp"

namespace tunica::comparison {

namespace key = results::key;

namespace {

std::string unit_of(const std::string& observable, const std::vector<Observable>& declared) {
  const auto found =
      std::find_if(declared.begin(), declared.end(), [&](const Observable& one) { return one.name == observable; });
  return found == declared.end() ? "1" : found->unit;
}

TakenRows taken_of(const experiment::TestEntry& test, const std::vector<Observable>& observables) {
  const data::Dataset dataset = data::read_dataset(test.data, observables);
  TakenRows taken{{test.name, {}, {}}, dataset.lines, dataset.understood, dataset.warnings};
  const auto add = [&](const std::string& name, const std::string& unit, const std::vector<double>& values) {
    taken.table.headers.push_back(fmt::format("{} [{}]", name, unit));
    taken.table.columns.push_back(values);
  };
  for (const auto& [name, values] : dataset.abscissae) {
    add(name, unit_of(name, observables), values);
    taken.table.prescribed.push_back(name);
  }
  if (!dataset.time.empty()) add("time", "s", dataset.time);
  for (const data::Channel& channel : dataset.channels) add(channel.observable, channel.unit, channel.values);
  const std::vector<bool> fitted = assembly::fitted_rows(test, dataset);
  std::vector<double> held_out;
  for (const bool row : fitted) held_out.push_back(row ? 0 : 1);
  if (std::ranges::count(fitted, false) > 0) add("held_out", "1", held_out);
  return taken;
}

}  // namespace

std::vector<TakenRows> taken_rows(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue) {
  std::vector<TakenRows> taken;
  for (const experiment::TestEntry& test : experiment.tests) try {
      taken.push_back(taken_of(test, catalogue.tests().find(test.type)->second.factory.observables));
    } catch (const InputError& problem) {
      throw InputError(fmt::format("test '{}': {}", test.name, problem.what()));
    }
  return taken;
}

nlohmann::ordered_json taken_rows_json(const std::vector<TakenRows>& tests) {
  auto document = nlohmann::ordered_json::object();
  for (const TakenRows& taken : tests) {
    auto columns = nlohmann::ordered_json::object();
    for (std::size_t c = 0; c < taken.table.headers.size(); ++c)
      columns[taken.table.headers[c]] = taken.table.columns[c];
    document[key::tests][taken.table.test] = {{key::columns, std::move(columns)},
                                              {key::prescribed, taken.table.prescribed},
                                              {key::lines, taken.lines},
                                              {key::understood, taken.understood},
                                              {key::warnings, taken.warnings}};
  }
  return document;
}

}  // namespace tunica::comparison
