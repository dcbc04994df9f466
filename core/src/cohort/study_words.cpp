// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "cohort/study_output.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::cohort {

namespace {

std::string p_words(double p) { return p < 1e-4 ? "< 0.0001" : fmt::format("{:.2g}", p); }

std::string mean_line(const Coordinate& coordinate, const Estimated& mean) {
  return fmt::format("  {} {:>11.5g}   {:.4g} … {:.4g}\n",
                     text::pad(text::titled(coordinate.name, coordinate.unit), 26), mean.value, mean.lower, mean.upper);
}

std::string spread_words(const Coordinate& coordinate, const SpreadSummary& spread, bool nested) {
  const bool log = coordinate.scale == Scale::log;
  const double factor = log ? 100 : 1;
  std::string words =
      fmt::format("  {} {:>10.3g} {}  {:.3g} … {}", text::pad(coordinate.name, 26), factor * spread.sd, log ? "%" : " ",
                  factor * spread.lower, spread.upper ? fmt::format("{:.3g}", factor * *spread.upper) : "any");
  if (nested) words += fmt::format("   animals {:.3g}{}", factor * spread.of_animals, log ? " %" : "");
  return words + "\n";
}

std::string effect_line(const Effect& effect, const std::string& unit) {
  const std::string size =
      effect.ratio ? fmt::format("× {:.3g}   {:.3g} … {:.3g}", effect.size.value, effect.size.lower, effect.size.upper)
                   : fmt::format("{:+.3g}{}   {:.3g} … {:.3g}", effect.size.value, text::unit_suffix(unit),
                                 effect.size.lower, effect.size.upper);
  const std::string p = fmt::format("p {}, adjusted {}", p_words(effect.p_permutation), p_words(effect.p_adjusted));
  return fmt::format("  {} {}   {}\n", text::pad(effect.of, 26), size, p);
}

/// Effects on parameters and on readings under one heading a level.
void add_level(const std::vector<const Analysis*>& analyses, const std::string& factor, const std::string& level,
               std::string& words) {
  bool headed = false;
  for (const Analysis* analysis : analyses)
    for (const Effect& effect : analysis->effects) {
      if (effect.factor != factor || effect.level != level) continue;
      if (!headed)
        words +=
            fmt::format("\n{}: {} against {} (95 % interval; p by permutation)\n", factor, level, effect.reference);
      headed = true;
      for (const Coordinate& coordinate : analysis->coordinates)
        if (coordinate.name == effect.of) words += effect_line(effect, coordinate.unit);
    }
}

void add_factors(const PopulationStudy& one, std::string& words) {
  std::vector<const Analysis*> analyses;
  if (one.problem.empty()) analyses.push_back(&one.parameters);
  if (one.readings.analysis) analyses.push_back(&*one.readings.analysis);
  for (const population::Factor& factor : one.members.factors)
    for (std::size_t level = 1; level < factor.levels.size(); ++level)
      add_level(analyses, factor.name, factor.levels[level], words);
  if (analyses.empty()) return;
  for (const FactorSummary& test : analyses.front()->factors)
    if (test.permutation.smallest > 0.05)
      words += text::hanging("  ! ", fmt::format("{}: {} arrangements of the labels cannot give p below {:.2g}. More "
                                                 "specimens are needed for a finding",
                                                 test.factor, test.permutation.used, test.permutation.smallest)) +
               "\n";
}

void add_population(const PopulationStudy& one, const SpecimenTable& table, std::string& words) {
  words += fmt::format("\n{}: ", one.run);
  words += fmt::format("population of {}{}\n", text::counted(one.members.specimens.size(), "specimen", "specimens"),
                       one.members.animals.empty() ? "" : fmt::format(" from {} animals", one.members.animals.size()));
  if (!one.problem.empty()) words += text::hanging("  ! ", "no population of the parameters: " + one.problem) + "\n";
  const Analysis& analysis = one.parameters;
  for (std::size_t g = 0; g < one.members.groups.size(); ++g) {
    words += fmt::format("\ntypical specimen, {} (95 % interval)\n", one.members.groups[g].name);
    for (const Analysis* of : {&analysis, one.readings.analysis ? &*one.readings.analysis : nullptr})
      for (std::size_t j = 0; of && j < of->means.size(); ++j) words += mean_line(of->coordinates[j], of->means[j][g]);
  }
  if (!analysis.spreads.empty()) words += "\nspread between specimens (standard deviation, 95 % interval)\n";
  for (std::size_t j = 0; j < analysis.spreads.size(); ++j)
    words += spread_words(analysis.coordinates[j], analysis.spreads[j], one.nested);
  add_factors(one, words);
  for (const Outlier& outlier : one.outliers)
    words +=
        text::hanging("  ! ", fmt::format("{} is unlike the others, most in {} (p {}, for all specimens together)",
                                          table.specimens[outlier.specimen].id, outlier.farthest, p_words(outlier.p))) +
        "\n";
}

void add_models(const std::vector<PopulationStudy>& populations, std::string& words) {
  words += "\nmodels over the whole cohort (AIC above the least)\n";
  double least = std::numeric_limits<double>::infinity();
  for (const PopulationStudy& one : populations)
    if (one.problem.empty()) least = std::min(least, one.aic);
  for (const PopulationStudy& one : populations)
    if (one.problem.empty()) words += fmt::format("  {} {:.1f}\n", text::pad(one.run, 26), one.aic - least);
}

}  // namespace

std::string study_words(const SpecimenTable& table, const Study& study) {
  std::string words;
  for (const Remark& remark : study.remarks) words += text::hanging("  ! ", remark.sentence) + "\n";
  for (const PopulationStudy& one : study.populations) add_population(one, table, words);
  if (study.populations.size() > 1) add_models(study.populations, words);
  if (study.diagnosis) words += diagnosis_words(table, *study.diagnosis);
  return words;
}

}  // namespace tunica::cohort
