// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "equilibrium.hpp"
#include "imperfections.hpp"
#include "prepared.hpp"
#include "step_solver.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"

namespace tunica::field {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;

/// A sheet whose displacements were measured at many points, by finite elements between its measured edges.
class FullField final : public Test {
 public:
  explicit FullField(const TestSetup& setup)
      : thickness_(setup.options.number("thickness")),
        plane_strain_(setup.options.text("state") == "plane_strain"),
        modified_newton_(setup.options.text("method") == "modified_newton"),
        prepared_(prepared(setup)),
        flaws_(flaws_between(prepared_->edges)) {
    if (!(thickness_ > 0))
      throw InputError(fmt::format("full_field: \"thickness\" is {:g} mm; give one above 0", thickness_));
    const double turn = setup.options.number("material_angle") * std::numbers::pi / 180;
    along_ = {std::cos(turn), -std::sin(turn)};
    for (const FlawParameter& flaw : flaws_) description_.parameters.push_back(flaw.parameter);
    description_.nulls.assign(flaws_.size(), 0.0);
    description_.costly = !modified_newton_;
    description_.volume = plane_strain_ ? TestDescription::Volume::free : TestDescription::Volume::either;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return prepared_->rows.rows(); }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (Status status = detail::elastic_only("full_field", input, output); !status.ok()) return status;
    if (!input.abscissae.empty() || !output.abscissa_derivative.empty())
      return Status::failed("full_field: points are where they were measured; take mechanisms out that move them");
    return on_mesh(input, output, prepared_->mesh, modified_newton_);
  }

  /// In equilibrium, with each triangle in four.
  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    const std::size_t n = prepared_->rows.rows().count, m = prepared_->rows.channels().size();
    std::vector<double> coarse(n * m), fine(n * m);
    if (Status status = on_mesh(input, {coarse, {}, {}, {}}, prepared_->mesh, modified_newton_); !status.ok())
      return status;
    if (Status status = on_mesh(
            input, {fine, {}, {}, {}},
            Meshed(prepared_->rows, prepared_->edges, prepared_->smoothing, refined(prepared_->mesh.specimen().mesh())),
            false);
        !status.ok())
      return status;
    std::vector<double> shift(n * m);
    for (std::size_t i = 0; i < n * m; ++i) shift[i] = fine[i] - coarse[i];
    for (std::size_t k = 0; k < m; ++k) {
      const auto largest = [&](const std::vector<double>& of) {
        double most = 0;
        for (std::size_t i = k * n; i < (k + 1) * n; ++i) most = std::max(most, std::abs(of[i]));
        return most;
      };
      found.push_back({fmt::format("each triangle in four: {}", prepared_->rows.rows().channels[k]), largest(shift),
                       is_force(prepared_->rows.channels()[k]) ? "mN" : "mm", 0.005 * largest(fine),
                       k == 0 ? shift : std::vector<double>()});
    }
    return {};
  }

 private:
  Status on_mesh(const TestInput& input, const TestOutput& output, const Meshed& on, bool nearly) const {
    if (plane_strain_) return simulate(input, output, on, plane::Faces::held, nearly);
    return free_faces::by_volume(
        input, output,
        [&](const TestInput& at, const TestOutput& out) {
          return simulate(at, out, on, plane::Faces::incompressible, nearly);
        },
        [&](const TestInput& at, const TestOutput& out) { return simulate(at, out, on, plane::Faces::free, nearly); });
  }

  Status simulate(const TestInput& input, const TestOutput& output, const Meshed& on, plane::Faces faces,
                  bool nearly) const {
    const bool wants_parameters = !output.jacobian.empty();
    const FlawedSheet sheet(on.specimen(), prepared_->edges, on.modes(), flaws_, input.test_parameters);
    Equilibrium body(on.specimen(), input.model, input.model_parameters, along_, faces, sheet.weights());
    const std::size_t size = prepared_->rows.rows().count * prepared_->rows.channels().size();
    std::fill(output.values.begin(), output.values.end(), 0.0);
    std::fill(output.jacobian.begin(), output.jacobian.end(), 0.0);
    std::vector<double> du, df;
    for (std::size_t k = 0; k < prepared_->rows.steps().size(); ++k) {
      const FieldRows::Step& step = prepared_->rows.steps()[k];
      StepSolver solver(on, k, body, &sheet);
      const auto problem = nearly ? solver.nearly_settle(wants_parameters) : solver.settle(wants_parameters);
      if (problem) return Status::failed(fmt::format("full_field: step {:g}: {}", step.value, *problem));
      if (!output.values.empty()) on.read(step, solver.displacements(), solver.forces(), thickness_, output.values);
      for (std::size_t j = 0; wants_parameters && j < input.model_parameters.size(); ++j) {
        solver.by_parameter(j, du, df);
        on.read(step, du, df, thickness_, output.jacobian.subspan(j * size, size));
      }
      for (std::size_t q = 0; wants_parameters && q < flaws_.size(); ++q)
        if (solver.by_flaw(q, du, df))
          on.read(step, du, df, thickness_, output.jacobian.subspan((input.model_parameters.size() + q) * size, size));
    }
    return {};
  }

  double thickness_;
  bool plane_strain_, modified_newton_;
  std::array<double, 2> along_{};
  std::shared_ptr<const Prepared> prepared_;
  std::vector<FlawParameter> flaws_;
  TestDescription description_;
};

std::vector<Parameter> own_parameters() {
  std::vector<Parameter> found;
  for (const FlawParameter& flaw : all_flaws()) found.push_back(flaw.parameter);
  return found;
}

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
       Option::choice(
           "method", {"finite_elements", "modified_newton"}, "finite_elements",
           "Whether each step is brought to equilibrium, or near it from the measured displacements with few "
           "factors of the stiffness: a quarter of the time, for searches."),
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
      own_parameters(),
      false,
      [](const Options& options) -> std::optional<StandIn> {
        StandIn cheaper{"full_field", options};
        cheaper.options.set("method", std::string("modified_newton"));
        return cheaper;
      }};
}

}  // namespace
}  // namespace tunica::field

TUNICA_PLUGIN("full_field", TUNICA_PLUGIN_VERSION) { registry.add(tunica::field::factory()); }
