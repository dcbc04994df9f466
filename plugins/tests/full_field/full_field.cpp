// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "equilibrium.hpp"
#include "settings.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/plugin.hpp"

namespace tunica::field {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;

/// A sheet whose displacements were measured at many points, by finite elements between its measured edges. A row is a
/// point of a step, or has the forces of a step.
class FullField final : public Test {
 public:
  explicit FullField(const TestSetup& setup)
      : edges_(edges_of(setup.options)),
        specimen_(mesh_of(setup), held(edges_)),
        thickness_(setup.options.number("thickness")),
        plane_strain_(setup.options.text("state") == "plane_strain") {
    if (!(thickness_ > 0))
      throw InputError(fmt::format("full_field: \"thickness\" is {:g} mm; give one above 0", thickness_));
    const double turn = setup.options.number("material_angle") * std::numbers::pi / 180;
    along_ = {std::cos(turn), -std::sin(turn)};
    bind(setup);
    find_points();
    prescribe(setup);
    description_.costly = true;
    description_.volume = plane_strain_ ? TestDescription::Volume::free : TestDescription::Volume::either;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (input.model.describe().history_size > 0)
      return Status::failed(
          "full_field: the model remembers its history, and steps are simulated at equilibrium; choose a model without "
          "history");
    if (!input.abscissae.empty())
      return Status::failed("full_field: points are where they were measured; take mechanisms out that move them");
    if (plane_strain_) return simulate(input, output, specimen_, steps_, plane::Faces::held);
    return free_faces::by_volume(
        input, output,
        [this](const TestInput& at, const TestOutput& out) {
          return simulate(at, out, specimen_, steps_, plane::Faces::incompressible);
        },
        [this](const TestInput& at, const TestOutput& out) {
          return simulate(at, out, specimen_, steps_, plane::Faces::free);
        });
  }

 private:
  struct Row {
    std::size_t step = 0;
    bool is_point = false;
    std::size_t point = 0;  ///< in places_
  };
  struct Step {
    double value = 0;
    std::vector<double> prescribed;  ///< by dof
    std::vector<std::size_t> rows;
  };
  enum class Channel { ux, uy, left, right, bottom, top };
  static constexpr std::array<const char*, 6> channel_names{"ux",          "uy",           "force_left",
                                                            "force_right", "force_bottom", "force_top"};

  static std::array<std::array<bool, 2>, 4> held(const Edges& edges) {
    std::array<std::array<bool, 2>, 4> is{};
    for (std::size_t side = 0; side < 4; ++side)
      for (std::size_t c = 0; c < 2; ++c) is[side][c] = edges[side][c] != Edge::free;
    return is;
  }

  void bind(const TestSetup& setup) {
    for (const auto& column : setup.rows.abscissae)
      for (std::size_t k = 0; k < 3; ++k)
        if (column.observable == std::array{"step", "x", "y"}[k])
          abscissae_[k].assign(column.values.begin(), column.values.end());
    const std::size_t n = setup.rows.count;
    const auto& [step, x, y] = abscissae_;
    if (x.empty() || y.empty())
      throw InputError(
          "full_field: no columns are mapped to 'x' and 'y', where the points are before loading; map them");
    rows_.count = n;
    for (const auto& column : setup.rows.abscissae) {
      rows_.abscissae.push_back(column);
      rows_.abscissae.back().values = abscissae_[column.observable == "step" ? 0 : column.observable == "x" ? 1 : 2];
    }
    rows_.channels = setup.rows.channels;
    for (const std::string& name : rows_.channels)
      channels_.push_back(
          static_cast<Channel>(std::find(channel_names.begin(), channel_names.end(), name) - channel_names.begin()));
    std::map<double, std::size_t> number;
    for (const double value : step) {
      if (!std::isfinite(value)) throw InputError("full_field: a row has no step; give every row its step");
      number.emplace(value, 0);
    }
    for (auto& [value, index] : number) {
      index = steps_.size();
      steps_.push_back({value, {}, {}});
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (std::isfinite(x[i]) != std::isfinite(y[i]))
        throw InputError(fmt::format("full_field: row {} has one of x and y; give both, or none for forces", i + 1));
      which_.push_back({number.at(step[i]), std::isfinite(x[i]), 0});
      steps_[which_.back().step].rows.push_back(i);
    }
  }

  void find_points() {
    std::map<Vector, std::size_t> known;
    std::size_t outside = 0, points = 0;
    Vector first{};
    for (std::size_t i = 0; i < rows_.count; ++i) {
      if (!which_[i].is_point) continue;
      ++points;
      const Vector point{abscissae_[1][i], abscissae_[2][i]};
      const auto [found, is_new] = known.emplace(point, places_.size());
      if (is_new) {
        const auto place = specimen_.find(point);
        if (!place && outside++ == 0) first = point;
        places_.push_back(place.value_or(Place{}));
      }
      which_[i].point = found->second;
    }
    if (points == 0) throw InputError("full_field: no row has a point; map 'x' and 'y' of the measured field");
    if (outside > 0)
      throw InputError(fmt::format(
          "full_field: {} of {} points lie outside of the specimen, the first at ({:g}, {:g}) mm, which reaches from "
          "({:g}, {:g}) to ({:g}, {:g}) mm; leave them out with \"where\", or correct the mesh or its unit",
          outside, places_.size(), first[0], first[1], corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)));
  }

  [[nodiscard]] double corner(std::size_t axis, std::size_t end) const {
    return specimen_.mesh().nodes[specimen_.nodes_on(2 * axis + end).front()][axis];
  }

  void prescribe(const TestSetup& setup) {
    std::array<std::span<const double>, 2> measured;
    for (std::size_t k = 0; k < channels_.size() && k < setup.measured.size(); ++k)
      if (channels_[k] == Channel::ux || channels_[k] == Channel::uy)
        measured[channels_[k] == Channel::ux ? 0 : 1] = setup.measured[k];
    for (std::size_t c = 0; c < 2; ++c)
      for (const auto& side : edges_)
        if ((side[c] == Edge::uniform || side[c] == Edge::measured) && measured[c].empty())
          throw InputError(
              fmt::format("full_field: a side moves as measured in {0}, and no column is mapped to 'u{0}'; "
                          "map it",
                          c == 0 ? "x" : "y"));
    const auto degree = static_cast<std::size_t>(setup.options.integer("smoothing"));
    for (Step& step : steps_) {
      Frame frame;
      for (const std::size_t i : step.rows) {
        if (!which_[i].is_point) continue;
        frame.points.push_back({abscissae_[1][i], abscissae_[2][i]});
        for (std::size_t c = 0; c < 2; ++c)
          frame.displacements[c].push_back(measured[c].empty() ? std::nan("") : measured[c][i]);
      }
      if (frame.points.empty())
        throw InputError(fmt::format("full_field: step {:g} has forces and no points; leave it out", step.value));
      step.prescribed = field::prescribed(specimen_, edges_, frame, degree);
    }
  }

  Status simulate(const TestInput& input, const TestOutput& output, const Specimen& on, const std::vector<Step>& steps,
                  plane::Faces faces) const {
    const bool wants_parameters = !output.jacobian.empty();
    if (wants_parameters && !input.model.describe().parameter_derivatives)
      return Status::failed("full_field: the model has no parameter derivatives; difference the whole prediction");
    Equilibrium body(on, input.model, input.model_parameters, along_, faces);
    const std::size_t size = rows_.count * channels_.size();
    std::fill(output.values.begin(), output.values.end(), 0.0);
    std::fill(output.jacobian.begin(), output.jacobian.end(), 0.0);
    std::fill(output.abscissa_derivative.begin(), output.abscissa_derivative.end(), 0.0);
    std::vector<double> du, df;
    for (const Step& step : steps) {
      if (auto problem = body.move_to(step.prescribed))
        return Status::failed(fmt::format("full_field: step {:g}: {}", step.value, *problem));
      if (!output.values.empty()) read(on, step, body.displacements(), body.forces(), output.values);
      if (!wants_parameters) continue;
      if (!body.linearise())
        return Status::failed(
            fmt::format("full_field: step {:g}: the stiffness is singular; narrow the bounds of the model's parameters",
                        step.value));
      for (std::size_t j = 0; j < input.model_parameters.size(); ++j) {
        body.by_parameter(j, du, df);
        read(on, step, du, df, output.jacobian.subspan(j * size, size));
      }
    }
    return {};
  }

  /// What the channels read off displacements and nodal forces, in the rows of a step.
  void read(const Specimen& on, const Step& step, const std::vector<double>& u, const std::vector<double>& f,
            std::span<double> values) const {
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const auto channel = static_cast<std::size_t>(channels_[k]);
      const bool is_force = channel >= 2;
      double force = 0;
      for (std::size_t side = channel - 2; is_force && side == channel - 2; ++side) {
        for (const std::size_t a : on.nodes_on(side)) force += f[2 * a + axis_of(side)];
        force *= outwards(side) * thickness_;
      }
      for (const std::size_t i : step.rows) {
        double& value = values[k * rows_.count + i];
        if (is_force) value = force;
        if (is_force || !which_[i].is_point) continue;
        const Place& place = places_[which_[i].point];
        value = 0;
        for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[2 * place.nodes[a] + channel];
      }
    }
  }

  Edges edges_;
  Specimen specimen_;
  double thickness_;
  bool plane_strain_;
  std::array<double, 2> along_{};
  std::array<std::vector<double>, 3> abscissae_;  ///< step, x, y
  std::vector<Channel> channels_;
  std::vector<Step> steps_;
  std::vector<Row> which_;
  std::vector<Place> places_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  const auto force = [](const char* name, const char* side) {
    return Observable{name, "mN", Role::channel, false,
                      fmt::format("Force on the {} side along its normal, positive in tension.", side)};
  };
  return {
      "full_field",
      "A sheet whose displacements were measured at many points, as by image correlation: finite elements between "
      "its measured edges.",
      "Avril et al., Comput. Mech. 42:381 (2008)",
      {Option::quantity("thickness", "mm", 0, "Unloaded thickness."),
       Option::json("mesh", {}, R"({"file": "plate.msh", "unit": "mm"} or {"size": "0.7 mm"} beside a shape.)"),
       Option::json("shape", "null",
                    R"({"rectangle": [width, height], "corner": [x, y], "holes": [{"centre", "radius"}]}.)"),
       Option::json("boundary", {},
                    R"({"left", "right", "bottom", "top"}: free, fixed, uniform or measured, or {"x", "y"} of them.)"),
       Option::choice("state", {"plane_stress", "plane_strain"}, "plane_stress",
                      "Whether the faces are free or held through the thickness."),
       Option::quantity("material_angle", "deg", -360,
                        "From x counter-clockwise to the circumferential axis of the material.", 0.0),
       Option::integer("smoothing", 4, {0, 20}, "Degree of the polynomial along a measured side.")},
      {{"step", "1", Role::abscissa, true, "Number of the frame, or any number that grows."},
       {"x", "mm", Role::abscissa, false, "Place of the point before loading."},
       {"y", "mm", Role::abscissa, false, "Place of the point before loading."},
       {"ux", "mm", Role::channel, false, "Displacement of the point along x."},
       {"uy", "mm", Role::channel, false, "Displacement of the point along y."},
       force("force_left", "left"),
       force("force_right", "right"),
       force("force_bottom", "bottom"),
       force("force_top", "top")},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<FullField>(setup); },
      {}};
}

}  // namespace
}  // namespace tunica::field

TUNICA_PLUGIN("full_field", TUNICA_PLUGIN_VERSION) { registry.add(tunica::field::factory()); }
