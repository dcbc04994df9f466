// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/mesh_bias.hpp"

#include <algorithm>
#include <limits>

#include "uncertainty/sandwich.hpp"

namespace tunica::uncertainty {
namespace {

/// Adds what the finer mesh of one test changes to the predictions of all. False where it has none.
bool add_shift(const assembly::Layout& layout, const std::string& test, const TestRows& rows,
               const std::vector<Agreement>& found, std::vector<double>& change) {
  bool finer = false;
  for (const Agreement& one : found) {
    if (one.shift.size() != rows.channels.size() * rows.count) continue;
    finer = true;
    for (const assembly::MeasuredChannel& view : layout.channels) {
      const auto channel = std::find(rows.channels.begin(), rows.channels.end(), view.observable);
      if (view.test != test || channel == rows.channels.end()) continue;
      const auto first = static_cast<std::size_t>(channel - rows.channels.begin()) * rows.count;
      for (std::size_t i = 0; i < view.count; ++i) change[view.offset + i] += one.shift[first + i];
    }
  }
  return finer;
}

}  // namespace

Status mesh_bias(const assembly::Assembly& assembly, std::span<const std::string> tests, std::span<const double> free,
                 const Identifiability& fixed, MeshBias& bias) {
  bias = {};
  if (fixed.fixed_by_data.empty() || !fixed.constrained.empty()) return {};
  std::vector<double> change(assembly.layout().prediction_count);
  std::vector<std::string> finer;
  for (std::size_t test = 0; test < tests.size(); ++test) {
    const Status status = assembly.evaluator().ask(test, free, [&](const Test& asked, const TestInput& input) {
      std::vector<Agreement> found;
      Status answer = asked.agreement(input, found);
      if (answer.ok() && add_shift(assembly.layout(), tests[test], asked.rows(), found, change))
        finer.push_back(tests[test]);
      return answer;
    });
    if (!status.ok()) return status;
  }
  if (finer.empty()) return {};
  std::vector<double> shift(free.size());
  if (Status status = minimum_shift(assembly, free, fixed.fixed_by_data, change, shift); !status.ok()) return status;
  bias.tests = std::move(finer);
  bias.of_parameter.assign(free.size(), std::numeric_limits<double>::quiet_NaN());
  for (const std::size_t j : fixed.fixed_by_data) bias.of_parameter[j] = -shift[j] * assembly.box().slope(j, free[j]);
  return {};
}

}  // namespace tunica::uncertainty
