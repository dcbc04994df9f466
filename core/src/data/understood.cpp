// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "data/quantities.hpp"
#include "data/series.hpp"
#include "data/words.hpp"
#include "text/lists.hpp"

namespace tunica::data {
namespace {

using From = Quantity::Kind;

std::string source_of(const Series::Column& column) {
  return fmt::format("'{}'{}{}", as_utf8(column.name), column.unit.empty() ? "" : " in " + column.unit,
                     column.turned ? ", which counts compression positive" : "");
}

std::string measure_of(const DataRequest& request) {
  return request.stress_measure == "cauchy"                  ? "Cauchy stress (true)"
         : request.stress_measure == "first_piola_kirchhoff" ? "first Piola-Kirchhoff stress (nominal)"
                                                             : "second Piola-Kirchhoff stress";
}

/// "stretch = 1 + displacement / 17.48 mm, from 'Way' in mm".
std::string formula(const Series::Column& column, const Quantity& quantity, const DataRequest& request) {
  const std::string& name = column.observable->name;
  const std::string source = source_of(column);
  const bool measured = request.specimen.gauge_at_preload;
  const std::string gauge =
      fmt::format("{:.5g} mm{}", column.gauge_length, measured ? ", the gauge length at the preload" : "");
  switch (quantity.kind) {
    case From::own:
      if (column.observable->kind == Observable::Kind::stress)
        return fmt::format("{}: {}, from {}", name, measure_of(request), source);
      if (column.observable->kind == Observable::Kind::stretch && column.observable->role != Observable::Role::time)
        return fmt::format("{}: 1 at rest, from {}", name, source);
      return fmt::format("{} from {}", name, source);
    case From::displacement:
      return fmt::format("{} = 1 + displacement / {}, from {}", name, gauge, source);
    case From::length:
      return fmt::format("{} = length / {}, from {}", name, gauge, source);
    case From::strain:
      return fmt::format("{} = 1 + strain (engineering strain), from {}", name, source);
    case From::true_strain:
      return fmt::format("{} = exp(true strain), from {}", name, source);
    case From::green_strain:
      return fmt::format("{} = √(1 + 2 Green strain), from {}", name, source);
    case From::shear_displacement:
      return fmt::format("{} = displacement / {:.5g} mm, from {}", name, request.specimen.height.value_or(0), source);
    case From::force:
    case From::plate_force:
      break;
  }
  const Specimen& specimen = request.specimen;
  const auto width = sizes_along(specimen, name).width;
  const std::string area =
      specimen.area ? fmt::format("{:.5g} mm²", *specimen.area)
                    : fmt::format("({:.5g} mm × {:.5g} mm)", width.value_or(0), specimen.thickness.value_or(0));
  if (quantity.kind == From::plate_force) return fmt::format("{} = force / {}, from {}", name, area, source);
  const char* const factor = request.stress_measure == "cauchy"                  ? ", times the stretch"
                             : request.stress_measure == "first_piola_kirchhoff" ? ""
                                                                                 : ", over the stretch";
  return fmt::format("{} = force / {}{}: {}, from {}", name, area, factor, measure_of(request), source);
}

std::string cycles_of(const DataRequest& request) {
  std::string words;
  if (request.cycle)
    words = request.cycle->last              ? "the last cycle"
            : request.cycle->numbers.empty() ? "all cycles"
                                             : fmt::format("cycle {}", fmt::join(request.cycle->numbers, ", "));
  if (request.cycle && !request.cycles_from.empty()) words += fmt::format(" (column '{}')", request.cycles_from);
  if (request.branch != BranchChoice::both)
    words += fmt::format("{}{}", words.empty() ? "" : ", ",
                         request.branch == BranchChoice::loading ? "loading only" : "unloading only");
  if (request.preload)
    words += fmt::format("{}from a preload of {:g} {} on", words.empty() ? "" : ", ", request.preload->value,
                         request.preload->is_force ? "mN" : "kPa");
  return words;
}

}  // namespace

std::vector<std::string> understood(const Series& series, const DataRequest& request,
                                    const std::vector<Observable>& observables) {
  std::vector<std::string> found;
  for (std::size_t k = 0; k < series.columns.size(); ++k)
    found.push_back(formula(series.columns[k], *quantity_named(request.columns[k].first, observables), request));
  std::vector<std::string> conditions;
  for (const auto& [column, value] : request.where) conditions.push_back(fmt::format("{} = {}", column, value));
  std::string rows;
  if (!conditions.empty()) rows = fmt::format("where {}", text::joined(conditions));
  if (const std::string cycles = cycles_of(request); !cycles.empty()) rows += (rows.empty() ? "" : "; ") + cycles;
  if (request.time_rate)
    rows += fmt::format("{}time from a rate of {:g}/s", rows.empty() ? "" : "; ", *request.time_rate);
  if (request.resample)
    rows += fmt::format("{}{} points a branch by local regression", rows.empty() ? "" : "; ", *request.resample);
  if (series.used_lines.size() < series.file_rows)
    rows = fmt::format("{} of the {} in the file{}{}", series.used_lines.size(), series.file_rows,
                       rows.empty() ? "" : ": ", rows);
  if (!rows.empty()) found.push_back("rows: " + rows);
  return found;
}

}  // namespace tunica::data
