// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "banded.hpp"
#include "dissection.hpp"

namespace tunica::fe {

/// L D Lᵀ of the matrix of a mesh: of its band where that is narrow, else by nested dissection.
class Factor {
 public:
  explicit Factor(const Mesh& mesh) : mesh_(mesh), dissected_(dissects(mesh)) {}

  static bool dissects(const Mesh& mesh);
  static FactorCost cost(const Mesh& mesh);
  static double bytes(const Mesh& mesh);

  /// Rows and columns `fixed` of the matrix become those of the unit matrix, times `diagonal`; then as
  /// Banded::factorise().
  std::optional<std::size_t> factorise(const Stencil& matrix, std::span<const std::size_t> fixed, double diagonal,
                                       const std::function<bool()>& late);
  /// x = (L D Lᵀ)⁻¹ x.
  void solve(std::span<double> x) const { solve({&x, 1}); }
  void solve(std::span<const std::span<double>> x) const;

 private:
  const Mesh mesh_;
  const bool dissected_;
  bool prepared_ = false;
  Banded band_;
  Dissection dissection_;
};

}  // namespace tunica::fe
