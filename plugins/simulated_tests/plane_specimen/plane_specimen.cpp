// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numbers>

#include <fmt/format.h>

#include "pulling.hpp"
#include "settings.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"

namespace tunica::plane {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;
/// A thin specimen of any outline between two grips, in plane stress. A quarter is enough where neither the angle nor
/// the material tells left from right; else the whole is simulated.
class PlaneSpecimen final : public Test {
 public:
  explicit PlaneSpecimen(const TestSetup& setup) : shape_(shape_of(setup.options)) {
    const Options& given = setup.options;
    elements_ = elements_of(given.text("elements"), shape_);
    ends_ = given.text("ends") == "sliding" ? Ends::sliding : Ends::clamped;
    const double turn = given.number("angle") * std::numbers::pi / 180;
    // x along the named axis, turned from axial towards circumferential; t and z components.
    along_ = given.text("direction") == "circumferential" ? std::array{std::cos(turn), -std::sin(turn)}
                                                          : std::array{std::sin(turn), std::cos(turn)};
    angled_ = std::abs(std::sin(2 * turn)) > 1e-12;
    bind(setup);
    description_.diagnostics = {"grip_stretch", "largest_stretch"};
    description_.diagnostic_units = {"1", "1"};
    description_.costly = true;
    description_.volume = TestDescription::Volume::either;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (Status status = detail::elastic_only("plane_specimen", input, output); !status.ok()) return status;
    return free_faces::by_volume(
        input, output,
        [this](const TestInput& at, const TestOutput& out) { return pull(at, out, *body(at, false), false); },
        [this](const TestInput& at, const TestOutput& out) { return pull(at, out, *body(at, true), true); });
  }

  /// With twice as many elements along and across.
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    const std::size_t n = rows_.count, m = gauges_.size();
    std::vector<double> coarse(n * m), fine(n * m);
    const bool changing = changes(input);
    const TestInput at = changing ? input : free_faces::without_compressibility(input);
    const auto used = body(at, changing);
    const Body finer(shape_, mesh_of(shape_, 2 * elements_[0], 2 * elements_[1], used->mesh().quarter), ends_);
    if (Status status = pull(at, {coarse, {}, {}, {}}, *used, changing); !status.ok()) return status;
    if (Status status = pull(at, {fine, {}, {}, {}}, finer, changing); !status.ok()) return status;
    for (std::size_t k = 0; k < m; ++k) {
      double difference = 0, largest = 0;
      for (std::size_t i = 0; i < n; ++i) {
        difference = std::max(difference, std::abs(coarse[k * n + i] - fine[k * n + i]));
        largest = std::max(largest, std::abs(fine[k * n + i]));
      }
      const bool stress = gauges_[k].kind == Gauge::Kind::stress;
      found.push_back({fmt::format("twice as many elements: {}", rows_.channels[k]), difference, stress ? "kPa" : "1",
                       0.005 * largest, std::vector<double>(n * m)});
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) found.back().shift[i] = fine[i] - coarse[i];
    }
    return {};
  }

  Status snapshots(const TestInput& input, std::span<const std::size_t> wanted,
                   std::vector<Snapshot>& found) const override {
    const Body body(shape_, mesh_of(shape_, elements_[0], elements_[1], false), ends_);
    const TestInput at = changes(input) ? input : free_faces::without_compressibility(input);
    Pulling pulling(body, at.model, at.model_parameters, along_, changes(input));
    const Gauge driver = gauge_of(body, Gauge::Kind::stretch);
    for (std::size_t i = 0; i < rows_.count; ++i) {
      if (auto problem = go_to(pulling, x_[i], driver)) return Status::failed(row_name(i, x_[i]) + *problem);
      if (std::find(wanted.begin(), wanted.end(), i) == wanted.end()) continue;
      found.push_back(snapshot(body, pulling, i));
    }
    return {};
  }

 private:
  void bind(const TestSetup& setup) {
    for (const auto& column : setup.rows.abscissae) {
      x_.assign(column.values.begin(), column.values.end());
      by_gauge_ = column.observable == "gauge_stretch";
      rows_.abscissae = {column};
    }
    if (setup.rows.abscissae.size() > 1)
      throw InputError(
          "plane_specimen: both 'stretch', of the grips, and 'gauge_stretch', of the marks, are mapped; keep one of "
          "them, and "
          "map the other to 'mark_stretch' where it is the marks'");
    if (x_.empty())
      throw InputError(
          "plane_specimen: no column is mapped to 'stretch', of the grips, or 'gauge_stretch', of the marks; map one "
          "in "
          "\"columns\"");
    for (std::size_t i = 0; i < x_.size(); ++i)
      if (!(x_[i] > 0 && std::isfinite(x_[i])))
        throw InputError("plane_specimen: row " + std::to_string(i + 1) + " has stretch " + std::to_string(x_[i]) +
                         "; a stretch is positive");
    rows_.abscissae.front().values = x_;
    rows_.count = x_.size();
    rows_.channels = setup.rows.channels;
    marks_along_ = setup.options.number("marks_along");
    marks_across_ = setup.options.number("marks_across");
    for (const std::string& name : rows_.channels)
      kinds_.push_back(name == "stress"         ? Gauge::Kind::stress
                       : name == "mark_stretch" ? Gauge::Kind::stretch
                                                : Gauge::Kind::transverse_stretch);
    const auto has = [&](Gauge::Kind kind) { return std::find(kinds_.begin(), kinds_.end(), kind) != kinds_.end(); };
    if (has(Gauge::Kind::stress) && setup.stress_measure != "first_piola_kirchhoff")
      throw InputError(
          fmt::format("plane_specimen: \"stress_measure\" is '{}', and stress is the force over the unloaded section "
                      "at the grips; give "
                      "\"first_piola_kirchhoff\"",
                      setup.stress_measure));
    check_marks(by_gauge_ || has(Gauge::Kind::stretch), "marks_along", marks_along_, {marks_along_ / 2, 0});
    check_marks(has(Gauge::Kind::transverse_stretch), "marks_across", marks_across_, {0, marks_across_ / 2});
    const Body body(shape_, mesh_of(shape_, elements_[0], elements_[1], true), ends_);
    for (const Gauge::Kind kind : kinds_) gauges_.push_back(gauge_of(body, kind));
  }

  void check_marks(bool used, const char* name, double size, Vector mark) const {
    if (!used) return;
    if (!(size > 0))
      throw InputError(fmt::format(
          "plane_specimen: \"{}\" is 0; give the distance of the marks on the unloaded specimen, for example \"5 mm\"",
          name));
    const Body body(shape_, mesh_of(shape_, elements_[0], elements_[1], true), ends_);
    if (body.displacement(mark, 0).empty())
      throw InputError(fmt::format(
          "plane_specimen: marks {:g} mm apart (\"{}\") are not on the specimen; give a distance that is", size, name));
  }

  [[nodiscard]] Gauge gauge_of(const Body& body, Gauge::Kind kind) const {
    Gauge gauge;
    gauge.kind = kind;
    gauge.area = shape_.width;
    if (kind == Gauge::Kind::stress) return gauge;
    const std::size_t axis = kind == Gauge::Kind::stretch ? 0 : 1;
    const double size = axis == 0 ? marks_along_ : marks_across_;
    if (!(size > 0)) return gauge;
    for (const double sign : {1.0, -1.0}) {
      Vector mark{0, 0};
      mark[axis] = sign * size / 2;
      for (const auto& [dof, weight] : body.displacement(mark, axis))
        gauge.reading.emplace_back(dof, sign * weight / size);
    }
    return gauge;
  }

  std::optional<std::string> go_to(Pulling& pulling, double x, const Gauge& driver) const {
    return by_gauge_ ? pulling.move_to(x, &driver) : pulling.move_to((x - 1) * shape_.length, nullptr);
  }

  [[nodiscard]] static bool changes(const TestInput& input) {
    return input.model.describe().compressible && !input.model.keeps_volume(input.model_parameters);
  }

  /// Whether this material bears no shear where it is stretched along x and y, within and beyond the stretches of the
  /// rows, so that a quarter stands for the whole.
  [[nodiscard]] bool is_symmetric(const TestInput& input, bool changing) const {
    if (angled_) return false;
    const auto [least, largest] = std::minmax_element(x_.begin(), x_.end());
    std::vector<std::array<double, 2>> states;
    for (const double x : {*least, *largest, 1 + 0.5 * (*largest - 1), 1 + 1.5 * (*largest - 1), 0.97, 1.08})
      for (const double power : {0.0, 0.5, 1.0}) states.push_back({x, std::pow(x, -power)});
    Membrane membrane(input.model, input.model_parameters, along_, changing ? Faces::free : Faces::incompressible);
    const std::size_t n = states.size();
    membrane.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t a = 0; a < 2; ++a) membrane.C[a * n + i] = states[i][a] * states[i][a];
    if (!membrane.evaluate(false, false)) return false;
    for (std::size_t i = 0; i < n; ++i) {
      const double normal = std::abs(membrane.stress[i]) + std::abs(membrane.stress[n + i]);
      if (std::abs(membrane.stress[2 * n + i]) > 1e-10 * normal) return false;
    }
    return true;
  }

  /// The mesh, whole or a quarter of it, made once.
  [[nodiscard]] std::shared_ptr<const Body> body(const TestInput& input, bool changing) const {
    const bool quarter = is_symmetric(input, changing);
    const std::lock_guard lock(mutex_);
    std::shared_ptr<const Body>& made = bodies_[quarter ? 1 : 0];
    if (made == nullptr)
      made = std::make_shared<const Body>(shape_, mesh_of(shape_, elements_[0], elements_[1], quarter), ends_);
    return made;
  }

  Status pull(const TestInput& input, const TestOutput& output, const Body& on, bool changing) const {
    const bool wants_parameters = !output.jacobian.empty();
    Pulling pulling(on, input.model, input.model_parameters, along_, changing);
    const Gauge driver = gauge_of(on, Gauge::Kind::stretch);
    std::vector<Gauge> gauges;
    for (const Gauge::Kind kind : kinds_) gauges.push_back(gauge_of(on, kind));
    const std::span<const double> x = input.abscissae.empty() ? std::span<const double>(x_) : input.abscissae[0];
    const std::size_t n = rows_.count, size = n * gauges.size(), parameters = input.model_parameters.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (auto problem = go_to(pulling, x[i], driver)) return Status::failed(row_name(i, x[i]) + *problem);
      for (std::size_t k = 0; k < gauges.size() && !output.values.empty(); ++k) {
        const double value = pulling.value(gauges[k]);
        if (!std::isfinite(value))
          return Status::failed(row_name(i, x[i]) +
                                "the stress overflows; narrow the bounds of the model's parameters");
        output.values[k * n + i] = value;
      }
      if (!output.diagnostics.empty()) {
        output.diagnostics[i] = 1 + pulling.pull() / shape_.length;
        output.diagnostics[n + i] = largest_stretch(pulling);
      }
      if (!wants_parameters && output.abscissa_derivative.empty()) continue;
      if (!pulling.linearise(wants_parameters, by_gauge_ ? &driver : nullptr))
        return Status::failed(row_name(i, x[i]) +
                              "the stiffness is singular; narrow the bounds of the model's parameters");
      for (std::size_t k = 0; k < gauges.size(); ++k) {
        if (!output.abscissa_derivative.empty())
          output.abscissa_derivative[k * n + i] = pulling.by_target(gauges[k]) * (by_gauge_ ? 1 : shape_.length);
        for (std::size_t j = 0; wants_parameters && j < parameters; ++j)
          output.jacobian[j * size + k * n + i] = pulling.by_parameter(gauges[k], j);
      }
    }
    return {};
  }

  static double largest_stretch(const Pulling& pulling) {
    double largest = 0;
    for (const auto& [xx, xy, yx, yy] : pulling.gradients()) {
      const double a = xx * xx + yx * yx, b = xy * xy + yy * yy, c = xx * xy + yx * yy;
      largest = std::max(largest, 0.5 * (a + b) + std::hypot(0.5 * (a - b), c));
    }
    return std::sqrt(largest);
  }

  /// Corners of elements, split into four cells each; Cauchy stress from the nearest Gauss point.
  Snapshot snapshot(const Body& body, const Pulling& pulling, std::size_t row) const {
    Snapshot shot;
    shot.row = row;
    const Mesh& mesh = body.mesh();
    const std::size_t points = body.points();
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      shot.points.insert(shot.points.end(), {mesh.nodes[a][0] + pulling.displacements()[2 * a],
                                             mesh.nodes[a][1] + pulling.displacements()[2 * a + 1], 0.0});
    Snapshot::Field stress{"cauchy_stress", "kPa", 6, true, {}}, displacement{"displacement", "mm", 3, false, {}};
    for (std::size_t a = 0; a < mesh.nodes.size(); ++a)
      displacement.values.insert(displacement.values.end(),
                                 {pulling.displacements()[2 * a], pulling.displacements()[2 * a + 1], 0.0});
    for (std::size_t e = 0; e < mesh.elements.size(); ++e)
      for (std::size_t q = 0; q < 4; ++q) {
        const std::size_t a = q % 2, b = q / 2;
        const auto& node = mesh.elements[e];
        shot.cells.insert(shot.cells.end(),
                          {node[3 * b + a], node[3 * b + a + 1], node[3 * b + a + 4], node[3 * b + a + 3]});
        const std::size_t i = 9 * e + 6 * b + 2 * a;  // the Gauss point of this corner
        const auto [xx, xy, yx, yy] = pulling.gradients()[i];
        const Membrane& m = pulling.membrane();
        const double s0 = m.stress[i], s1 = m.stress[points + i], s2 = m.stress[2 * points + i],
                     J = (xx * yy - xy * yx) * std::sqrt(m.normal[i]);
        const double px = xx * s0 + xy * s2, py = xx * s2 + xy * s1, qx = yx * s0 + yy * s2, qy = yx * s2 + yy * s1;
        stress.values.insert(stress.values.end(), {(px * xx + py * xy) / J, (qx * yx + qy * yy) / J, 0.0,
                                                   (px * yx + py * yy) / J, 0.0, 0.0});
      }
    shot.fields = {std::move(displacement), std::move(stress)};
    return shot;
  }

  std::string row_name(std::size_t row, double x) const {
    return fmt::format("plane_specimen: row {} ({} {:g}): ", row + 1, by_gauge_ ? "gauge_stretch" : "stretch", x);
  }

  Shape shape_;
  std::array<std::size_t, 2> elements_{};
  Ends ends_ = Ends::clamped;
  std::array<double, 2> along_{};
  bool angled_ = false, by_gauge_ = false;
  double marks_along_ = 0, marks_across_ = 0;
  std::vector<double> x_;
  std::vector<Gauge::Kind> kinds_;
  std::vector<Gauge> gauges_;
  TestRows rows_;
  TestDescription description_;
  mutable std::mutex mutex_;
  mutable std::array<std::shared_ptr<const Body>, 2> bodies_;  ///< the whole, a quarter
};

TestFactory factory() {
  const auto length = [](const char* name, const char* doc) { return Option::quantity(name, "mm", 0, doc, 0.0); };
  return {"plane_specimen",
          "A thin strip, dog-bone or plate with a hole between two grips, by finite elements in plane stress.",
          "Bonet, Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008)",
          {Option::choice("shape", {"strip", "dog_bone", "plate_with_hole"}, "strip", "Outline of the specimen."),
           Option::quantity("length", "mm", 0, "Unloaded distance of the grips."),
           Option::quantity("width", "mm", 0, "Unloaded width at the grips."),
           length("gauge_section", "Length of the narrow part of a dog-bone."),
           length("gauge_width", "Width of the narrow part of a dog-bone."),
           length("fillet", "Radius of the arcs between the narrow part and the width at the grips."),
           length("hole_radius", "Radius of the hole in the centre of a plate."),
           length("marks_along", "Unloaded distance of two marks on the axis, the same from the centre."),
           length("marks_across", "Unloaded distance of two marks across the axis, the same from the centre."),
           Option::choice("direction", {"circumferential", "axial"}, "axial",
                          "Material axis that the specimen is pulled along."),
           Option::quantity("angle", "deg", -360,
                            "Turn of the specimen from that axis, from axial towards circumferential.", 0.0),
           Option::choice("ends", {"clamped", "sliding"}, "clamped",
                          "Whether the grips hold the width (clamped) or let it contract (sliding)."),
           Option::json(
               "elements", "null",
               "[along, across] over length and width, or over a quarter turn and the way from the hole to the edge; "
               "null chooses.")},
          {{"stretch", "1", Role::abscissa, false, "Distance of the grips over that unloaded.", Kind::stretch},
           {"gauge_stretch", "1", Role::abscissa, false,
            "Distance of the marks along the axis over that unloaded, in place of the "
            "stretch of the grips.",
            Kind::stretch},
           {"stress", "kPa", Role::channel, false, "Force over the unloaded section at the grips.", Kind::stress},
           {"mark_stretch", "1", Role::channel, false, "Distance of the marks along the axis over that unloaded.",
            Kind::stretch},
           {"mark_transverse_stretch", "1", Role::channel, false,
            "Distance of the marks across the axis over that unloaded.", Kind::stretch}},
          [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<PlaneSpecimen>(setup); },
          {}};
}

}  // namespace
}  // namespace tunica::plane

TUNICA_PLUGIN("plane_specimen", TUNICA_PLUGIN_VERSION) { registry.add(tunica::plane::factory()); }
