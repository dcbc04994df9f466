// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <new>
#include <utility>

#include "tunica/detail/vector_level.hpp"

namespace tunica::fe {

/// Memory that begins at a cache line, so that no vector of it lies across two. Of numbers that nobody gave it stays
/// untouched: a large factor takes seconds to be cleared at once, and is cleared block by block.
template <class T>
struct Aligned {
  using value_type = T;
  static constexpr std::align_val_t line{64};

  Aligned() = default;
  template <class U>
  explicit(false) Aligned(const Aligned<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, line); }
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
  friend bool operator==(const Aligned&, const Aligned&) { return true; }
};

/// Dense blocks of an L D Lᵀ factor. A panel is eight columns, from the first of its diagonals on, at a distance of
/// `height` from each other.
inline constexpr std::size_t panel = 8;

using Pair = double __attribute__((vector_size(16), may_alias));
using Four = double __attribute__((vector_size(32), may_alias));
using Eight = double __attribute__((vector_size(64), may_alias));

template <class Vector>
constexpr std::size_t lanes = sizeof(Vector) / sizeof(double);

/// The vector of so many lanes, and how many of them by how many columns the registers of its level sum up.
template <std::size_t Lanes>
struct Block;
template <>
struct Block<2> {
  using Vector = Pair;
  static constexpr std::size_t lanes = 2, vectors = 2, columns = 4;
};
template <>
struct Block<4> {
  using Vector = Four;
  static constexpr std::size_t lanes = 4, vectors = 2, columns = 4;
};
template <>
struct Block<8> {
  using Vector = Eight;
  static constexpr std::size_t lanes = 8, vectors = 1, columns = 8;
};

/// Runs a kernel with the Block of this library's level. It is a lambda that has to be inlined.
template <class Kernel>
void in_blocks(const Kernel& kernel) {
  detail::vectorised([&](auto count) __attribute__((always_inline)) { kernel(Block<count>()); });
}

template <class Vector>
[[gnu::always_inline]] inline Vector& at(double* place) {
  return *reinterpret_cast<Vector*>(place);
}
template <class Vector>
[[gnu::always_inline]] inline const Vector& at(const double* place) {
  return *reinterpret_cast<const Vector*>(place);
}

/// to −= Σ over `count` panels of L W. L is Vectors · lanes rows by 8 columns of a panel, W 8 rows by Columns; the sums
/// stay in registers.
template <class Vector, std::size_t Vectors, std::size_t Columns>
[[gnu::always_inline]] inline void subtract_products(double* to, std::size_t to_height, const double* L,
                                                     std::size_t height, std::size_t next_L, const double* W,
                                                     std::size_t count) {
  Vector sum[Vectors][Columns] = {};
  for (std::size_t s = 0; s < count; ++s, L += next_L, W += panel * panel) {
    const double* l = L;
    const double* w = W;
    for (std::size_t k = 0; k < panel; ++k, l += height, w += panel) {
      Vector x[Vectors];
      for (std::size_t i = 0; i < Vectors; ++i) x[i] = at<Vector>(l + i * lanes<Vector>);
      for (std::size_t q = 0; q < Columns; ++q)
        for (std::size_t i = 0; i < Vectors; ++i) sum[i][q] += x[i] * w[q];
    }
  }
  for (std::size_t q = 0; q < Columns; ++q)
    for (std::size_t i = 0; i < Vectors; ++i) at<Vector>(to + q * to_height + i * lanes<Vector>) -= sum[i][q];
}

/// to = the sums of neighbouring lanes of a and of b, in turn.
template <class Vector>
[[gnu::always_inline]] inline void add_neighbours(const Vector& a, const Vector& b, Vector& to) {
  if constexpr (lanes<Vector> == 2)
    to = __builtin_shufflevector(a, b, 0, 2) + __builtin_shufflevector(a, b, 1, 3);
  else if constexpr (lanes<Vector> == 4)
    to = __builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7);
  else
    to = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
         __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
}

/// to = the sums over the lanes of v[0], v[1], …, as many as lanes.
template <class Vector>
[[gnu::always_inline]] inline void sum_lanes(const Vector* v, Vector& to) {
  if constexpr (lanes<Vector> == 2) {
    add_neighbours(v[0], v[1], to);
  } else if constexpr (lanes<Vector> == 4) {
    Vector a, b;
    add_neighbours(v[0], v[1], a);
    add_neighbours(v[2], v[3], b);
    to = __builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7);
  } else {
    Vector pair[4], half[2];
    for (std::size_t i = 0; i < 4; ++i) add_neighbours(v[2 * i], v[2 * i + 1], pair[i]);
    for (std::size_t i = 0; i < 2; ++i)
      half[i] = __builtin_shufflevector(pair[2 * i], pair[2 * i + 1], 0, 1, 8, 9, 4, 5, 12, 13) +
                __builtin_shufflevector(pair[2 * i], pair[2 * i + 1], 2, 3, 10, 11, 6, 7, 14, 15);
    to = __builtin_shufflevector(half[0], half[1], 0, 1, 2, 3, 8, 9, 10, 11) +
         __builtin_shufflevector(half[0], half[1], 4, 5, 6, 7, 12, 13, 14, 15);
  }
}

/// A panel of `rows` rows becomes that of L and D, after what the panels before take from it: the block on the diagonal
/// column by column, then X L₁₁ᵀ D = A below. Columns from `exist` on become those of the unit matrix.
/// `pivots` are the inverse ones, `inverse` is that of L₁₁, by rows. Returns the number of negative pivots.
template <class Vector>
[[gnu::always_inline]] inline std::size_t factorise_panel(double* a, std::size_t height, std::size_t rows,
                                                          std::size_t exist, double* pivots, double* inverse) {
  constexpr std::size_t wide = lanes<Vector>, parts = panel / wide;
  std::size_t negative = 0;
  for (std::size_t q = 0; q < panel; ++q) {
    double* const l = a + q * height;
    if (q >= exist) l[q] = 1;
    negative += l[q] < 0;
    pivots[q] = 1 / l[q];
    const double pivot = l[q];
    for (std::size_t i = q / wide; i < parts; ++i) at<Vector>(l + i * wide) *= pivots[q];
    for (std::size_t c = q + 1; c < panel; ++c) {
      const double w = pivot * l[c];
      for (std::size_t i = c / wide; i < parts; ++i)
        at<Vector>(a + c * height + i * wide) -= at<Vector>(l + i * wide) * w;
    }
    l[q] = pivot;
  }
  for (std::size_t r = panel; r < rows; r += wide) {
    Vector x[panel];
    for (std::size_t q = 0; q < panel; ++q) x[q] = at<Vector>(a + q * height + r);
    for (std::size_t q = 0; q < panel; ++q) {
      for (std::size_t c = q + 1; c < panel; ++c) x[c] -= x[q] * a[q * height + c];
      at<Vector>(a + q * height + r) = x[q] * pivots[q];
    }
  }
  for (std::size_t i = 0; i < panel; ++i) {
    Vector row[parts] = {};
    row[i / wide][i % wide] = 1;
    for (std::size_t k = 0; k < i; ++k)
      for (std::size_t p = 0; p < parts; ++p) row[p] -= at<Vector>(inverse + k * panel + p * wide) * a[k * height + i];
    for (std::size_t p = 0; p < parts; ++p) at<Vector>(inverse + i * panel + p * wide) = row[p];
  }
  return negative;
}

/// y of the panel = L₁₁⁻¹ y, and the rows below lose their share of it.
template <class Vector>
[[gnu::always_inline]] inline void substitute_forward(const double* l, std::size_t height, std::size_t rows,
                                                      const double* inverse, double* y) {
  constexpr std::size_t wide = lanes<Vector>, parts = panel / wide;
  Vector dot[panel], own[parts];
  for (std::size_t i = 0; i < panel; ++i) {
    dot[i] = at<Vector>(inverse + i * panel) * at<Vector>(y);
    for (std::size_t p = 1; p < parts; ++p)
      dot[i] += at<Vector>(inverse + i * panel + p * wide) * at<Vector>(y + p * wide);
  }
  for (std::size_t p = 0; p < parts; ++p) sum_lanes(dot + p * wide, own[p]);
  for (std::size_t p = 0; p < parts; ++p) at<Vector>(y + p * wide) = own[p];
  for (std::size_t r = panel; r < rows; r += wide) {
    Vector even = at<Vector>(l + r) * own[0][0], odd = at<Vector>(l + height + r) * own[1 / wide][1 % wide];
    for (std::size_t q = 2; q < panel; q += 2) {
      even += at<Vector>(l + q * height + r) * own[q / wide][q % wide];
      odd += at<Vector>(l + (q + 1) * height + r) * own[(q + 1) / wide][(q + 1) % wide];
    }
    at<Vector>(y + r) -= even + odd;
  }
}

/// y of the panel = L₁₁⁻ᵀ (D⁻¹ y − L₂₁ᵀ y₂).
template <class Vector>
[[gnu::always_inline]] inline void substitute_backward(const double* l, std::size_t height, std::size_t rows,
                                                       const double* inverse, const double* pivots, double* y) {
  constexpr std::size_t wide = lanes<Vector>, parts = panel / wide;
  Vector dot[panel] = {}, own[parts], solved[parts] = {};
  for (std::size_t r = rows; r > panel; r -= wide)  // what was solved last comes last
    for (std::size_t q = 0; q < panel; ++q) dot[q] += at<Vector>(l + q * height + r - wide) * at<Vector>(y + r - wide);
  for (std::size_t p = 0; p < parts; ++p) {
    sum_lanes(dot + p * wide, own[p]);
    own[p] = at<Vector>(y + p * wide) * at<Vector>(pivots + p * wide) - own[p];
  }
  for (std::size_t c = 0; c < panel; ++c)
    for (std::size_t p = 0; p < parts; ++p)
      solved[p] += at<Vector>(inverse + c * panel + p * wide) * own[c / wide][c % wide];
  for (std::size_t p = 0; p < parts; ++p) at<Vector>(y + p * wide) = solved[p];
}

/// Operations between two questions whether it is late: some hundredths of a second.
inline constexpr double between_questions = 5e7;

}  // namespace tunica::fe
