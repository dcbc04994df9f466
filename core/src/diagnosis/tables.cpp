// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/detectable.hpp"
#include "diagnosis/outputs.hpp"
#include "execution/files.hpp"

namespace tunica::diagnosis {
namespace {

std::string residual_table(const Diagnosis& d) {
  const auto predicted = [](const calibration::Assembly& assembly, std::span<const double> free) {
    std::vector<double> values(assembly.prediction_count());
    const auto workspace = assembly.make_workspace();
    if (!assembly.predict(free, values, {}, *workspace).ok()) values.assign(values.size(), NAN);
    return values;
  };
  const std::vector<double> base = predicted(*d.base, d.fit.free);
  const std::vector<double> extended =
      d.extension ? predicted(d.extension->extended->assembly(), d.extension->fit.free) : std::vector<double>();
  std::string text =
      "test,channel,row,abscissa,abscissa_unit,abscissa_name,unit,measured,predicted,extended,sigma,residual,residual_"
      "extended";
  for (const Cause& cause : d.causes) text += ",signature_" + cause.id;
  text += '\n';
  std::size_t c = 0;
  for (const calibration::ChannelView& view : d.base->channels()) {
    if (c >= d.curves.size() || d.curves[c].test != view.test || d.curves[c].channel != view.observable) continue;
    const Curve& curve = d.curves[c++];
    for (std::size_t k = 0; k < curve.rows.size(); ++k) {
      const std::size_t row = curve.rows[k];
      const Eigen::Index i = curve.first + static_cast<Eigen::Index>(k);
      const double sigma = std::hypot(curve.noise.noise.absolute, curve.noise.noise.relative * base[view.offset + row]);
      text += fmt::format(
          "{},{},{},{:.8g},{},{},{},{:.8g},{:.8g},{},{:.6g},{:.6g},{}", view.test, view.observable, row,
          view.abscissa[row], view.abscissa_unit, view.abscissa_name, view.unit, view.measured[row],
          base[view.offset + row], extended.empty() ? "" : fmt::format("{:.8g}", extended[view.offset + row]), sigma,
          -d.fit.residuals[i], d.extension ? fmt::format("{:.6g}", -d.extension->fit.residuals[i]) : "");
      for (const Cause& cause : d.causes) {
        double value = 0;
        for (const Direction& direction : d.directions) {
          const Hypothesis& hypothesis = d.candidates[direction.candidate].hypotheses[direction.hypothesis];
          if (hypothesis.addition.id != cause.id || !(hypothesis.addition.target == cause.target)) continue;
          value = direction.unit[i] * direction.unit.dot(-d.fit.residuals);
          break;
        }
        text += fmt::format(",{:.6g}", value);
      }
      text += '\n';
    }
  }
  return text;
}

std::string confusability_table(const Diagnosis& d) {
  const Eigen::MatrixXd alike = likeness(d.directions, d.candidates.size());
  std::string text = "mechanism";
  for (const Candidate& candidate : d.candidates) text += "," + candidate.id;
  text += '\n';
  for (std::size_t a = 0; a < d.candidates.size(); ++a) {
    text += d.candidates[a].id;
    for (std::size_t b = 0; b < d.candidates.size(); ++b)
      text += fmt::format(",{:.4f}", a == b ? 1.0 : alike(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
    text += '\n';
  }
  return text;
}

}  // namespace

void write_tables(const std::filesystem::path& directory, const Diagnosis& d) {
  execution::write_atomically(directory / "residuals.csv", residual_table(d));
  execution::write_atomically(directory / "confusability.csv", confusability_table(d));
}

}  // namespace tunica::diagnosis
