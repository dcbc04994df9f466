// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "comparison/simulation.hpp"
#include "comparison/summary.hpp"

namespace tunica::comparison {

/// Whether the best point of every run behaves as a material, asked for or not: transverse stability over the measured
/// strips and beyond, ellipticity, Drucker's condition, the model's own inequalities; and what a constraint costs, the
/// ratio of the objective to that of the best run of the same model, tests and objective without constraints.
void add_stability(const execution::Plan& plan, Summary& summary);

/// One line a run, for the terminal; empty without results.
std::string stability_table(const Summary& summary);

/// `stability` of a run's best point in result.json; null without.
nlohmann::ordered_json stability_json(const RunSummary& run);

/// stability.csv   λ2, λ3, stress, Ψ and slope of the free strips of every run's best point, from rest to the largest
///                 stretch of the run
/// energy.csv      W(λ_circumferential, λ_axial) of an incompressible sheet on a grid over the same stretches: its
///                 isocontours, with the strips of stability.csv on them
///
/// Where a run has several models, its name in the tables is followed by that of the model.
void write_stability_tables(const std::filesystem::path& directory, const execution::Plan& plan,
                            const Summary& summary);
/// The same for parameter sets that no run has found.
struct StabilitySubject {
  std::string label;
  const assembly::Assembly* assembly;
  std::vector<double> free;
  double limit;  ///< stretch
};
void write_stability_tables(const std::filesystem::path& directory, const std::vector<StabilitySubject>& subjects);

/// The stretches of the strips that are made of a model, and the largest that the tests of the assembly reach; or, with
/// `to`, all stretches up to that one.
stability::Domain domain_of(const assembly::Assembly& assembly, std::size_t model, std::optional<double> to = {});

/// Of every model at these parameters, over domain_of().
StabilitySummary stability_of(const assembly::Assembly& assembly, std::span<const double> free,
                              std::optional<double> to);

/// Writes the tables of a subject, and the text of a map where there is one; returns the files.
std::vector<std::filesystem::path> write_stability(const std::filesystem::path& directory, const Subject& subject,
                                                   std::optional<double> to, const std::string& map);

}  // namespace tunica::comparison
