// SPDX-License-Identifier: Apache-2.0
#include "uniaxial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "../loading_order/loading_order.hpp"
#include "along_radius.hpp"
#include "axes_path.hpp"
#include "compressible.hpp"
#include "memory_path.hpp"
#include "tensor_path.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/plugin.hpp"

namespace tunica::uniaxial {
namespace {

std::vector<Parameter> own_parameters() {
  return {{"misalignment", "deg", 0, -15, 15, Scale::linear,
           "Angle between the pulled direction and the nominal material axis.", ""}};
}

/// Whether a strip along an axis may bear shear stress, as one family at an angle makes it. The Jacobian by the
/// misalignment is then not 0. Parts tell; of a model without parts a stretched and a compressed strip do.
bool may_shear(const TestInput& input) {
  const auto parts = input.model.parts();
  if (!parts.empty())
    return std::any_of(parts.begin(), parts.end(), [&input](const auto& part) {
      if (part->describe().mirrored) return false;
      Invariant x;
      part->invariant(input.model_parameters, x, {});
      return x.fibre != 0 && std::abs(std::sin(2 * x.angle)) > 1e-12;
    });
  constexpr std::array stretches{1.1, 0.9};
  return std::any_of(stretches.begin(), stretches.end(), [&input](double stretch) {
    const std::array<double, 6> C{stretch * stretch, 1 / stretch, 1 / stretch, 0, 0, 0};
    std::array<double, 6> S{};
    const Status status = input.model.evaluate({1, C, input.model_parameters, {}, {}}, {{}, S, {}, {}, {}});
    return status.ok() && std::abs(S[3]) > 1e-12 * std::abs(S[0]);
  });
}

/// Whether every part is a function of I1 and I2 alone, so that the axis of the strip does not matter. A model without
/// parts does not say.
bool is_isotropic(const TestInput& input) {
  const auto parts = input.model.parts();
  return !parts.empty() && std::all_of(parts.begin(), parts.end(), [&input](const auto& part) {
    Invariant x;
    part->invariant(input.model_parameters, x, {});
    return x.fibre == 0 && x.normal == 0 && x.across == 0;
  });
}

/// A strip pulled along a direction of the material, or cut at an angle to it. Its lateral faces are free,
/// and the grips keep it from shearing.
class Uniaxial final : public Test {
 public:
  explicit Uniaxial(const TestSetup& setup) : axes_(bind(setup)), memory_(strip_) {
    description_.parameters = own_parameters();
    description_.nulls = {0};
    description_.diagnostics = {"transverse_stretch", "normal_stretch"};
    description_.diagnostic_units = {"1", "1"};
    description_.volume = TestDescription::Volume::either;
    const bool along_an_axis = strip_.turn == 0 && !radial_;
    if (along_an_axis) description_.free_strip_axis = strip_.loaded;
    description_.path_derivatives = along_an_axis;
    description_.path_exceptions = {"misalignment"};
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    return free_faces::by_volume(
        input, output,
        [this](const TestInput& at, const TestOutput& out) { return predict_at_constant_volume(at, out); },
        [this](const TestInput& at, const TestOutput& out) { return predict_compressible(strip_, radial_, at, out); });
  }

 private:
  Status predict_at_constant_volume(const TestInput& input, const TestOutput& output) const {
    if (!radial_ || is_isotropic(input)) return predict_in_plane(input, output);
    const AlongRadius turned(input.model);
    return predict_in_plane({turned, input.model_parameters, input.test_parameters, input.abscissae}, output);
  }

  Status predict_in_plane(const TestInput& input, const TestOutput& output) const {
    const ModelDescription& model = input.model.describe();
    const double misalignment = input.test_parameters[0];
    if (strip_.turn != 0) return predict_on_tensors(strip_, input, strip_.turn + misalignment, output);
    if (misalignment == 0 && model.axis_history_size > 0) return predict_with_memory(input, output);
    if (misalignment != 0 || model.history_size > 0 || !model.principal_axes)
      return predict_on_tensors(strip_, input, misalignment, output);
    if (!model.parameter_derivatives && !output.jacobian.empty())
      return Status::failed("uniaxial: the model has no parameter derivatives");
    return predict_on_axes(input, output);
  }

  Status predict_on_axes(const TestInput& input, const TestOutput& output) const {
    if (!output.jacobian.empty() && may_shear(input)) return predict_on_tensors(strip_, input, 0, output);
    Status status = axes_.predict(strip_, input, output);
    // At α = 0 the mirrored families make every channel even in α.
    if (status.ok() && !output.jacobian.empty()) {
      const std::size_t rows = strip_.channels.size() * strip_.stretch.size();
      for (double& entry : output.jacobian.subspan(input.model_parameters.size() * rows)) entry = 0;
    }
    return status;
  }

  /// At the nulls of its mechanisms the elastic model answers. A path that Newton's method does not find in one go is
  /// followed row by row on tensors, without derivatives.
  Status predict_with_memory(const TestInput& input, const TestOutput& output) const {
    if (output.jacobian.empty() && !input.model.remembers(input.model_parameters)) {
      const Model& elastic = input.model.elastic();
      return predict_on_axes({elastic, input.model_parameters.first(elastic.describe().parameters.size()),
                              input.test_parameters, input.abscissae},
                             output);
    }
    if (output.abscissa_derivative.empty()) {
      Status status = memory_.predict(strip_, input, output);
      if (status.ok() || !output.jacobian.empty()) return status;
    }
    return predict_on_tensors(strip_, input, 0, output);
  }

  const Strip& bind(const TestSetup& setup) {
    const std::string& direction = setup.options.text("direction");
    radial_ = direction == "radial";
    if (radial_ && setup.options.number("angle") != 0)
      throw InputError(
          "uniaxial: \"direction\" is 'radial' and \"angle\" is not 0, and a strip along the normal of the wall is not "
          "turned in its plane; take \"angle\" out");
    const bool circumferential = radial_ || direction == "circumferential";
    strip_.loaded = circumferential ? 0 : 1;
    strip_.transverse = 1 - strip_.loaded;
    // The angle turns z towards t, and t away from z; a misalignment turns the pulled axis towards the other one.
    strip_.turn = circumferential ? -setup.options.number("angle") : setup.options.number("angle");
    strip_.measure = setup.stress_measure == "first_piola_kirchhoff"    ? Measure::first_piola_kirchhoff
                     : setup.stress_measure == "second_piola_kirchhoff" ? Measure::second_piola_kirchhoff
                                                                        : Measure::cauchy;
    for (const auto& column : setup.rows.abscissae)
      if (column.observable == "stretch") {
        strip_.stretch.assign(column.values.begin(), column.values.end());
        rows_.abscissae = {column};
      }
    strip_.time.assign(setup.rows.time.begin(), setup.rows.time.end());
    if (strip_.stretch.empty())
      throw InputError("uniaxial: no rows, or no column mapped to 'stretch'; map one in \"columns\"");
    for (std::size_t i = 0; i < strip_.stretch.size(); ++i)
      if (!(strip_.stretch[i] > 0 && std::isfinite(strip_.stretch[i])))
        throw InputError("uniaxial: row " + std::to_string(i + 1) + " has stretch " +
                         std::to_string(strip_.stretch[i]) + "; a stretch is positive");
    check_loading_order("uniaxial", strip_.time);
    for (const std::string& channel : setup.rows.channels)
      strip_.channels.push_back(channel == "transverse_stretch" ? Channel::transverse_stretch
                                : channel == "normal_stretch"   ? Channel::normal_stretch
                                : channel == "volume_ratio"     ? Channel::volume_ratio
                                                                : Channel::stress);
    rows_.count = strip_.stretch.size();
    rows_.abscissae.front().values = strip_.stretch;
    rows_.channels = setup.rows.channels;
    rows_.time = strip_.time;
    return strip_;
  }

  Strip strip_;
  bool radial_ = false;  ///< through the thickness; the strip is then that of AlongRadius, along its first axis
  TestRows rows_;
  TestDescription description_;
  AxesPath axes_;
  MemoryPath memory_;
};

/// Strips along both directions with their width measured, and one cut at 45°. Where there is a clock, a slow cycle and
/// a hold as well.
std::vector<PlannedTest> plan(const PlanningScope& scope) {
  std::vector<PlannedTest> plans;
  const auto strip = [&](std::string description, const char* direction, std::vector<double> stretch,
                         std::vector<double> time) -> PlannedTest& {
    return plans.emplace_back(PlannedTest{std::move(description),
                                          {{"direction", std::string(direction)}},
                                          {{"stretch", std::move(stretch)}},
                                          std::move(time),
                                          {"stress"}});
  };
  const double reach = scope.reach;
  for (const char* direction : {"circumferential", "axial"})
    strip(fmt::format("a strip pulled along the {} direction to a stretch of {:.3g}, its width measured too", direction,
                      reach),
          direction, even_steps(1, reach), {})
        .channels.push_back("transverse_stretch");
  strip(fmt::format("a strip cut at 45° between the axes, pulled to {:.3g}", reach), "axial", even_steps(1, reach), {})
      .parameters = {{"misalignment", 45}};
  if (!(scope.shortest_time > 0)) return plans;
  std::vector<double> cycle = even_steps(1, reach, 10), back = even_steps(reach, 1 + 0.1 * (reach - 1), 10);
  cycle.insert(cycle.end(), back.begin(), back.end());
  strip(fmt::format("one slow cycle of a strip, to {:.3g} and back in {:.3g} s", reach, 10 * scope.longest_time),
        "circumferential", cycle, even_steps(0, 10 * scope.longest_time));
  std::vector<double> hold = even_steps(1, reach, 4), time = even_steps(0, scope.shortest_time / 20, 4);
  for (const double later : even_steps(0, scope.longest_time, 16)) {
    hold.push_back(reach);
    time.push_back(time[3] + later);
  }
  strip(fmt::format("a strip pulled to {:.3g} within {:.3g} s and held for {:.3g} s", reach, scope.shortest_time / 20,
                    scope.longest_time),
        "circumferential", hold, time);
  return plans;
}

TestFactory factory() {
  TestFactory made{
      "uniaxial",
      "A strip pulled along a direction of the material, lateral faces free.",
      "Holzapfel & Ogden, J. R. Soc. Interface 7:787 (2010)",
      {Option::choice("direction", {"circumferential", "axial", "radial"}, {},
                      "Material axis the strip is pulled along; radial is through the thickness."),
       Option::quantity("angle", "deg", -360,
                        "Turn of the strip from that axis, from axial towards circumferential. The grips keep the "
                        "strip from shearing.",
                        0.0),
       Option::quantity("length", "mm", 0,
                        "Unloaded distance of the clamps; 0 = not known. The mechanism clamped_ends needs it.", 0.0),
       Option::quantity("width", "mm", 0, "Unloaded width; 0 = not known. The mechanism clamped_ends needs it.", 0.0),
       Option::quantity("gauge_length", "mm", 0,
                        "Unloaded distance of the marks on the strip that the stretch is of; 0 = it is of the clamps.",
                        0.0)},
      {{"stretch", "1", Observable::Role::abscissa, true, "Stretch along the strip.", Observable::Kind::stretch},
       {"time", "s", Observable::Role::time, false, "Time since the unloaded state.", Observable::Kind::plain},
       {"stress", "kPa", Observable::Role::channel, false, "Stress along the strip.", Observable::Kind::stress},
       {"transverse_stretch", "1", Observable::Role::channel, false,
        "In-plane stretch across the strip; of a radial one the circumferential stretch.", Observable::Kind::stretch},
       {"normal_stretch", "1", Observable::Role::channel, false,
        "Stretch through the thickness; of a radial strip the axial stretch.", Observable::Kind::stretch},
       {"volume_ratio", "1", Observable::Role::channel, false,
        "Volume over that of the unloaded strip; 1 unless the model is compressible.", Observable::Kind::plain}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Uniaxial>(setup); },
      own_parameters(),
      false,
      {},
      plan};
  made.specimen = Specimen::strip;
  made.first_choice = true;
  return made;
}

}  // namespace
}  // namespace tunica::uniaxial

TUNICA_PLUGIN("uniaxial", TUNICA_PLUGIN_VERSION) { registry.add(tunica::uniaxial::factory()); }
