// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "diagnosis/output/outputs.hpp"
#include "experiment/reader.hpp"
#include "text/csv.hpp"
#include "text/units.hpp"

namespace tunica::diagnosis {
namespace {

struct Column {
  std::string observable, unit;
  const std::vector<double>* values;
};

/// Abscissae, time and channels in base units; the channels of one replicate where there are several.
std::vector<Column> columns_of(const data::Dataset& data, const std::vector<Observable>& observables,
                               std::optional<std::size_t> replicate) {
  std::vector<Column> columns;
  for (const Observable& observable : observables) {
    for (const auto& [name, values] : data.abscissae)
      if (name == observable.name) columns.push_back({name, observable.unit, &values});
    if (observable.role == Observable::Role::time && !data.time.empty())
      columns.push_back({observable.name, observable.unit, &data.time});
    for (const data::Channel& channel : data.channels)
      if (channel.observable == observable.name)
        columns.push_back(
            {channel.observable, observable.unit, replicate ? &channel.replicates[*replicate] : &channel.values});
  }
  return columns;
}

/// Rows in the order of the file, in which a hold-out counts them.
std::string table_of(const std::vector<Column>& columns, const data::Dataset& data) {
  std::vector<std::size_t> rows(data.count);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  if (!data.file_rows.empty())
    std::sort(rows.begin(), rows.end(),
              [&](std::size_t a, std::size_t b) { return data.file_rows[a] < data.file_rows[b]; });
  std::string text;
  for (const Column& column : columns)
    text += fmt::format("{}{}", text.empty() ? "" : ",", text::csv_cell(text::titled(column.observable, column.unit)));
  text += '\n';
  for (const std::size_t row : rows)
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double value = (*columns[k].values)[row];
      text += fmt::format("{}{}{}", k > 0 ? "," : "", std::isnan(value) ? "" : fmt::format("{}", value),
                          k + 1 < columns.size() ? "" : "\n");
    }
  return text;
}

/// The root mean square of σ where it was stated row by row, which a file cannot say.
data::Noise without_levels(const data::Noise& noise) {
  if (noise.level.empty()) return noise;
  double sum = 0;
  for (const double level : noise.level) sum += std::pow(noise.absolute, 2) + std::pow(noise.relative * level, 2);
  return {std::sqrt(sum / static_cast<double>(noise.level.size())), 0, noise.correlation, {}, {}};
}

}  // namespace

std::vector<NamedText> mended_files(const Diagnosis& d, const std::filesystem::path& directory,
                                    const plugins::Catalogue& catalogue) {
  if (!d.explanation.mended) return {};
  experiment::Experiment experiment = *d.explanation.mended;
  std::vector<NamedText> files;
  for (experiment::TestEntry& entry : experiment.tests) {
    entry.weights.assign(entry.data.noise.size(), 1.0);
    for (auto& [channel, noise] : entry.data.noise) noise = without_levels(noise);
    const auto given = std::exchange(entry.data.given, nullptr);
    const FileCause& cause = d.explanation.file.causes.front();
    const std::vector<std::string>& changed = cause.tests;
    // A mechanism mends the simulation, not the numbers.
    if (!given || !cause.mechanism.empty() || std::find(changed.begin(), changed.end(), entry.name) == changed.end())
      continue;
    const auto& observables = catalogue.tests().find(entry.type)->second.factory.observables;
    const std::size_t replicates = given->channels.front().replicates.size();
    data::DataRequest request;
    for (std::size_t k = 0; k < std::max<std::size_t>(replicates, 1); ++k) {
      const auto columns = columns_of(*given, observables, replicates > 0 ? std::optional(k) : std::nullopt);
      const std::string name =
          fmt::format("mended_{}{}.csv", entry.name, replicates > 0 ? fmt::format("_{}", k + 1) : "");
      files.push_back({name, table_of(columns, *given)});
      request.files.push_back(directory / name);
      if (k > 0) continue;
      for (const Column& column : columns) request.columns.emplace_back(column.observable, column.observable);
    }
    request.stress_measure = entry.data.stress_measure;
    request.noise = std::move(entry.data.noise);
    request.order = entry.data.order;
    entry.data = std::move(request);
  }
  experiment.name += "_mended";
  files.push_back({"mended.json", experiment::write_input(experiment, catalogue)});
  return files;
}

}  // namespace tunica::diagnosis
