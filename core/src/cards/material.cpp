// SPDX-License-Identifier: Apache-2.0
#include "cards/material.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "text/lists.hpp"
#include "tunica/error.hpp"

namespace tunica::cards {

namespace {

constexpr std::array<std::string_view, 4> fibre_models{"hgo", "gho", "holzapfel_2015", "four_fibre"};

/// A family at ±theta counts as two.
void add_pair(const Material& material, double A, double B, std::vector<FibreFamily>& families) {
  const double theta = value_of(material, "theta"), k1 = value_of(material, "k1"), k2 = value_of(material, "k2");
  for (const double angle : {theta, -theta}) families.insert(families.end(), {angle, k1, k2, A, B});
}

}  // namespace

bool FibreFamily::without_normal() const { return std::abs(1 - 3 * A - B) < 1e-12; }

double value_of(const Material& material, const std::string& parameter) {
  const auto found = material.values.find(parameter);
  if (found == material.values.end()) {
    std::vector<std::string> given;
    for (const auto& [name, value] : material.values) given.insert(given.end(), name);
    throw InputError(fmt::format("model '{}': the parameter '{}' has no value, only {}; give every parameter one",
                                 material.type, parameter, given.empty() ? "nothing" : text::joined(given)));
  }
  if (!std::isfinite(found->second))
    throw InputError(fmt::format("model '{}': found {} for the parameter '{}', expected a finite number; give it one",
                                 material.type, found->second, parameter));
  return found->second;
}

std::vector<OgdenTerm> ogden_terms(const Material& material) {
  std::vector<OgdenTerm> terms;
  for (std::size_t k = 1; k == 1 || material.values.contains(fmt::format("mu_{}", k)); ++k) {
    terms.insert(terms.end(),
                 {value_of(material, fmt::format("mu_{}", k)), value_of(material, fmt::format("alpha_{}", k))});
    if (terms.back().alpha == 0)
      throw InputError(
          fmt::format("model '{}': the exponent alpha_{} is 0, and every program divides by it; keep it off 0 by its "
                      "bounds, or leave the term out",
                      material.type, k));
  }
  return terms;
}

bool is_foam(const Material& material) { return material.type == "hyperfoam" || material.type == "blatz_ko"; }

std::vector<FoamTerm> foam_terms(const Material& material) {
  if (material.type == "blatz_ko") {
    const double mu = value_of(material, "mu"), f = value_of(material, "f"), nu = value_of(material, "nu");
    std::vector<FoamTerm> terms;
    if (f != 0) terms.push_back({mu * f, 2, nu});
    if (f != 1) terms.push_back({mu * (1 - f), -2, nu});
    return terms;
  }
  std::vector<FoamTerm> terms;
  const bool shared = material.values.contains("nu");
  for (const OgdenTerm& term : ogden_terms(material))
    terms.push_back({term.mu, term.alpha, value_of(material, shared ? "nu" : fmt::format("nu_{}", terms.size() + 1))});
  return terms;
}

std::size_t mooney_terms(const Material& material) {
  const auto has = [&](const char* name) { return material.values.contains(name); };
  return has("c30") ? 9 : has("c20") ? 5 : has("c11") ? 3 : 2;
}

bool has_fibres(const Material& material) {
  return std::find(fibre_models.begin(), fibre_models.end(), material.type) != fibre_models.end();
}

FibreEnergy fibre_energy(const Material& material) {
  FibreEnergy energy{value_of(material, "mu"), {}};
  if (material.type == "gho") {
    const double kappa = value_of(material, "kappa");
    add_pair(material, kappa, 1 - 3 * kappa, energy.families);
  } else if (material.type == "holzapfel_2015") {
    add_pair(material, value_of(material, "A"), value_of(material, "B"), energy.families);
  } else {
    add_pair(material, 0, 1, energy.families);
  }
  if (material.type == "four_fibre") {
    energy.families.insert(energy.families.end(), {0, value_of(material, "k1_axial"), value_of(material, "k2_axial")});
    energy.families.insert(energy.families.end(),
                           {90, value_of(material, "k1_circumferential"), value_of(material, "k2_circumferential")});
  }
  return energy;
}

double stiffness_at_rest(const Material& material) {
  double stiffness = 0;
  if (has_fibres(material)) {
    const FibreEnergy energy = fibre_energy(material);
    double k1 = 0;
    for (const auto& family : energy.families) k1 = std::max(k1, family.k1);
    stiffness = energy.mu + 4 * k1;
  } else if (material.type == "mooney_rivlin") {
    stiffness = 2 * (value_of(material, "c10") + value_of(material, "c01"));
  } else if (material.type == "yeoh") {
    stiffness = 2 * value_of(material, "c10");
  } else if (is_foam(material)) {
    for (const auto& term : foam_terms(material)) stiffness += term.mu;
  } else if (material.type == "ogden") {
    for (const auto& term : ogden_terms(material)) stiffness += 0.5 * term.mu * term.alpha;
  } else {
    stiffness = value_of(material, "mu");
  }
  if (stiffness > 0) return stiffness;
  throw InputError(
      fmt::format("model '{}': found a shear modulus of {:g} kPa at rest, expected one above 0; check the parameters",
                  material.type, stiffness));
}

}  // namespace tunica::cards
