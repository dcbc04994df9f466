// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "diagnosis/naming/credible.hpp"
#include "diagnosis/output/outputs.hpp"
#include "execution/files.hpp"
#include "text/csv.hpp"

namespace tunica::diagnosis {
namespace {

/// The effect of a cause in every row, in σ. For a single cause, it is the difference between its refit and the base
/// fit. For one of several, it is the effect of its amplitude in their refit that the parameters could not absorb.
Eigen::VectorXd signature_of(const Diagnosis& d, std::size_t which) {
  const Fit& base = d.analysis.evidence.fit;
  const Claim& claim = d.explanation.claim;
  if (claim.named < 2 && which < claim.rivals.size()) return claim.rivals[which].fit.residuals - base.residuals;
  Eigen::VectorXd nothing = Eigen::VectorXd::Zero(base.residuals.size());
  if (!claim.best || which >= claim.best->additions.size()) return nothing;
  const Extension& extension = *claim.best->extension;
  const Extension::Part& part = extension.parts()[which];
  std::vector<double> without = claim.best->fit.free;
  for (const std::size_t member : part.amplitude) without[member] = part.null;
  Eigen::VectorXd residuals;
  if (!whitened(extension.assembly(), without, *extension.assembly().evaluator().make_workspace(), residuals, nullptr)
           .ok())
    return nothing;
  return d.analysis.hypotheses.projection.off(claim.best->fit.residuals - residuals);
}

std::string residual_table(const Diagnosis& d) {
  const Claim& claim = d.explanation.claim;
  std::vector<std::pair<std::string, Eigen::VectorXd>> signatures;
  std::map<std::string, int> of_a_kind;
  for (std::size_t k = 0; k < claim.causes.size(); ++k) {
    const std::string& id = claim.causes[k].id;
    const int number = ++of_a_kind[id];
    signatures.emplace_back(id + (number > 1 ? fmt::format("_{}", number) : ""), signature_of(d, k));
  }
  return claim.best
             ? residual_table(d.analysis.evidence, &claim.best->extension->assembly(), &claim.best->fit, signatures)
             : residual_table(d.analysis.evidence, nullptr, nullptr, signatures);
}

/// Of the mechanisms that leave a trace in these data.
std::string confusability_table(const Diagnosis& d) {
  const auto& best = d.explanation.best_direction;
  const Eigen::MatrixXd alike = likeness(d.analysis.hypotheses, best);
  const std::vector<Candidate>& candidates = d.analysis.hypotheses.candidates;
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (best[k]) shown.push_back(k);
  std::string text = "mechanism";
  for (const std::size_t a : shown) text += "," + candidates[a].id;
  text += '\n';
  for (const std::size_t a : shown) {
    text += candidates[a].id;
    for (const std::size_t b : shown)
      text += fmt::format(",{:.4f}", alike(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
    text += '\n';
  }
  return text;
}

}  // namespace

std::string residual_table(const Evidence& evidence, const assembly::Assembly* extension, const Fit* fit,
                           const std::vector<std::pair<std::string, Eigen::VectorXd>>& signatures) {
  const auto predicted = [](const assembly::Assembly& assembly, std::span<const double> free) {
    std::vector<double> values(assembly.layout().prediction_count);
    const auto workspace = assembly.evaluator().make_workspace();
    if (!assembly.evaluator().predict(free, values, {}, *workspace).ok()) values.assign(values.size(), NAN);
    return values;
  };
  const std::vector<double> base = predicted(*evidence.base, evidence.fit.free);
  const std::vector<double> extended = fit != nullptr ? predicted(*extension, fit->free) : std::vector<double>();
  std::string text =
      "test,channel,row,abscissa,abscissa_unit,abscissa_name,curve,unit,measured,predicted,extended,sigma,residual,"
      "residual_"
      "extended";
  for (const auto& [name, values] : signatures) text += ",signature_" + name;
  text += '\n';
  std::size_t c = 0;
  for (const assembly::MeasuredChannel& view : evidence.base->layout().channels) {
    if (c >= evidence.curves.size() || evidence.curves[c].test != view.test ||
        evidence.curves[c].channel != view.observable)
      continue;
    const Curve& curve = evidence.curves[c++];
    const std::vector<double> sd = row_deviations(view);
    const assembly::DrawnOver& over = view.drawn_over;
    for (std::size_t k = 0; k < curve.rows.size(); ++k) {
      const std::size_t row = curve.rows[k];
      const Eigen::Index i = curve.first + static_cast<Eigen::Index>(k);
      // A gross row hardly counts in the fit, but here its full deviation appears.
      const auto& gross = view.noise->gross;
      const bool silent = std::find(gross.begin(), gross.end(), row) != gross.end();
      const auto residual = [&](const std::vector<double>& values, const Fit& of) {
        return silent ? (view.measured[row] - values[view.offset + row]) / sd[k] : -of.residuals[i];
      };
      text += fmt::format(
          "{},{},{},{:.8g},{},{},{},{},{:.8g},{:.8g},{},{:.6g},{:.6g},{}", view.test, view.observable,
          view.file_row(row), over.values[row], over.unit, over.name,
          over.curves.empty() ? "" : text::csv_cell(over.curves[row]), view.unit, view.measured[row],
          base[view.offset + row], extended.empty() ? "" : fmt::format("{:.8g}", extended[view.offset + row]), sd[k],
          residual(base, evidence.fit), fit != nullptr ? fmt::format("{:.6g}", residual(extended, *fit)) : "");
      for (const auto& [name, values] : signatures) text += fmt::format(",{:.6g}", values[i]);
      text += '\n';
    }
  }
  return text;
}

void write_tables(const std::filesystem::path& directory, const Diagnosis& d) {
  execution::write_atomically(directory / "residuals.csv", residual_table(d));
  execution::write_atomically(directory / "confusability.csv", confusability_table(d));
}

}  // namespace tunica::diagnosis
