// SPDX-License-Identifier: Apache-2.0
// Inflation of a membrane: a flat circular membrane of radius a and thickness T, clamped at its rim, is blown up to a
// cap of height h by a pressure p. With the usual assumption of a spherical cap that is stretched evenly and equally in
// all directions (Reuge, Schmidt, Le Maoult, Rachik, Abbé 2001, Polym. Eng. Sci. 41:522–531),
//
//   φ = 2 atan(h/a),   λ = φ/sin φ,   radius of the cap a/sin φ,   thickness T/λ²,
//
// and equilibrium of a cap, Laplace's law with both Cauchy stresses, p = (T/λ²) (sin φ/a) (σ_t + σ_z). A free surface
// fixes the pressure that S leaves open: σ_b = λ² S_b − λ⁻⁴ S_r, b = t, z.
#include <cmath>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class BulgeTest final : public Test {
 public:
  explicit BulgeTest(const TestSetup& setup)
      : radius_(setup.options.number("radius")), thickness_(setup.options.number("thickness")) {
    if (setup.rows.abscissae.empty()) throw InputError("bulge: map a column to 'height'");
    const auto given = setup.rows.abscissae.front().values;
    height_.assign(given.begin(), given.end());
    for (std::size_t i = 0; i < height_.size(); ++i)
      if (!(height_[i] > 0))
        throw InputError("bulge: found the height " + std::to_string(height_[i]) + " mm in row " + std::to_string(i) +
                         ", expected one above 0; leave the flat membrane out");
    rows_ = {.count = height_.size(), .abscissae = {{"height", height_}}, .channels = setup.rows.channels, .time = {}};
    description_.diagnostics = {"pole_stretch"}, description_.diagnostic_units = {"1"};
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const ModelDescription& model = input.model.describe();
    if (model.history_size > 0) return Status::failed("bulge: takes no model that remembers its history");
    if (!output.jacobian.empty() && !model.parameter_derivatives)
      return Status::failed("bulge: the model has no parameter derivatives");
    const auto height = input.abscissae.empty() ? std::span<const double>(height_) : input.abscissae.front();
    const std::size_t n = rows_.count, np = input.model_parameters.size();
    std::vector<Cap> caps;
    std::vector<double> C(6 * n, 0.0), S(6 * n), A(output.abscissa_derivative.empty() ? 0 : 36 * n),
        S_dp(output.jacobian.empty() ? 0 : 6 * np * n);
    for (std::size_t i = 0; i < n; ++i) {
      const Cap& cap = caps.emplace_back(height[i], radius_);
      C[i] = C[n + i] = cap.stretch * cap.stretch, C[2 * n + i] = std::pow(cap.stretch, -4);
      if (!output.diagnostics.empty()) output.diagnostics[i] = cap.stretch;
    }
    if (Status status = input.model.evaluate({n, C, input.model_parameters, {}, {}}, {{}, S, A, S_dp, {}});
        !status.ok())
      return status;

    for (std::size_t i = 0; i < n; ++i) {
      const double l = caps[i].stretch, by_stress = thickness_ * caps[i].sine / (radius_ * l * l);
      // σ_t + σ_z = λ² (S_t + S_z) − 2 λ⁻⁴ S_r, of S or of a derivative of S at fixed stretch
      const auto stress = [&](std::span<const double> s) {
        return l * l * (s[i] + s[n + i]) - 2 * std::pow(l, -4) * s[2 * n + i];
      };
      const double sigma = stress(S);
      if (!std::isfinite(sigma))
        return Status::failed("bulge: the energy overflows at row " + std::to_string(i) + ", height " +
                              std::to_string(height[i]) + " mm");
      if (!output.values.empty()) output.values[i] = by_stress * sigma;
      for (std::size_t j = 0; !output.jacobian.empty() && j < np; ++j)
        output.jacobian[j * n + i] = by_stress * stress(std::span<const double>(S_dp).subspan(6 * j * n, 6 * n));
      if (A.empty()) continue;
      // dS_b/dλ = ½ Σ_x A_bx dC_xx/dλ with dC/dλ = (2λ, 2λ, −4 λ⁻⁵), and the change of the geometry
      const auto dS = [&](std::size_t b) {
        return l * (A[6 * b * n + i] + A[(6 * b + 1) * n + i]) - 2 * std::pow(l, -5) * A[(6 * b + 2) * n + i];
      };
      const double d_sigma = 2 * l * (S[i] + S[n + i]) + 8 * std::pow(l, -5) * S[2 * n + i] + l * l * (dS(0) + dS(1)) -
                             2 * std::pow(l, -4) * dS(2);
      output.abscissa_derivative[i] =
          by_stress * (caps[i].stretch_slope * (d_sigma - 2 * sigma / l) + caps[i].sine_slope / caps[i].sine * sigma);
    }
    return {};
  }

 private:
  /// λ and sin φ at height h, with their derivatives by h: dφ/dh = 2a/(a² + h²).
  struct Cap {
    double stretch, sine, stretch_slope, sine_slope;
    Cap(double h, double a) {
      const double phi = 2 * std::atan(h / a), turn = 2 * a / (a * a + h * h);
      sine = std::sin(phi), stretch = phi / sine;
      sine_slope = std::cos(phi) * turn;
      stretch_slope = turn / sine - stretch / sine * sine_slope;
    }
  };
  double radius_, thickness_;
  std::vector<double> height_;
  TestRows rows_;
  TestDescription description_;
};

Option length(std::string name, std::string doc) {
  return {.name = std::move(name),
          .kind = Option::Kind::quantity,
          .fallback = {},
          .doc = std::move(doc),
          .unit = "mm",
          .min = 1e-6};
}

}  // namespace

TUNICA_PLUGIN("bulge", "1.0.0") {
  registry.add(TestFactory{"bulge",
                           "A circular membrane, clamped at its rim and blown up to a cap.",
                           "Reuge, Schmidt, Le Maoult, Rachik, Abbé, Polym. Eng. Sci. 41:522 (2001)",
                           {length("radius", "Radius of the membrane inside its clamp."),
                            length("thickness", "Thickness of the flat membrane.")},
                           {{"height", "mm", Observable::Role::abscissa, true, "Height of the pole above the rim."},
                            {"pressure", "kPa", Observable::Role::channel, true, "Pressure in the membrane."}},
                           [](const TestSetup& setup) { return std::make_unique<BulgeTest>(setup); }});
}
