// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <numeric>

#include "compressible.hpp"
#include "response.hpp"
#include "sheet.hpp"
#include "tunica/detail/compressible_prediction.hpp"
#include "tunica/detail/vector_level.hpp"
#include "tunica/detail/vector_math.hpp"
#include "tunica/plugin.hpp"

namespace tunica::biaxial {
namespace {

/// Positions of the tangent's components (a, b) in the order tt, zz, rr, tz, zr, tr.
constexpr std::array<std::array<std::size_t, 3>, 3> place{{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};

bool all_finite(std::span<const double> values) { return detail::all_finite(values.data(), values.size()); }

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
    description_.volume = TestDescription::Volume::either;
    rows_.count = sheet_.count();
    for (std::size_t k = 0; k < sheet_.columns.size(); ++k) {
      rows_.abscissae.push_back({sheet_.names[k], sheet_.columns[k]});
      bound_.push_back(sheet_.columns[k]);
    }
    rows_.channels = setup.rows.channels;
    rows_.time = sheet_.time;
    c_.resize(3 * rows_.count);
    set_stretches(bound_, c_);
  }

  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const auto columns = input.abscissae.empty() ? std::span<const std::span<const double>>(bound_) : input.abscissae;
    return free_faces::by_volume(
        input, output,
        [&](const TestInput& at, const TestOutput& out) { return predict_at_constant_volume(columns, at, out); },
        [&](const TestInput& at, const TestOutput& out) { return predict_compressible(sheet_, columns, at, out); });
  }

 private:
  Status predict_at_constant_volume(std::span<const std::span<const double>> columns, const TestInput& input,
                                    const TestOutput& output) const {
    const ModelDescription& model = input.model.describe();
    const Response::Wants wants{!output.abscissa_derivative.empty(), !output.jacobian.empty()};
    const bool followed = model.axis_history_size > 0 && sheet_.angle == 0;
    if (model.history_size > 0 && (wants.tangent || (wants.parameters && !followed)))
      return Status::failed("biaxial: no exact Jacobian along the path of a model with history");
    if (!model.parameter_derivatives && !followed && wants.parameters)
      return Status::failed("biaxial: the model has no parameter derivatives");
    const std::size_t n = rows_.count, rows = sheet_.channels.size() * n, parameters = input.model_parameters.size();

    thread_local Response r;
    r.reserve(n, parameters);
    if (input.abscissae.empty())
      std::copy(c_.begin(), c_.end(), r.c.begin());
    else
      set_stretches(columns, r.c);
    if (!output.diagnostics.empty())
      for (std::size_t i = 0; i < n; ++i) output.diagnostics[i] = std::sqrt(r.c[2 * n + i]);
    if (Status status = r.evaluate(input.model, input.model_parameters, sheet_.time, n, sheet_.angle, wants);
        !status.ok())
      return status;
    if (sheet_.angle != 0 && !output.diagnostics.empty())  // σ_tz = λt λz S_tz
      for (std::size_t i = 0; i < n; ++i) output.diagnostics[n + i] = std::sqrt(r.c[i] * r.c[n + i]) * r.shear[i];

    r.set_factors(n, sheet_.power);
    if (const std::size_t bad = first_undefined(r); bad < n)
      return Status::failed("biaxial: the energy overflows or is undefined at " + sheet_.row_name(columns, bad));
    if (!output.values.empty()) write(r, r.stress.data(), output.values);
    for (std::size_t j = 0; wants.parameters && j < parameters; ++j)
      write(r, r.stress_dp.data() + 3 * j * n, output.jacobian.subspan(j * rows, rows));
    for (std::size_t k = 0; wants.tangent && k < columns.size(); ++k)
      for (std::size_t i = 0; i < n; ++i)
        set(output.abscissa_derivative.subspan(k * rows, rows), i, by_column(r, i, k));
    if (!all_finite(output.values) || !all_finite(output.jacobian) || !all_finite(output.abscissa_derivative))
      return Status::failed("biaxial: a stress or its derivative overflows, first at " +
                            sheet_.row_name(columns, first_overflow(output)));
    return {};
  }

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

  /// c_a S_aa − c_r S_rr
  InPlane cauchy(const Response& r, std::size_t i) const {
    const std::size_t n = rows_.count;
    const double normal = r.c[2 * n + i] * r.stress[2 * n + i];
    return {r.c[i] * r.stress[i] - normal, r.c[n + i] * r.stress[n + i] - normal};
  }

  /// The first row where σ_t + σ_z is not finite, or the number of rows.
  std::size_t first_undefined(const Response& r) const {
    const std::size_t n = rows_.count;
    const auto is_undefined = [this, &r](std::size_t i) {
      const InPlane stress = cauchy(r, i);
      return !std::isfinite(stress[0] + stress[1]);
    };
    std::size_t undefined = 0;
    for (std::size_t i = 0; i < n; ++i) undefined += is_undefined(i) ? 1u : 0u;
    std::size_t first = undefined > 0 ? 0 : n;
    while (first < n && !is_undefined(first)) ++first;
    return first;
  }

  /// Every channel of S, or of a derivative of S at fixed stretches, in the data's measure.
  void write(const Response& r, const double* S, std::span<double> out) const {
    const std::size_t n = rows_.count;
    for (std::size_t k = 0; k < sheet_.channels.size(); ++k) {
      const auto [t, z] = sheet_.channels[k];
      const double *const c = r.c.data(), *const factor = r.factor.data();
      double* const to = out.data() + k * n;
      detail::vectorised([=, t = t, z = z] {
        TUNICA_LANES
        for (std::size_t i = 0; i < n; ++i) {
          const double normal = c[2 * n + i] * S[2 * n + i];
          to[i] = t * factor[i] * (c[i] * S[i] - normal) + z * factor[n + i] * (c[n + i] * S[n + i] - normal);
        }
      });
    }
  }

  /// Stresses in the data's measure by abscissa k. With l_b = ln λ_b: ∂c_b/∂l_b = 2 c_b and ∂c_r/∂l_b = −2 c_r, hence
  ///   ∂S_xx/∂l_b = A_xb c_b − A_xr c_r with A = 2 ∂S/∂C.
  InPlane by_column(const Response& r, std::size_t i, std::size_t k) const {
    const std::size_t n = rows_.count;
    const InPlane stress = cauchy(r, i);
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
        sum[a] += along * r.factor[a * n + i] * by_l / std::sqrt(cb);
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
  std::vector<double> c_;  ///< squared stretches of the bound rows, as Response::c
  TestRows rows_;
  TestDescription description_;
};

using Role = Observable::Role;
using Kind = Observable::Kind;

/// Sheets pulled equally, and twice as far in one direction.
std::vector<PlannedTest> plan(const PlanningScope& scope) {
  const double edge = 1 + 0.7 * (scope.reach - 1), half = 1 + (edge - 1) / 2;
  const auto sheet = [](const char* description, double circumferential, double axial) {
    return PlannedTest{
        description,
        {{"protocol", std::string("general")}},
        {{"stretch_circumferential", even_steps(1, circumferential)}, {"stretch_axial", even_steps(1, axial)}},
        {},
        {"stress_circumferential", "stress_axial"}};
  };
  return {sheet("a sheet stretched equally in both directions", edge, edge),
          sheet("a sheet stretched twice as far along the circumference as along the axis", edge, half),
          sheet("a sheet stretched twice as far along the axis as along the circumference", half, edge)};
}

TestFactory factory() {
  TestFactory made{
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
      {},
      false,
      {},
      plan};
  made.specimen = Specimen::sheet;
  made.first_choice = true;
  return made;
}

}  // namespace
}  // namespace tunica::biaxial

TUNICA_PLUGIN("biaxial", TUNICA_PLUGIN_VERSION) { registry.add(tunica::biaxial::factory()); }
