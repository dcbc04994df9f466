// SPDX-License-Identifier: Apache-2.0
#include "factor.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::plane {
namespace {

/// Eigen's factor of N unknowns of a plane mesh takes as long as so many times N^1.5 operations of the band, as
/// measured from 150 to 100 000 unknowns.
constexpr double price = 300;
constexpr double most_entries = 2e7;

bool band_is_cheaper(std::size_t size, std::size_t width) {
  const auto n = static_cast<double>(size), w = static_cast<double>(width);
  return n * w * w / 2 < price * std::pow(n, 1.5) && n * w < most_entries;
}

}  // namespace

Factor::Factor(const Body& body, const Eigen::SparseMatrix<double>& pattern) {
  const std::size_t unknowns = body.unknowns();
  std::vector<std::size_t> centre_of(unknowns, Body::none);
  std::vector<bool> centre(body.mesh().nodes.size(), false);
  for (const auto& element : body.mesh().elements) {
    const std::size_t x = body.unknown(2 * element[4]), y = body.unknown(2 * element[4] + 1);
    if (x == Body::none || y == Body::none) continue;  // on a plane of symmetry
    centre[element[4]] = true;
    centre_of[x] = centre_of[y] = centres_.size();
    centres_.push_back({{x, y}, {}, {}, {}, {}, {}});
    for (std::size_t a = 0; a < 9; ++a)
      for (std::size_t d = 0; d < 2; ++d)
        if (const std::size_t k = body.unknown(2 * element[a] + d); a != 4 && k != Body::none)
          centres_.back().around.push_back(static_cast<std::uint32_t>(k));
  }
  const std::vector<std::size_t> nodes = order(body, centre);
  position_.assign(unknowns, Body::none);
  std::size_t size = 0;
  for (const std::size_t node : nodes)
    for (std::size_t d = 0; d < 2; ++d)
      if (const std::size_t k = body.unknown(2 * node + d); k != Body::none) position_[k] = size++;
  std::size_t width = 0;
  const auto widen = [&](std::size_t i, std::size_t j) {
    if (position_[i] == Body::none || position_[j] == Body::none) return;
    width = std::max(width, position_[i] > position_[j] ? position_[i] - position_[j] : position_[j] - position_[i]);
  };
  for (Eigen::Index j = 0; j < pattern.outerSize(); ++j)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(pattern, j); entry; ++entry)
      widen(static_cast<std::size_t>(entry.row()), static_cast<std::size_t>(j));
  banded_ = size > 0 && band_is_cheaper(size, width);
  if (!banded_) {
    centres_.clear();
    sparse_.analyzePattern(pattern);
    return;
  }
  band_.resize(size, width);
  locate(pattern, centre_of);
}

/// Nodes but for centres, column by column from one end of the longer side to the other.
std::vector<std::size_t> Factor::order(const Body& body, const std::vector<bool>& centre) {
  const std::vector<Vector>& nodes = body.mesh().nodes;
  std::array<double, 2> size{};
  for (std::size_t d = 0; d < 2; ++d) {
    const auto by = [d](const Vector& a, const Vector& b) { return a[d] < b[d]; };
    const auto [least, largest] = std::minmax_element(nodes.begin(), nodes.end(), by);
    size[d] = (*largest)[d] - (*least)[d];
  }
  const std::size_t along = size[0] >= size[1] ? 0 : 1;
  const double same = 1e-9 * size[along];
  std::vector<std::pair<std::array<double, 2>, std::size_t>> sorted;
  for (std::size_t a = 0; a < nodes.size(); ++a)
    if (!centre[a]) sorted.push_back({{std::round(nodes[a][along] / same), nodes[a][1 - along]}, a});
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::size_t> found;
  for (const auto& [where, node] : sorted) found.push_back(node);
  return found;
}

std::uint32_t Factor::place(std::size_t i, std::size_t j) {
  const auto [low, high] = std::minmax(position_[i], position_[j]);
  return static_cast<std::uint32_t>(band_.column(low) + (high - low) - band_.column(0));
}

void Factor::locate(const Eigen::SparseMatrix<double>& pattern, const std::vector<std::size_t>& centre_of) {
  band_size_ = static_cast<std::size_t>(band_.column(band_.padded_size() - 1) + 1 - band_.column(0));
  std::size_t inner = 0;
  for (Centre& one : centres_) {
    first_inner_.push_back(inner);
    inner += 3 + 2 * one.around.size();
    one.coupling.resize(2 * one.around.size());
    one.scaled.resize(2 * one.around.size());
    for (std::size_t a = 0; a < one.around.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b) one.places.push_back(place(one.around[a], one.around[b]));
  }
  inner_.assign(inner, 0);
  const auto inside = [&](std::size_t i, std::size_t j) {
    if (position_[i] != Body::none) std::swap(i, j);  // i of a centre
    const std::size_t c = centre_of[i];
    const Centre& one = centres_[c];
    const std::size_t d = i == one.unknowns[1] ? 1 : 0;
    if (position_[j] == Body::none) return first_inner_[c] + d + (j == one.unknowns[1] ? 1 : 0);
    const auto a = static_cast<std::size_t>(
        std::find(one.around.begin(), one.around.end(), static_cast<std::uint32_t>(j)) - one.around.begin());
    return first_inner_[c] + 3 + 2 * a + d;
  };
  for (Eigen::Index column = 0; column < pattern.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(pattern, column); entry; ++entry) {
      const auto i = static_cast<std::size_t>(entry.row()), j = static_cast<std::size_t>(column);
      const bool outside = position_[i] != Body::none && position_[j] != Body::none;
      target_.push_back(outside ? place(i, j) : static_cast<std::uint32_t>(band_size_ + inside(i, j)));
    }
}

bool Factor::factorise(const Eigen::SparseMatrix<double>& K) {
  if (!banded_) {
    sparse_.factorize(K);
    return sparse_.info() == Eigen::Success;
  }
  band_.clear();
  double* const band = band_.column(0);
  const double* const value = K.valuePtr();
  for (std::size_t k = 0; k < target_.size(); ++k)
    (target_[k] < band_size_ ? band[target_[k]] : inner_[target_[k] - band_size_]) = value[k];
  for (std::size_t c = 0; c < centres_.size(); ++c) {
    Centre& one = centres_[c];
    const double* const K_cc = &inner_[first_inner_[c]];
    const double det = K_cc[0] * K_cc[2] - K_cc[1] * K_cc[1];
    if (det == 0 || !std::isfinite(det)) return false;
    one.inverse = {K_cc[2] / det, -K_cc[1] / det, K_cc[0] / det};
    std::copy_n(K_cc + 3, one.coupling.size(), one.coupling.begin());
    const auto [p, q, r] = one.inverse;
    std::size_t at = 0;
    for (std::size_t a = 0; a < one.around.size(); ++a) {
      const double x = one.coupling[2 * a], y = one.coupling[2 * a + 1];
      const double sx = one.scaled[2 * a] = x * p + y * q, sy = one.scaled[2 * a + 1] = x * q + y * r;
      for (std::size_t b = 0; b <= a; ++b)
        band[one.places[at++]] -= sx * one.coupling[2 * b] + sy * one.coupling[2 * b + 1];
    }
  }
  return band_.factorise().has_value();
}

void Factor::solve(Eigen::MatrixXd& x) const {
  if (!banded_) {
    x = sparse_.solve(x).eval();
    return;
  }
  Eigen::MatrixXd y(static_cast<Eigen::Index>(band_.size()), x.cols());
  std::vector<std::span<double>> columns;
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const auto b = x.col(k);
    for (const Centre& one : centres_) {
      const double p = b[static_cast<Eigen::Index>(one.unknowns[0])], q = b[static_cast<Eigen::Index>(one.unknowns[1])];
      for (std::size_t a = 0; a < one.around.size(); ++a)
        x(one.around[a], k) -= one.scaled[2 * a] * p + one.scaled[2 * a + 1] * q;
    }
    for (std::size_t i = 0; i < position_.size(); ++i)
      if (position_[i] != Body::none)
        y(static_cast<Eigen::Index>(position_[i]), k) = x(static_cast<Eigen::Index>(i), k);
    columns.emplace_back(&y(0, k), band_.size());
  }
  band_.solve(columns);
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    for (std::size_t i = 0; i < position_.size(); ++i)
      if (position_[i] != Body::none)
        x(static_cast<Eigen::Index>(i), k) = y(static_cast<Eigen::Index>(position_[i]), k);
    for (const Centre& one : centres_) {
      double p = x(static_cast<Eigen::Index>(one.unknowns[0]), k), q = x(static_cast<Eigen::Index>(one.unknowns[1]), k);
      for (std::size_t a = 0; a < one.around.size(); ++a) {
        p -= one.coupling[2 * a] * x(one.around[a], k);
        q -= one.coupling[2 * a + 1] * x(one.around[a], k);
      }
      const auto [u, v, w] = one.inverse;
      x(static_cast<Eigen::Index>(one.unknowns[0]), k) = u * p + v * q;
      x(static_cast<Eigen::Index>(one.unknowns[1]), k) = v * p + w * q;
    }
  }
}

}  // namespace tunica::plane
