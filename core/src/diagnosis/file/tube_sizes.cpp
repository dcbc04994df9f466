// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "diagnosis/file/correction.hpp"

namespace tunica::diagnosis {
namespace {

/// Unloaded radii of a tube, mm; its type is known by the options that it has.
struct Radii {
  double inner = 0, outer = 0;
};

std::optional<Radii> radii_of(const experiment::TestEntry& entry) {
  for (const char* const name : {"inner_radius", "outer_radius", "thickness"})
    if (!entry.options.has(name)) return std::nullopt;
  const double inner = entry.options.number("inner_radius"), outer = entry.options.number("outer_radius");
  double wall = entry.options.number("thickness");
  if (wall == 0)
    for (const experiment::LayerEntry& layer : entry.layers) wall += layer.thickness;
  return Radii{inner > 0 ? inner : outer - wall, outer > 0 ? outer : inner + wall};
}

constexpr std::array lengths{"outer_diameter", "inner_diameter"};

bool has_length(const Record& record, const std::string& test) {
  for (const char* const name : lengths)
    if (channel_of(record.data(test), name) != nullptr) return true;
  return false;
}

void set_wall(experiment::TestEntry& entry, const Radii& radii) {
  entry.options.set("inner_radius", radii.inner);
  entry.options.set("outer_radius", radii.outer);
  entry.options.set("thickness", 0.0);
}

/// Lumen area of the loaded tube, mm², from a diameter by constant volume of the wall; empty where no diameter is in
/// the data.
std::vector<double> lumen_areas(const Record& record, const std::string& test, const Radii& radii) {
  const data::Dataset& data = record.data(test);
  const std::vector<double>* const stretches = abscissa_of(data, "axial_stretch");
  const double held =
      record.test(test).options.has("axial_stretch") ? record.test(test).options.number("axial_stretch") : 1;
  const double wall = std::numbers::pi * (radii.outer * radii.outer - radii.inner * radii.inner);
  std::vector<double> areas;
  for (std::size_t i = 0; i < data.count; ++i) {
    const double stretch = stretches != nullptr ? (*stretches)[i] : held;
    if (const data::Channel* const outer = channel_of(data, "outer_diameter"))
      areas.push_back(std::numbers::pi / 4 * outer->values[i] * outer->values[i] - wall / stretch);
    else if (const data::Channel* const inner = channel_of(data, "inner_diameter"))
      areas.push_back(std::numbers::pi / 4 * inner->values[i] * inner->values[i]);
    else
      return {};
  }
  return areas;
}

}  // namespace

void add_tube_sizes(const Record& record, const std::vector<std::string>& tests, Corrections& all) {
  std::vector<std::string> tubes, measured, pulled;
  for (const std::string& test : tests) {
    if (!radii_of(record.test(test))) continue;
    tubes.push_back(test);
    if (has_length(record, test)) measured.push_back(test);
    if (has_length(record, test) && channel_of(record.data(test), "axial_force") != nullptr) pulled.push_back(test);
  }
  const auto add = [&](const std::vector<std::string>& in_tests, const char* sentence, const char* mend,
                       const std::function<bool(Record&, const std::string&, const Radii&)>& apply) {
    add_for_each_and_all(
        FileKind::geometry, in_tests,
        [&](const std::vector<std::string>& in) -> Wording {
          return {fmt::format(fmt::runtime(sentence), quoted(in)), fmt::format(fmt::runtime(mend), quoted(in))};
        },
        [apply](Record& read, const std::string& test) {
          const auto radii = radii_of(read.test(test));
          return radii && apply(read, test, *radii);
        },
        all);
  };
  const auto scaled_lengths = [](double factor) {
    return [factor](Record& read, const std::string& test, const Radii&) {
      for (const char* const name : lengths)
        if (channel_of(read.data(test), name) != nullptr && !read.scale_channel(test, name, factor)) return false;
      return true;
    };
  };
  add(measured, "the diameters of {} are radii", "twice the values into the column of {}", scaled_lengths(2));
  add(measured, "the diameters of {} are twice as large as the tube's", "half the values into the column of {}",
      scaled_lengths(0.5));
  add(measured, "the diameters of {} are changes of the diameter",
      "the diameter of the unloaded tube added to the column of {}",
      [](Record& read, const std::string& test, const Radii& radii) {
        for (const char* const name : lengths) {
          if (channel_of(read.data(test), name) == nullptr) continue;
          const double unloaded = 2 * (name == std::string_view("outer_diameter") ? radii.outer : radii.inner);
          if (!read.shift_channel(test, name, std::vector<double>(read.data(test).count, unloaded))) return false;
        }
        return true;
      });
  add(measured, "the diameters of {} are those of the other side of the wall",
      "\"inner_diameter\" for \"outer_diameter\", or the reverse, in the columns of {}",
      [](Record& read, const std::string& test, const Radii&) {
        const bool outer = channel_of(read.data(test), "outer_diameter") != nullptr,
                   inner = channel_of(read.data(test), "inner_diameter") != nullptr;
        if (outer && inner) return read.exchange_channels(test, "outer_diameter", "inner_diameter");
        read.rename_channel(test, outer ? "outer_diameter" : "inner_diameter",
                            outer ? "inner_diameter" : "outer_diameter");
        return true;
      });
  const auto radii_times = [](double inner, double outer) {
    return [inner, outer](Record& read, const std::string& test, const Radii& radii) {
      const Radii own{inner * radii.inner, outer * radii.outer};
      if (!(own.outer > own.inner) || !read.test(test).layers.empty()) return false;
      set_wall(read.test(test), own);
      return true;
    };
  };
  add(tubes, "the unloaded radii of {} are diameters", "half of the radii in {}", radii_times(0.5, 0.5));
  add(tubes, "the unloaded radii of {} are half of the tube's", "twice the radii in {}", radii_times(2, 2));
  add(tubes, "the inner radius of {} is a diameter", "half of \"inner_radius\" in {}", radii_times(0.5, 1));
  add(tubes, "the outer radius of {} is a diameter", "half of \"outer_radius\" in {}", radii_times(1, 0.5));
  const auto wall_times = [](double factor, bool outside) {
    return [factor, outside](Record& read, const std::string& test, const Radii& radii) {
      const double wall = factor * (radii.outer - radii.inner);
      const Radii own = outside ? Radii{radii.inner, radii.inner + wall} : Radii{radii.outer - wall, radii.outer};
      if (!(own.inner > 0) || !read.test(test).layers.empty()) return false;
      set_wall(read.test(test), own);
      return true;
    };
  };
  add(tubes, "the wall of {} is half as thick, as where both walls of a flattened ring were measured",
      "half of the thickness in {}", wall_times(0.5, true));
  add(tubes, "the wall of {} is half as thick, with the outer radius as it is", "half of the thickness in {}",
      wall_times(0.5, false));
  add(tubes, "the wall of {} is twice as thick", "twice the thickness in {}", wall_times(2, true));
  add(tubes, "the wall of {} is twice as thick, with the outer radius as it is", "twice the thickness in {}",
      wall_times(2, false));
  add(pulled, "the axial force of {} has the pressure on the closed ends in it",
      "the force without pressure times lumen area in the column of {}",
      [](Record& read, const std::string& test, const Radii& radii) {
        const std::vector<double>* const pressure = abscissa_of(read.data(test), "pressure");
        std::vector<double> offsets = lumen_areas(read, test, radii);
        if (pressure == nullptr || offsets.empty()) return false;
        // kPa · mm² = mN
        for (std::size_t i = 0; i < offsets.size(); ++i)
          offsets[i] = std::isnan(offsets[i]) ? 0 : -(*pressure)[i] * offsets[i];
        return read.shift_channel(test, "axial_force", offsets);
      });
}

}  // namespace tunica::diagnosis
