// SPDX-License-Identifier: Apache-2.0
#include "factor.hpp"

namespace tunica::fe {
namespace {

/// Operations of small fronts take so many times those of a band, as measured.
constexpr double price = 1.5;

FactorCost cost_of_band(const Mesh& mesh) {
  const auto size = static_cast<double>(2 * mesh.nodes()), width = static_cast<double>(Stencil::width_of(mesh));
  return {size * width * width / 2, Banded::bytes(2 * mesh.nodes(), Stencil::width_of(mesh)) / 8, 0};
}

}  // namespace

bool Factor::dissects(const Mesh& mesh) {
  return price * Dissection::cost(mesh).operations < cost_of_band(mesh).operations;
}

FactorCost Factor::cost(const Mesh& mesh) { return dissects(mesh) ? Dissection::cost(mesh) : cost_of_band(mesh); }

/// By dissection each entry has a place that is kept, too.
double Factor::bytes(const Mesh& mesh) { return cost(mesh).bytes() + (dissects(mesh) ? Stencil::bytes(mesh) : 0); }

std::optional<std::size_t> Factor::factorise(const Stencil& matrix, std::span<const std::size_t> fixed, double diagonal,
                                             const std::function<bool()>& late) {
  if (dissected_) {
    prepared_ = prepared_ || dissection_.prepare(mesh_, matrix, late);
    if (!prepared_) return {};
    return dissection_.factorise(matrix, fixed, diagonal, late);
  }
  matrix.spread(band_);
  for (const std::size_t position : fixed) band_.fix(position, diagonal);
  return band_.factorise(late);
}

void Factor::solve(std::span<const std::span<double>> x) const {
  if (dissected_)
    dissection_.solve(x);
  else
    band_.solve(x);
}

}  // namespace tunica::fe
