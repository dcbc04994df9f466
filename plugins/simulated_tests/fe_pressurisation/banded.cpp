// SPDX-License-Identifier: Apache-2.0
#include "banded.hpp"

namespace tunica::fe {
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

template <class Vector>
std::size_t Banded::factorise_panel_at(std::size_t J) {
  const std::size_t exist = std::min(panel, size_ - J * panel);
  return factorise_panel<Vector>(a_.data() + J * panel * height_, height_, height_, exist,
                                 inverse_pivot_.data() + J * panel, inverse_.data() + J * panel * panel);
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
                                                      a + from * each + (I - from) * panel + r, height, each - panel,
                                                      scaled + (from - first) * panel * panel + q, J - from);
    }
    negative += factorise_panel_at<Vector>(J);
  }
  return negative;
}

/// The update of later columns by the columns of a panel.
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

/// With few registers it is faster than by_blocks().
std::optional<std::size_t> Banded::by_panels(const std::function<bool()>& late) {
  const auto every = static_cast<std::size_t>(between_questions / (panel * static_cast<double>(width_ * width_))) + 1;
  std::size_t negative = 0;
  for (std::size_t J = 0; J < panels(); ++J) {
    if (late && (J + 1) % every == 0 && late()) return {};
    negative += factorise_panel_at<Pair>(J);
    subtract_panel(J);
  }
  return negative;
}

std::optional<std::size_t> Banded::factorise(const std::function<bool()>& late) {
  scaled_.resize(height_ * panel);
  inverse_.resize(panels() * panel * panel);
  inverse_pivot_.resize(panels() * panel);
  std::optional<std::size_t> negative;
  in_blocks([&](auto block) __attribute__((always_inline)) {
    using Kind = decltype(block);
    if constexpr (Kind::lanes == 2)
      negative = by_panels(late);
    else
      negative = by_blocks<typename Kind::Vector, Kind::vectors, Kind::columns>(late);
  });
  return negative;
}

/// x has zeros beyond the matrix.
template <class Vector>
void Banded::substitute(std::span<double* const> x) const {
  const double* const inverse = inverse_.data();
  for (std::size_t J = 0; J < panels(); ++J)
    for (double* const y : x)
      substitute_forward<Vector>(a_.data() + J * panel * height_, height_, height_, inverse + J * panel * panel,
                                 y + J * panel);
  for (std::size_t J = panels(); J-- > 0;)
    for (double* const y : x)
      substitute_backward<Vector>(a_.data() + J * panel * height_, height_, height_, inverse + J * panel * panel,
                                  inverse_pivot_.data() + J * panel, y + J * panel);
}

void Banded::solve(std::span<const std::span<double>> x) const {
  thread_local std::vector<double, Aligned<double>> padded;
  thread_local std::vector<double*> places;
  const std::size_t each = panels() * panel + height_;
  padded.resize(each * x.size());
  places.clear();
  for (std::size_t k = 0; k < x.size(); ++k) {
    places.push_back(padded.data() + k * each);
    std::fill(std::copy(x[k].begin(), x[k].end(), places[k]), places[k] + each, 0.0);
  }
  const std::span<double* const> all(places);
  in_blocks([&](auto block) __attribute__((always_inline)) { substitute<typename decltype(block)::Vector>(all); });
  for (std::size_t k = 0; k < x.size(); ++k) std::copy_n(places[k], x[k].size(), x[k].begin());
}

}  // namespace tunica::fe
