// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/estimate_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/evidence/row_correlation.hpp"
#include "numerics/distributions.hpp"

namespace tunica::diagnosis {
namespace {

constexpr double beyond_chance = 1e-3;  ///< of a contradiction
constexpr double significant = 2.6;     ///< standard deviations of a correlation; one in 200 by chance
constexpr std::size_t most_channels = 4;

std::string amount(double value, const NoiseSource& source) {
  return fmt::format("{:.3g}{}", value, source.unit == "1" ? "" : " " + source.unit);
}

std::string sigma(const NoiseSource& source) {
  const data::Noise& noise = source.noise;
  const std::string relative =
      noise.relative > 0 ? fmt::format(" and {:.2g} % of the value", 100 * noise.relative) : "";
  return fmt::format("{}, {} {}{}", source.test, source.channel, amount(noise.absolute, source), relative);
}

std::string listed(const std::vector<std::string>& all) {
  const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), most_channels));
  std::string text = fmt::format("{}", fmt::join(all.begin(), end, "; "));
  if (all.size() > most_channels) text += fmt::format("; and {} more in result.json", all.size() - most_channels);
  return text;
}

/// σ by source, and what contradicts it.
Warning noise_warning(const std::vector<NoiseSource>& open) {
  std::vector<std::string> estimated, differences, contradicted;
  for (const NoiseSource& source : open) {
    (source.kind == NoiseSource::Kind::encompassing ? estimated : differences).push_back(sigma(source));
    if (contradiction(source) * static_cast<double>(open.size()) < beyond_chance)
      contradicted.push_back(
          fmt::format("{}, {} ({})", source.test, source.channel, amount(source.neighbours, source)));
  }
  std::string text = "no noise is stated. ";
  if (!estimated.empty())
    text += fmt::format(
        "σ is estimated from the part of the residuals that neither a mechanism nor a smooth shape can explain: {}. "
        "What is as rough as noise from row to row counts as noise. ",
        listed(estimated));
  if (!differences.empty())
    text +=
        fmt::format("Too few rows are left for that here, and σ is taken from differences of neighbouring rows: {}. ",
                    listed(differences));
  if (!contradicted.empty())
    text += fmt::format(
        "Differences of neighbouring rows give another σ, by more than chance: {}. It is larger where few rows follow "
        "a bend, and smaller where neighbouring rows share their errors. ",
        listed(contradicted));
  return {WarningKind::noise_estimated,
          text + "State noise.absolute, noise.relative and noise.correlation, or give replicates"};
}

}  // namespace

double contradiction(const NoiseSource& source) {
  if (source.kind != NoiseSource::Kind::encompassing || !(source.neighbours > 0)) return 1;
  const data::Noise& noise = source.noise;
  if (!(source.freedom > 0) || noise.relative > 0) return 1;
  const double F = std::pow(noise.absolute / source.neighbours, 2);
  return 2 * std::min(numerics::f_below(F, source.freedom, source.neighbours_freedom),
                      numerics::f_above(F, source.freedom, source.neighbours_freedom));
}

std::vector<Warning> estimate_warnings(const Evidence& evidence, const Fit& best) {
  std::vector<NoiseSource> open;
  for (const Curve& curve : evidence.curves)
    if (curve.noise.open()) open.push_back(curve.noise);
  if (open.empty()) return {};
  std::vector<Warning> warnings{noise_warning(open)};
  const auto correlation = row_correlation(evidence, best);
  if (correlation && correlation->value > significant * correlation->sd) {
    // The correction for the projection may push the estimate beyond ±1.
    constexpr double nearly_all = 0.95;
    const std::string size = correlation->value > nearly_all
                                 ? "near 1"
                                 : fmt::format("{:.2f} ± {:.2f}", correlation->value, correlation->sd);
    warnings.push_back(
        {WarningKind::rows_correlated,
         fmt::format("neighbouring rows share their errors: correlation {} in what no candidate explains. "
                     "The diagnosis takes them as independent, so that alarms come too easily. State "
                     "noise.correlation, or give replicates",
                     size)});
  }
  return warnings;
}

}  // namespace tunica::diagnosis
