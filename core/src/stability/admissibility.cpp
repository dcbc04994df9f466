// SPDX-License-Identifier: Apache-2.0
#include "stability/admissibility.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace tunica::stability {
namespace {

const char* direction(std::size_t axis) { return axis == 0 ? "circumferential" : "axial"; }

std::string words(const TransverseVerdict& verdict, const Domain& domain) {
  const char* const name = direction(verdict.axis);
  const std::string reach =
      verdict.measured_to > 1 ? fmt::format("{} to {:.4g}", domain.stated ? "judged" : "measured", verdict.measured_to)
                              : "no strip was measured";
  if (!verdict.first_unstable)
    return fmt::format("{} strip: the transverse stretch λ3 falls up to stretch {:.4g} ({})", name, verdict.checked_to,
                       reach);
  const std::string until = verdict.stable_again ? fmt::format(" to {:.4g}", *verdict.stable_again) : " on";
  if (!verdict.stable)
    return fmt::format("{} strip: UNSTABLE, the transverse stretch λ3 grows from stretch {:.4g}{} ({})", name,
                       *verdict.first_unstable, until, reach);
  if (*verdict.first_unstable < verdict.measured_to)
    return fmt::format("{} strip: stable at every measured stretch ({}); between them λ3 grows from stretch {:.5g}{}",
                       name, reach, *verdict.first_unstable, until);
  return fmt::format(
      "{} strip: the transverse stretch λ3 falls at first and grows from stretch {:.4g}{}, beyond that "
      "domain ({})",
      name, *verdict.first_unstable, until, reach);
}

std::string components(const std::array<double, 3>& v) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", v[0], v[1], v[2]);
}

}  // namespace

bool Admissibility::transversely_stable() const {
  return std::all_of(transverse.begin(), transverse.end(), [](const TransverseVerdict& v) { return v.stable; });
}

std::vector<std::string> Admissibility::sentences() const {
  std::vector<std::string> all;
  for (const TransverseVerdict& verdict : transverse) all.push_back(words(verdict, domain));
  if (ellipticity.first_lost)
    all.push_back(
        fmt::format("ELLIPTICITY IS LOST at stretch {:.4g} in {}: bands of normal {} would shear along {} "
                    "(components t, z, r)",
                    *ellipticity.first_lost, ellipticity.path, components(ellipticity.n), components(ellipticity.m)));
  else
    all.push_back(
        fmt::format("elliptic up to stretch {:.4g} in strips, equibiaxial extension and pure shear; weakest, "
                    "{:.3g} kPa, in {}",
                    domain.largest, ellipticity.weakest, ellipticity.path));
  if (drucker && drucker->first_lost)
    all.push_back(
        fmt::format("DRUCKER'S CONDITION IS LOST at stretch {:.4g} in {}", *drucker->first_lost, drucker->path));
  else if (drucker)
    all.push_back(fmt::format("Drucker-stable up to stretch {:.4g} in strips, equibiaxial extension and pure shear",
                              domain.largest));
  return all;
}

Admissibility judge(const Model& model, std::span<const double> parameters, const Domain& domain) {
  Admissibility found;
  found.domain = domain;
  for (std::size_t axis = 0; axis < 2; ++axis)
    found.transverse.push_back(
        judge(model, parameters, axis, domain.strips[axis], std::max(domain.beyond, domain.largest)));
  const auto paths = homogeneous_paths(model, parameters, domain.largest);
  found.ellipticity = judge_ellipticity(model, parameters, paths);
  if (is_isotropic(model, parameters)) found.drucker = judge_drucker(model, parameters, paths);
  return found;
}

}  // namespace tunica::stability
