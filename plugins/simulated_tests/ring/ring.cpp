// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"
#include "wall.hpp"

namespace tunica::ring {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;
enum class Channel { force, stretch };

constexpr int points_across = 8;
/// Thickness over the radius of the centreline. There, at λ = 1.1, a straightened neo-Hookean wall bears 2.4 % more
/// than its centreline says, and the term of c01 in Mooney's rubber 19 % less.
constexpr double thickest = 0.5;

/// A ring of a tube that two pins pull apart.
class RingPull final : public Test {
 public:
  explicit RingPull(const TestSetup& setup)
      : ring_{setup.options.number("inner_radius"), setup.options.number("thickness"), setup.options.number("width"),
              setup.options.number("pin_radius")} {
    check_sizes();
    if (setup.options.text("wall") == "straightened") {
      const thick_wall::Rule rule(points_across);
      places_ = rule.node;
      weights_ = rule.weight;
    } else {
      places_ = {0.5};
      weights_ = {1};
    }
    bind(setup);
    description_.diagnostics = {"inner_stretch", "outer_stretch", "thickness_stretch"};
    description_.diagnostic_units = {"1", "1", "1"};
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const ModelDescription& model = input.model.describe();
    if (Status status = detail::elastic_only("ring", input, output); !status.ok()) return status;
    if (!model.principal_axes)
      return Status::failed(
          "ring: the model has no path in principal axes, which the strips of the wall need; choose one that has it, "
          "or fit the legs as a test of type 'uniaxial'");
    const bool derivatives = !output.jacobian.empty();
    const std::span<const double> distance =
        input.abscissae.empty() ? std::span<const double>(distance_) : input.abscissae.front();
    Wall wall(ring_, places_, weights_);
    std::size_t lost = StripPath::none;
    if (Status status = wall.solve(input.model, input.model_parameters, distance, derivatives, lost); !status.ok())
      return Status::failed("ring: " + status.reason() +
                            (lost == StripPath::none ? std::string() : ", at " + row_name(lost, distance[lost])) +
                            "; narrow the bounds of the model's parameters");
    const std::size_t n = rows_.count, size = n * channels_.size();
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(wall.force[i]))
        return Status::failed("ring: the stress overflows at " + row_name(i, distance[i]) +
                              "; narrow the bounds of the model's parameters");
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const bool force = channels_[k] == Channel::force;
      const auto copy = [&](const std::vector<double>& from, std::size_t first, std::span<double> to) {
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = from[first + i];
      };
      const auto part = [&](std::span<double> of, std::size_t column) {
        return of.empty() ? of : of.subspan(column * size + k * n, n);
      };
      copy(force ? wall.force : wall.stretch, 0, part(output.values, 0));
      copy(force ? wall.force_by_distance : wall.stretch_by_distance, 0, part(output.abscissa_derivative, 0));
      for (std::size_t j = 0; derivatives && j < input.model_parameters.size(); ++j)
        copy(force ? wall.force_dp : wall.stretch_dp, j * n, part(output.jacobian, j));
    }
    for (std::size_t i = 0; i < n && !output.diagnostics.empty(); ++i) {
      output.diagnostics[i] = wall.stretch[i] * ring_.centre() / ring_.inner_radius;
      output.diagnostics[n + i] = wall.stretch[i] * ring_.centre() / (ring_.inner_radius + ring_.thickness);
      output.diagnostics[2 * n + i] = wall.thinning[i];
    }
    return {};
  }

 private:
  void check_sizes() const {
    for (const auto& [name, size] :
         {std::pair("inner_radius", ring_.inner_radius), std::pair("thickness", ring_.thickness),
          std::pair("width", ring_.width), std::pair("pin_radius", ring_.pin_radius)})
      if (!(size > 0))
        throw InputError(fmt::format(
            "ring: \"{}\" is {:g} mm, and it is above 0; give that of the unloaded ring, or of the pins", name, size));
    if (ring_.pin_radius > ring_.inner_radius)
      throw InputError(
          fmt::format("ring: \"pin_radius\" is {:g} mm and \"inner_radius\" {:g} mm, and pins fit into the ring; give "
                      "radii, not diameters",
                      ring_.pin_radius, ring_.inner_radius));
    if (ring_.thickness > thickest * ring_.centre())
      throw InputError(fmt::format(
          "ring: the wall is {:g} mm thick and its centreline has the radius {:g} mm, and beyond a ratio of "
          "{:g} bending decides; cut the ring open and test the strip, or simulate the ring with a test of "
          "type 'external'",
          ring_.thickness, ring_.centre(), thickest));
  }

  void bind(const TestSetup& setup) {
    for (const TestRows::Column& column : setup.rows.abscissae) {
      distance_.assign(column.values.begin(), column.values.end());
      rows_.abscissae = {column};
    }
    if (distance_.empty()) throw InputError("ring: no column is mapped to 'pin_distance'; map one in \"columns\"");
    for (std::size_t i = 0; i < distance_.size(); ++i)
      if (!(std::isfinite(distance_[i]) && distance_[i] >= ring_.taut() - 1e-9))
        throw InputError(
            fmt::format("ring: {}, and the ring is not straight before {:g} mm, as long as its unloaded centreline; "
                        "leave such rows "
                        "out with \"rows\" or \"where\", and see that the distance is that of the centres of the pins",
                        row_name(i, distance_[i]), ring_.taut()));
    rows_.abscissae.front().values = distance_;
    rows_.count = distance_.size();
    rows_.channels = setup.rows.channels;
    for (const std::string& name : rows_.channels)
      channels_.push_back(name == "force" ? Channel::force : Channel::stretch);
  }

  static std::string row_name(std::size_t row, double distance) {
    return fmt::format("row {} (pin_distance {:g} mm)", row + 1, distance);
  }

  Ring ring_;
  std::vector<double> places_, weights_, distance_;
  std::vector<Channel> channels_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  const auto size = [](const char* name, const char* doc) { return Option::quantity(name, "mm", 0, doc); };
  return {
      "ring",
      "A ring of a tube that two pins pull apart: two straight legs and two halves of a circle.",
      "Mahutga, Schoephoerster, Barocas, Exp. Mech. 61:53 (2021)",
      {size("inner_radius", "Inner radius of the unloaded ring."),
       size("thickness", "Thickness of its wall, unloaded."),
       size("width", "Width of the unloaded ring, along the axis of the tube."), size("pin_radius", "Radius of a pin."),
       Option::choice(
           "wall", {"centreline", "straightened"}, "centreline",
           "Whether all layers stretch as the centreline does, or the inner ones more, as where a curved wall "
           "is straightened.")},
      {{"pin_distance", "mm", Role::abscissa, true, "Distance of the pins, from centre to centre.", Kind::plain},
       {"force", "mN", Role::channel, false, "Force on a pin, borne by both legs.", Kind::plain},
       {"stretch", "1", Role::channel, false, "Stretch of the centreline, as marks on a leg show it.", Kind::stretch}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<RingPull>(setup); },
      {}};
}

}  // namespace
}  // namespace tunica::ring

TUNICA_PLUGIN("ring", TUNICA_PLUGIN_VERSION) { registry.add(tunica::ring::factory()); }
