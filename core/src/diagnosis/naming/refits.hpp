// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/detection/analysis.hpp"
#include "diagnosis/hypotheses/extension.hpp"

namespace tunica::diagnosis {

/// Mechanisms fitted at finite amplitude beside all parameters.
struct Refit {
  std::vector<Addition> additions;
  std::shared_ptr<const Extension> extension;
  Fit fit;
};

/// Fits the parameters again with the additions, from what the linearisation says and from a smaller amplitude; none
/// where neither can be evaluated. `amplitudes` are differences from the nulls (even: squares). With `from`, a refit
/// with all additions but the last, first from where that one ended. Nuisance parameters are fitted, or stay as the
/// additions have them.
enum class Nuisance { fitted, held };
std::optional<Refit> fit_with(const Inquiry& inquiry, const Analysis& analysis, std::vector<Addition> additions,
                              std::span<const double> amplitudes, const Refit* from = nullptr,
                              Nuisance nuisance = Nuisance::fitted);

/// A missing effect may drive a parameter of the base fit to a bound, and a refit with the effect may not leave it. For
/// example, at θ = 0 two families of fibres coincide, and the derivative vanishes. If the base fit has such a
/// parameter, the refit starts again from the best of many random points, and the better result counts. It ends below
/// `enough`.
Refit searched_again(const Inquiry& inquiry, const Analysis& analysis, Refit refit, double enough = 0);

}  // namespace tunica::diagnosis
