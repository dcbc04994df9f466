// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "agreement.hpp"
#include "fields.hpp"
#include "history.hpp"
#include "totals.hpp"
#include "tunica/plugin.hpp"

namespace tunica::fe {
namespace {

constexpr double most_memory = 4;  ///< GiB

/// "elements": [radial, axial over half the length], or null for the default of the element.
void set_elements(const std::string& text, Tube& tube) {
  const nlohmann::json given = nlohmann::json::parse(text, nullptr, false);
  if (given.is_null()) {
    if (tube.order == 2) {
      tube.radial = 8;
      tube.axial = 20;
    }
    return;
  }
  const bool pair = given.is_array() && given.size() == 2 && given[0].is_number_unsigned() &&
                    given[1].is_number_unsigned() && given[0] >= 1 && given[0] <= 200 && given[1] >= 2 &&
                    given[1] <= 2000;
  if (!pair)
    throw InputError("fe_pressurisation: \"elements\" is " + text +
                     "; give two numbers, [radial, axial over half the length], for example [8, 20]; at most "
                     "[200, 2000]");
  tube.radial = given[0];
  tube.axial = given[1];
}

/// A matrix and its factor are what takes memory.
void refuse_more_memory_than_there_should_be(const Tube& tube) {
  const double GiB = 1024. * 1024 * 1024, needed = Solver::bytes(mesh_of(tube)) / GiB;
  if (needed > most_memory)
    throw InputError(fmt::format(
        "fe_pressurisation: a mesh of {} × {} elements of {} nodes needs {:.1f} GiB of memory, and {} GiB are allowed; "
        "take fewer elements across the wall",
        tube.radial, tube.axial, tube.order == 1 ? 4 : 9, needed, most_memory));
}

/// A tube of finite length under inner pressure: see assembly.hpp for the discrete potential, solver.hpp for Newton's
/// method, path.hpp for the loading, sensitivity.hpp for exact derivatives.
class FePressurisation final : public Test {
 public:
  explicit FePressurisation(const TestSetup& setup) : tube_(thick_wall::bind(setup, "fe_pressurisation")) {
    const Options& given = setup.options;
    plan_.order = given.text("element") == "quadrilateral_4" ? 1 : 2;
    set_elements(given.text("elements"), plan_);
    if (tube_.layered) plan_.interfaces = tube_.interfaces;
    if (plan_.radial < plan_.interfaces.size() + 1)
      throw InputError(fmt::format(
          "fe_pressurisation: \"elements\" begins with {}, and the wall has {} layers, each of which takes one element "
          "across at least; raise that number",
          plan_.radial, plan_.interfaces.size() + 1));
    plan_.inner = tube_.inner_radius;
    plan_.outer = tube_.outer_radius;
    plan_.length = given.number("length");
    refuse_more_memory_than_there_should_be(plan_);
    plan_.grading = given.number("grading");
    if (!(plan_.length > 0))
      throw InputError(
          "fe_pressurisation: \"length\" is 0; give the unloaded length between the ends, for example \"14 mm\"");
    const std::string& ends = given.text("ends");
    plan_.ends = ends == "clamped" ? Ends::clamped : ends == "sliding" ? Ends::sliding : Ends::clamped_after_stretch;
    plan_.tolerance = given.number("tolerance");
    plan_.time_limit = given.number("time_limit");
    plan_.steps = static_cast<std::size_t>(given.integer("max_steps"));
    description_.parameters = thick_wall::own_parameters(tube_.layered);
    description_.nulls = thick_wall::own_nulls(tube_.layered);
    description_.diagnostics = {"inner_radius_stretch"};
    description_.diagnostic_units = {"1"};
    description_.costly = true;
    rows_.count = tube_.count();
    for (std::size_t k = 0; k < tube_.columns.size(); ++k)
      rows_.abscissae.push_back({tube_.names[k], tube_.columns[k]});
    rows_.channels = setup.rows.channels;
    rows_.time = tube_.time;
    for (const Channel channel : tube_.channels) {
      const bool outer = channel == Channel::outer_diameter || channel == Channel::outer_diameter_stretch;
      wanted_[channel == Channel::axial_force ? 2 : outer ? 0 : 1] = true;
    }
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const bool derivatives = !output.jacobian.empty() || !output.abscissa_derivative.empty();
    bool history = false;
    for (const Model* model : models_of(input)) {
      history |= model->describe().history_size > 0;
      if (derivatives && model->describe().history_size > 0)
        return Status::failed("fe_pressurisation: no exact Jacobian along the path of a model with history");
      if (derivatives && !model->describe().parameter_derivatives)
        return Status::failed("fe_pressurisation: the model has no parameter derivatives");
    }
    Setting at;
    if (Status status = prepare(input, !output.jacobian.empty(), at); !status.ok()) return status;

    thread_local std::unique_ptr<Simulation> simulation;  // its memory serves the next call
    if (!simulation || simulation->tube() != at.plan) simulation = std::make_unique<Simulation>(at.plan);
    thread_local std::vector<Sample> samples;
    std::size_t failed_at = 0;
    const double support = at.wall->tether / at.plan.outer;
    const Status status =
        history
            ? follow_history(*simulation, *at.material, at.loads, tube_.time, support, samples, failed_at)
            : simulation->run(*at.material, at.loads, derivatives ? wanted_ : Wanted{}, samples, failed_at, support);
    if (!status.ok())
      return Status::failed(fmt::format(
          "fe_pressurisation: {} is not reached: {}",
          TubeRows::row_name(failed_at, at.loads[failed_at].pressure, at.loads[failed_at].stretch), status.reason()));
    return write(at, samples, input.model_parameters.size(), output);
  }

  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    Setting at;
    if (Status status = prepare(input, false, at); !status.ok()) return status;
    return check_agreement(at.plan, *at.wall, *at.material, input, at.loads, found);
  }

  Status snapshots(const TestInput& input, std::span<const std::size_t> rows,
                   std::vector<Snapshot>& found) const override {
    for (const Model* model : models_of(input))
      if (model->describe().history_size > 0)
        return Status::failed(
            "fe_pressurisation shows the wall of a material without history only; take the model without its "
            "mechanisms of history");
    Setting at;
    if (Status status = prepare(input, false, at); !status.ok()) return status;
    return snapshots_of(at.plan, input, *at.material, at.loads, rows, found);
  }

 private:
  using Channel = TubeRows::Channel;

  static std::vector<const Model*> models_of(const TestInput& input) {
    if (input.layers.empty()) return {&input.model};
    return {input.layers.begin(), input.layers.end()};
  }

  /// The simulated tube with its imperfections and materials, and the prescribed values of each row.
  struct Setting {
    Tube plan;
    std::optional<thick_wall::Wall> wall;
    thick_wall::SectorDerivative sector;
    std::optional<Closing> closing;
    std::optional<Material> material;
    std::vector<Load> loads;
  };
  Status prepare(const TestInput& input, bool parameters, Setting& at) const {
    at.plan = plan_;
    at.wall.emplace(tube_, input.test_parameters);
    thick_wall::Wall& wall = *at.wall;
    at.plan.inner = wall.Ri;
    if (!(wall.Ri > 0 && wall.Ri < wall.Ro))
      return Status::failed("fe_pressurisation: the thickness error leaves no wall or no lumen");
    std::vector<double> pressure, stretch;
    if (Status status =
            tube_.prescribed(input, input.test_parameters[thick_wall::axial_stretch_error], pressure, stretch);
        !status.ok())
      return status;
    for (std::size_t i = 0; i < pressure.size(); ++i) at.loads.push_back({stretch[i], pressure[i]});
    thread_local thick_wall::Sections sections;
    constexpr std::size_t rule = 5;  // 20 points in each piece
    const std::vector<const Model*> models = models_of(input);
    // The sector closes at equilibrium, where only the elastic part of a model plays a part.
    std::vector<const Model*> elastic;
    std::vector<double> elastic_parameters;
    std::size_t first = 0;
    for (const Model* model : models) {
      elastic.push_back(&model->elastic());
      const auto own = input.model_parameters.subspan(first, elastic.back()->describe().parameters.size());
      elastic_parameters.insert(elastic_parameters.end(), own.begin(), own.end());
      first += model->describe().parameters.size();
    }
    const thick_wall::Layers layers({*elastic.front(), elastic_parameters, input.test_parameters, {}, elastic});
    if (Status status = thick_wall::close_sector(tube_, layers, thick_wall::rules()[rule], sections, wall,
                                                 parameters ? &at.sector : nullptr);
        !status.ok())
      return status;
    const Mesh mesh = mesh_of(at.plan);
    at.closing.emplace(mesh, wall, tube_.layered ? 1 : input.test_parameters[thick_wall::layer_ratio], parameters);
    at.material.emplace(models, input.model_parameters, mesh.columns,
                        parameters || !at.closing->none() ? &*at.closing : nullptr);
    return {};
  }

  /// A channel, or its derivative, of what is observed.
  static double channel(Channel channel, const Tube& plan, const Observed& at) {
    switch (channel) {
      case Channel::outer_diameter:
        return 2 * at[0];
      case Channel::inner_diameter:
        return 2 * at[1];
      case Channel::outer_diameter_stretch:
        return at[0] / plan.outer;
      case Channel::inner_diameter_stretch:
        return at[1] / plan.inner;
      case Channel::axial_force:
        break;
    }
    return at[2];
  }

  Status write(const Setting& at, const std::vector<Sample>& samples, std::size_t parameters,
               const TestOutput& output) const {
    const Tube& plan = at.plan;
    const std::size_t n = samples.size(), size = n * tube_.channels.size();
    std::vector<Observed> totals;
    for (std::size_t i = 0; i < n; ++i) {
      const Sample& sample = samples[i];
      if (!output.jacobian.empty()) total_derivatives(sample, *at.wall, at.sector, parameters, totals);
      for (std::size_t k = 0; k < tube_.channels.size(); ++k) {
        const Channel what = tube_.channels[k];
        if (!output.values.empty()) output.values[k * n + i] = channel(what, plan, sample.value);
        if (!output.jacobian.empty()) {
          for (std::size_t j = 0; j < totals.size(); ++j)
            output.jacobian[j * size + k * n + i] = channel(what, plan, totals[j]);
          // The unloaded inner radius changes with the thickness, too.
          if (what == Channel::inner_diameter_stretch)
            output.jacobian[(parameters + thick_wall::thickness_error) * size + k * n + i] +=
                sample.value[1] / (plan.inner * plan.inner) * (plan_.outer - plan_.inner);
        }
        for (std::size_t a = 0; a < (output.abscissa_derivative.empty() ? 0 : tube_.columns.size()); ++a) {
          const std::size_t direction = parameters + (a == tube_.pressure_column ? along_pressure : along_stretch);
          output.abscissa_derivative[a * size + k * n + i] = channel(what, plan, sample.by[direction]);
        }
      }
    }
    for (std::size_t i = 0; i < (output.diagnostics.empty() ? 0 : n); ++i)
      output.diagnostics[i] = samples[i].value[1] / plan.inner;
    return {};
  }

  thick_wall::Tube tube_;
  Tube plan_;
  Wanted wanted_{};
  TestRows rows_;
  TestDescription description_;
};

std::vector<Option> options() {
  std::vector<Option> all = tube_options();
  const std::vector<Option> wall = thick_wall::wall_options();
  all.insert(all.end(), wall.begin(), wall.end());
  const std::vector<Option> own = {
      Option::quantity("length", "mm", 0.0, "Unloaded length between the ends."),
      Option::choice(
          "ends", {"clamped", "clamped_after_stretch", "sliding"}, "clamped",
          "How the ends are held: radially fixed from the start (clamped), from the end of the axial stretch on, or "
          "not at all (sliding: then the tube is a long one, until it bulges or buckles)."),
      Option::choice(
          "element", {"quadrilateral_4", "quadrilateral_9"}, "quadrilateral_9",
          "Four-node elements with a constant pressure each, or nine-node ones with a linear pressure, which "
          "take a third of the time at the same error."),
      Option::json("elements", "null",
                   "Numbers of elements, [radial, axial over half the length]; null means [8, 20], or [25, 100] of "
                   "four nodes."),
      Option::number(
          "grading", 1.5, {1.0, 4.0},
          "Refinement towards the end: 1 is uniform; element k of n ends at 1 − (1 − k/n)^grading of half the "
          "length."),
      Option::number(
          "tolerance", 1e-6, {1e-10, 1e-2},
          "Of the curve between the pressures that are solved, over the outer radius and the largest force."),
      Option::integer("max_steps", 1000, {1, 1e6}, "Load steps at most, in one simulation."),
      Option::quantity("time_limit", "s", 0.001, "A simulation that takes longer fails.", 60.0)};
  all.insert(all.end(), own.begin(), own.end());
  return all;
}

/// The long tube with the same wall and stretch.
std::optional<StandIn> long_tube(const Options& given) {
  StandIn found{"thick_wall_pressurisation", {}};
  for (const std::vector<Option>& shared : {tube_options(), thick_wall::wall_options()})
    for (const Option& option : shared) found.options.set(option.name, given.values().at(option.name));
  return found;
}

TestFactory factory() {
  TestFactory made{
      "fe_pressurisation",
      "A tube of finite length under inner pressure, stretched and held at its ends, by axisymmetric mixed finite "
      "elements.",
      "D. Boffi, F. Brezzi, M. Fortin, Mixed Finite Element Methods and Applications (2013), section 8.6; J. Bonet, "
      "R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008)",
      options(),
      tube_observables(),
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<FePressurisation>(setup); },
      thick_wall::own_parameters(false),
      true,
      long_tube};
  made.specimen = Specimen::tube;
  return made;
}

}  // namespace
}  // namespace tunica::fe

TUNICA_PLUGIN("fe_pressurisation", TUNICA_PLUGIN_VERSION) { registry.add(tunica::fe::factory()); }
