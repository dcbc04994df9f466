// SPDX-License-Identifier: Apache-2.0
#include "assembly/binding.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "data/nearest.hpp"

namespace tunica::assembly {
namespace {

using experiment::ParameterSetting;

std::string place(const Slot& slot) {
  if (!slot.setting || slot.setting->pointer.empty()) return fmt::format("parameter '{}'", slot.declaration.name);
  return fmt::format("{}: parameter '{}'", slot.setting->pointer, slot.declaration.name);
}

/// A native imperfection takes part only if the file mentions it.
bool held(const Slot& slot) {
  if (slot.setting) return slot.setting->fixed.has_value();
  return !std::isnan(slot.null);
}

double held_value(const Slot& slot) { return slot.setting ? *slot.setting->fixed : slot.null; }

/// The effective declaration of one slot, before sharing.
FreeParameter effective(const Slot& slot) {
  const Parameter& own = slot.declaration;
  FreeParameter free{own.name, own.unit, own.min, own.max, own.initial, own.scale, {}, {own.min, own.max}, {slot.id}};
  if (const ParameterSetting* setting = slot.setting) {
    free.min = setting->min.value_or(own.min);
    free.max = setting->max.value_or(own.max);
    // The reader and input.json both fill in defaults. A value that differs from its default is therefore the user's
    // choice.
    free.own_min = setting->min && *setting->min != slot.declaration.min;
    free.own_max = setting->max && *setting->max != slot.declaration.max;
    free.scale = setting->scale.value_or(own.scale);
    free.prior = setting->prior;
    if (setting->share) free.name = *setting->share;
  }
  return free;
}

void check_bounds(const FreeParameter& free, const std::string& where) {
  if (!(free.min < free.max)) {
    throw InputError(fmt::format("{}: min {} is not below max {} {}; widen the bounds, or hold the value with 'fixed'",
                                 where, free.min, free.max, free.unit));
  }
  if (free.scale == Scale::log && !(free.min > 0)) {
    throw InputError(fmt::format("{}: scale 'log' needs min > 0, found min {} {}; raise min or use scale 'linear'",
                                 where, free.min, free.unit));
  }
}

void check_initial(double initial, const FreeParameter& free, const std::string& where) {
  if (initial < free.min || initial > free.max) {
    throw InputError(
        fmt::format("{}: initial {} lies outside its bounds {} … {} {}; move it inside or widen the bounds", where,
                    initial, free.min, free.max, free.unit));
  }
}

/// Narrows the bounds of `free` to those of `slot`, another parameter of the same share.
void tie(FreeParameter& free, const Slot& first, const Slot& slot) {
  const FreeParameter other = effective(slot);
  if (other.unit != free.unit) {
    throw InputError(
        fmt::format("{}: shares '{}' with '{}', but is in {} where that is in {}; share parameters of one unit",
                    place(slot), free.name, first.declaration.name, other.unit, free.unit));
  }
  const double min = std::max(free.min, other.min), max = std::min(free.max, other.max);
  free.own_min = other.min > free.min ? other.own_min : free.own_min;
  free.own_max = other.max < free.max ? other.own_max : free.own_max;
  if (!(min < max)) {
    throw InputError(fmt::format(
        "{}: its bounds {} … {} {} leave nothing in common with {} … {} of '{}', which shares "
        "'{}'; give both the same bounds",
        place(slot), other.min, other.max, free.unit, free.min, free.max, first.declaration.name, free.name));
  }
  free.min = min;
  free.max = max;
  if (other.prior) {
    if (free.prior && (free.prior->mean != other.prior->mean || free.prior->sd != other.prior->sd)) {
      throw InputError(fmt::format("{}: a second, different prior for the shared parameter '{}'; state it once",
                                   place(slot), free.name));
    }
    free.prior = other.prior;
  }
}

/// One free parameter from the slots that share it (mostly one).
FreeParameter merge(const std::vector<const Slot*>& slots) {
  FreeParameter free = effective(*slots.front());
  const Slot* scaled = nullptr;  // the slot that states a scale or an initial value
  const Slot* started = nullptr;
  for (const Slot* slot : slots) {
    if (slot != slots.front()) {
      tie(free, *slots.front(), *slot);
      free.places.push_back(slot->id);
    }
    if (!slot->setting) continue;
    if (const auto scale = slot->setting->scale) {
      if (scaled && *scaled->setting->scale != *scale) {
        throw InputError(fmt::format("{}: another scale than '{}', which shares '{}'; state it once", place(*slot),
                                     scaled->declaration.name, free.name));
      }
      scaled = slot;
      free.scale = *scale;
    }
    if (const auto initial = slot->setting->initial) {
      if (started && *started->setting->initial != *initial) {
        throw InputError(fmt::format("{}: another initial value than '{}', which shares '{}'; state it once",
                                     place(*slot), started->declaration.name, free.name));
      }
      started = slot;
      free.initial = *initial;
    }
    free.own_initial = free.own_initial || slot->setting->own_initial;
  }
  check_bounds(free, place(*slots.front()));
  if (started) check_initial(free.initial, free, place(*started));
  free.initial = std::clamp(free.initial, free.min, free.max);
  return free;
}

}  // namespace

std::optional<std::size_t> Layout::index_of(const ParameterId& id) const {
  for (std::size_t j = 0; j < parameters.size(); ++j)
    if (std::ranges::find(parameters[j].places, id) != parameters[j].places.end()) return j;
  return std::nullopt;
}

FreeParameter::Bound FreeParameter::kind_of(bool upper) const {
  const double bound = upper ? max : min, limit = upper ? declared.max : declared.min;
  const bool own = upper ? own_max : own_min;
  constexpr double close = 1e-3;  // 0.3333 stands for 1/3
  const auto is = [bound](double value) { return std::abs(bound - value) <= close * std::max(1.0, std::abs(value)); };
  if (!own || std::abs(bound - limit) <= close * std::max(1.0, std::abs(limit))) {
    // Mirrored angles give the same families; a stiffness is at least 0, and a share is at most 1.
    if (unit == "deg" && (is(0) || is(90) || is(-90))) return Bound::symmetry;
    if (bound == 0 || (unit == "1" && (is(1.0 / 3) || is(0.5) || is(1)))) return Bound::physical;
  }
  return own ? Bound::chosen : Bound::by_default;
}

Binding bind_parameters(const std::vector<std::vector<Slot>>& owners) {
  Binding binding;
  std::vector<std::vector<const Slot*>> groups;      // of each free parameter
  std::map<std::string, std::size_t> shares, names;  // name → free parameter; outside names, for the clash of names
  for (const auto& slots : owners) {
    ParameterVector vector{std::vector<double>(slots.size()), {}};
    for (std::size_t position = 0; position < slots.size(); ++position) {
      const Slot& slot = slots[position];
      if (slot.same_as) {
        const ParameterVector& other = binding.owners[slot.same_as->owner];
        vector.values[position] = other.values[slot.same_as->position];
        for (const Link& link : other.links)
          if (link.position == slot.same_as->position) vector.links.push_back({position, link.index});
        continue;
      }
      if (held(slot)) {
        vector.values[position] = held_value(slot);
        binding.fixed.push_back({slot.declaration.name,
                                 slot.declaration.unit,
                                 held_value(slot),
                                 {slot.declaration.min, slot.declaration.max}});
        continue;
      }
      const bool shared = slot.setting && slot.setting->share;
      std::size_t index = groups.size();
      if (shared) index = shares.try_emplace(*slot.setting->share, index).first->second;
      if (index == groups.size()) groups.emplace_back();
      groups[index].push_back(&slot);
      if (!shared) names.emplace(slot.declaration.name, index);
      vector.links.push_back({position, index});
    }
    binding.owners.push_back(std::move(vector));
  }
  for (const auto& [share, index] : shares) {
    if (names.contains(share)) {
      throw InputError(
          fmt::format("{}: the share '{}' has the name of another parameter of this run; choose another name",
                      place(*groups[index].front()), share));
    }
  }
  for (const auto& group : groups) binding.free.push_back(merge(group));
  for (ParameterVector& owner : binding.owners) {
    for (const Link& link : owner.links) owner.values[link.position] = binding.free[link.index].initial;
  }
  return binding;
}

void refuse_unknown(const experiment::ParameterSettings& settings, const std::vector<std::string>& known,
                    const std::string& owner) {
  for (const auto& [name, setting] : settings) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (known.empty()) {
      throw InputError(
          fmt::format("{}: unknown parameter '{}': {} has no parameters; remove it", setting.pointer, name, owner));
    }
    throw InputError(fmt::format("{}: unknown parameter '{}' of {}. {}", setting.pointer, name, owner,
                                 data::suggestion(name, known)));
  }
}

}  // namespace tunica::assembly
