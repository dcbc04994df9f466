// SPDX-License-Identifier: Apache-2.0
#include "stencil.hpp"

#include <algorithm>

namespace tunica::fe {

void Stencil::resize(const Mesh& mesh) {
  const std::size_t order = mesh.order;
  size_ = 2 * mesh.nodes();
  width_ = width_of(mesh);
  own_ = 2 * order + 2;
  each_ = 2 * (2 * order + 1) + 1;  // the column may be that of r or of z
  below_.clear();
  first_.clear();
  for (std::size_t k = 0; k < own_; ++k) below_.push_back(k);
  for (std::size_t plane = 1; plane <= order; ++plane) {
    first_.push_back(2 * (plane * mesh.across() - order) - 1);
    for (std::size_t k = 0; k < each_; ++k) below_.push_back(first_.back() + k);
  }
  a_.assign(size_ * slots(), 0.0);
}

double Stencil::bytes(const Mesh& mesh) {
  const std::size_t slots = 2 * mesh.order + 2 + mesh.order * (2 * (2 * mesh.order + 1) + 1);
  return 8. * static_cast<double>(2 * mesh.nodes() * slots);
}

std::size_t Stencil::slot(std::size_t below) const {
  if (below < own_) return below;
  for (std::size_t plane = 0; plane < first_.size(); ++plane)
    if (below >= first_[plane] && below - first_[plane] < each_) return own_ + plane * each_ + below - first_[plane];
  return slots();
}

double Stencil::row_times(std::size_t i, std::span<const double> x) const {
  double sum = 0;
  for (std::size_t k = slots(); k-- > 1;)
    if (below_[k] <= i) sum += column(i - below_[k])[k] * x[i - below_[k]];
  for (std::size_t k = 0; k < slots(); ++k)
    if (i + below_[k] < size_) sum += column(i)[k] * x[i + below_[k]];
  return sum;
}

void Stencil::multiply(std::span<const double> x, std::span<double> y) const {
  std::fill(y.begin(), y.end(), 0.0);
  for (std::size_t j = 0; j < size_; ++j) {
    const double* const a = column(j);
    double sum = a[0] * x[j];
    for (std::size_t k = 1; k < slots(); ++k) {
      const std::size_t i = j + below_[k];
      if (i >= size_) continue;
      sum += a[k] * x[i];
      y[i] += a[k] * x[j];
    }
    y[j] += sum;
  }
}

void Stencil::spread(Banded& band) const {
  if (band.size() != size_ || band.width() != width_) band.resize(size_, width_);
  band.clear(size_, band.padded_size());  // what fills up the last panel
  for (std::size_t j = 0; j < size_; ++j) {
    band.clear(j, j + 1);  // while it is in the cache
    const double* const a = column(j);
    double* const to = band.column(j);
    const std::size_t left = size_ - j;
    for (std::size_t k = 0; k < slots(); ++k)
      if (below_[k] < left && below_[k] <= width_) to[below_[k]] += a[k];
  }
}

}  // namespace tunica::fe
