// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "discovery/bound_set.hpp"

namespace tunica::discovery {

/// A term as a model of its own, of the plugin `composed`. A law is the same at constant volume, and that of a product
/// z is linear in z as in I1.
std::unique_ptr<Model> alone(const Subject& subject, const Kind& kind);

/// The free parameters of a term in the order of that model: amplitude, heights, shapes.
std::vector<std::size_t> parameters_of(const BoundTerm& term);

/// dψ/dx of a term at these x, kPa; not for stretches. `by_law`: its derivatives by the parameters of the law, that of
/// parameter j at [j·n + i].
std::vector<double> term_slopes(const Subject& subject, const Kind& kind, std::span<const double> own,
                                std::span<const double> x, std::vector<double>* by_law = nullptr);

}  // namespace tunica::discovery
