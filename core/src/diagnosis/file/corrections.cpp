// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/file/correction.hpp"
#include "text/lists.hpp"

namespace tunica::diagnosis {

std::string quoted(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) all.push_back(fmt::format("'{}'", name));
  return text::joined(all);
}

void add_for_each_and_all(FileKind kind, const std::vector<std::string>& tests,
                          const std::function<Wording(const std::vector<std::string>&)>& words,
                          const std::function<bool(Record&, const std::string&)>& apply, Corrections& all) {
  const auto add = [&](const std::vector<std::string>& in, bool common) {
    Wording wording = words(in);
    all.push_back({kind, in, common, std::move(wording.sentence), std::move(wording.mend), [apply, in](Record& record) {
                     return std::all_of(in.begin(), in.end(),
                                        [&](const std::string& test) { return apply(record, test); });
                   }});
    all.back().changes = std::move(wording.changes);
  };
  if (tests.size() > 1) add(tests, true);
  for (const std::string& test : tests) add({test}, tests.size() == 1);
}

std::vector<std::string> fitted_tests(const Record& record, const experiment::RunEntry& run) {
  std::vector<std::string> tests;
  for (const std::string& name : run.tests)
    if (!record.test(name).hold_out.all) tests.push_back(name);
  return tests;
}

namespace {

bool states_noise(const experiment::TestEntry& test) {
  return std::any_of(test.data.noise.begin(), test.data.noise.end(),
                     [](const auto& noise) { return noise.second.absolute != 0; });
}

}  // namespace

Corrections corrections_of(const Inquiry& inquiry, const Record& record, const experiment::RunEntry& run,
                           bool scale_is_seen) {
  const std::vector<std::string> tests = fitted_tests(record, run);
  Corrections all;
  add_stress_measures(record, tests, all);
  add_strain_definitions(record, tests, all);
  add_exchanges(record, tests, all);
  add_signs(record, tests, all);
  add_units(record, tests, scale_is_seen, all);
  add_tube_sizes(record, tests, all);
  add_angles(record, run, inquiry.catalogue, all);
  add_clocks(inquiry, record, run, all);
  add_calibrations(record, tests, inquiry.catalogue, all);

  std::map<std::pair<FileKind, bool>, double> members;
  std::set<FileKind> kinds;
  for (const Correction& one : all) {
    ++members[{one.kind, one.common}];
    kinds.insert(one.kind);
  }
  for (Correction& one : all) {
    // A stated noise is that of the numbers, and would have to change with them.
    if (one.kind == FileKind::unit && std::any_of(one.tests.begin(), one.tests.end(), [&](const std::string& test) {
          return states_noise(inquiry.experiment.test(test));
        }))
      one.changes.clear();
    const double scopes = members.contains({one.kind, !one.common}) ? 2 : 1;
    one.log_prior = -std::log(static_cast<double>(kinds.size()) * scopes * members[{one.kind, one.common}]);
  }
  return all;
}

}  // namespace tunica::diagnosis
