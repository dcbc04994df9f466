// SPDX-License-Identifier: Apache-2.0
#include "banded.hpp"

#include <algorithm>
#include <utility>

namespace tunica::fe {

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

double Banded::row_times(std::size_t i, std::span<const double> x) const {
  double sum = 0;
  for (std::size_t j = i > width_ ? i - width_ : 0; j < i; ++j) sum += column(j)[i - j] * x[j];
  for (std::size_t j = i; j < std::min(size_, i + width_ + 1); ++j) sum += column(i)[j - i] * x[j];
  return sum;
}

void Banded::fix(std::size_t i, double diagonal) {
  std::fill_n(column(i), width_ + 1, 0.0);
  for (std::size_t j = i > width_ ? i - width_ : 0; j < i; ++j) a_[j * stride_ + i - j] = 0;
  *column(i) = diagonal;
}

std::optional<std::size_t> Banded::factorise(const std::function<bool()>& late) {
  constexpr double between = 5e7;  // operations between two questions: some hundredths of a second
  const double cost = 2.0 * block * static_cast<double>(width_ * width_);
  const auto every = static_cast<std::size_t>(between / cost) + 1;
  std::size_t negative = 0, asked = 0;
  // Entries of column j beyond the band are zero up to the stride, so that a block of columns has equal lengths.
  for (std::size_t j = 0; j < size_; j += block) {
    if (late && ++asked % every == 0 && late()) return {};
    double* __restrict__ const l0 = column(j);
    double* __restrict__ const l1 = column(j + 1);
    double* __restrict__ const l2 = column(j + 2);
    double* __restrict__ const l3 = column(j + 3);
    double d[block];
    double* const panel[block] = {l0, l1, l2, l3};
    for (std::size_t q = 0; q < block; ++q) {
      double* const l = panel[q];
      for (std::size_t p = 0; p < q; ++p) {
        const double w = d[p] * panel[p][q - p];
        const double* const other = panel[p] + (q - p);
        for (std::size_t i = 0; i <= width_ - (q - p); ++i) l[i] -= w * other[i];
      }
      d[q] = j + q < size_ ? l[0] : 1;
      negative += d[q] < 0;
      const double inverse = 1 / d[q];
      for (std::size_t i = 1; i <= width_; ++i) l[i] *= inverse;
    }
    const std::size_t last = std::min(j + block - 1 + width_, size_ - 1);
    for (std::size_t c = j + block; c <= last; ++c) {
      const std::size_t at = c - j;
      const double w0 = d[0] * l0[at], w1 = d[1] * l1[at - 1], w2 = d[2] * l2[at - 2], w3 = d[3] * l3[at - 3];
      double* __restrict__ const a = column(c);
      const double* __restrict__ const p0 = l0 + at;
      const double* __restrict__ const p1 = l1 + at - 1;
      const double* __restrict__ const p2 = l2 + at - 2;
      const double* __restrict__ const p3 = l3 + at - 3;
      const std::size_t m = width_ + block - at;  // rows c … j + 3 + width
      for (std::size_t i = 0; i < m; ++i) a[i] -= (w0 * p0[i] + w1 * p1[i]) + (w2 * p2[i] + w3 * p3[i]);
    }
  }
  return negative;
}

void Banded::solve(std::span<double> x) const {
  thread_local std::vector<double> padded;
  padded.assign(size_ + width_ + 2 * block, 0.0);
  std::copy(x.begin(), x.end(), padded.begin());
  const std::size_t blocks = (size_ + block - 1) / block;
  for (std::size_t b = 0; b < blocks; ++b) {
    const double* const l0 = column(block * b);
    const double* const l1 = column(block * b + 1);
    const double* const l2 = column(block * b + 2);
    const double* const l3 = column(block * b + 3);
    double* __restrict__ const y = padded.data() + block * b;
    y[1] -= l0[1] * y[0];
    y[2] -= l0[2] * y[0] + l1[1] * y[1];
    y[3] -= l0[3] * y[0] + l1[2] * y[1] + l2[1] * y[2];
    const double y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3];
    for (std::size_t i = block; i < width_ + block; ++i)
      y[i] -= (l0[i] * y0 + l1[i - 1] * y1) + (l2[i - 2] * y2 + l3[i - 3] * y3);
  }
  for (std::size_t j = 0; j < size_; ++j) padded[j] /= *column(j);
  for (std::size_t b = blocks; b-- > 0;) {
    const double* const l0 = column(block * b);
    const double* const l1 = column(block * b + 1);
    const double* const l2 = column(block * b + 2);
    const double* const l3 = column(block * b + 3);
    double* const y = padded.data() + block * b;
    double s0[2] = {}, s1[2] = {}, s2[2] = {}, s3[2] = {};
    for (std::size_t i = block; i < width_ + block; i += 2)
      for (std::size_t k = 0; k < 2; ++k) {  // beyond the band both L and y are zero, or belong to nobody
        s0[k] += l0[i + k] * y[i + k];
        s1[k] += l1[i + k - 1] * y[i + k];
        s2[k] += l2[i + k - 2] * y[i + k];
        s3[k] += l3[i + k - 3] * y[i + k];
      }
    y[3] -= s3[0] + s3[1];
    y[2] -= s2[0] + s2[1] + l2[1] * y[3];
    y[1] -= s1[0] + s1[1] + l1[1] * y[2] + l1[2] * y[3];
    y[0] -= s0[0] + s0[1] + l0[1] * y[1] + l0[2] * y[2] + l0[3] * y[3];
  }
  std::copy_n(padded.data(), size_, x.begin());
}

}  // namespace tunica::fe
