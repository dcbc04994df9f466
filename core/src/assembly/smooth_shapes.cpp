// SPDX-License-Identifier: Apache-2.0
#include "assembly/smooth_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "numerics/orthogonal.hpp"

namespace tunica::assembly {
namespace {

using Abscissae = std::vector<std::pair<std::string, std::vector<double>>>;
using Rows = std::vector<std::size_t>;

constexpr double turned = 0.05;  ///< of the range of an abscissa
constexpr double still = 0.01;   ///< of its largest value: an abscissa that is held moves by less
constexpr std::size_t most_terms = 9, least_branch = 4;
constexpr double least_freedom = 4;

/// Places among `rows` at which a branch begins because `x` has turned at the place before.
std::vector<std::size_t> turns_of(const std::vector<double>& x, const Rows& rows) {
  double low = x[rows[0]], high = low, largest = 0;
  for (const std::size_t row : rows) {
    low = std::min(low, x[row]);
    high = std::max(high, x[row]);
    largest = std::max(largest, std::abs(x[row]));
  }
  const double enough = std::max(turned * (high - low), still * largest);
  std::vector<std::size_t> turns;
  std::size_t extreme = 0;  // the last one, or how far the path has come since
  int heading = 0;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    const double way = x[rows[k]] - x[rows[extreme]];
    if (heading == 0 ? std::abs(way) > enough : heading * way > 0) {
      heading = way > 0 ? 1 : -1;
      extreme = k;
    } else if (heading != 0 && -heading * way > enough) {
      turns.push_back(extreme + 1);
      heading = -heading;
      extreme = k;
    }
  }
  return turns;
}

/// 1 if x is monotonic along the branch, near 0 if it only jitters.
double straightness(const std::vector<double>& x, const Rows& branch) {
  double travelled = 0;
  for (std::size_t k = 1; k < branch.size(); ++k) travelled += std::abs(x[branch[k]] - x[branch[k - 1]]);
  return travelled > 0 ? std::abs(x[branch.back()] - x[branch.front()]) / travelled : 0;
}

std::vector<Rows> branches_of(const Rows& rows, const Abscissae& abscissae) {
  std::vector<bool> begins(rows.size(), false);
  for (const auto& [name, x] : abscissae) {
    const std::vector<std::size_t> turns = turns_of(x, rows);
    if ((turns.size() + 1) * least_branch > rows.size()) continue;  // trembles rather than turns
    for (const std::size_t place : turns) begins[place] = true;
  }
  std::vector<Rows> branches(1);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (begins[k]) branches.emplace_back();
    branches.back().push_back(rows[k]);
  }
  return branches;
}

/// Residual sums of squares of a branch with 0, 1, … `most_terms` Chebyshev polynomials, as far as half the rows allow.
std::array<double, most_terms + 1> squares_left(std::span<const double> values, const Abscissae& abscissae,
                                                const Rows& branch) {
  const auto n = static_cast<Eigen::Index>(branch.size());
  const auto terms = static_cast<Eigen::Index>(std::min(most_terms, branch.size() / 2));
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1, 1), y(n);
  double most = 0;
  for (const auto& [name, column] : abscissae) {
    const double own = straightness(column, branch);
    if (own <= most) continue;
    most = own;
    double low = column[branch[0]], high = low;
    for (const std::size_t row : branch) {
      low = std::min(low, column[row]);
      high = std::max(high, column[row]);
    }
    for (Eigen::Index i = 0; i < n; ++i)
      x[i] = 2 * (column[branch[static_cast<std::size_t>(i)]] - low) / (high - low) - 1;
  }
  for (Eigen::Index i = 0; i < n; ++i) y[i] = values[branch[static_cast<std::size_t>(i)]];
  Eigen::MatrixXd shapes(n, terms);
  for (Eigen::Index k = 0; k < terms; ++k)
    shapes.col(k) = k == 0   ? Eigen::VectorXd::Ones(n)
                    : k == 1 ? x
                             : Eigen::VectorXd(2 * x.cwiseProduct(shapes.col(k - 1)) - shapes.col(k - 2));
  const Eigen::VectorXd along = numerics::rotated(shapes, y);
  std::array<double, most_terms + 1> left{};
  for (std::size_t k = 0; k < left.size(); ++k) {
    const Eigen::Index taken = std::min(static_cast<Eigen::Index>(k), terms);
    left[k] = along.tail(n - taken).squaredNorm();
  }
  return left;
}

}  // namespace

std::optional<SmoothScatter> smooth_scatter(std::span<const double> values, const Abscissae& abscissae,
                                            const std::vector<bool>& fitted) {
  Rows rows;
  for (std::size_t i = 0; i < fitted.size(); ++i)
    if (fitted[i]) rows.push_back(i);
  if (rows.size() < least_branch) return {};
  std::array<double, most_terms + 1> squares{}, freedom{};
  for (const Rows& branch : branches_of(rows, abscissae)) {
    if (branch.size() < least_branch) continue;  // little more than its own shape
    const auto left = squares_left(values, abscissae, branch);
    for (std::size_t k = 1; k <= most_terms; ++k) {
      squares[k] += left[k];
      freedom[k] += static_cast<double>(branch.size() - std::min(k, branch.size() / 2));
    }
  }
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k <= most_terms; ++k) {
    if (freedom[k] < least_freedom) break;
    const double validation = squares[k] / (freedom[k] * freedom[k]);
    if (validation >= least) continue;
    least = validation;
    best = k;
  }
  if (best == 0) return {};
  return SmoothScatter{squares[best] / freedom[best], freedom[best]};
}

}  // namespace tunica::assembly
