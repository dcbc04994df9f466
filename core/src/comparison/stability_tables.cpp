// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "comparison/stability_map.hpp"
#include "comparison/stability_report.hpp"
#include "execution/evaluation_table.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::comparison {
namespace {

constexpr std::size_t steps = 60, grid = 41;

std::string table_cell(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

/// Rows of one strip, as far as it has an equilibrium.
void append_strip(std::string& table, const std::string& label, const Model& model,
                  const std::vector<double>& parameters, std::size_t axis, double limit) {
  for (std::size_t k = 0; k <= steps; ++k) {
    const double stretch = 1 + (limit - 1) * static_cast<double>(k) / steps;
    stability::StripState at;
    if (!stability::FreePath(model, axis, {stretch}).states(parameters, {&at, 1}).ok()) return;
    table += fmt::format("{},{},{},{},{},{},{},{}\n", label, axis == 0 ? "circumferential" : "axial",
                         table_cell(stretch), table_cell(at.transverse), table_cell(at.normal), table_cell(at.stress),
                         table_cell(at.anisotropy), table_cell(at.normal_slope()));
  }
}

void append_energy(std::string& table, const std::string& label, const Model& model,
                   const std::vector<double>& parameters, double limit) {
  const auto energy = [&](double t, double z) {
    const double r = 1 / (t * z);
    const std::array<double, 6> C{t * t, z * z, r * r, 0, 0, 0};
    double W = std::nan("");
    return model.evaluate({1, C, parameters, {}, {}}, {{&W, 1}, {}, {}, {}, {}}).ok() ? W : std::nan("");
  };
  // Down to where a strip contracts: λ2 ≥ 1/λ1 of an incompressible sheet.
  const double low = 1 / limit, at_rest = energy(1, 1);
  for (std::size_t i = 0; i < grid; ++i)
    for (std::size_t j = 0; j < grid; ++j) {
      const double t = low + (limit - low) * static_cast<double>(i) / (grid - 1);
      const double z = low + (limit - low) * static_cast<double>(j) / (grid - 1);
      table += fmt::format("{},{},{},{}\n", label, table_cell(t), table_cell(z), table_cell(energy(t, z) - at_rest));
    }
}

}  // namespace

void write_stability_tables(const std::filesystem::path& directory, const std::vector<StabilitySubject>& subjects) {
  if (subjects.empty()) return;
  std::string strips =
      "# Free strips at the best point of every run. normal_slope = d ln(normal stretch)/d ln(stretch): positive = "
      "unstable.\nrun,direction,stretch [1],transverse_stretch [1],normal_stretch [1],cauchy_stress [kPa],anisotropy "
      "[1],normal_slope [1]\n";
  std::string energies =
      "# Energy of an incompressible sheet at the best point of every run, zero at rest: its isocontours over the two "
      "stretches.\nrun,circumferential_stretch [1],axial_stretch [1],energy [kPa]\n";
  for (const StabilitySubject& subject : subjects) {
    const auto& assembly = *subject.assembly;
    for (std::size_t m = 0; m < assembly.models().count(); ++m) {
      const auto parameters = assembly.models().parameters(m, subject.free);
      if (!assembly.models().model(m).keeps_volume(parameters)) continue;  // both tables are of J = 1
      const std::string label = text::csv_cell(
          assembly.models().count() > 1 ? subject.label + ' ' + assembly.models().name(m) : subject.label);
      for (const std::size_t axis : {std::size_t{0}, std::size_t{1}})
        append_strip(strips, label, assembly.models().model(m), parameters, axis, subject.limit);
      append_energy(energies, label, assembly.models().model(m), parameters, subject.limit);
    }
  }
  execution::write_atomically(directory / "stability.csv", strips);
  execution::write_atomically(directory / "energy.csv", energies);
}

std::vector<std::filesystem::path> write_stability(const std::filesystem::path& directory, const Subject& subject,
                                                   std::optional<double> to, const std::string& map) {
  const double limit = domain_of(*subject.assembly, 0, to).largest;
  write_stability_tables(directory, {{subject.model, subject.assembly.get(), subject.free, limit}});
  std::vector<std::filesystem::path> files{directory / "stability.csv", directory / "energy.csv"};
  if (map.empty()) return files;
  files.push_back(directory / "stability_map.csv");
  execution::write_atomically(files.back(), map);
  return files;
}

void write_stability_tables(const std::filesystem::path& directory, const execution::Plan& plan,
                            const Summary& summary) {
  std::vector<StabilitySubject> subjects;
  for (std::size_t run = 0; run < summary.runs.size(); ++run) {
    const auto& entry = summary.runs[run];
    if (!entry.stability) continue;
    StabilitySubject subject{
        entry.label, plan.runs[run].assembly.get(), {}, entry.stability->models.front().verdict.domain.largest};
    for (const auto& parameter : entry.parameters) subject.free.push_back(parameter.value);
    subjects.push_back(std::move(subject));
  }
  write_stability_tables(directory, subjects);
  const auto& analysis = plan.experiment->analysis;
  for (std::size_t k = 0; k < subjects.size() && !analysis.stability_map.empty(); ++k) {
    const auto& free = subjects[k].assembly->layout().parameters;
    const bool searched =
        std::all_of(analysis.stability_map.begin(), analysis.stability_map.end(), [&](const auto& name) {
          return std::any_of(free.begin(), free.end(), [&](const auto& parameter) { return parameter.name == name; });
        });
    if (!searched) continue;  // another model's parameters
    std::string label = subjects[k].label;
    for (const char c : {'/', '#'}) std::replace(label.begin(), label.end(), c, '-');
    execution::write_atomically(
        directory / ("stability_map_" + label + ".csv"),
        stability_map(*subjects[k].assembly, subjects[k].free, {analysis.stability_map[0], analysis.stability_map[1]},
                      analysis.map_points, subjects[k].limit));
  }
}

}  // namespace tunica::comparison
