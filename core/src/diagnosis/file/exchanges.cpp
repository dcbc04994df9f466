// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "data/quantities.hpp"
#include "diagnosis/file/changes.hpp"
#include "diagnosis/file/correction.hpp"

namespace tunica::diagnosis {
namespace {

/// The two directions of a sheet: stretches and stresses of both are in the data.
struct Directions {
  std::string stretch[2], stress[2];
};

std::optional<Directions> directions_in(const Record& record, const std::string& test) {
  const data::Dataset& data = record.data(test);
  Directions found;
  std::size_t count = 0;
  for (const data::Channel& channel : data.channels) {
    const auto& known = record.observables(test);
    const auto observable =
        std::find_if(known.begin(), known.end(), [&](const Observable& one) { return one.name == channel.observable; });
    if (observable == known.end() || observable->kind != Observable::Kind::stress) continue;
    const Observable* const beside = data::stretch_beside(*observable, known);
    if (beside == nullptr || abscissa_of(data, beside->name) == nullptr) continue;
    if (count == 2) return std::nullopt;
    found.stress[count] = channel.observable;
    found.stretch[count++] = beside->name;
  }
  if (count != 2) return std::nullopt;
  return found;
}

/// "axial" of a test that is pulled along "circumferential", and the other way round.
std::optional<std::string> other_direction(const experiment::TestEntry& entry) {
  if (!entry.options.has("direction")) return std::nullopt;
  const std::string& direction = entry.options.text("direction");
  if (direction == "circumferential") return "axial";
  if (direction == "axial") return "circumferential";
  return std::nullopt;
}

std::vector<std::string> stresses_in(const Record& record, const std::string& test) {
  std::vector<std::string> names;
  for (const data::Channel& channel : record.data(test).channels)
    for (const Observable& observable : record.observables(test))
      if (observable.name == channel.observable && observable.kind == Observable::Kind::stress)
        names.push_back(observable.name);
  return names;
}

std::vector<std::string> stretches_in(const Record& record, const std::string& test) {
  std::vector<std::string> names;
  for (const auto& [name, values] : record.data(test).abscissae)
    for (const Observable& observable : record.observables(test))
      if (observable.name == name && observable.kind == Observable::Kind::stretch &&
          data::stretch_beside({"stress", "", Observable::Role::channel, false, ""}, record.observables(test)) !=
              nullptr)
        names.push_back(name);
  return names;
}

}  // namespace

void add_exchanges(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  std::vector<std::string> sheets, strips;
  for (const std::string& test : tests) {
    if (directions_in(record, test))
      sheets.push_back(test);
    else if (other_direction(record.test(test)) && record.test(test).layers.empty())
      strips.push_back(test);
  }
  const auto add_sheets = [&](const char* what, bool stretches, bool stresses) {
    add_for_each_and_all(
        FileKind::exchange, sheets,
        [&](const std::vector<std::string>& in) -> Wording {
          return {fmt::format("the {} of the two directions of {} are exchanged", what, quoted(in)),
                  fmt::format("the names of the columns of the {} of {} the other way round", what, quoted(in))};
        },
        [stretches, stresses](Record& read, const std::string& test) {
          const auto found = directions_in(read, test);
          return found && (!stretches || read.exchange_abscissae(test, found->stretch[0], found->stretch[1])) &&
                 (!stresses || read.exchange_channels(test, found->stress[0], found->stress[1]));
        },
        all);
  };
  add_sheets("stretches", true, false);
  add_sheets("stresses", false, true);
  add_sheets("stretches and stresses", true, true);
  add_for_each_and_all(
      FileKind::exchange, strips,
      [&](const std::vector<std::string>& in) -> Wording {
        std::vector<Change> changes;
        for (const std::string& test : in)
          changes.push_back({pointer({"tests", test, "direction"}), json_text(*other_direction(record.test(test)))});
        return {in.size() == 1 ? fmt::format("'{}' was pulled along the {} direction", in.front(),
                                             *other_direction(record.test(in.front())))
                               : fmt::format("the directions of {} are exchanged", quoted(in)),
                in.size() == 1 ? fmt::format("\"direction\": \"{}\" in '{}'", *other_direction(record.test(in.front())),
                                             in.front())
                               : fmt::format("the other \"direction\" in each of {}", quoted(in)),
                changes};
      },
      [](Record& read, const std::string& test) {
        const auto other = other_direction(read.test(test));
        if (other) read.test(test).options.set("direction", *other);
        return other.has_value();
      },
      all);
}

void add_signs(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  std::vector<std::string> stressed;
  for (const std::string& test : tests)
    if (!stresses_in(record, test).empty() && !stretches_in(record, test).empty()) stressed.push_back(test);
  // The key turns forces, stresses, displacements and strains. A stretch has no sign to turn.
  const auto mend = [](bool stretches, bool stresses) {
    return !stretches ? "\"compression\": \"positive\" for the stress or the force"
           : stresses
               ? "\"compression\": \"positive\", and 2 less the value in a column of stretches,"
               : "2 less the value in a column of stretches, or \"compression\": \"positive\" for one of strains or "
                 "displacements,";
  };
  const auto add = [&](const char* what, bool stretches, bool stresses) {
    add_for_each_and_all(
        FileKind::sign, stressed,
        [&](const std::vector<std::string>& in) -> Wording {
          return {fmt::format("the {} of {} count compression positive", what, quoted(in)),
                  fmt::format("{} in the data of {}", mend(stretches, stresses), quoted(in))};
        },
        [stretches, stresses](Record& read, const std::string& test) {
          if (stretches)
            for (const std::string& name : stretches_in(read, test))
              if (!read.map_abscissa(test, name, [](double stretch) { return 2 - stretch; })) return false;
          if (stresses)
            for (const std::string& name : stresses_in(read, test))
              if (!read.scale_channel(test, name, -1)) return false;
          return true;
        },
        all);
  };
  add("stretches", true, false);
  add("stresses", false, true);
  add("stretches and stresses", true, true);
}

}  // namespace tunica::diagnosis
