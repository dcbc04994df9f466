// SPDX-License-Identifier: Apache-2.0
// Baek, Gleason, Rajagopal, Humphrey (2007), Comput. Methods Appl. Mech. Eng. 196:3070–3078,
// doi 10.1016/j.cma.2006.06.018: the diagonal families of Holzapfel, Gasser, Ogden, and one along each axis,
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1] + Σ_{a=z,t} k1_a/(2 k2_a) [exp(k2_a E_a²) − 1],
//
// E_i = I_i − 1, E_z = C_zz − 1, E_t = C_tt − 1.
#include "tunica/models/arterial_fibres.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, k1_axial, k2_axial, k1_circumferential, k2_circumferential, parameter_count };

/// A parameter of one of the families along an axis.
Parameter of_family(const std::string& family, Parameter (*parameter)(const std::string&)) {
  Parameter own = parameter(family);
  own.name += "_" + family;
  own.reference = "Baek, Gleason, Rajagopal, Humphrey 2007";
  return own;
}

EnergyParts parts(const Options& options) {
  using Diagonal = arterial::AlignedFibres<theta>;
  return energy_parts(isotropic::neo_hookean<parameter_count>(mu),
                      arterial::fibres<Diagonal, parameter_count>({theta}, {k1, k2}, options),
                      arterial::single_fibres<0, parameter_count>("axial_fibres", {k1_axial, k2_axial}, options),
                      arterial::single_fibres<90, parameter_count>("circumferential_fibres",
                                                                   {k1_circumferential, k2_circumferential}, options));
}

CardEnergy card(const Options& options, std::span<const double> p) {
  FibreEnergy energy = arterial::card_of_pair(p[mu], {p[theta], p[k1], p[k2]}, options);
  energy.families.push_back({0, p[k1_axial], p[k2_axial]});
  energy.families.push_back({90, p[k1_circumferential], p[k2_circumferential]});
  return energy;
}

}  // namespace

TUNICA_PLUGIN("four_fibre", TUNICA_PLUGIN_VERSION) {
  registry.add(with_card(
      hyperelastic_factory(
          {.type = "four_fibre",
           .parameters = {arterial::mu(), arterial::k1(), arterial::k2(), arterial::theta(),
                          of_family("axial", arterial::k1), of_family("axial", arterial::k2),
                          of_family("circumferential", arterial::k1), of_family("circumferential", arterial::k2)}},
          "Four fibre families in a neo-Hookean matrix: a diagonal pair, an axial and a circumferential one.",
          "Baek, Gleason, Rajagopal, Humphrey, Comput. Methods Appl. Mech. Eng. 196:3070 (2007)", parts,
          {arterial::fibre_switch()}),
      card));
}
