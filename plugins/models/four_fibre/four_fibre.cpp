// SPDX-License-Identifier: Apache-2.0
// Baek, Gleason, Rajagopal, Humphrey (2007), Comput. Methods Appl. Mech. Eng. 196:3070–3078,
// doi 10.1016/j.cma.2006.06.018: the diagonal families of Holzapfel, Gasser, Ogden, and one along each axis,
//
//   W = μ/2 (I1 − 3) + k1/(2 k2) Σ_{i=4,6} [exp(k2 E_i²) − 1] + Σ_{a=z,t} k1_a/(2 k2_a) [exp(k2_a E_a²) − 1],
//
// E_i = I_i − 1, E_z = C_zz − 1, E_t = C_tt − 1.
#include "tunica/models/arterial_fibres.hpp"

namespace {

using namespace tunica;
enum { mu, k1, k2, theta, k1_axial, k2_axial, k1_circumferential, k2_circumferential, parameter_count };

struct Fibres {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    InvariantOf<T> e;
    e.fibre = T(1);
    e.offset = T(-1);
    e.angle = p[theta] * degree;
    return e;
  }
};

Parameter of_family(Parameter parameter, const std::string& family) {
  parameter.name += "_" + family;
  parameter.doc.insert(parameter.doc.find("fibres"), family + " ");
  parameter.reference = "Baek, Gleason, Rajagopal, Humphrey 2007";
  return parameter;
}

std::unique_ptr<Model> create(const Options& options) {
  ModelDescription description;
  description.type = "four_fibre";
  description.parameters = {arterial::mu(),
                            arterial::k1(),
                            arterial::k2(),
                            arterial::theta(),
                            of_family(arterial::k1(), "axial"),
                            of_family(arterial::k2(), "axial"),
                            of_family(arterial::k1(), "circumferential"),
                            of_family(arterial::k2(), "circumferential")};
  std::vector<std::unique_ptr<EnergyPart>> parts;
  parts.push_back(isotropic::neo_hookean<parameter_count>(mu));
  parts.push_back(arterial::fibres<Fibres, parameter_count>({theta}, {k1, k2}, options));
  parts.push_back(arterial::single_fibres<0, parameter_count>("axial_fibres", {k1_axial, k2_axial}, options));
  parts.push_back(arterial::single_fibres<90, parameter_count>("circumferential_fibres",
                                                               {k1_circumferential, k2_circumferential}, options));
  return std::make_unique<Hyperelastic>(std::move(description), std::move(parts));
}

}  // namespace

TUNICA_PLUGIN("four_fibre", TUNICA_PLUGIN_VERSION) {
  registry.add(tunica::ModelFactory{
      "four_fibre",
      "Four fibre families in a neo-Hookean matrix: a diagonal pair, an axial and a circumferential one.",
      "Baek, Gleason, Rajagopal, Humphrey, Comput. Methods Appl. Mech. Eng. 196:3070 (2007)",
      {tunica::arterial::fibre_switch()},
      create});
}
