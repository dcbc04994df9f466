// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "cohort/study_output.hpp"
#include "text/lists.hpp"
#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::cohort {

namespace {

std::string p_words(double p) { return p < 1e-4 ? "< 0.0001" : fmt::format("{:.2g}", p); }

std::string mean_line(const Coordinate& coordinate, const Estimated& mean, const std::string& group) {
  return fmt::format("  {} {:>11.5g}   {:.4g} … {:.4g}{}\n",
                     text::pad(text::titled(coordinate.name, coordinate.unit), 26), mean.value, mean.lower, mean.upper,
                     group);
}

std::string spread_words(const Coordinate& coordinate, const Spread& spread, bool nested) {
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
  const std::string p = effect.p_permutation ? fmt::format("p {}, adjusted {}", p_words(*effect.p_permutation),
                                                           p_words(effect.p_adjusted.value_or(1)))
                                             : fmt::format("p {}, Holm {}", p_words(effect.p), p_words(effect.p_holm));
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
  std::vector<const Analysis*> analyses{&one.parameters};
  for (const ReadingStudy& reading : one.readings)
    if (reading.analysis) analyses.push_back(&*reading.analysis);
  for (const DesignFactor& factor : one.design.factors)
    for (std::size_t level = 1; level < factor.levels.size(); ++level)
      add_level(analyses, factor.name, factor.levels[level], words);
  for (const FactorTest& test : one.parameters.factors)
    if (test.permutation.made > 0 && test.permutation.smallest_p > 0.05)
      words += text::hanging("  ! ", fmt::format("{}: {} arrangements of the labels cannot give p below {:.2g}. More "
                                                 "specimens are needed for a finding",
                                                 test.factor, test.permutation.made, test.permutation.smallest_p)) +
               "\n";
}

void add_population(const PopulationStudy& one, const SpecimenTable& table, std::string& words) {
  words += fmt::format("\n{}: ", one.run);
  if (!one.problem.empty()) {
    words += one.problem + "\n";
    return;
  }
  words += fmt::format("population of {}{}\n", text::counted(one.design.specimens.size(), "specimen", "specimens"),
                       one.nested ? fmt::format(" from {} animals", one.design.animal_count) : "");
  const Analysis& analysis = one.parameters;
  for (std::size_t g = 0; g < analysis.groups.size(); ++g) {
    words += fmt::format("\ntypical specimen, {} (95 % interval)\n", analysis.groups[g].name);
    for (std::size_t j = 0; j < analysis.coordinates.size(); ++j)
      words += mean_line(analysis.coordinates[j], analysis.means[j][g], "");
    for (const ReadingStudy& reading : one.readings)
      if (reading.analysis && g < reading.analysis->groups.size())
        words += mean_line(reading.analysis->coordinates[0], reading.analysis->means[0][g], "");
  }
  words += "\nspread between specimens (standard deviation, 95 % interval)\n";
  for (std::size_t j = 0; j < analysis.coordinates.size(); ++j)
    words += spread_words(analysis.coordinates[j], analysis.spreads[j], one.nested);
  add_factors(one, words);
  for (const Outlier& outlier : one.outliers)
    words += text::hanging("  ! ", fmt::format("{} is unlike the others (p {}, for all specimens together)",
                                               table.specimens[outlier.specimen].id, p_words(outlier.p))) +
             "\n";
}

}  // namespace

std::string study_words(const SpecimenTable& table, const Study& study) {
  std::string words;
  for (const Remark& remark : study.remarks) words += text::hanging("  ! ", remark.sentence) + "\n";
  for (const PopulationStudy& one : study.populations) add_population(one, table, words);
  if (study.populations.size() < 2) return words;
  words += "\nmodels over the whole cohort (AIC above the least)\n";
  double least = study.populations.front().aic;
  for (const PopulationStudy& one : study.populations)
    if (one.problem.empty()) least = std::min(least, one.aic);
  for (const PopulationStudy& one : study.populations)
    if (one.problem.empty()) words += fmt::format("  {} {:.1f}\n", text::pad(one.run, 26), one.aic - least);
  return words;
}

}  // namespace tunica::cohort
