// SPDX-License-Identifier: Apache-2.0
// A strip whose loading is not in the data but stated: ramps, holds and cycles of a stretch, a displacement, a stress
// or a force, one after the other from rest. Rows have a time, and what was measured then. So a relaxation curve of
// time and stress is enough, and a row of relaxation, creep and recovery stands in one file. A row at the instant of a
// jump is behind it.
#include <algorithm>
#include <cmath>
#include <memory>

#include "controlled_strip.hpp"
#include "segments.hpp"

namespace tunica::controlled_strip {
namespace {

/// Holds begin where they change fastest: the first step of a hold is this part of it.
constexpr double first_part = 1e-4;

class LoadingSegments final : public Test {
 public:
  explicit LoadingSegments(const TestSetup& setup)
      : strip_(strip_of(setup, "loading_segments")),
        temperature_(temperature_of(setup, "loading_segments")),
        description_(description_of_strip(strip_, temperature_)) {
    time_.assign(setup.rows.time.begin(), setup.rows.time.end());
    if (time_.empty())
      throw InputError("loading_segments: no rows, or no column mapped to 'time'; map one in \"columns\"");
    const Sizes sizes{setup.options.number("gauge_length"), setup.options.number("area")};
    lay_out(read_segments(setup.options.text("segments"), sizes, setup.unit_factor), setup.options.count("steps"));
    rows_.count = time_.size();
    rows_.channels = setup.rows.channels;
    rows_.time = time_;
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& output) const override {
    return follow_shifted(strip_, temperature_, steps_, input, output);
  }

 private:
  /// The steps of all segments, with those of the rows among them.
  void lay_out(const std::vector<Segment>& segments, std::size_t parts) {
    check_steps("loading_segments", static_cast<double>(segments.size()) * static_cast<double>(parts));
    const double end = segments.back().to_t;
    // A clock and a sum of durations agree to rounding only.
    const double close = 1e-9 * std::max(1.0, end);
    for (std::size_t i = 0; i < time_.size(); ++i)
      if (!(time_[i] >= 0 && time_[i] <= end + close))
        throw InputError("loading_segments: row " + std::to_string(i + 1) + " is at " + std::to_string(time_[i]) +
                         " s, and \"segments\" go from 0 to " + std::to_string(end) +
                         " s; correct the time, or lengthen the segments");
    std::size_t row = 0;
    for (std::size_t s = 0; s < segments.size(); ++s) {
      const Segment& segment = segments[s];
      bool begins = true;
      const auto add = [&](double time, std::size_t of_row) {
        const double duration = segment.to_t - segment.from;
        const double part = segment.hold   ? 0
                            : duration > 0 ? std::clamp((time - segment.from) / duration, 0.0, 1.0)
                                           : 1;
        steps_.push_back({time, segment.control, part * segment.to, 1 - part, begins, of_row});
        begins = false;
      };
      const bool jump_next = s + 1 < segments.size() && segments[s + 1].to_t == segment.to_t;
      for (const double time : points_of(segment, parts)) {
        for (; row < time_.size() && time_[row] < time - close; ++row) add(time_[row], row);
        const bool here = row < time_.size() && time_[row] <= time + close && !(time == segment.to_t && jump_next);
        if (!here) add(time, LoadStep::none);
        for (; here && row < time_.size() && time_[row] <= time + close; ++row) add(time, row);
      }
    }
  }

  /// Ends of the steps of a segment: even in a ramp, growing in a hold.
  static std::vector<double> points_of(const Segment& segment, std::size_t parts) {
    const double duration = segment.to_t - segment.from;
    if (!(duration > 0)) return {segment.to_t};
    std::vector<double> points;
    for (std::size_t k = 1; k < parts; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(parts);
      points.push_back(segment.from + duration * (segment.hold ? std::pow(first_part, 1 - part) : part));
    }
    points.push_back(segment.to_t);
    return points;
  }

  Strip strip_;
  Temperature temperature_;
  TestDescription description_;
  std::vector<LoadStep> steps_;
  std::vector<double> time_;
  TestRows rows_;
};

}  // namespace

TestFactory loading_segments_factory() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  std::vector<Observable> observables{
      {"time", "s", Role::time, true, "Time since the first segment began.", Kind::plain},
      {"stress", "kPa", Role::channel, false, "Measured stress along the strip.", Kind::stress},
      {"stretch", "1", Role::channel, false, "Measured stretch along the strip.", Kind::stretch}};
  for (Observable& lateral : lateral_channels()) observables.push_back(std::move(lateral));
  Option segments = Option::json("segments", std::nullopt,
                                 "The loading from rest: a list of ramps, holds and cycles, each with its time.");
  segments.schema = R"({"type": "array", "minItems": 1, "items": {"type": "object"}})";
  std::vector<Option> options{
      direction_option(), std::move(segments),
      Option::integer("steps", 20, {1, 10000}, "Steps of the simulation in each segment, beside the rows."),
      Option::quantity("gauge_length", "mm", 0, "Unloaded length; segments of displacement need it.", 0.0),
      Option::quantity("area", "mm2", 0, "Unloaded section; segments of force need it.", 0.0)};
  add_common_options(options);
  TestFactory made{
      "loading_segments",
      "A strip whose loading is stated in segments by stretch, displacement, stress or force: relaxation, creep, "
      "recovery.",
      "Findley, Lai, Onaran, Creep and Relaxation of Nonlinear Viscoelastic Materials (1976)",
      std::move(options),
      std::move(observables),
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<LoadingSegments>(setup); },
      all_parameters()};
  made.specimen = Specimen::strip;
  return made;
}

}  // namespace tunica::controlled_strip
