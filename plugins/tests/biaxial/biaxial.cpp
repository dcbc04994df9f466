// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <numeric>

#include "response.hpp"
#include "sheet.hpp"
#include "tunica/plugin.hpp"

namespace tunica::biaxial {
namespace {

/// Positions of the tangent's components (a, b) in the order tt, zz, rr, tz, zr, tr.
constexpr std::array<std::array<std::size_t, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// A thin sheet, both in-plane stretches prescribed, its faces free: λr = 1/(λt λz), σr = 0, so that no equation has to
/// be solved. With the squared stretches c and S = 2 ∂W/∂C
///
///   σ_a = c_a S_aa − c_r S_rr,   a = t, z                                (physics: docs/theory.md, biaxial sheet)
///
/// A sheet may be cut at an angle to the axes of the material. t and z are then its own axes, clamps keep it from
/// shearing, and the shear stress that they bear is a diagnostic.
class Biaxial final : public Test {
 public:
  explicit Biaxial(const TestSetup& setup) : sheet_(bind(setup)) {
    description_.diagnostics = {"normal_stretch"};
    description_.diagnostic_units = {"1"};
    if (sheet_.angle != 0) {
      description_.diagnostics.emplace_back("shear_stress");
      description_.diagnostic_units.emplace_back("kPa");
    }
    description_.path_derivatives = sheet_.angle == 0;
    rows_.count = sheet_.count();
    for (std::size_t k = 0; k < sheet_.columns.size(); ++k) {
      rows_.abscissae.push_back({sheet_.names[k], sheet_.columns[k]});
      bound_.push_back(sheet_.columns[k]);
    }
    rows_.channels = setup.rows.channels;
    rows_.time = sheet_.time;
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const ModelDescription& model = input.model.describe();
    const Response::Wants wants{!output.abscissa_derivative.empty(), !output.jacobian.empty()};
    const bool followed = model.axis_history_size > 0 && sheet_.angle == 0;
    if (model.history_size > 0 && (wants.tangent || (wants.parameters && !followed)))
      return Status::failed("biaxial: no exact Jacobian along the path of a model with history");
    if (!model.parameter_derivatives && !followed && wants.parameters)
      return Status::failed("biaxial: the model has no parameter derivatives");
    const auto columns = input.abscissae.empty() ? std::span<const std::span<const double>>(bound_) : input.abscissae;
    const std::size_t n = rows_.count, rows = sheet_.channels.size() * n, parameters = input.model_parameters.size();

    thread_local Response r;
    r.reserve(n, parameters);
    set_stretches(columns, r.c);
    if (!output.diagnostics.empty())
      for (std::size_t i = 0; i < n; ++i) output.diagnostics[i] = std::sqrt(r.c[2 * n + i]);
    if (Status status = r.evaluate(input.model, input.model_parameters, sheet_.time, n, sheet_.angle, wants);
        !status.ok())
      return status;
    if (sheet_.angle != 0 && !output.diagnostics.empty())  // σ_tz = λt λz S_tz
      for (std::size_t i = 0; i < n; ++i) output.diagnostics[n + i] = std::sqrt(r.c[i] * r.c[n + i]) * r.shear[i];

    for (std::size_t i = 0; i < n; ++i) {
      const InPlane stress = cauchy(r, r.stress, i), factor = measure(r, i);
      if (!std::isfinite(stress[0] + stress[1]))
        return Status::failed("biaxial: the energy overflows or is undefined at " + sheet_.row_name(columns, i));
      if (!output.values.empty()) set(output.values, i, {factor[0] * stress[0], factor[1] * stress[1]});
      for (std::size_t j = 0; wants.parameters && j < parameters; ++j) {
        const InPlane by_p = cauchy(r, std::span<const double>(r.stress_dp).subspan(3 * j * n, 3 * n), i);
        set(output.jacobian.subspan(j * rows, rows), i, {factor[0] * by_p[0], factor[1] * by_p[1]});
      }
      for (std::size_t k = 0; wants.tangent && k < columns.size(); ++k)
        set(output.abscissa_derivative.subspan(k * rows, rows), i, by_column(r, i, stress, factor, k));
    }
    if (!all_finite(output.values) || !all_finite(output.jacobian) || !all_finite(output.abscissa_derivative))
      return Status::failed("biaxial: a stress or its derivative overflows, first at " +
                            sheet_.row_name(columns, first_overflow(output)));
    return {};
  }

 private:
  void set_stretches(std::span<const std::span<const double>> columns, std::span<double> c) const {
    const std::size_t n = rows_.count;
    const InPlane held = sheet_.held();
    for (std::size_t i = 0; i < n; ++i) {
      InPlane stretch = held;
      for (std::size_t k = 0; k < columns.size(); ++k)
        for (std::size_t a = 0; a < 2; ++a) stretch[a] += sheet_.direction(k)[a] * columns[k][i];
      for (std::size_t a = 0; a < 2; ++a) c[a * n + i] = stretch[a] * stretch[a];
      c[2 * n + i] = 1 / (c[i] * c[n + i]);
    }
  }

  /// c_a S_aa − c_r S_rr, of S or of a derivative of S at fixed stretches.
  InPlane cauchy(const Response& r, std::span<const double> S, std::size_t i) const {
    const std::size_t n = rows_.count;
    const double normal = r.c[2 * n + i] * S[2 * n + i];
    return {r.c[i] * S[i] - normal, r.c[n + i] * S[n + i] - normal};
  }

  /// Cauchy stress to the data's measure: P = σ/λ, S = σ/λ².
  InPlane measure(const Response& r, std::size_t i) const {
    if (sheet_.power == 0) return {1, 1};
    const InPlane c{r.c[i], r.c[rows_.count + i]};
    return sheet_.power == 2 ? InPlane{1 / c[0], 1 / c[1]} : InPlane{1 / std::sqrt(c[0]), 1 / std::sqrt(c[1])};
  }

  /// Stresses in the data's measure by abscissa k. With l_b = ln λ_b: ∂c_b/∂l_b = 2 c_b and ∂c_r/∂l_b = −2 c_r, hence
  ///   ∂S_xx/∂l_b = A_xb c_b − A_xr c_r with A = 2 ∂S/∂C.
  InPlane by_column(const Response& r, std::size_t i, const InPlane& stress, const InPlane& factor,
                    std::size_t k) const {
    const std::size_t n = rows_.count;
    const double cr = r.c[2 * n + i];
    InPlane sum{0, 0};
    for (std::size_t b = 0; b < 2; ++b) {
      const double along = sheet_.direction(k)[b], cb = r.c[b * n + i];
      if (along == 0) continue;
      const auto change = [&](std::size_t x) {
        return r.tangent[place[x][b] * n + i] * cb - r.tangent[place[x][2] * n + i] * cr;
      };
      for (std::size_t a = 0; a < 2; ++a) {
        const double ca = r.c[a * n + i], own = a == b ? 2 * ca * r.stress[a * n + i] - sheet_.power * stress[a] : 0;
        const double by_l = own + ca * change(a) + 2 * cr * r.stress[2 * n + i] - cr * change(2);
        sum[a] += along * factor[a] * by_l / std::sqrt(cb);
      }
    }
    return sum;
  }

  void set(std::span<double> out, std::size_t i, const InPlane& of_directions) const {
    for (std::size_t k = 0; k < sheet_.channels.size(); ++k)
      out[k * rows_.count + i] =
          std::inner_product(of_directions.begin(), of_directions.end(), sheet_.channels[k].begin(), 0.0);
  }

  std::size_t first_overflow(const TestOutput& output) const {
    std::size_t first = rows_.count - 1;
    for (const auto& values : {output.values, output.jacobian, output.abscissa_derivative})
      for (std::size_t k = 0; k < values.size(); ++k)
        if (!std::isfinite(values[k])) first = std::min(first, k % rows_.count);
    return first;
  }

  Sheet sheet_;
  std::vector<std::span<const double>> bound_;
  TestRows rows_;
  TestDescription description_;
};

using Role = Observable::Role;
using Kind = Observable::Kind;

TestFactory factory() {
  return {
      "biaxial",
      "A thin sheet stretched along the circumferential and the axial direction, its faces free.",
      "Holzapfel & Ogden, Math. Mech. Solids 14:474 (2009)",
      {Option::choice("protocol", {"general", "equibiaxial", "pure_shear"}, "general",
                      "Which stretches the data have: both (general), one for both directions (equibiaxial), or one "
                      "while the other is held at 1 (pure_shear)."),
       Option::choice("direction", {"circumferential", "axial"}, "circumferential",
                      "The direction that is pulled in pure shear; the other protocols do not ask for it."),
       Option::quantity("angle", "deg", -360,
                        "Turn of the sheet's circumferential and axial axes from those of the material, from axial "
                        "towards circumferential. Clamps keep the sheet from shearing.",
                        0.0)},
      {{"stretch_circumferential", "1", Role::abscissa, false, "Circumferential stretch (protocol general).",
        Kind::stretch},
       {"stretch_axial", "1", Role::abscissa, false, "Axial stretch (protocol general).", Kind::stretch},
       {"stretch", "1", Role::abscissa, false, "The one stretch of the protocols equibiaxial and pure_shear.",
        Kind::stretch},
       {"time", "s", Role::time, false, "Time since the unloaded state.", Kind::plain},
       {"stress_circumferential", "kPa", Role::channel, false, "Circumferential stress.", Kind::stress,
        "stretch_circumferential"},
       {"stress_axial", "kPa", Role::channel, false, "Axial stress.", Kind::stress, "stretch_axial"},
       {"stress", "kPa", Role::channel, false,
        "Stress along the pulled direction of pure_shear; mean of both directions in equibiaxial.", Kind::stress}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<Biaxial>(setup); },
      {}};
}

}  // namespace
}  // namespace tunica::biaxial

TUNICA_PLUGIN("biaxial", TUNICA_PLUGIN_VERSION) { registry.add(tunica::biaxial::factory()); }
