// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "diagnosis/file/changes.hpp"
#include "diagnosis/file/correction.hpp"
#include "diagnosis/hypotheses/extension.hpp"

namespace tunica::diagnosis {
namespace {

bool acts_on(const MechanismFactory& mechanism, const std::string& type) {
  const auto& types = mechanism.applies_to;
  return types.empty() || std::find(types.begin(), types.end(), type) != types.end();
}

bool takes_channel(const MechanismFactory& mechanism) {
  return std::any_of(mechanism.options.begin(), mechanism.options.end(),
                     [](const Option& option) { return option.name == "channel"; });
}

/// The stresses of a sheet, where it has two.
std::vector<std::string> directions_of(const Record& record, const std::string& test) {
  std::vector<std::string> names;
  for (const data::Channel& channel : record.data(test).channels)
    if (channel.observable.starts_with("stress")) names.push_back(channel.observable);
  return names.size() == 2 ? names : std::vector<std::string>();
}

/// As an extension names them: what a test has already, and the second of two, gets a number.
void number_names(const Record& record, std::vector<Addition>& additions) {
  int number = 1;
  for (Addition& addition : additions) {
    const auto taken = [&](const std::string& test) {
      const auto& there = record.test(test).mechanisms;
      return std::any_of(there.begin(), there.end(), [&](const auto& one) { return one.name() == addition.name(); });
    };
    const auto& tests = addition.place.tests;
    do {
      if (number > 1) addition.as = fmt::format("{}_{}", addition.id, number);
      ++number;
    } while (std::any_of(tests.begin(), tests.end(), taken));
  }
}

/// The addition as an entry of "mechanisms".
std::string entry_text(const Addition& addition, const MechanismFactory& mechanism) {
  const auto pair = [](std::string_view key, std::string_view value) {
    return fmt::format("{}: {}", json_text(key), value);
  };
  std::vector<std::string> keys{pair("type", json_text(addition.id))};
  if (!addition.place.channel.empty()) keys.push_back(pair("channel", json_text(addition.place.channel)));
  if (!addition.as.empty()) keys.push_back(pair("as", json_text(addition.as)));
  if (addition.place.tests.size() > 1) {
    std::vector<std::string> shared;
    for (const Parameter& parameter : mechanism.parameters)
      shared.push_back(
          pair(parameter.name, fmt::format("{{{}}}", pair("share", json_text(share_of(addition, parameter))))));
    keys.push_back(pair("parameters", fmt::format("{{{}}}", fmt::join(shared, ", "))));
  }
  return fmt::format("{{{}}}", fmt::join(keys, ", "));
}

void add(const Record& record, const MechanismFactory& mechanism, const std::vector<std::string>& tests, bool common,
         const std::vector<std::string>& channels, Corrections& all) {
  Correction one{FileKind::calibration, tests, common, "", "", {}};
  for (const std::string& channel : channels) one.additions.push_back({mechanism.id, {tests, channel}, {}});
  number_names(record, one.additions);
  std::vector<std::string> entries;
  for (const Addition& addition : one.additions) entries.push_back(entry_text(addition, mechanism));
  one.mend = fmt::format("\"mechanisms\": [{}] into {}", fmt::join(entries, ", "), quoted(tests));
  for (const std::string& test : tests) add_mechanisms(record.test(test), entries, one.changes);
  all.push_back(std::move(one));
}

/// Of a sheet each direction; where the mechanism takes both together, that too, and each with an amplitude of its own
/// where it takes one alone.
void add_directions(const Record& record, const MechanismFactory& mechanism, const std::vector<std::string>& tests,
                    bool common, const std::vector<std::string>& directions, Corrections& all) {
  for (const std::string& direction : directions) add(record, mechanism, tests, common, {direction}, all);
  if (mechanism.by_channel)
    add(record, mechanism, tests, common, directions, all);
  else
    add(record, mechanism, tests, common, {""}, all);
}

/// "axial " of "stress_axial"
std::string direction_words(const std::string& channel) {
  return channel.size() > 7 ? channel.substr(7) + " " : std::string();
}

std::string words_of(const Addition& addition, double amplitude, const plugins::Catalogue& catalogue) {
  const MechanismFactory& mechanism = catalogue.mechanisms().find(addition.id)->second.factory;
  return mechanism.calibration({quoted(addition.place.tests), direction_words(addition.place.channel), amplitude});
}

}  // namespace

void add_calibrations(const Record& record, const std::vector<std::string>& tests, const plugins::Catalogue& catalogue,
                      Corrections& all) {
  for (const auto& [id, entry] : catalogue.mechanisms()) {
    const MechanismFactory& mechanism = entry.factory;
    // In one test these are causes in the rig.
    const bool of_the_rig = !mechanism.question_only;
    if (!mechanism.calibration) continue;
    std::vector<std::string> fit_for, directions;
    for (const std::string& test : tests) {
      if (!acts_on(mechanism, record.test(test).type)) continue;
      if (mechanism.memory && record.data(test).time.size() < 2) continue;
      const std::vector<std::string> own = directions_of(record, test);
      if (takes_channel(mechanism) && own.empty()) continue;
      fit_for.push_back(test);
      directions = own;
    }
    const auto add_in = [&](const std::vector<std::string>& in, bool common) {
      if (takes_channel(mechanism))
        add_directions(record, mechanism, in, common, directions, all);
      else
        add(record, mechanism, in, common, {""}, all);
    };
    if (fit_for.size() > 1) add_in(fit_for, true);
    if (of_the_rig) continue;
    for (const std::string& test : fit_for) add_in({test}, fit_for.size() == 1 && tests.size() == 1);
  }
}

std::string calibration_words(const Correction& correction, const std::vector<Amplitude>& amplitudes,
                              const plugins::Catalogue& catalogue) {
  std::string words;
  for (std::size_t k = 0; k < correction.additions.size(); ++k)
    words += (k > 0 ? ", and " : "") + words_of(correction.additions[k], amplitudes[k].value, catalogue);
  return words;
}

}  // namespace tunica::diagnosis
