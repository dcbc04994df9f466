// SPDX-License-Identifier: Apache-2.0
#include "bases.hpp"

#include <algorithm>
#include <stdexcept>

namespace blind {
namespace {

using List = std::vector<BaseParameter>;

const BaseParameter mu{"mu", &Tissue::mu, 0.1, 200}, k1{"k1", &Tissue::k1, 0.01, 1000},
    k2{"k2", &Tissue::k2, 0.001, 100}, theta{"theta", &Tissue::theta, 0, 90, false, 30};

}  // namespace

const List& fitted(Base base) {
  static const List hgo{mu, k1, k2, theta}, gho{mu, k1, k2, theta, {"kappa", &Tissue::kappa, 0, 1. / 3, false, 0.1}},
      holzapfel{mu, k1, k2, {"A", &Tissue::A, 0, 1. / 3, false, 0.1}, {"B", &Tissue::B, 0, 1, false, 0.3}},
      four{mu,
           k1,
           k2,
           theta,
           {"k1_axial", &Tissue::axial_k, 0.01, 1000},
           {"k2_axial", &Tissue::axial_k2, 0.001, 100},
           {"k1_circumferential", &Tissue::around_k, 0.01, 1000},
           {"k2_circumferential", &Tissue::around_k2, 0.001, 100}},
      yeoh{{"c10", &Tissue::c10, 1, 10000},
           {"c20", &Tissue::c20, -50, 50, false, 5},
           {"c30", &Tissue::c30, -5, 5, false, 0.1}},
      ogden{{"mu_1", &Tissue::mu_1, 10, 5000},
            {"alpha_1", &Tissue::alpha_1, 0.3, 6, false},
            {"mu_2", &Tissue::mu_2, -500, -0.5, false, 10},
            {"alpha_2", &Tissue::alpha_2, -6, -0.3, false}};
  switch (base) {
    case Base::gho:
      return gho;
    case Base::holzapfel_2015:
      return holzapfel;
    case Base::four_fibre:
      return four;
    case Base::yeoh:
      return yeoh;
    case Base::ogden:
      return ogden;
    case Base::hgo:
      break;
  }
  return hgo;
}

/// Aligned tests see 2A + B and B cos 2θ only: the angle is what histology tells.
const List& held(Base base) {
  static const List nothing, angle{theta};
  return base == Base::holzapfel_2015 ? angle : nothing;
}

const std::vector<std::string>& base_names() {
  static const std::vector<std::string> all{"hgo", "gho", "holzapfel_2015", "four_fibre", "yeoh", "ogden"};
  return all;
}
const std::string& name_of(Base base) { return base_names()[static_cast<std::size_t>(base)]; }

Base base_called(const std::string& name) {
  const auto found = std::find(base_names().begin(), base_names().end(), name);
  if (found == base_names().end())
    throw std::invalid_argument("no base '" + name + "'; known: hgo, gho, holzapfel_2015, four_fibre, yeoh, ogden");
  return static_cast<Base>(found - base_names().begin());
}

bool isotropic(Base base) { return base == Base::yeoh || base == Base::ogden; }

}  // namespace blind
