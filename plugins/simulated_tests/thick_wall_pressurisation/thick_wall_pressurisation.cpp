// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <fmt/format.h>

#include "history.hpp"
#include "through_wall.hpp"
#include "tunica/plugin.hpp"

namespace tunica::thick_wall {
namespace {

/// A long tube under inner pressure at prescribed axial stretch, semi-analytic: see wall.hpp for the geometry,
/// sections.hpp for pressure and axial force, path.hpp for how the pressure is inverted.
class ThickWallPressurisation final : public Test {
 public:
  explicit ThickWallPressurisation(const TestSetup& setup)
      : tube_(bound(setup)), fixed_(tube_.gauss_points > 0), rule_(fixed_ ? static_cast<int>(tube_.gauss_points) : 12) {
    description_.parameters = own_parameters(tube_.layered);
    description_.nulls = own_nulls(tube_.layered);
    description_.diagnostics = {"inner_radius_stretch", "mean_circumferential_stress", "mean_axial_stress"};
    description_.diagnostic_units = {"1", "kPa", "kPa"};
    description_.path_derivatives = !tube_.layered;
    description_.path_exceptions = {"tethering"};
    rows_.count = tube_.count();
    for (std::size_t k = 0; k < tube_.columns.size(); ++k)
      rows_.abscissae.push_back({tube_.names[k], tube_.columns[k]});
    rows_.channels = setup.rows.channels;
    rows_.time = tube_.time;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const bool derivatives = !output.jacobian.empty() || !output.abscissa_derivative.empty();
    const Model* const throughout = &input.model;
    bool history = false;
    for (const Model* layer : input.layers.empty() ? std::span(&throughout, 1) : input.layers) {
      const ModelDescription& model = layer->describe();
      history |= model.history_size > 0;
      const bool followed = input.layers.empty() && model.axis_history_size > 0 && output.abscissa_derivative.empty();
      if (model.history_size > 0 && followed) continue;
      if (model.history_size > 0 && derivatives)
        return Status::failed("thick_wall_pressurisation: no exact Jacobian along the path of a model with history");
      if (!model.parameter_derivatives && !output.jacobian.empty())
        return Status::failed("thick_wall_pressurisation: the model has no parameter derivatives");
    }
    return history ? predict_with_history(tube_, rule_, input, output)
                   : predict_elastic(tube_, fixed_ ? &rule_ : nullptr, input, output);
  }

  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    for (const Model* layer : input.layers.empty()
                                  ? std::vector<const Model*>{&input.model}
                                  : std::vector<const Model*>(input.layers.begin(), input.layers.end()))
      if (layer->describe().history_size > 0)
        return Status::failed(
            "thick_wall_pressurisation shows the wall of a material without history only; take the "
            "model without its mechanisms of history");
    return through_wall(tube_, input, rows, found);
  }

 private:
  static Tube bound(const TestSetup& setup) {
    Tube tube = bind(setup, "thick_wall_pressurisation");
    tube.gauss_points = static_cast<std::size_t>(setup.options.integer("gauss_points"));
    if (tube.gauss_points == 1)
      throw InputError(
          "thick_wall_pressurisation: \"gauss_points\" is 1, which integrates nothing well; give 2 or more, "
          "or 0 to have the number chosen");
    return tube;
  }

  Tube tube_;
  bool fixed_;  ///< the number of Gauss points
  Rule rule_;   ///< where it is, and for models with history
  TestRows rows_;
  TestDescription description_;
};

std::vector<Option> options() {
  std::vector<Option> all = tube_options();
  const std::vector<Option> wall = wall_options();
  all.insert(all.end(), wall.begin(), wall.end());
  all.push_back(Option::integer(
      "gauss_points", 0, {0, 150},
      "Gauss points in each layer (of one model: of the two of layer_ratio), and in each piece into which "
      "fibre switches cut them; 0 takes "
      "as many as the estimated error asks for (12 for a model with history)."));
  return all;
}

/// The tubes that were made, at another axial stretch.
std::vector<PlannedTest> plan(const PlanningScope& scope) {
  std::vector<PlannedTest> plans;
  for (const PlanningScope::Made& tube : scope.made)
    for (const double change : {-0.1, 0.1}) {
      if (!tube.options.has("axial_stretch") || !(tube.largest_loaded > 0)) continue;
      const double stretch = tube.options.number("axial_stretch") + change;
      if (stretch < 1) continue;
      PlannedTest plan{fmt::format("the tube of '{}' inflated at an axial stretch of {:.3g}", tube.name, stretch),
                       {tube.options.values().begin(), tube.options.values().end()},
                       {{"pressure", even_steps(0, tube.largest_loaded)}},
                       {},
                       {"outer_diameter_stretch", "axial_force"}};
      plan.options.emplace_back("axial_stretch", stretch);
      plans.push_back(std::move(plan));
    }
  return plans;
}

TestFactory factory() {
  TestFactory made{
      "thick_wall_pressurisation",
      "A long tube under inner pressure at prescribed axial stretch, its thick wall integrated semi-analytically.",
      "Holzapfel, Gasser, Ogden, J. Elasticity 61:1 (2000), section 3",
      options(),
      tube_observables(),
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<ThickWallPressurisation>(setup); },
      own_parameters(false),
      true,
      {},
      plan};
  made.specimen = Specimen::tube;
  made.first_choice = true;
  return made;
}

}  // namespace
}  // namespace tunica::thick_wall

TUNICA_PLUGIN("thick_wall_pressurisation", TUNICA_PLUGIN_VERSION) { registry.add(tunica::thick_wall::factory()); }
