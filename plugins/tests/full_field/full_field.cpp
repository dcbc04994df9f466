// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "edge_fit.hpp"
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
        smoothing_(static_cast<std::size_t>(setup.options.integer("smoothing"))),
        thickness_(setup.options.number("thickness")),
        plane_strain_(setup.options.text("state") == "plane_strain") {
    if (!(thickness_ > 0))
      throw InputError(fmt::format("full_field: \"thickness\" is {:g} mm; give one above 0", thickness_));
    const double turn = setup.options.number("material_angle") * std::numbers::pi / 180;
    along_ = {std::cos(turn), -std::sin(turn)};
    bind(setup);
    take_frames(setup);
    mesh_ = meshed(mesh_of(setup));
    if (setup.options.text("unseen_sides") == "refuse") refuse_unseen_sides();
    for (const Channel channel : channels_) refuse_force(static_cast<std::size_t>(channel));
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
    if (!input.abscissae.empty() || !output.abscissa_derivative.empty())
      return Status::failed("full_field: points are where they were measured; take mechanisms out that move them");
    return on_mesh(input, output, *mesh_);
  }

  /// With each triangle in four.
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    const std::size_t n = rows_.count, m = channels_.size();
    std::vector<double> coarse(n * m), fine(n * m);
    if (Status status = on_mesh(input, {coarse, {}, {}, {}}, *mesh_); !status.ok()) return status;
    if (Status status = on_mesh(input, {fine, {}, {}, {}}, *meshed(refined(mesh_->specimen.mesh()))); !status.ok())
      return status;
    std::vector<double> shift(n * m);
    for (std::size_t i = 0; i < n * m; ++i) shift[i] = fine[i] - coarse[i];
    for (std::size_t k = 0; k < m; ++k) {
      const auto largest = [&](const std::vector<double>& of) {
        double most = 0;
        for (std::size_t i = k * n; i < (k + 1) * n; ++i) most = std::max(most, std::abs(of[i]));
        return most;
      };
      const bool force = channels_[k] != Channel::ux && channels_[k] != Channel::uy;
      found.push_back({fmt::format("each triangle in four: {}", rows_.channels[k]), largest(shift), force ? "mN" : "mm",
                       0.005 * largest(fine), k == 0 ? shift : std::vector<double>()});
    }
    return {};
  }

 private:
  struct Row {
    std::size_t step = 0;
    bool is_point = false;
    std::size_t point = 0;  ///< in points_
  };
  struct Step {
    double value = 0;
    std::vector<std::size_t> rows;
    Frame frame;
  };
  /// A mesh, and what the measured field is on it.
  struct Meshed {
    Specimen specimen;
    std::vector<std::vector<double>> prescribed;  ///< a step, by dof: where the edges begin
    std::vector<Mode> modes;                      ///< in which they may move
    std::vector<Place> places;                    ///< of points_
  };
  enum class Channel { ux, uy, left, right, bottom, top };
  static constexpr std::array<const char*, 6> channel_names{"ux",          "uy",           "force_left",
                                                            "force_right", "force_bottom", "force_top"};

  [[nodiscard]] static std::array<std::array<bool, 2>, 4> held(const Edges& edges) {
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

  /// A mesh that reaches beyond the points takes the load of what may not be there.
  void refuse_unseen_sides() const {
    const Specimen& specimen = mesh_->specimen;
    for (const Step& step : steps_) {
      const double spacing = std::sqrt(specimen.area() / static_cast<double>(step.frame.points.size()));
      for (std::size_t side = 0; side < 4; ++side) {
        const double gap = specimen.gap(side, step.frame.points);
        if (gap > most_spacings * spacing)
          throw InputError(
              fmt::format("full_field: step {:g}: the mesh reaches {:.3g} mm beyond the points on the {} side, and "
                          "points are {:.3g} mm "
                          "apart; give a shape that ends where the specimen does, or write \"unseen_sides\": "
                          "\"accept\" where it does",
                          step.value, gap, side_names[side], spacing));
      }
    }
  }

  /// A free side bears no force. A node where two sides meet that are both held bears what belongs to either: no one
  /// can part it.
  void refuse_force(std::size_t channel) const {
    if (channel < 2) return;
    const std::size_t side = channel - 2, axis = axis_of(side);
    if (edges_[side][axis] == Edge::free)
      throw InputError(
          fmt::format("full_field: '{}' is mapped, and the {} side is free in {}, so that it bears none; say "
                      "in \"boundary\" how it moves, or take the force out",
                      channel_names[channel], side_names[side], axis == 0 ? "x" : "y"));
    for (std::size_t other = 2 * (1 - axis); other < 2 * (1 - axis) + 2; ++other) {
      if (edges_[other][axis] == Edge::free) continue;
      for (const std::size_t node : mesh_->specimen.nodes_on(side))
        if (std::ranges::find(mesh_->specimen.nodes_on(other), node) != mesh_->specimen.nodes_on(other).end())
          throw InputError(fmt::format(
              "full_field: '{}' is mapped, and the {} side, which meets the {} one in a corner, is held in {} "
              "too; free it there, or take the force out",
              channel_names[channel], side_names[other], side_names[side], axis == 0 ? "x" : "y"));
    }
  }

  /// The points of each step and what was measured there.
  void take_frames(const TestSetup& setup) {
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
    std::map<Vector, std::size_t> known;
    for (Step& step : steps_) {
      for (const std::size_t i : step.rows) {
        if (!which_[i].is_point) continue;
        const Vector point{abscissae_[1][i], abscissae_[2][i]};
        const auto [found, is_new] = known.emplace(point, points_.size());
        if (is_new) points_.push_back(point);
        which_[i].point = found->second;
        step.frame.points.push_back(point);
        for (std::size_t c = 0; c < 2; ++c)
          step.frame.displacements[c].push_back(measured[c].empty() ? std::nan("") : measured[c][i]);
      }
      if (step.frame.points.empty())
        throw InputError(fmt::format("full_field: step {:g} has forces and no points; leave it out", step.value));
    }
  }

  [[nodiscard]] std::shared_ptr<const Meshed> meshed(Mesh mesh) const {
    auto made = std::make_shared<Meshed>(Meshed{Specimen(std::move(mesh), held(edges_)), {}, {}, {}});
    std::size_t outside = 0;
    Vector first{};
    for (const Vector& point : points_) {
      const auto place = made->specimen.find(point);
      if (!place && outside++ == 0) first = point;
      made->places.push_back(place.value_or(Place{}));
    }
    if (outside > 0) {
      const auto corner = [&](std::size_t axis, std::size_t end) {
        return made->specimen.mesh().nodes[made->specimen.nodes_on(2 * axis + end).front()][axis];
      };
      throw InputError(fmt::format(
          "full_field: {} of {} points lie outside of the specimen, the first at ({:g}, {:g}) mm, which reaches from "
          "({:g}, {:g}) to ({:g}, {:g}) mm; leave them out with \"where\", or correct the mesh or its unit",
          outside, points_.size(), first[0], first[1], corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)));
    }
    for (const Step& step : steps_)
      made->prescribed.push_back(beginning(made->specimen, edges_, step.frame, std::min(smoothing_, most_to_begin)));
    made->modes = modes(made->specimen, edges_, smoothing_);
    return made;
  }

  Status on_mesh(const TestInput& input, const TestOutput& output, const Meshed& on) const {
    if (plane_strain_) return simulate(input, output, on, plane::Faces::held);
    return free_faces::by_volume(
        input, output,
        [&](const TestInput& at, const TestOutput& out) { return simulate(at, out, on, plane::Faces::incompressible); },
        [&](const TestInput& at, const TestOutput& out) { return simulate(at, out, on, plane::Faces::free); });
  }

  Status simulate(const TestInput& input, const TestOutput& output, const Meshed& on, plane::Faces faces) const {
    const bool wants_parameters = !output.jacobian.empty();
    if (wants_parameters && !input.model.describe().parameter_derivatives)
      return Status::failed("full_field: the model has no parameter derivatives; difference the whole prediction");
    Equilibrium body(on.specimen, input.model, input.model_parameters, along_, faces);
    const std::size_t size = rows_.count * channels_.size();
    std::fill(output.values.begin(), output.values.end(), 0.0);
    std::fill(output.jacobian.begin(), output.jacobian.end(), 0.0);
    std::vector<double> du, df;
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const Step& step = steps_[k];
      EdgeFit edges(on.modes, [&](const std::vector<double>& u) { return at_points(on, step, u); });
      if (auto problem = settle(body, edges, on, k)) return Status::failed(step_name(step) + *problem);
      if (!output.values.empty()) read(on, step, body.displacements(), body.forces(), output.values);
      if (!wants_parameters) continue;
      if (!body.linearise(true)) return Status::failed(step_name(step) + singular);
      edges.linearise(body);
      for (std::size_t j = 0; j < input.model_parameters.size(); ++j) {
        body.by_parameter(j, du, df);
        edges.follow(du, df);
        read(on, step, du, df, output.jacobian.subspan(j * size, size));
      }
    }
    return {};
  }

  [[nodiscard]] static std::string step_name(const Step& step) {
    return fmt::format("full_field: step {:g}: ", step.value);
  }
  static constexpr double most_spacings = 1.5;     ///< from a side to the nearest point
  static constexpr std::size_t most_to_begin = 3;  ///< degree of the edges before they are fitted
  static constexpr const char* singular = "the stiffness is singular; narrow the bounds of the model's parameters";

  /// Moves to a step and fits its edges to the points: a chord method, whose steps shrink by the bend of the response.
  std::optional<std::string> settle(Equilibrium& body, EdgeFit& edges, const Meshed& on, std::size_t k) const {
    constexpr int rounds = 4, chords = 6;
    const double small = 1e-9 * std::max(on.specimen.extent(0), on.specimen.extent(1));
    const Eigen::VectorXd measured = measured_at_points(steps_[k]);
    std::vector<double> prescribed = on.prescribed[k];
    if (auto problem = body.move_to(prescribed)) return problem;
    for (int round = 0; round < rounds; ++round) {
      if (!body.linearise(false)) return singular;
      edges.linearise(body);
      for (int chord = 0; chord < chords; ++chord) {
        const Eigen::VectorXd change = edges.solve(measured - at_points(on, steps_[k], body.displacements()));
        if (!change.allFinite()) return "the edges do not follow from the points; give a smaller \"smoothing\"";
        edges.add(change, prescribed);
        if (auto problem = body.move_to(prescribed)) return problem;
        if (change.lpNorm<Eigen::Infinity>() < small) return {};
      }
    }
    return "the edges that fit the points best were not found; narrow the bounds of the model's parameters";
  }

  /// Displacements where they were measured, x before y.
  [[nodiscard]] Eigen::VectorXd at_points(const Meshed& on, const Step& step, const std::vector<double>& u) const {
    std::vector<double> values;
    for (std::size_t c = 0; c < 2; ++c) {
      std::size_t at = 0;
      for (const std::size_t i : step.rows) {
        if (!which_[i].is_point || !std::isfinite(step.frame.displacements[c][at++])) continue;
        const Place& place = on.places[which_[i].point];
        double& value = values.emplace_back(0);
        for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[2 * place.nodes[a] + c];
      }
    }
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  [[nodiscard]] static Eigen::VectorXd measured_at_points(const Step& step) {
    std::vector<double> values;
    for (const auto& component : step.frame.displacements)
      for (const double value : component)
        if (std::isfinite(value)) values.push_back(value);
    return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  /// What the channels read off displacements and nodal forces, in the rows of a step.
  void read(const Meshed& on, const Step& step, const std::vector<double>& u, const std::vector<double>& f,
            std::span<double> values) const {
    for (std::size_t k = 0; k < channels_.size(); ++k) {
      const auto channel = static_cast<std::size_t>(channels_[k]);
      const bool is_force = channel >= 2;
      double force = 0;
      for (std::size_t side = channel - 2; is_force && side == channel - 2; ++side) {
        for (const std::size_t a : on.specimen.nodes_on(side)) force += f[2 * a + axis_of(side)];
        force *= outwards(side) * thickness_;
      }
      for (const std::size_t i : step.rows) {
        double& value = values[k * rows_.count + i];
        if (is_force) value = force;
        if (is_force || !which_[i].is_point) continue;
        const Place& place = on.places[which_[i].point];
        value = 0;
        for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[2 * place.nodes[a] + channel];
      }
    }
  }

  Edges edges_;
  std::size_t smoothing_;
  double thickness_;
  bool plane_strain_;
  std::array<double, 2> along_{};
  std::array<std::vector<double>, 3> abscissae_;  ///< step, x, y
  std::vector<Channel> channels_;
  std::vector<Step> steps_;
  std::vector<Row> which_;
  std::vector<Vector> points_;
  std::shared_ptr<const Meshed> mesh_;
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
       Option::choice("unseen_sides", {"refuse", "accept"}, "refuse",
                      "What to do where a side lies more than 1.5 spacings from the nearest point."),
       Option::integer("smoothing", 6, {0, 20}, "Degree of the polynomial along a measured side.")},
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
