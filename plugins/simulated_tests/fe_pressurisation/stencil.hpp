// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "banded.hpp"
#include "mesh.hpp"

namespace tunica::fe {

/// A symmetric matrix over the positions of a mesh, its lower half by columns, with entries for nodes that share an
/// element alone: a fifth of the band at 25 × 50 elements, a twentieth at 100 × 400.
///
/// Below the diagonal follow the rest of the node's own plane within an element, then of each of the next planes what
/// an element reaches on both sides.
class Stencil {
 public:
  void resize(const Mesh& mesh);
  void clear() { std::fill(a_.begin(), a_.end(), 0.0); }
  /// Of the band that a mesh makes.
  static std::size_t width_of(const Mesh& mesh) { return 2 * (mesh.order * mesh.across() + mesh.order) + 1; }
  /// Bytes of a matrix of that mesh.
  static double bytes(const Mesh& mesh);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Of the band around it.
  [[nodiscard]] std::size_t width() const { return width_; }
  /// Entry (j + below, j) stands at column(j)[slot(below)].
  [[nodiscard]] double* column(std::size_t j) { return a_.data() + j * slots(); }
  [[nodiscard]] const double* column(std::size_t j) const { return a_.data() + j * slots(); }
  /// Of entry (i, j), i ≥ j, from column(0) on.
  [[nodiscard]] std::size_t place(std::size_t i, std::size_t j) const { return j * slots() + slot(i - j); }
  /// slots() if there is no entry.
  [[nodiscard]] std::size_t slot(std::size_t below) const;
  /// Adds to (i, j) and thereby to (j, i), which share an element.
  void add(std::size_t i, std::size_t j, double value) {
    if (i < j) std::swap(i, j);
    column(j)[slot(i - j)] += value;
  }
  /// (i, j) for i ≥ j.
  [[nodiscard]] double entry(std::size_t i, std::size_t j) const {
    const std::size_t at = slot(i - j);
    return at < slots() ? column(j)[at] : 0;
  }

  /// Entry i of A x.
  [[nodiscard]] double row_times(std::size_t i, std::span<const double> x) const;
  /// y = A x.
  void multiply(std::span<const double> x, std::span<double> y) const;
  /// The same matrix as a band.
  void spread(Banded& band) const;

 private:
  [[nodiscard]] std::size_t slots() const { return below_.size(); }

  std::size_t size_ = 0, width_ = 0, own_ = 0, each_ = 0;
  std::vector<std::size_t> below_;  ///< of each slot, ascending by planes
  std::vector<std::size_t> first_;  ///< of each plane after the own one
  std::vector<double> a_;
};

}  // namespace tunica::fe
