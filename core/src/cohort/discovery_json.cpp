// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cohort/discovery_study.hpp"
#include "cohort/tables.hpp"
#include "discovery/output/outputs.hpp"
#include "discovery/output/parts.hpp"
#include "results/keys.hpp"
#include "text/csv.hpp"

namespace tunica::cohort {

namespace key = results::key;

namespace {

using Json = nlohmann::ordered_json;

/// The middle of the specimens, and the least and largest value.
Json over_specimens(const discovery::CommonTerm& term) {
  Json all = Json::object();
  for (const auto& first : term.specimens) {
    if (!first) continue;
    for (const diagnosis::Amplitude& parameter : first->parameters) {
      if (all.contains(parameter.name)) continue;
      std::vector<double> values;
      for (const auto& one : term.specimens)
        if (one)
          for (const diagnosis::Amplitude& own : one->parameters)
            if (own.name == parameter.name) values.push_back(own.value);
      std::sort(values.begin(), values.end());
      const std::size_t n = values.size();
      all[parameter.name] = {{key::value, (values[(n - 1) / 2] + values[n / 2]) / 2},
                             {key::low, values.front()},
                             {key::high, values.back()},
                             {key::unit, parameter.unit}};
    }
  }
  return all;
}

Json term_json(const discovery::CommonDiscovery& found, const discovery::CommonTerm& term) {
  Json one = {{key::name, term.name}};
  one.update(discovery::kind_json(*term.kind));
  one[key::closed] = true;
  one[key::probability] = term.probability;
  one[key::invariant_probability] = term.invariant_probability;
  one[key::seen] = term.seen();
  one[key::parameters] = over_specimens(term);
  one[key::curves] = Json::array();
  for (std::size_t s = 0; s < term.specimens.size(); ++s)
    if (const auto& own = term.specimens[s])
      one[key::curves].push_back({{key::specimen, found.specimens[s].id},
                                  {key::x, own->curve.x},
                                  {key::slope, own->curve.slope},
                                  {key::unit, "kPa"}});
  return one;
}

Json specimen_json(const discovery::SpecimenOutcome& one) {
  return {{key::specimen, one.id},
          {key::rows, one.analysis.evidence.fit.residuals.size()},
          {key::p_before, one.analysis.alarm.p()},
          {key::p_after, one.p_after},
          {key::chi2_before, one.chi2_before},
          {key::chi2_after, one.chi2_after},
          {key::gain, one.gain},
          {key::needed, one.needed}};
}

}  // namespace

std::string discovery_document(const Specification& cohort, const DiscoveryStudy& study,
                               const plugins::Catalogue& catalogue) {
  const discovery::CommonDiscovery& found = study.found;
  Json result = discovery::answer_json(found.request, found.judgement);
  const bool base = !found.request.from_nothing;
  result[key::p_before] = base ? Json(found.p_before) : Json(nullptr);
  result[key::p_after] = found.p_after;
  result[key::chi2_before] = base ? Json(found.chi2_before) : Json(nullptr);
  result[key::chi2_after] = found.chi2_after;
  result[key::rows] = found.rows;
  result[key::sets_fitted] = found.sets_tried;
  result[key::terms] = Json::array();
  for (const discovery::CommonTerm& term : found.terms) result[key::terms].push_back(term_json(found, term));
  result[key::path_dependence] = discovery::paths_json(found.paths);
  result[key::held_out] = Json::array();
  result[key::specimens] = Json::array();
  for (const discovery::SpecimenOutcome& one : found.specimens) result[key::specimens].push_back(specimen_json(one));
  result[key::left_out] = Json::array();
  for (const discovery::LeftOut& one : found.left_out)
    result[key::left_out].push_back({{key::specimen, one.id}, {key::reason, one.reason}});
  std::vector<std::string> data;
  for (const discovery::SpecimenOutcome& one : found.specimens) {
    const auto& own = one.analysis.evidence.base->layout().data_hashes;
    data.insert(data.end(), own.begin(), own.end());
  }
  return discovery::document(cohort.name, found.warnings, std::move(result), study.first,
                             found.specimens.front().analysis.evidence, data, catalogue);
}

std::string term_table(const SpecimenTable& table, const DiscoveryStudy& study) {
  std::string text = column_cells(table) + "gain,term,parameter,unit,value,low,high\n";
  for (std::size_t s = 0; s < study.positions.size(); ++s) {
    const std::string begin =
        cells_of(table, table.specimens[study.positions[s]]) + fmt::format("{},", study.found.specimens[s].gain);
    if (study.found.terms.empty()) text += begin + ",,,,,\n";
    for (const discovery::CommonTerm& term : study.found.terms) {
      if (!term.specimens[s]) {
        text += begin + term.name + ",,,,,\n";
        continue;
      }
      for (const diagnosis::Amplitude& one : term.specimens[s]->parameters)
        text += begin + fmt::format("{},{},{},{},{},{}\n", term.name, one.name, text::csv_cell(one.unit), one.value,
                                    one.low, one.high);
    }
  }
  return text;
}

}  // namespace tunica::cohort
