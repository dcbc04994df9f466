// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "inflation.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"

namespace tunica::bulge {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;
enum class Channel { pressure, apex_stretch, apex_curvature };

/// Below this height over the radius the membrane counts as flat: strains are below 1e-6.
constexpr double least_height = 1e-3;
/// Above it a wrong unit is likelier than a balloon.
constexpr double largest_height = 20;

std::vector<Parameter> own_parameters() {
  return {{"prestretch", "1", 1, 1, 2, Scale::linear,
           "Stretch of the membrane, the same in all directions, when its rim was clamped.", ""}};
}

bool changes(const TestInput& input) {
  return input.model.describe().compressible && !input.model.keeps_volume(input.model_parameters);
}

/// Whether the membrane is isotropic in its plane and therefore bulges as a solid of revolution.
bool is_even_in_plane(const TestInput& input, plane::Faces faces) {
  constexpr std::array<std::array<double, 2>, 4> states{{{1.1, 1.0}, {1.3, 1.1}, {1.1, 1.3}, {1.6, 1.4}}};
  constexpr double different = 1e-8;
  std::vector<double> first;
  for (const double degrees : {0.0, 27.0, 45.0, 90.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    plane::Membrane sheet(input.model, input.model_parameters, {std::cos(angle), std::sin(angle)}, faces);
    sheet.resize(states.size());
    for (std::size_t i = 0; i < states.size(); ++i)
      for (std::size_t a = 0; a < 2; ++a) sheet.C[a * states.size() + i] = states[i][a] * states[i][a];
    if (!sheet.evaluate(false, false)) return true;  // the simulation says more
    if (first.empty()) first = sheet.stress;
    double size = 0, apart = 0;
    for (std::size_t k = 0; k < first.size(); ++k) {
      size = std::max(size, std::abs(first[k]));
      apart = std::max(apart, std::abs(sheet.stress[k] - first[k]));
    }
    if (apart > different * size) return false;
  }
  return true;
}

/// A circular membrane, clamped at its rim and inflated to prescribed heights of its apex.
class Bulge final : public Test {
 public:
  explicit Bulge(const TestSetup& setup)
      : radius_(setup.options.number("radius")),
        thickness_(setup.options.number("thickness")),
        mesh_(setup.options.count("elements")),
        finer_(2 * setup.options.count("elements")) {
    bind(setup);
    description_.parameters = own_parameters();
    description_.nulls = {1};
    description_.diagnostics = {"apex_thickness_stretch", "rim_stretch"};
    description_.diagnostic_units = {"1", "1"};
    description_.volume = TestDescription::Volume::either;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (Status status = detail::elastic_only("bulge", input, output); !status.ok()) return status;
    return free_faces::by_volume(
        input, output, [this](const TestInput& at, const TestOutput& out) { return inflate(at, out, mesh_); },
        [this](const TestInput& at, const TestOutput& out) { return inflate(at, out, mesh_); });
  }

  Status agreement(const TestInput& input, std::vector<Agreement>& found) const override {
    const std::size_t n = rows_.count, m = channels_.size();
    std::vector<double> coarse(n * m), fine(n * m);
    const TestInput at = changes(input) ? input : free_faces::without_compressibility(input);
    if (Status status = inflate(at, {coarse, {}, {}, {}}, mesh_); !status.ok()) return status;
    if (Status status = inflate(at, {fine, {}, {}, {}}, finer_); !status.ok()) return status;
    for (std::size_t k = 0; k < m; ++k) {
      constexpr double explained = 1e-3;
      double difference = 0, largest = 0;
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) {
        difference = std::max(difference, std::abs(coarse[i] - fine[i]));
        largest = std::max(largest, std::abs(fine[i]));
      }
      const char* const unit = channels_[k] == Channel::pressure       ? "kPa"
                               : channels_[k] == Channel::apex_stretch ? "1"
                                                                       : "1/mm";
      found.push_back({fmt::format("twice as many elements: {}", rows_.channels[k]), difference, unit,
                       explained * largest, std::vector<double>(n * m)});
      for (std::size_t i = k * n; i < (k + 1) * n; ++i) found.back().shift[i] = fine[i] - coarse[i];
    }
    return {};
  }

 private:
  void bind(const TestSetup& setup) {
    if (!(radius_ > 0 && thickness_ > 0))
      throw InputError(
          fmt::format("bulge: \"radius\" is {:g} mm and \"thickness\" {:g} mm, and both are above 0; give the inner "
                      "radius of the clamp and the thickness of the unloaded membrane",
                      radius_, thickness_));
    constexpr double thin = 0.2;
    if (thickness_ > thin * radius_)
      throw InputError(
          fmt::format("bulge: \"thickness\" is {:g} mm and \"radius\" {:g} mm, and a membrane is thinner than a fifth "
                      "of its radius, else it bends; correct the sizes, or simulate the plate with a test of type "
                      "'external'",
                      thickness_, radius_));
    for (const TestRows::Column& column : setup.rows.abscissae) {
      height_.assign(column.values.begin(), column.values.end());
      rows_.abscissae = {column};
    }
    if (height_.empty()) throw InputError("bulge: no column is mapped to 'height'; map one in \"columns\"");
    for (std::size_t i = 0; i < height_.size(); ++i)
      if (!can_reach(height_[i])) throw InputError("bulge: " + row_name(i, height_[i]) + "; expected " + admitted());
    rows_.abscissae.front().values = height_;
    rows_.count = height_.size();
    rows_.channels = setup.rows.channels;
    for (const std::string& name : rows_.channels)
      channels_.push_back(name == "pressure"       ? Channel::pressure
                          : name == "apex_stretch" ? Channel::apex_stretch
                                                   : Channel::apex_curvature);
  }

  [[nodiscard]] bool can_reach(double height) const {
    return std::isfinite(height) &&
           (height == 0 || (height >= least_height * radius_ && height <= largest_height * radius_));
  }
  [[nodiscard]] std::string admitted() const {
    return fmt::format(
        "0, or from a thousandth of the radius, {:g} mm, to 20 times the radius; leave rows out where the membrane is "
        "flat, and see to the unit",
        least_height * radius_);
  }
  static std::string row_name(std::size_t row, double height) {
    return fmt::format("row {} has height {:g} mm", row + 1, height);
  }

  Status inflate(const TestInput& input, const TestOutput& output, const Mesh& mesh) const {
    const bool wants_parameters = !output.jacobian.empty();
    const plane::Faces faces = changes(input) || (input.model.describe().compressible && wants_parameters)
                                   ? plane::Faces::free
                                   : plane::Faces::incompressible;
    if (!is_even_in_plane(input, faces))
      return Status::failed(
          "bulge: the material has directions in its plane, and a bulge of revolution has none; choose an isotropic "
          "model, or fibres that are dispersed evenly in the plane");
    // The clamp has this radius; the unloaded membrane inside of it was smaller.
    const double rim = input.test_parameters[0], unloaded = radius_ / rim;
    Inflation inflation(mesh, input.model, input.model_parameters, faces, rim);
    const std::span<const double> height =
        input.abscissae.empty() ? std::span<const double>(height_) : input.abscissae.front();
    const std::size_t n = rows_.count, size = n * channels_.size(), parameters = input.model_parameters.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (!can_reach(height[i])) return Status::failed("bulge: " + row_name(i, height[i]) + "; expected " + admitted());
      const bool flat = height[i] == 0;
      if (!flat || !output.abscissa_derivative.empty())
        if (auto problem = inflation.raise_to(flat ? least_height : height[i] / unloaded))
          return Status::failed("bulge: " + row_name(i, height[i]) + ": " + *problem);
      const Inflation::Reading at = flat ? Inflation::Reading{0, rim, 0} : inflation.reading();
      for (std::size_t k = 0; k < channels_.size() && !output.values.empty(); ++k) {
        output.values[k * n + i] = value(channels_[k], at, unloaded);
        if (!std::isfinite(output.values[k * n + i]))
          return Status::failed("bulge: " + row_name(i, height[i]) +
                                ", where the energy overflows; narrow the bounds of the model's parameters");
      }
      if (!output.diagnostics.empty()) {
        output.diagnostics[i] = inflation.thickness_stretch(at.apex);
        output.diagnostics[n + i] = flat ? rim : inflation.rim_stretch();
      }
      const auto write = [&](std::span<double> column, const Inflation::Reading& change, double factor) {
        for (std::size_t k = 0; k < channels_.size(); ++k)
          column[k * n + i] = factor * derivative(channels_[k], at, change, unloaded);
      };
      if (!output.abscissa_derivative.empty()) {
        // A flat membrane rises like the one a little above it, but without tension at no load.
        const Inflation::Reading near = inflation.reading();
        if (!flat && !inflation.linearise(false)) return singular(i, height[i]);
        write(output.abscissa_derivative,
              flat ? Inflation::Reading{rim > 1 ? near.load / least_height : 0, 0, near.bend / least_height}
                   : inflation.by_height(),
              1 / unloaded);
      }
      if (!wants_parameters) continue;
      if (!flat && !inflation.linearise(true)) return singular(i, height[i]);
      const auto column = [&](std::size_t j) { return output.jacobian.subspan(j * size, size); };
      for (std::size_t j = 0; j < parameters; ++j)
        write(column(j), flat ? Inflation::Reading{} : inflation.by_parameter(j), 1);
      const Inflation::Reading by_rim = flat ? Inflation::Reading{0, 1, 0} : inflation.by_rim(),
                               by_height = flat ? Inflation::Reading{} : inflation.by_height();
      const double rise = height[i] / radius_;
      write(column(parameters),
            {by_rim.load + rise * by_height.load, by_rim.apex + rise * by_height.apex,
             by_rim.bend + rise * by_height.bend},
            1);
      for (std::size_t k = 0; k < channels_.size(); ++k)
        if (channels_[k] != Channel::apex_stretch)
          column(parameters)[k * n + i] += value(channels_[k], at, unloaded) / rim;  // by the unloaded radius
    }
    return {};
  }

  static Status singular(std::size_t row, double height) {
    return Status::failed("bulge: " + row_name(row, height) +
                          ", where the stiffness is singular; narrow the bounds of the model's parameters");
  }

  /// p = q H/a. Near the pole r = f R and z = a g(0) + g' R²/a, so that the curvature is −z'' = −2 g'/(a f²).
  [[nodiscard]] double value(Channel channel, const Inflation::Reading& at, double a) const {
    if (channel == Channel::pressure) return at.load * thickness_ / a;
    if (channel == Channel::apex_stretch) return at.apex;
    return at.bend == 0 ? 0 : -2 * at.bend / (a * at.apex * at.apex);
  }
  /// At the same a.
  [[nodiscard]] double derivative(Channel channel, const Inflation::Reading& at, const Inflation::Reading& change,
                                  double a) const {
    if (channel == Channel::pressure) return change.load * thickness_ / a;
    if (channel == Channel::apex_stretch) return change.apex;
    return -2 / (a * at.apex * at.apex) * (change.bend - 2 * at.bend * change.apex / at.apex);
  }

  double radius_, thickness_;
  Mesh mesh_, finer_;
  std::vector<double> height_;
  std::vector<Channel> channels_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  return {
      "bulge",
      "A circular membrane, clamped at its rim and inflated, by finite elements along its meridian.",
      "Adkins, Rivlin, Phil. Trans. R. Soc. A 244:505 (1952)",
      {Option::quantity("radius", "mm", 0, "Inner radius of the clamp."),
       Option::quantity("thickness", "mm", 0, "Thickness of the unloaded membrane."),
       Option::integer("elements", 4, {1, 64}, "Elements of degree 4 between pole and rim, as wide as each other.")},
      {{"height", "mm", Role::abscissa, true, "Height of the apex above the clamp.", Kind::plain},
       {"pressure", "kPa", Role::channel, false, "Pressure below the membrane.", Kind::plain},
       {"apex_stretch", "1", Role::channel, false, "Stretch at the apex, the same in all directions.", Kind::stretch},
       {"apex_curvature", "1/mm", Role::channel, false, "Curvature at the apex, 1 over its radius.", Kind::plain}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Bulge>(setup); },
      own_parameters()};
}

}  // namespace
}  // namespace tunica::bulge

TUNICA_PLUGIN("bulge", TUNICA_PLUGIN_VERSION) { registry.add(tunica::bulge::factory()); }
