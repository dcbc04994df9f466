// SPDX-License-Identifier: Apache-2.0
// Fung, Fronek, Patitucci (1979), Am. J. Physiol. 237:H620–H631: an exponential of a quadratic form in the
// Green–Lagrange strains E = (C − 1)/2 of the wall,
//
//   W = c/2 (e^Q − 1),   Q = a1 E_tt² + a2 E_zz² + 2 a4 E_tt E_zz,
//
// and with radial strain (Chuong, Fung 1983, J. Biomech. Eng. 105:268–274)
//
//   Q += a3 E_rr² + 2 a5 E_zz E_rr + 2 a6 E_rr E_tt.
//
// Shear (Humphrey 1995, Crit. Rev. Biomed. Eng. 23:1–162) adds 2 a7 E_tz² + 2 a8 E_zr² + 2 a9 E_tr². Where a7 to a9 are
// no parameters, each is what isotropy in its plane would ask for: a7 = (a1 + a2)/2 − a4, and so on. They are positive
// where Q is positive definite.
//
// The material is incompressible: tests add a pressure, so that `plane` needs no radial strain. Where a1 = a2 = 2 a4 it
// is isotropic for small strains.
#include <numbers>
#include <utility>

#include "tunica/models/joint_energy.hpp"

namespace {

using namespace tunica;

enum class Form { plane, wall, wall_with_shear };
/// Parameters of the largest form; the others lack the last ones, and `plane` has a4 in the place of a3.
enum { c, a1, a2, a3, a4, a5, a6, a7, a8, a9, all_parameters };

const char *const fung_1979 = "Fung, Fronek, Patitucci, Am. J. Physiol. 237:H620 (1979)",
                  *const chuong_fung = "Chuong, Fung, J. Biomech. Eng. 105:268 (1983)",
                  *const humphrey = "Humphrey, Crit. Rev. Biomed. Eng. 23:1 (1995)";

template <Form form>
struct Fung {
  static constexpr auto type = "fung", doc = "Artery wall, an exponential of a quadratic form in Green strains.",
                        reference = "Fung, Fronek, Patitucci, Am. J. Physiol. 237:H620 (1979)";
  static constexpr bool is_plane = form == Form::plane, has_shear = form == Form::wall_with_shear;
  static constexpr std::size_t parameter_count = is_plane ? 4 : has_shear ? all_parameters : 7;
  static constexpr std::size_t invariant_count = 6;

  static std::vector<Parameter> parameters() {
    const auto square = [](const char* name, double initial, const char* doc, const char* source) {
      return Parameter{name, "1", initial, 1e-3, 100, Scale::log, doc, source};
    };
    const auto product = [](const char* name, const char* doc, const char* source) {
      return Parameter{name, "1", 0.1, -10, 100, Scale::linear, doc, source};
    };
    std::vector<Parameter> all{{"c", "kPa", 20, 0.01, 1e4, Scale::log, "Stiffness of the exponential.", fung_1979},
                               square("a1", 1, "Weight of E_tt^2.", fung_1979),
                               square("a2", 0.5, "Weight of E_zz^2.", fung_1979)};
    if (!is_plane) all.push_back(square("a3", 0.1, "Weight of E_rr^2.", chuong_fung));
    all.push_back(product("a4", "Half the weight of E_tt E_zz.", fung_1979));
    if (is_plane) return all;
    all.push_back(product("a5", "Half the weight of E_zz E_rr.", chuong_fung));
    all.push_back(product("a6", "Half the weight of E_rr E_tt.", chuong_fung));
    if (!has_shear) return all;
    all.push_back(square("a7", 1, "Half the weight of E_tz^2.", humphrey));
    all.push_back(square("a8", 1, "Half the weight of E_zr^2.", humphrey));
    all.push_back(square("a9", 1, "Half the weight of E_tr^2.", humphrey));
    return all;
  }

  /// The nine coefficients at their places above.
  template <class T>
  static std::array<T, all_parameters> coefficients(std::span<const T> p) {
    std::array<T, all_parameters> a{};
    for (std::size_t j = 0; j < parameter_count; ++j) a[j] = p[j];
    if constexpr (is_plane) std::swap(a[a3], a[a4]);
    if constexpr (!has_shear) {
      a[a7] = 0.5 * (a[a1] + a[a2]) - a[a4];
      a[a8] = 0.5 * (a[a2] + a[a3]) - a[a5];
      a[a9] = 0.5 * (a[a3] + a[a1]) - a[a6];
    }
    return a;
  }

  /// Q is positive definite in the normal strains: its leading minors.
  static std::vector<Combination> admissible() {
    const auto a = [](std::span<const double> p) { return coefficients(p); };
    const auto minor = [a](std::span<const double> p) {
      const auto k = a(p);
      return k[a1] * k[a2] - k[a4] * k[a4];
    };
    std::vector<Combination> all{{"a1 a2 - a4^2", "1", {1, 2, is_plane ? 3u : 4u}, minor, ""}};
    if (!is_plane)
      all.push_back({"det of a1 to a6",
                     "1",
                     {a1, a2, a3, a4, a5, a6},
                     [a, minor](std::span<const double> p) {
                       const auto k = a(p);
                       return k[a3] * minor(p) - k[a1] * k[a5] * k[a5] - k[a2] * k[a6] * k[a6] +
                              2 * k[a4] * k[a5] * k[a6];
                     },
                     ""});
    return all;
  }

  /// E_tt, E_zz, E_rr, E_tz, E_zr, E_tr. At 45 degrees M·CM = (C_tt + C_zz)/2 + C_tz, and C_tt + C_zz = I1 − C_rr.
  template <class T>
  static std::array<InvariantOf<T>, invariant_count> invariants(std::span<const T>) {
    const T half(0.5), quarter(0.25), t(std::numbers::pi / 2);
    return {{{.fibre = half, .offset = -half, .angle = t},
             {.fibre = half, .offset = -half},
             {.normal = half, .offset = -half},
             {.i1 = -quarter, .fibre = half, .normal = quarter, .angle = T(std::numbers::pi / 4)},
             {.across = half},
             {.across = half, .angle = t}}};
  }
  template <class T>
  static T energy(std::span<const T> E, std::span<const T> p) {
    using std::exp;
    const auto a = coefficients(p);
    T Q = a[a1] * E[0] * E[0] + a[a2] * E[1] * E[1] + 2.0 * a[a4] * E[0] * E[1];
    if constexpr (!is_plane) Q += a[a3] * E[2] * E[2] + 2.0 * a[a5] * E[1] * E[2] + 2.0 * a[a6] * E[2] * E[0];
    Q += 2.0 * (a[a7] * E[3] * E[3] + a[a8] * E[4] * E[4] + a[a9] * E[5] * E[5]);
    return 0.5 * a[c] * (exp(Q) - 1.0);
  }
};

}  // namespace

TUNICA_PLUGIN("fung", TUNICA_PLUGIN_VERSION) {
  using Plane = Fung<Form::plane>;
  const Option choice = Option::choice(
      "form", {"plane", "wall", "wall_with_shear"}, "plane",
      "Strains with parameters: in the plane (a1, a2, a4), radial ones too (to a6), all with shear (to a9).");
  const auto create = [](const Options& options) -> std::unique_ptr<Model> {
    const std::string& form = options.text("form");
    if (form == "wall") return std::make_unique<JointEnergy<Fung<Form::wall>>>();
    if (form == "wall_with_shear") return std::make_unique<JointEnergy<Fung<Form::wall_with_shear>>>();
    return std::make_unique<JointEnergy<Plane>>();
  };
  registry.add(ModelFactory{Plane::type, Plane::doc, Plane::reference, {choice}, create});
}
