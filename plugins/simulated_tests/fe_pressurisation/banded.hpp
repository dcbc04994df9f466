// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "panels.hpp"

namespace tunica::fe {

/// A symmetric band matrix, its lower half: entries (i, j), 0 ≤ i − j ≤ width.
///
/// A structured mesh numbered along its short side needs no ordering, no index and no pivoting. Eight columns make a
/// panel, a dense matrix of `height` rows from the first of its diagonals on, by columns: whatever the band cuts off
/// is zero. Then the factorisation is one of small dense blocks, which the vector units of the machine work through in
/// registers.
class Banded {
 public:
  void resize(std::size_t size, std::size_t width);
  void clear() { clear(0, padded_size()); }
  /// Columns `from` up to `to`.
  void clear(std::size_t from, std::size_t to) { std::fill(a_.data() + from * height_, a_.data() + to * height_, 0.0); }
  /// Columns with those of zeros that fill up the last panel.
  [[nodiscard]] std::size_t padded_size() const { return panels() * panel; }
  /// Bytes of a matrix of that size.
  static double bytes(std::size_t size, std::size_t width) {
    return 8. * static_cast<double>(size + panel) * static_cast<double>(width + 2 * panel);
  }

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Entry (i, j) at column(j)[i − j].
  [[nodiscard]] double* column(std::size_t j) { return a_.data() + place(j); }
  [[nodiscard]] const double* column(std::size_t j) const { return a_.data() + place(j); }
  /// Adds to (i, j) and thereby to (j, i).
  void add(std::size_t i, std::size_t j, double value) {
    if (i < j) std::swap(i, j);
    column(j)[i - j] += value;
  }

  /// y = A x.
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// Row and column i become those of the unit matrix, times `diagonal`.
  void fix(std::size_t i, double diagonal);

  /// A becomes L D Lᵀ in place, without pivoting; L below the diagonal, D on it. Returns the number of negative
  /// pivots, which is that of negative eigenvalues; a pivot of zero leaves numbers that are not finite. `late` is
  /// asked now and then; where it says yes, nothing is returned and A is of no use.
  std::optional<std::size_t> factorise(const std::function<bool()>& late = {});
  /// x = (L D Lᵀ)⁻¹ x.
  void solve(std::span<double> x) const { solve({&x, 1}); }
  /// The same for several x, each panel being read once for all of them.
  void solve(std::span<const std::span<double>> x) const;

 private:
  [[nodiscard]] std::size_t place(std::size_t j) const {
    return j / panel * panel * height_ + j % panel * (height_ + 1);
  }
  [[nodiscard]] std::size_t panels() const { return (size_ + panel - 1) / panel; }
  // What works on wide vectors has to be inlined into the kernel of its level, else it has the instructions of none.
  template <class Vector, std::size_t Vectors, std::size_t Columns>
  [[gnu::always_inline]] inline std::optional<std::size_t> by_blocks(const std::function<bool()>& late);
  std::optional<std::size_t> by_panels(const std::function<bool()>& late);
  template <class Vector>
  [[gnu::always_inline]] inline std::size_t factorise_panel_at(std::size_t J);
  void subtract_panel(std::size_t at);
  template <class Vector>
  [[gnu::always_inline]] inline void substitute(std::span<double* const> x) const;

  std::size_t size_ = 0, width_ = 0, height_ = 0;
  std::vector<double, Aligned<double>> a_, scaled_;  ///< scaled_: D Lᵀ of the rows of a panel
  /// Of each panel the inverse of L on the diagonal, by rows, and those of D.
  std::vector<double, Aligned<double>> inverse_, inverse_pivot_;
};

}  // namespace tunica::fe
