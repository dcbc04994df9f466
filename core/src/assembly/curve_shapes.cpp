// SPDX-License-Identifier: Apache-2.0
#include "assembly/curve_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <boost/math/special_functions/legendre.hpp>

#include "data/cycles.hpp"

namespace tunica::assembly {
namespace {

constexpr double tremble = 0.05;  ///< of the range
constexpr std::size_t hold_rows = 4, long_hold = 8;

/// Ranges [first, end) of rows in which the abscissa is held.
std::vector<std::pair<std::size_t, std::size_t>> holds(const std::vector<double>& abscissa, double range) {
  constexpr double still = 1e-6;  // of the range
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < abscissa.size();) {
    std::size_t end = i + 1;
    while (end < abscissa.size() && std::abs(abscissa[end] - abscissa[i]) <= still * range) ++end;
    if (end - i >= hold_rows) found.emplace_back(i, end);
    i = end;
  }
  return found;
}

/// x in [−1, 1] between the ends of a range.
double between(double x, double low, double high) { return high > low ? 2 * (x - low) / (high - low) - 1 : 0; }

/// The branches of a path; none if its reversals are only jitter.
std::vector<data::Branch> branches(const std::vector<double>& path) {
  constexpr std::size_t least_rows = 8;  // of a branch, on average
  std::vector<data::Branch> found = path.empty() ? std::vector<data::Branch>() : data::branches_of(path, path.front());
  if (found.size() * least_rows > path.size()) found.clear();
  return found;
}

class CurveColumns {
 public:
  /// `each_branch`: branches after the first loading and unloading also have their own shapes. All shapes together are
  /// then at most half as many as the rows.
  CurveColumns(const std::vector<double>& abscissa, unsigned most, bool each_branch)
      : abscissa_(abscissa), most_(most), left_(abscissa.size() / 3), each_branch_(each_branch) {}

  /// Each with its degree.
  std::vector<std::pair<Eigen::VectorXd, unsigned>> all() {
    const auto [low, high] = std::minmax_element(abscissa_.begin(), abscissa_.end());
    const std::size_t n = abscissa_.size();
    std::vector<double> u(n), once(n, 1);
    for (std::size_t i = 0; i < n; ++i)
      u[i] = *high > *low ? between(abscissa_[i], *low, *high)
                          : between(static_cast<double>(i), 0, static_cast<double>(n - 1));
    const std::vector<int> directions = loading_directions(abscissa_);
    const bool up = std::count(directions.begin(), directions.end(), 1) > 0,
               down = std::count(directions.begin(), directions.end(), -1) > 0;
    const std::vector<double> direction(directions.begin(), directions.end());
    // Low degrees come first: a short curve then has the low degrees of both directions.
    for (unsigned degree = 0; degree <= most_; ++degree) {
      add(degree, u, once);
      if (up && down && degree >= 1 && degree < most_) add(degree - 1, u, direction);
    }
    for (const auto& [first, end] : holds(abscissa_, *high - *low)) {
      if (end - first < long_hold || end - first == n) continue;
      std::vector<double> inside(n, 0), row(n, 0);
      for (std::size_t i = first; i < end; ++i) {
        inside[i] = 1;
        row[i] = between(static_cast<double>(i), static_cast<double>(first), static_cast<double>(end - 1));
      }
      for (unsigned degree = 0; degree <= 2; ++degree) add(degree, row, inside);
    }
    if (each_branch_) add_later_branches(branches(abscissa_));
    return std::move(columns_);
  }

 private:
  /// Any difference between cycles.
  void add_later_branches(const std::vector<data::Branch>& all) {
    const std::size_t n = abscissa_.size();
    left_ += n / 2 - n / 3;
    for (unsigned degree = 0; degree <= most_; ++degree)
      for (std::size_t b = 2; b < all.size(); ++b) {
        const std::size_t first = all[b].first, end = all[b].last;
        const auto from = abscissa_.begin() + static_cast<std::ptrdiff_t>(first),
                   to = abscissa_.begin() + static_cast<std::ptrdiff_t>(end);
        const auto [low, high] = std::minmax_element(from, to);
        std::vector<double> inside(n, 0), u(n, 0);
        for (std::size_t i = first; i < end; ++i) {
          inside[i] = 1;
          u[i] = between(abscissa_[i], *low, *high);
        }
        add(degree, u, inside);
      }
  }

  void add(unsigned degree, const std::vector<double>& u, const std::vector<double>& factor) {
    if (left_ == 0) return;
    --left_;
    Eigen::VectorXd column(static_cast<Eigen::Index>(u.size()));
    for (std::size_t i = 0; i < u.size(); ++i)
      column[static_cast<Eigen::Index>(i)] = factor[i] * boost::math::legendre_p(static_cast<int>(degree), u[i]);
    columns_.emplace_back(std::move(column), degree);
  }

  const std::vector<double>& abscissa_;
  unsigned most_;
  std::size_t left_;  ///< columns that may still be added
  bool each_branch_;
  std::vector<std::pair<Eigen::VectorXd, unsigned>> columns_;
};

}  // namespace

std::vector<int> loading_directions(const std::vector<double>& abscissa) {
  std::vector<int> direction(abscissa.size(), 1);
  if (abscissa.empty()) return direction;
  const auto [low, high] = std::minmax_element(abscissa.begin(), abscissa.end());
  const double range = *high - *low;
  if (!(range > 0)) return direction;
  // From one extreme to the next opposite one, if they differ by more than the jitter.
  std::size_t from = 0, extreme = 0;
  int heading = 0;
  const auto close = [&](std::size_t end) {
    for (std::size_t i = from; i <= end; ++i) direction[i] = heading;
    from = end + 1;
  };
  for (std::size_t i = 1; i < abscissa.size(); ++i) {
    const double step = abscissa[i] - abscissa[extreme];
    if (heading == 0) {
      if (std::abs(step) > tremble * range) {
        heading = step > 0 ? 1 : -1;
        extreme = i;
      }
    } else if (step * heading >= 0) {
      extreme = i;
    } else if (std::abs(step) > tremble * range) {
      close(extreme);
      heading = -heading;
      extreme = i;
    }
  }
  close(abscissa.size() - 1);
  for (const auto& [first, end] : holds(abscissa, range))
    for (std::size_t i = first + 1; i < end; ++i) direction[i] = 0;
  return direction;
}

CurveShapes curve_shapes(const std::vector<double>& abscissa, unsigned most, bool each_branch) {
  const auto columns = CurveColumns(abscissa, most, each_branch).all();
  CurveShapes shapes{{static_cast<Eigen::Index>(abscissa.size()), static_cast<Eigen::Index>(columns.size())}, {}};
  for (std::size_t k = 0; k < columns.size(); ++k) {
    shapes.columns.col(static_cast<Eigen::Index>(k)) = columns[k].first;
    shapes.degree.push_back(columns[k].second);
  }
  return shapes;
}

}  // namespace tunica::assembly
