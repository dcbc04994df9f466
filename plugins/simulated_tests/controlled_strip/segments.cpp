// SPDX-License-Identifier: Apache-2.0
#include "segments.hpp"

#include <cmath>
#include <optional>

#include "tunica/detail/bounded_json.hpp"
#include "tunica/error.hpp"

namespace tunica::controlled_strip {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t most_cycles = 10000;

/// The quantities that a segment may prescribe, and their conversion to a stretch or a stress: value · factor + offset.
struct Quantity {
  const char *name, *unit;
  Control control;
};
constexpr Quantity quantities[]{{"stretch", "1", Control::stretch},
                                {"displacement", "mm", Control::stretch},
                                {"nominal_stress", "kPa", Control::nominal},
                                {"cauchy_stress", "kPa", Control::cauchy},
                                {"force", "mN", Control::nominal}};

class Reader {
 public:
  Reader(const Sizes& sizes, const UnitFactor& unit_factor) : sizes_(sizes), unit_factor_(unit_factor) {}

  std::vector<Segment> read(const std::string& text) {
    Json list;
    try {
      list = detail::parse_json<Json>(text);
    } catch (const Json::exception&) {
      throw InputError("loading_segments: \"segments\" is no JSON; give a list of segments");
    }
    if (!list.is_array() || list.empty())
      throw InputError(
          "loading_segments: \"segments\" is " + std::string(list.is_array() ? "empty" : "no list") +
          "; give a list such as [{\"ramp\": {\"stretch\": 1.5}, \"duration\": \"2 s\"}, {\"hold\": \"100 s\"}]");
    for (const Json& one : list) {
      ++number_;
      segment(one);
    }
    return std::move(segments_);
  }

 private:
  [[noreturn]] void refuse(const std::string& found, const std::string& remedy) const {
    throw InputError("loading_segments: segment " + std::to_string(number_) + " of \"segments\" " + found + "; " +
                     remedy);
  }

  void segment(const Json& one) {
    const int kinds =
        !one.is_object() ? 0 : int(one.contains("ramp")) + int(one.contains("hold")) + int(one.contains("cycle"));
    if (kinds != 1)
      refuse("is " + one.dump().substr(0, 60), "expected an object with one of \"ramp\", \"hold\" and \"cycle\"");
    for (const auto& [key, value] : one.items()) {
      const bool timing = !one.contains("hold") && (key == "duration" || key == "rate");
      if (key != "ramp" && key != "hold" && key != "cycle" && !timing && !(key == "count" && one.contains("cycle")))
        refuse("has the key '" + key + "', which means nothing there",
               "take it out: a ramp has \"duration\" or \"rate\", a cycle \"count\" as well, a hold only its time");
    }
    if (one.contains("hold"))
      hold(one["hold"]);
    else if (one.contains("ramp"))
      ramp(one["ramp"], one);
    else
      cycle(one["cycle"], one);
  }

  void hold(const Json& time) {
    if (segments_.empty())
      refuse("is a hold, and nothing was prescribed before it",
             "expected a ramp first, with \"duration\": 0 for a jump");
    Segment held = segments_.back();
    held.hold = true;
    add(held, number(time, "s", "the time of a hold"));
  }

  void ramp(const Json& target, const Json& one) {
    const Quantity& quantity = quantity_of(target);
    Segment ramp{quantity.control, false, value(target.front(), quantity)};
    add(ramp, duration(one, quantity, ramp));
  }

  void cycle(const Json& target, const Json& one) {
    const Quantity& quantity = quantity_of(target);
    const Json& ends = target.front();
    if (!ends.is_array() || ends.size() != 2)
      refuse("is a cycle of " + ends.dump().substr(0, 40),
             "give the two values that it goes to and fro between, as in {\"stretch\": [1, 1.5]}");
    const Json count = one.value("count", Json(1));
    if (!count.is_number_integer() || count.get<std::int64_t>() < 1 || count.get<std::int64_t>() > most_cycles)
      refuse("has the count " + count.dump().substr(0, 40), "expected a whole number from 1 to 10000");
    const double low = value(ends[0], quantity), high = value(ends[1], quantity);
    for (std::int64_t k = 0; k < 2 * count.get<std::int64_t>(); ++k) {
      Segment ramp{quantity.control, false, k % 2 == 0 ? high : low};
      // "duration" is that of one cycle, there and back.
      const double time = duration(one, quantity, ramp);
      add(ramp, one.contains("duration") ? time / 2 : time);
    }
  }

  const Quantity& quantity_of(const Json& target) const {
    std::string known;
    for (const Quantity& one : quantities) known += (known.empty() ? "" : ", ") + std::string(one.name);
    if (!target.is_object() || target.size() != 1)
      refuse("prescribes " + target.dump().substr(0, 60), "give one quantity and its value, of: " + known);
    for (const Quantity& one : quantities) {
      if (target.begin().key() != one.name) continue;
      if (std::string_view(one.unit) == "mm" && !(sizes_.gauge_length > 0))
        refuse("prescribes a displacement, and the test has no \"gauge_length\"", "give it beside \"type\"");
      if (std::string_view(one.unit) == "mN" && !(sizes_.area > 0))
        refuse("prescribes a force, and the test has no \"area\"", "give the unloaded section beside \"type\"");
      return one;
    }
    refuse("prescribes '" + target.begin().key() + "'", "expected one of: " + known);
  }

  /// λ = 1 + d/L, P = F/A.
  double value(const Json& given, const Quantity& quantity) const {
    const double read = number(given, quantity.unit, std::string("a ") + quantity.name);
    const double converted = std::string_view(quantity.unit) == "mm"   ? 1 + read / sizes_.gauge_length
                             : std::string_view(quantity.unit) == "mN" ? read / sizes_.area
                                                                       : read;
    if (quantity.control == Control::stretch && !(converted > 0))
      refuse("goes to the stretch " + std::to_string(converted), "expected one above 0; at rest it is 1");
    return converted;
  }

  double duration(const Json& one, const Quantity& quantity, const Segment& ramp) const {
    if (one.contains("duration") == one.contains("rate"))
      refuse(one.contains("rate") ? "has a \"duration\" and a \"rate\"" : "has neither \"duration\" nor \"rate\"",
             "give one of them");
    if (one.contains("duration")) return number(one["duration"], "s", "a duration");
    const double given = number(one["rate"], std::string(quantity.unit) + "/s", "a rate");
    const double rate = std::string_view(quantity.unit) == "mm"   ? given / sizes_.gauge_length
                        : std::string_view(quantity.unit) == "mN" ? given / sizes_.area
                                                                  : given;
    if (!(rate > 0)) refuse("has the rate " + std::to_string(rate), "expected one above 0, whatever the direction");
    const std::optional<double> from = known_value(quantity.control);
    if (!from)
      refuse("has a rate, and where it begins is not known because another quantity was prescribed before",
             "give its \"duration\"");
    return std::abs(ramp.to - *from) / rate;
  }

  /// The value of a quantity at the end of what was read: rest at first, unknown after another one was prescribed.
  std::optional<double> known_value(Control control) const {
    if (segments_.empty()) return control == Control::stretch ? 1 : 0;
    if (segments_.back().control != control) return std::nullopt;
    return segments_.back().to;
  }

  double number(const Json& given, const std::string& unit, const std::string& what) const {
    double value = NAN;
    if (given.is_number()) value = given.get<double>();
    if (given.is_string()) {
      const std::string& text = given.get_ref<const std::string&>();
      std::size_t end = 0;
      try {
        value = std::stod(text, &end);
      } catch (const std::exception&) {
        end = 0;
      }
      while (end < text.size() && text[end] == ' ') ++end;
      if (end > 0 && end < text.size()) {
        if (!unit_factor_) refuse("gives " + what + " with a unit", "give it in " + unit);
        try {
          value *= unit_factor_(text.substr(end), unit);
        } catch (const InputError& problem) {
          refuse("gives '" + text.substr(0, 40) + "' for " + what + ": " + problem.what(),
                 "expected a unit of " + unit);
        }
      }
    }
    if (!std::isfinite(value))
      refuse("gives " + given.dump().substr(0, 40) + " for " + what,
             "expected a number, or text with a unit of " + unit);
    return value;
  }

  void add(Segment segment, double duration) {
    if (!(duration >= 0)) refuse("takes " + std::to_string(duration) + " s", "expected 0 s or more");
    segment.from = segments_.empty() ? 0 : segments_.back().to_t;
    segment.to_t = segment.from + duration;
    segments_.push_back(segment);
  }

  const Sizes& sizes_;
  const UnitFactor& unit_factor_;
  std::vector<Segment> segments_;
  std::size_t number_ = 0;
};

}  // namespace

std::vector<Segment> read_segments(const std::string& json, const Sizes& sizes, const UnitFactor& unit_factor) {
  return Reader(sizes, unit_factor).read(json);
}

}  // namespace tunica::controlled_strip
