// SPDX-License-Identifier: Apache-2.0
#include "comparison/uncertainty_tables.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

#include "data/sha256.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::comparison {

namespace {

std::string column(const assembly::FreeParameter& parameter) {
  return text::csv_cell(fmt::format("{} [{}]", parameter.name, parameter.unit));
}

/// Columns of all these runs, each once.
template <class Run>
std::vector<std::string> columns_of(const std::vector<Run>& runs) {
  std::vector<std::string> columns;
  for (const auto& run : runs)
    for (const auto& parameter : run.assembly->layout().parameters)
      if (std::find(columns.begin(), columns.end(), column(parameter)) == columns.end())
        columns.push_back(column(parameter));
  return columns;
}

/// The values of one run in these columns; empty cells where it has none.
std::string cells(const assembly::Assembly& assembly, const std::vector<double>& free,
                  const std::vector<std::string>& columns) {
  std::string text;
  for (const auto& wanted : columns) {
    text += ',';
    for (std::size_t j = 0; j < free.size(); ++j)
      if (column(assembly.layout().parameters[j]) == wanted) text += fmt::format("{}", free[j]);
  }
  return text;
}

/// A file system allows 255 bytes, and names of layers, mechanisms and parameters are joined: longer ones end with the
/// beginning of their hash.
std::string file_name(const std::string& parameter) {
  constexpr std::size_t longest = 150;
  std::string name;
  for (const char c : parameter.substr(0, longest))
    name += std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.' ? c : '-';
  if (parameter.size() > longest) name += "-" + data::sha256(parameter).substr(0, 8);
  return "profile_" + name + ".csv";
}

}  // namespace

void write_profiles(const std::filesystem::path& directory, const std::vector<RunProfiles>& runs) {
  const auto columns = columns_of(runs);
  std::map<std::string, std::string> files;  // by parameter
  for (const auto& run : runs)
    for (const auto& profile : run.profiles) {
      const auto& parameter = run.assembly->layout().parameters[profile.parameter];
      auto& text = files[parameter.name];
      if (text.empty())
        text = fmt::format(
            "# Profile likelihood of {}: delta = least -2 ln L with it held, minus that of the optimum; a 95 % "
            "interval\n"
            "# is where delta is below the threshold. The parameters as fitted along the profile follow.\n"
            "run,value [{}],delta,threshold,{}\n",
            parameter.name, parameter.unit, fmt::join(columns, ","));
      for (const auto& point : profile.points)
        text += fmt::format("{},{},{},{}{}\n", text::csv_cell(run.label), point.value, point.delta, profile.threshold,
                            cells(*run.assembly, point.free, columns));
    }
  for (const auto& [parameter, text] : files) execution::write_atomically(directory / file_name(parameter), text);
}

void write_bootstrap(const std::filesystem::path& directory, const std::vector<RunDraws>& runs) {
  if (runs.empty()) return;
  const auto columns = columns_of(runs);
  std::string text = fmt::format("run,draw,status,converged,objective,{}\n", fmt::join(columns, ","));
  for (const auto& run : runs)
    for (std::size_t k = 0; k < run.bootstrap.draws.size(); ++k) {
      const auto& draw = run.bootstrap.draws[k];
      text += fmt::format("{},{},{},{},{}{}\n", text::csv_cell(run.label), k + 1, name(draw.status.kind()),
                          draw.converged ? 1 : 0, draw.free.empty() ? "" : fmt::format("{}", draw.objective),
                          cells(*run.assembly, draw.free, columns));
    }
  execution::write_atomically(directory / "bootstrap.csv", text);
}

}  // namespace tunica::comparison
