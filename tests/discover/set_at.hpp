// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "discovery/bound_set.hpp"
#include "discovery/set_fit.hpp"

namespace tunica::trial {

/// A set of terms that no search has fitted, with its parameters as they are given. It has no evidence.
inline discovery::SetFit set_at(const discovery::Subject& subject, const std::vector<discovery::KindPointer>& kinds,
                                const std::vector<double>& free) {
  discovery::SetFit one{kinds, std::make_shared<const discovery::BoundSet>(subject, kinds), {}, 0};
  const assembly::Assembly& assembly = one.set->assembly();
  one.fit.status =
      diagnosis::whitened(assembly, free, *assembly.evaluator().make_workspace(), one.fit.residuals, &one.fit.jacobian);
  one.fit.free = free;
  one.fit.chi2 = one.fit.residuals.squaredNorm();
  one.fit.at_bound.assign(free.size(), false);
  return one;
}

}  // namespace tunica::trial
