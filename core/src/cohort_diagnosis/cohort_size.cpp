// SPDX-License-Identifier: Apache-2.0
#include "cohort_diagnosis/cohort_size.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::cohort_diagnosis {
namespace {

/// Squares averaged over specimens.
double together(std::span<const SpecimenEvidence* const> specimens, double SpecimenEvidence::*share) {
  double sum = 0;
  for (const SpecimenEvidence* one : specimens) sum += std::pow(one->*share, 2) / static_cast<double>(specimens.size());
  return std::sqrt(sum);
}

}  // namespace

CohortSize size_of(std::span<const SpecimenEvidence* const> specimens) {
  CohortSize found;
  found.rms = together(specimens, &SpecimenEvidence::rms);
  found.tolerance.share = together(specimens, &SpecimenEvidence::tolerance);
  // Where specimens know it in different ways, the one that says least is that of the cohort.
  found.tolerance.origin = diagnosis::Tolerance::Origin::stated;
  for (const SpecimenEvidence* one : specimens)
    found.tolerance.origin = std::max(found.tolerance.origin, one->tolerance_origin);
  if (found.tolerance.origin == diagnosis::Tolerance::Origin::standard) {
    std::vector<const std::vector<Outline>*> outlines;
    for (const SpecimenEvidence* one : specimens) outlines.push_back(&one->outlines);
    if (const auto spread = spread_between(outlines)) found.tolerance = {*spread, diagnosis::Tolerance::Origin::cohort};
  }
  found.within = static_cast<std::size_t>(std::count_if(
      specimens.begin(), specimens.end(), [&](const auto* one) { return one->rms_upper <= found.tolerance.share; }));
  return found;
}

}  // namespace tunica::cohort_diagnosis
