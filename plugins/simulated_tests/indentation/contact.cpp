// SPDX-License-Identifier: Apache-2.0
#include "contact.hpp"

#include <algorithm>
#include <cmath>

#include <ceres/jet.h>
#include <fmt/format.h>

namespace tunica::indentation {
namespace {

/// k, by χ.
template <class T>
T correction(const Contact& contact, const T& chi) {
  const T chi2 = chi * chi, chi3 = chi2 * chi;
  switch (contact.law) {
    case Law::half_space:
      break;
    case Law::bonded:
      return 1.0 + 1.133 * chi + 1.283 * chi2 + 0.769 * chi3 + 0.0975 * chi2 * chi2;
    case Law::sliding:
      return 1.0 + 0.884 * chi + 0.781 * chi2 + 0.386 * chi3 + 0.0048 * chi2 * chi2;
    case Law::deep: {
      // Published in two pieces, for R/h up to 2 and beyond.
      const double inverse = contact.thickness / contact.radius;
      const bool thin = inverse < 0.5;
      const double alpha = thin ? 9.5 : 10.05 - 0.63 * std::sqrt(inverse) * (3.1 + inverse * inverse),
                   beta = thin ? 4.212 : 4.8 - 4.23 * inverse * inverse;
      return (1.0 + 1.15 * chi + alpha * chi3 + beta * chi3 * chi3) / (1.0 + 2.3 * chi3);
    }
  }
  return T(1);
}

template <class T>
T force_over_modulus(const Contact& contact, const T& depth) {
  using std::sqrt;
  const T a = sqrt(contact.radius * depth);  // of the contact, to first order
  const T chi = contact.law == Law::half_space ? T(0) : T(a / contact.thickness);
  return 16.0 / 3.0 * a * depth * correction(contact, chi);
}

}  // namespace

double Contact::force(double depth) const { return depth > 0 ? force_over_modulus(*this, depth) : 0; }

double Contact::slope(double depth) const {
  using Jet = ceres::Jet<double, 1>;
  return depth > 0 ? force_over_modulus(*this, Jet(depth, 0)).v[0] : 0;
}

double Contact::deepest() const {
  constexpr double small = 0.1;  // of radius and thickness, where strains are small
  switch (law) {
    case Law::half_space:
      return small * radius;
    case Law::bonded:
    case Law::sliding:
      return small * std::min(radius, thickness);
    case Law::deep:
      break;
  }
  return std::min(0.6 * thickness, radius);
}

std::string Contact::objection() const {
  const double ratio = law == Law::half_space ? 1 : radius / thickness;
  const auto outside = [&](double least, double largest) {
    return ratio < least || ratio > largest
               ? fmt::format(
                     "the radius of the sphere is {:.3g} times the thickness of the layer, and the law holds from "
                     "{:g} to {:g} times",
                     ratio, least, largest)
               : std::string();
  };
  switch (law) {
    case Law::half_space:
      return {};
    case Law::bonded:
    case Law::sliding:
      return outside(0.078, 10);  // h from 0.1 R to 12.8 R
    case Law::deep:
      break;
  }
  return outside(0.3, 12.7);
}

}  // namespace tunica::indentation
