// SPDX-License-Identifier: Apache-2.0
#include "comparison/fit_table.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::comparison {

namespace {

using Diagnostics = std::vector<std::pair<std::string, std::vector<double>>>;

/// What one run predicts for one test.
struct Fit {
  std::string label;
  std::vector<const assembly::MeasuredChannel*> channels;
  std::vector<double> predictions;  ///< of all tests
  Diagnostics diagnostics;
  const RunSummary* summary = nullptr;
};

/// Columns about a curve, where some run has them.
struct Extra {
  const char* name;
  std::vector<double> RunSummary::*values;
};
constexpr std::array<Extra, 8> extras{{{"ci95", &RunSummary::curve_ci95},
                                       {"lowest", &RunSummary::curve_lowest},
                                       {"highest", &RunSummary::curve_highest},
                                       {"posterior_low", &RunSummary::posterior_lower},
                                       {"posterior_median", &RunSummary::posterior_median},
                                       {"posterior_high", &RunSummary::posterior_upper},
                                       {"measured_low", &RunSummary::measured_lower},
                                       {"measured_high", &RunSummary::measured_upper}}};

std::vector<Fit> fits_of(const execution::Plan& plan, const Summary& summary, const std::string& test) {
  std::vector<Fit> fits;
  for (std::size_t run = 0; run < plan.runs.size(); ++run) {
    const auto& tests = plan.runs[run].entry->tests;
    const auto position = std::find(tests.begin(), tests.end(), test);
    if (!summary.runs[run].has_result || position == tests.end()) continue;
    const auto& assembly = *plan.runs[run].assembly;
    Fit fit;
    fit.label = summary.runs[run].label;
    fit.summary = &summary.runs[run];
    for (const auto& channel : assembly.layout().channels)
      if (channel.test == test) fit.channels.push_back(&channel);
    std::vector<double> free;
    for (const auto& parameter : summary.runs[run].parameters) free.push_back(parameter.value);
    fit.predictions.resize(assembly.layout().prediction_count);
    auto workspace = assembly.evaluator().make_workspace();
    if (fit.channels.empty() || !assembly.evaluator().predict(free, fit.predictions, {}, *workspace).ok()) continue;
    if (!assembly.evaluator()
             .diagnostics(static_cast<std::size_t>(position - tests.begin()), free, fit.diagnostics)
             .ok())
      fit.diagnostics.clear();
    fits.push_back(std::move(fit));
  }
  return fits;
}

std::string fit_cell(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

}  // namespace

std::string file_stem(const std::string& test) {
  std::string name;
  for (const char c : test) name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' ? c : '-';
  return name;
}

std::string fit_table(const execution::Plan& plan, const Summary& summary, const std::string& test) {
  const auto fits = fits_of(plan, summary, test);
  if (fits.empty()) return {};
  std::vector<std::string> diagnostics;
  for (const auto& fit : fits)
    for (const auto& [name, values] : fit.diagnostics)
      if (std::find(diagnostics.begin(), diagnostics.end(), name) == diagnostics.end()) diagnostics.push_back(name);

  const auto& first = *fits.front().channels.front();
  std::string text = fmt::format("run,{} [{}]", first.abscissa_name, first.abscissa_unit);
  for (const auto& other : first.other_abscissae) text += ',' + other.first;
  for (const auto* channel : fits.front().channels)
    text += fmt::format(",{0} [{1}],{0}.predicted [{1}]", channel->observable, channel->unit);
  text += ",held_out";
  for (const auto& name : diagnostics) text += ',' + name;
  std::vector<Extra> shown;
  for (const Extra& extra : extras)
    if (std::any_of(fits.begin(), fits.end(), [&](const Fit& fit) { return !(fit.summary->*extra.values).empty(); }))
      shown.push_back(extra);
  for (const auto* channel : fits.front().channels)
    for (const Extra& extra : shown) text += fmt::format(",{}.{} [{}]", channel->observable, extra.name, channel->unit);
  text += '\n';
  // A row of a field is a point or has forces: what was not measured there is nowhere.
  const auto nothing = [](const auto& channel, std::size_t row) {
    return channel.is_field() && std::isnan(channel.measured[row]);
  };
  for (const auto& fit : fits) {
    const auto& lead = *fit.channels.front();
    for (std::size_t row = 0; row < lead.count; ++row) {
      text += text::csv_cell(fit.label) + ',' + fit_cell(lead.abscissa[row]);
      for (const auto& other : lead.other_abscissae) text += ',' + fit_cell(other.second[row]);
      for (const auto* channel : fit.channels)
        text += ',' + fit_cell(channel->measured[row]) + ',' +
                (nothing(*channel, row) ? "" : fit_cell(fit.predictions[channel->offset + row]));
      const bool held_out = std::any_of(fit.channels.begin(), fit.channels.end(),
                                        [row](const auto* channel) { return channel->held_out(row); });
      text += held_out ? ",1" : ",0";
      for (const auto& name : diagnostics) {
        const auto found = std::find_if(fit.diagnostics.begin(), fit.diagnostics.end(),
                                        [&](const auto& entry) { return entry.first == name; });
        text += ',';
        if (found != fit.diagnostics.end() && row < found->second.size()) text += fit_cell(found->second[row]);
      }
      for (const auto* channel : fit.channels)
        for (const Extra& extra : shown) {
          const auto& values = fit.summary->*extra.values;
          text += ',' + (values.empty() || nothing(*channel, row) ? "" : fit_cell(values[channel->offset + row]));
        }
      text += '\n';
    }
  }
  return text;
}

void write_fit_tables(const std::filesystem::path& directory, const execution::Plan& plan, const Summary& summary) {
  for (const auto& test : plan.experiment->tests) {
    const std::string text = fit_table(plan, summary, test.name);
    if (!text.empty()) execution::write_atomically(directory / ("fit_" + file_stem(test.name) + ".csv"), text);
  }
}

}  // namespace tunica::comparison
