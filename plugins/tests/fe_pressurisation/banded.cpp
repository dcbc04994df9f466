// SPDX-License-Identifier: Apache-2.0
#include "banded.hpp"

#include "tunica/detail/vector_level.hpp"

namespace tunica::fe {
namespace {

using Pair = double __attribute__((vector_size(16), may_alias));
using Four = double __attribute__((vector_size(32), may_alias));
using Eight = double __attribute__((vector_size(64), may_alias));

template <class Vector>
constexpr std::size_t lanes = sizeof(Vector) / sizeof(double);

template <class Vector>
[[gnu::always_inline]] inline Vector& at(double* place) {
  return *reinterpret_cast<Vector*>(place);
}
template <class Vector>
[[gnu::always_inline]] inline const Vector& at(const double* place) {
  return *reinterpret_cast<const Vector*>(place);
}

/// to −= Σ over `count` panels of L W, L being Vectors · lanes rows by 8 columns of a panel, W 8 rows by Columns; the
/// sums stay in registers.
template <class Vector, std::size_t Vectors, std::size_t Columns>
[[gnu::always_inline]] inline void subtract_products(double* to, std::size_t height, const double* L,
                                                     std::size_t next_L, const double* W, std::size_t count) {
  constexpr std::size_t panel = 8;
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
    for (std::size_t i = 0; i < Vectors; ++i) at<Vector>(to + q * height + i * lanes<Vector>) -= sum[i][q];
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

/// Operations between two questions whether it is late: some hundredths of a second.
constexpr double between_questions = 5e7;

}  // namespace

void Banded::resize(std::size_t size, std::size_t width) {
  size_ = size;
  width_ = width;
  height_ = (width + panel - 1) / panel * panel + panel;
  a_.assign(panels() * panel * height_, 0.0);
}

void Banded::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t j = 0; j < size_; ++j) {
    const double* const a = column(j);
    const std::size_t m = std::min(width_, size_ - 1 - j);
    double sum = a[0] * x[j];
    for (std::size_t i = 1; i <= m; ++i) sum += a[i] * x[j + i];
    y[j] += sum;
    for (std::size_t i = 1; i <= m; ++i) y[j + i] += a[i] * x[j];
  }
}

void Banded::fix(std::size_t i, double diagonal) {
  std::fill_n(column(i), width_ + 1, 0.0);
  for (std::size_t j = i > width_ ? i - width_ : 0; j < i; ++j) column(j)[i - j] = 0;
  *column(i) = diagonal;
}

/// Panel `at` becomes that of L and D, its share of the panels before being subtracted already: the block on the
/// diagonal column by column, then X L₁₁ᵀ D = A below. Returns the number of negative pivots.
template <class Vector>
std::size_t Banded::factorise_panel(std::size_t at_panel) {
  constexpr std::size_t wide = lanes<Vector>, parts = panel / wide;
  const std::size_t height = height_;
  double* const a = a_.data() + at_panel * panel * height;
  std::size_t negative = 0;
  double* const inverse = inverse_pivot_.data() + at_panel * panel;
  for (std::size_t q = 0; q < panel; ++q) {
    double* const l = a + q * height;
    const bool exists = at_panel * panel + q < size_;
    if (!exists) l[q] = 1;
    negative += l[q] < 0;
    inverse[q] = 1 / l[q];
    const double pivot = l[q];
    for (std::size_t i = q / wide; i < parts; ++i) at<Vector>(l + i * wide) *= inverse[q];
    for (std::size_t c = q + 1; c < panel; ++c) {
      const double w = pivot * l[c];
      for (std::size_t i = c / wide; i < parts; ++i)
        at<Vector>(a + c * height + i * wide) -= at<Vector>(l + i * wide) * w;
    }
    l[q] = pivot;
  }
  for (std::size_t r = panel; r < height; r += wide) {
    Vector x[panel];
    for (std::size_t q = 0; q < panel; ++q) x[q] = at<Vector>(a + q * height + r);
    for (std::size_t q = 0; q < panel; ++q) {
      for (std::size_t c = q + 1; c < panel; ++c) x[c] -= x[q] * a[q * height + c];
      at<Vector>(a + q * height + r) = x[q] * inverse[q];
    }
  }
  // L₁₁⁻¹ by rows, L₁₁ having ones on the diagonal
  double* const rows = inverse_.data() + at_panel * panel * panel;
  for (std::size_t i = 0; i < panel; ++i) {
    Vector row[parts] = {};
    row[i / wide][i % wide] = 1;
    for (std::size_t k = 0; k < i; ++k)
      for (std::size_t p = 0; p < parts; ++p) row[p] -= at<Vector>(rows + k * panel + p * wide) * a[k * height + i];
    for (std::size_t p = 0; p < parts; ++p) at<Vector>(rows + i * panel + p * wide) = row[p];
  }
  return negative;
}

/// Each panel takes from those before at once: L D Lᵀ of a block of rows is summed up in registers.
template <class Vector, std::size_t Vectors, std::size_t Columns>
std::optional<std::size_t> Banded::by_blocks(const std::function<bool()>& late) {
  constexpr std::size_t rows = Vectors * lanes<Vector>;
  const std::size_t height = height_, each = panel * height, blocks = height / panel, count = panels();
  const auto every = static_cast<std::size_t>(between_questions / (panel * static_cast<double>(width_ * width_))) + 1;
  double* const a = a_.data();
  double* const scaled = scaled_.data();
  std::size_t negative = 0, asked = 0;
  for (std::size_t J = 0; J < count; ++J) {
    if (late && ++asked % every == 0 && late()) return {};
    const std::size_t first = J + 1 > blocks ? J + 1 - blocks : 0;
    for (std::size_t K = first; K < J; ++K) {
      const double* const l = a + K * each + (J - K) * panel;
      double* const w = scaled + (K - first) * panel * panel;
      for (std::size_t k = 0; k < panel; ++k)
        for (std::size_t q = 0; q < panel; ++q) w[k * panel + q] = a[K * each + k * (height + 1)] * l[k * height + q];
    }
    for (std::size_t I = J; I < J + blocks; ++I) {
      const std::size_t from = std::max(first, I + 1 > blocks ? I + 1 - blocks : 0);
      if (from >= J) break;
      for (std::size_t r = 0; r < panel; r += rows)
        for (std::size_t q = 0; q < panel; q += Columns)
          subtract_products<Vector, Vectors, Columns>(a + J * each + (I - J) * panel + r + q * height, height,
                                                      a + from * each + (I - from) * panel + r, each - panel,
                                                      scaled + (from - first) * panel * panel + q, J - from);
    }
    negative += factorise_panel<Vector>(J);
  }
  return negative;
}

/// What the columns of a panel take from those after it. With few registers it is faster than by_blocks().
void Banded::subtract_panel(std::size_t at_panel) {
  const std::size_t height = height_, first = at_panel * panel;
  const double* const l = a_.data() + first * height;
  const std::size_t end = std::min(panels() * panel, first + height);
  for (std::size_t c = first + panel; c < end; ++c) {
    const std::size_t below = c - first, m = height - below;
    double* __restrict__ const to = column(c);
    for (std::size_t q = 0; q < panel; q += 4) {
      const double* __restrict__ const p0 = l + q * height + below;
      const double* __restrict__ const p1 = p0 + height;
      const double* __restrict__ const p2 = p1 + height;
      const double* __restrict__ const p3 = p2 + height;
      const double w0 = l[q * (height + 1)] * *p0, w1 = l[(q + 1) * (height + 1)] * *p1,
                   w2 = l[(q + 2) * (height + 1)] * *p2, w3 = l[(q + 3) * (height + 1)] * *p3;
      for (std::size_t i = 0; i < m; ++i) to[i] -= (w0 * p0[i] + w1 * p1[i]) + (w2 * p2[i] + w3 * p3[i]);
    }
  }
}

std::optional<std::size_t> Banded::factorise(const std::function<bool()>& late) {
  using detail::VectorLevel;
  scaled_.resize(height_ * panel);
  inverse_.resize(panels() * panel * panel);
  inverse_pivot_.resize(panels() * panel);
  std::optional<std::size_t> negative;
  switch (detail::vector_level()) {
    case VectorLevel::avx512:
      detail::vectorised([&] { negative = by_blocks<Eight, 1, 8>(late); });
      return negative;
    case VectorLevel::avx2:
      detail::vectorised([&] { negative = by_blocks<Four, 2, 4>(late); });
      return negative;
    case VectorLevel::baseline:
      break;
  }
  const auto every = static_cast<std::size_t>(between_questions / (panel * static_cast<double>(width_ * width_))) + 1;
  negative = 0;
  for (std::size_t J = 0; J < panels(); ++J) {
    if (late && (J + 1) % every == 0 && late()) return {};
    *negative += factorise_panel<Pair>(J);
    subtract_panel(J);
  }
  return negative;
}

/// Forward, by D, and backward; x has zeros beyond the matrix.
template <class Vector>
void Banded::substitute(std::span<double* const> x) const {
  constexpr std::size_t wide = lanes<Vector>, parts = panel / wide;
  const std::size_t height = height_, count = panels();
  for (std::size_t J = 0; J < count; ++J) {
    const double* const l = a_.data() + J * panel * height;
    const double* const rows = inverse_.data() + J * panel * panel;
    for (double* const whole : x) {
      double* const y = whole + J * panel;
      Vector dot[panel], own[parts];
      for (std::size_t i = 0; i < panel; ++i) {
        dot[i] = at<Vector>(rows + i * panel) * at<Vector>(y);
        for (std::size_t p = 1; p < parts; ++p)
          dot[i] += at<Vector>(rows + i * panel + p * wide) * at<Vector>(y + p * wide);
      }
      for (std::size_t p = 0; p < parts; ++p) sum_lanes(dot + p * wide, own[p]);
      for (std::size_t p = 0; p < parts; ++p) at<Vector>(y + p * wide) = own[p];
      for (std::size_t r = panel; r < height; r += wide) {
        Vector even = at<Vector>(l + r) * own[0][0], odd = at<Vector>(l + height + r) * own[1 / wide][1 % wide];
        for (std::size_t q = 2; q < panel; q += 2) {
          even += at<Vector>(l + q * height + r) * own[q / wide][q % wide];
          odd += at<Vector>(l + (q + 1) * height + r) * own[(q + 1) / wide][(q + 1) % wide];
        }
        at<Vector>(y + r) -= even + odd;
      }
    }
  }
  for (std::size_t J = count; J-- > 0;) {
    const double* const l = a_.data() + J * panel * height;
    const double* const rows = inverse_.data() + J * panel * panel;
    const double* const pivots = inverse_pivot_.data() + J * panel;
    for (double* const whole : x) {
      double* const y = whole + J * panel;
      Vector dot[panel] = {}, own[parts], solved[parts] = {};
      for (std::size_t r = height; r > panel; r -= wide)  // what was solved last comes last
        for (std::size_t q = 0; q < panel; ++q)
          dot[q] += at<Vector>(l + q * height + r - wide) * at<Vector>(y + r - wide);
      for (std::size_t p = 0; p < parts; ++p) {
        sum_lanes(dot + p * wide, own[p]);
        own[p] = at<Vector>(y + p * wide) * at<Vector>(pivots + p * wide) - own[p];
      }
      for (std::size_t c = 0; c < panel; ++c)
        for (std::size_t p = 0; p < parts; ++p)
          solved[p] += at<Vector>(rows + c * panel + p * wide) * own[c / wide][c % wide];
      for (std::size_t p = 0; p < parts; ++p) at<Vector>(y + p * wide) = solved[p];
    }
  }
}

void Banded::solve(std::span<const std::span<double>> x) const {
  thread_local std::vector<double, Aligned<double>> padded;
  thread_local std::vector<double*> places;
  const std::size_t each = panels() * panel + height_;
  padded.assign(each * x.size(), 0.0);
  places.clear();
  for (std::size_t k = 0; k < x.size(); ++k) {
    places.push_back(padded.data() + k * each);
    std::copy(x[k].begin(), x[k].end(), places[k]);
  }
  const std::span<double* const> all(places);
  using detail::VectorLevel;
  switch (detail::vector_level()) {
    case VectorLevel::avx512:
      detail::vectorised([&] { substitute<Eight>(all); });
      break;
    case VectorLevel::avx2:
      detail::vectorised([&] { substitute<Four>(all); });
      break;
    case VectorLevel::baseline:
      substitute<Pair>(all);
  }
  for (std::size_t k = 0; k < x.size(); ++k) std::copy_n(places[k], x[k].size(), x[k].begin());
}

}  // namespace tunica::fe
