// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "contact.hpp"
#include "stiffness.hpp"
#include "tunica/detail/elastic_only.hpp"
#include "tunica/plugin.hpp"

namespace tunica::indentation {
namespace {

using Role = Observable::Role;
using Kind = Observable::Kind;

/// Of a sphere of 1 mm, unless its radius is given: contact is found within a tenth of it.
std::vector<Parameter> own_parameters(double radius = 1) {
  return {
      {"contact_point", "mm", 0, -0.1 * radius, 0.1 * radius, Scale::linear,
       "Recorded depth at which the sphere touches, by default within a tenth of the radius; true depth is less by it.",
       ""}};
}

/// A rigid sphere that is pressed into a layer or a half-space.
class Indentation final : public Test {
 public:
  explicit Indentation(const TestSetup& setup) {
    const std::string& law = setup.options.text("law");
    contact_.law = law == "half_space" ? Law::half_space
                   : law == "bonded"   ? Law::bonded
                   : law == "sliding"  ? Law::sliding
                                       : Law::deep;
    contact_.radius = setup.options.number("radius");
    contact_.thickness = setup.options.number("thickness");
    check_sizes(law);
    bind(setup);
    description_.parameters = own_parameters(contact_.radius);
    description_.nulls = {0};
    description_.diagnostics = {"shear_modulus"};
    description_.diagnostic_units = {"kPa"};
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const ModelDescription& model = input.model.describe();
    if (Status status = detail::elastic_only("indentation", input, output); !status.ok()) return status;
    if (!model.principal_axes)
      return Status::failed(
          "indentation: the model has no path in principal axes, of which its shear modulus is taken; choose one that "
          "has it");
    const bool derivatives = !output.jacobian.empty();
    ShearModulus modulus;
    if (Status status = modulus.evaluate(input.model, input.model_parameters, derivatives); !status.ok())
      return Status::failed("indentation: " + status.reason());
    const std::span<const double> recorded =
        input.abscissae.empty() ? std::span<const double>(depth_) : input.abscissae.front();
    const std::size_t n = rows_.count, parameters = input.model_parameters.size();
    double deepest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double depth = recorded[i] - input.test_parameters[0];
      if (depth > contact_.deepest() * (1 + 1e-9)) return too_deep(i, recorded[i], depth);
      deepest = std::max(deepest, depth);
      const double force = contact_.force(depth), slope = modulus.value * contact_.slope(depth);
      if (!std::isfinite(modulus.value * force))
        return Status::failed(
            fmt::format("indentation: the force overflows at row {}; narrow the bounds of the model's "
                        "parameters",
                        i + 1));
      for (std::size_t k = 0; k < rows_.channels.size(); ++k) {
        const std::size_t at = k * n + i, size = rows_.channels.size() * n;
        if (!output.values.empty()) output.values[at] = modulus.value * force;
        if (!output.abscissa_derivative.empty()) output.abscissa_derivative[at] = slope;
        for (std::size_t j = 0; derivatives && j < parameters; ++j)
          output.jacobian[j * size + at] = modulus.by_parameter[j] * force;
        if (derivatives) output.jacobian[parameters * size + at] = -slope;
      }
      if (!output.diagnostics.empty()) output.diagnostics[i] = modulus.value;
    }
    // Below the sphere the layer is shortened by about δ/h.
    if (contact_.law == Law::deep)
      if (Status status = modulus.neo_hookean(input.model, input.model_parameters, deepest / contact_.thickness);
          !status.ok())
        return Status::failed("indentation: " + status.reason());
    return {};
  }

 private:
  /// The recorded depth alone decides nothing: an actuator may have any offset.
  [[nodiscard]] Status too_deep(std::size_t row, double recorded, double depth) const {
    return Status::failed(
        fmt::format("indentation: row {} has depth {:g} mm, {:g} mm from contact, and the law holds to {:g} mm; leave "
                    "deeper rows out with \"where\", give \"contact_point\" another value or bounds, or choose the law "
                    "'deep' for a neo-Hookean layer on a rigid base",
                    row + 1, recorded, depth, contact_.deepest()));
  }

  void check_sizes(const std::string& law) const {
    if (!(contact_.radius > 0))
      throw InputError(
          "indentation: \"radius\" is 0 mm, and a sphere has one above 0; give that of the indenter, for example \"2 "
          "mm\"");
    const bool layer = contact_.law != Law::half_space;
    if (layer != (contact_.thickness > 0))
      throw InputError(fmt::format(
          "indentation: \"law\" is '{}' and \"thickness\" {:g} mm; {}", law, contact_.thickness,
          layer ? "give the thickness of the unloaded layer, or \"law\": \"half_space\""
                : "give \"law\": \"bonded\", \"sliding\" or \"deep\" for a layer, or take the thickness out"));
    if (const std::string why = contact_.objection(); !why.empty())
      throw InputError(fmt::format("indentation: {}; correct the sizes, or choose another \"law\"", why));
  }

  void bind(const TestSetup& setup) {
    for (const TestRows::Column& column : setup.rows.abscissae) {
      depth_.assign(column.values.begin(), column.values.end());
      rows_.abscissae = {column};
    }
    if (depth_.empty()) throw InputError("indentation: no column is mapped to 'depth'; map one in \"columns\"");
    for (std::size_t i = 0; i < depth_.size(); ++i)
      if (!std::isfinite(depth_[i]))
        throw InputError(fmt::format("indentation: row {} has depth {}; expected a number in mm", i + 1, depth_[i]));
    rows_.abscissae.front().values = depth_;
    rows_.count = depth_.size();
    rows_.channels = setup.rows.channels;
  }

  Contact contact_;
  std::vector<double> depth_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  return {"indentation",
          "A rigid sphere pressed into a layer or a half-space, by published closed forms of the shear modulus.",
          "Dimitriadis, Horkay, Maresca, Kachar, Chadwick, Biophys. J. 82:2798 (2002)",
          {Option::quantity("radius", "mm", 0, "Radius of the sphere."),
           Option::quantity("thickness", "mm", 0, "Thickness of the unloaded layer; 0 = a half-space.", 0.0),
           Option::choice(
               "law", {"half_space", "bonded", "sliding", "deep"}, "half_space",
               "Hertz's half-space; a layer that is bonded to its base, or slides on it; a neo-Hookean layer that "
               "is bonded, to six tenths of its thickness.")},
          {{"depth", "mm", Role::abscissa, true, "Depth of the sphere below the surface before contact.", Kind::plain},
           {"force", "mN", Role::channel, false, "Force on the sphere; positive where it is pressed.", Kind::plain}},
          [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Indentation>(setup); },
          own_parameters()};
}

}  // namespace
}  // namespace tunica::indentation

TUNICA_PLUGIN("indentation", TUNICA_PLUGIN_VERSION) { registry.add(tunica::indentation::factory()); }
