// SPDX-License-Identifier: Apache-2.0
// Holzapfel, Ogden (2009), Phil. Trans. R. Soc. A 367:3445–3475, doi 10.1098/rsta.2009.0091, eq. (5.38), myocardium
// with fibres f, sheets s across them, and the normal n of both:
//
//   W = a/(2b) {exp[b (I1 − 3)] − 1} + Σ_{i=f,s} a_i/(2b_i) {exp[b_i ⟨I4i − 1⟩²] − 1}
//       + a_fs/(2b_fs) {exp[b_fs I8²] − 1},   I4i = i·C i,  I8 = f·C s,  ⟨x⟩ = max(x, 0).
//
// Fibres lie in the wall, f = sin θ e_t + cos θ e_z. Sheets stand across the wall, s = e_r, or lie in it,
// s = cos θ e_t − sin θ e_z. In the wall I8 is M·CM at θ + 45° less (C_ff + C_ss)/2, and C_ff + C_ss = I1 − C_rr.
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/convex_laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { a, b, a_f, b_f, a_s, b_s, a_fs, b_fs, theta, parameter_count };
using Role = EnergyPart::Role;
using Active = EnergyPart::Active;

struct RadialSheet {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T>) {
    return {.normal = T(1), .offset = T(-1)};
  }
};
struct SheetInTheWall {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.fibre = T(1), .offset = T(-1), .angle = (p[theta] + 90.0) * degree};
  }
};
struct RadialCoupling {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.across = T(1), .angle = p[theta] * degree};
  }
};
struct CouplingInTheWall {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.i1 = T(-0.5), .fibre = T(1), .normal = T(0.5), .angle = (p[theta] + 45.0) * degree};
  }
};

template <class Geometry>
std::unique_ptr<EnergyPart> exponential(const char* name, Role role, Active active,
                                        std::vector<std::size_t> of_invariant, std::vector<std::size_t> of_law) {
  return std::make_unique<LawPart<laws::Exponential, Geometry, parameter_count>>(
      EnergyPart::Description{name, role, active, false, std::move(of_invariant), std::move(of_law), false});
}

/// Fibres are those of the role `fibre` that lie in the wall: mechanisms of fibres change nothing else.
EnergyParts parts(const Options& options) {
  constexpr Active pulled = Active::argument_positive;
  auto matrix = isotropic::part<laws::GrowingExponential, isotropic::FirstInvariant, parameter_count>("matrix", {a, b});
  auto fibres = exponential<arterial::AlignedFibres<theta>>("fibres", Role::fibre, pulled, {theta}, {a_f, b_f});
  if (options.text("sheet") == "radial")
    return energy_parts(std::move(matrix), std::move(fibres),
                        exponential<RadialSheet>("sheets", Role::matrix, pulled, {}, {a_s, b_s}),
                        exponential<RadialCoupling>("coupling", Role::matrix, Active::always, {theta}, {a_fs, b_fs}));
  return energy_parts(std::move(matrix), std::move(fibres),
                      exponential<SheetInTheWall>("sheets", Role::fibre, pulled, {theta}, {a_s, b_s}),
                      exponential<CouplingInTheWall>("coupling", Role::matrix, Active::always, {theta}, {a_fs, b_fs}));
}

ModelDescription description() {
  const char* const source =
      "Holzapfel, Ogden 2009, table 1, from the shear of porcine myocardium by Dokos et al. 2002";
  const auto stiffness = [source](const char* name, double initial, const char* doc) {
    return Parameter{name, "kPa", initial, 1e-3, 1000, Scale::log, doc, source};
  };
  const auto rate = [source](const char* name, double initial, const char* doc) {
    return Parameter{name, "1", initial, 1e-3, 100, Scale::log, doc, source};
  };
  return {.type = "holzapfel_ogden",
          .parameters = {stiffness("a", 0.059, "Shear modulus of the matrix."),
                         rate("b", 8.023, "How fast the matrix stiffens."),
                         stiffness("a_f", 18.472, "Stiffness of the fibres."),
                         rate("b_f", 16.026, "How fast the fibres stiffen."),
                         stiffness("a_s", 2.481, "Stiffness along the sheets, across the fibres."),
                         rate("b_s", 11.12, "How fast the sheets stiffen."),
                         stiffness("a_fs", 0.216, "Stiffness against shear between fibres and sheets."),
                         rate("b_fs", 11.436, "How fast that shear stiffens."),
                         {"theta", "deg", 90, 0, 180, Scale::linear, "Angle of the fibres from the axial direction.",
                          "Holzapfel, Ogden 2009"}}};
}

}  // namespace

TUNICA_PLUGIN("holzapfel_ogden", TUNICA_PLUGIN_VERSION) {
  registry.add(hyperelastic_factory(
      description(), "Myocardium: fibres, sheets across them, and the shear between both (Holzapfel–Ogden).",
      "Holzapfel, Ogden, Phil. Trans. R. Soc. A 367:3445 (2009)", parts,
      {Option::choice("sheet", {"radial", "in_plane"}, "radial",
                      "Where sheets extend to from the fibres: across the wall, or in it at a right angle.")}));
}
