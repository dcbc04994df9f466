// SPDX-License-Identifier: Apache-2.0
#include "cohort/remarks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "text/lists.hpp"
#include "text/units.hpp"

namespace tunica::cohort {

namespace {

void remark_failures(const Collection& found, std::vector<Remark>& remarks) {
  Remark remark{RemarkKind::not_fitted, {}, {}};
  for (const Record& record : found.records)
    if (record.outcome != Outcome::fitted) remark.specimens.push_back(record.id);
  if (remark.specimens.empty()) return;
  remark.sentence =
      fmt::format("{} of {} specimens {} not fitted and {} left out; the reasons stand beside them",
                  remark.specimens.size(), found.records.size(), text::agreeing(remark.specimens.size(), "was", "were"),
                  text::agreeing(remark.specimens.size(), "is", "are"));
  remarks.push_back(std::move(remark));
}

void remark_few(const Collection& found, std::vector<Remark>& remarks) {
  constexpr std::size_t enough = 4;
  const std::size_t count = found.count(Outcome::fitted);
  if (count >= enough || count == 0) return;
  remarks.push_back({RemarkKind::few_specimens,
                     fmt::format("{} {} fitted: what they have in common is hardly known. Intervals are wide, and the "
                                 "spread between specimens is a guess. Measure more",
                                 text::counted(count, "specimen", "specimens"), text::agreeing(count, "was", "were"))});
}

/// Two specimens with the same curves are one, entered twice.
void remark_same_data(const Collection& found, std::vector<Remark>& remarks) {
  std::map<std::string, std::vector<std::string>> by_data;
  std::vector<std::string> order;
  for (const Record& record : found.records) {
    if (record.data.empty()) continue;
    if (by_data[record.data].empty()) order.push_back(record.data);
    by_data[record.data].push_back(record.id);
  }
  for (const std::string& data : order)
    if (const auto& ids = by_data[data]; ids.size() > 1)
      remarks.push_back({RemarkKind::same_data,
                         fmt::format("{} have the same measured values. One measurement counts several times; take "
                                     "all but one of them out with \"where\"",
                                     text::joined(ids)),
                         ids});
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

bool suspicious(double value, double median) {
  return std::abs(std::log(value / median)) >= std::log(suspicious_ratio);
}

/// A unit that is wrong in one file makes its values a thousand times too large. They are the same in every run.
void remark_large_values(const std::vector<const Record*>& fitted, std::vector<Remark>& remarks) {
  const std::vector<Record::Quality>& channels = fitted.front()->runs.front().quality;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    std::vector<double> values;
    for (const Record* record : fitted)
      if (const auto& own = record->runs.front().quality; c < own.size()) values.push_back(own[c].largest);
    const double median = median_of(values);
    for (const Record* record : fitted) {
      if (c >= record->runs.front().quality.size()) continue;
      const Record::Quality& one = record->runs.front().quality[c];
      if (!(one.largest > 0 && median > 0 && suspicious(one.largest, median))) continue;
      remarks.push_back(
          {RemarkKind::far_off,
           fmt::format("{}: {} of '{}' reaches {:.3g}{}, in the median of the cohort {:.3g}. Is the unit "
                       "of its column right?",
                       record->id, one.channel, one.test, one.largest, text::unit_suffix(one.unit), median),
           {record->id}});
    }
  }
}

/// A unit that is wrong elsewhere makes a modulus a thousand times too large.
void remark_far_off(const std::vector<const Record*>& fitted, std::size_t run, std::vector<Remark>& remarks) {
  const std::vector<Record::Parameter>& parameters = fitted.front()->runs[run].parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    if (parameters[j].scale != Scale::log) continue;
    std::vector<double> values;
    for (const Record* record : fitted) values.push_back(record->runs[run].parameters[j].value);
    const double median = median_of(values);
    for (const Record* record : fitted) {
      const Record::Parameter& one = record->runs[run].parameters[j];
      // One that the data do not fix may be anywhere.
      if (!one.identified || !suspicious(one.value, median)) continue;
      remarks.push_back({RemarkKind::far_off,
                         fmt::format("{}: {} is {:.3g}{}, the median of the cohort {:.3g}. Is a unit wrong?",
                                     record->id, one.name, one.value, text::unit_suffix(one.unit), median),
                         {record->id}});
    }
  }
}

void remark_bounds(const std::vector<const Record*>& fitted, std::size_t run, std::vector<Remark>& remarks) {
  const std::vector<Record::Parameter>& parameters = fitted.front()->runs[run].parameters;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    Remark remark{RemarkKind::often_at_bound, {}, {}};
    for (const Record* record : fitted)
      if (!record->runs[run].parameters[j].at_bound.empty()) remark.specimens.push_back(record->id);
    if (remark.specimens.empty() || 5 * remark.specimens.size() < fitted.size()) continue;
    remark.sentence = fmt::format(
        "{}: {} lies at a bound in {} of {} specimens{}. Its mean and spread say little; widen "
        "the bound, fix the parameter, or doubt the model",
        fitted.front()->runs[run].label, parameters[j].name, remark.specimens.size(), fitted.size(),
        remark.specimens.size() < 4 ? fmt::format(" ({})", text::joined(remark.specimens)) : "");
    remarks.push_back(std::move(remark));
  }
}

}  // namespace

std::vector<Remark> remarks_of(const SpecimenTable& table, const Collection& found) {
  std::vector<Remark> remarks;
  remark_failures(found, remarks);
  remark_few(found, remarks);
  for (const Factor& factor : table.factors)
    if (!factor.refusal.empty()) remarks.push_back({RemarkKind::factor_not_compared, factor.refusal});
  remark_same_data(found, remarks);
  std::vector<const Record*> fitted;
  for (const Record& record : found.records)
    if (record.outcome == Outcome::fitted) fitted.push_back(&record);
  if (fitted.empty()) return remarks;
  if (!fitted.front()->runs.empty()) remark_large_values(fitted, remarks);
  for (std::size_t run = 0; run < fitted.front()->runs.size(); ++run) {
    remark_far_off(fitted, run, remarks);
    remark_bounds(fitted, run, remarks);
  }
  return remarks;
}

}  // namespace tunica::cohort
