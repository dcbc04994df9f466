// SPDX-License-Identifier: Apache-2.0
#include "assembly/field_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <boost/math/special_functions/legendre.hpp>

namespace tunica::assembly {
namespace {

constexpr unsigned over_steps = 2;

/// P_0 … P_most of the values between the ends of their range, a column each; P_0 alone where they do not vary.
Eigen::MatrixXd polynomials(const std::vector<double>& values, unsigned most) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double from = *low, range = *high - *low;
  Eigen::MatrixXd found(static_cast<Eigen::Index>(values.size()), range > 0 ? most + 1 : 1);
  for (Eigen::Index i = 0; i < found.rows(); ++i)
    for (Eigen::Index degree = 0; degree < found.cols(); ++degree)
      found(i, degree) = range > 0
                             ? boost::math::legendre_p(static_cast<int>(degree),
                                                       2 * (values[static_cast<std::size_t>(i)] - from) / range - 1)
                             : 1;
  return found;
}

}  // namespace

CurveShapes field_shapes(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& step,
                         unsigned most) {
  const std::array<Eigen::MatrixXd, 3> along{polynomials(x, most), polynomials(y, most), polynomials(step, over_steps)};
  std::vector<std::array<Eigen::Index, 3>> products;
  for (Eigen::Index degree = 0; degree <= static_cast<Eigen::Index>(most); ++degree)
    for (Eigen::Index k = 0; k < std::min(along[2].cols(), degree + 1); ++k)
      for (Eigen::Index i = 0; i <= degree - k; ++i)
        if (i < along[0].cols() && degree - k - i < along[1].cols()) products.push_back({i, degree - k - i, k});
  products.resize(std::min(products.size(), x.size() / 3));
  // Over its range the mean square of P_i is 1/(2i + 1).
  const auto mean_square = [](const std::array<Eigen::Index, 3>& of) {
    double product = 1;
    for (const Eigen::Index i : of) product /= 2.0 * static_cast<double>(i) + 1;
    return product;
  };
  std::vector<double> of_degree(most + 1, 0);
  for (const auto& one : products) of_degree[static_cast<std::size_t>(one[0] + one[1] + one[2])] += mean_square(one);
  CurveShapes shapes{{static_cast<Eigen::Index>(x.size()), static_cast<Eigen::Index>(products.size())}, {}};
  for (std::size_t c = 0; c < products.size(); ++c) {
    const auto [i, j, k] = products[c];
    const auto degree = static_cast<std::size_t>(i + j + k);
    const double height = 1 / std::sqrt((2.0 * static_cast<double>(degree) + 1) * of_degree[degree]);
    shapes.columns.col(static_cast<Eigen::Index>(c)) =
        height * along[0].col(i).cwiseProduct(along[1].col(j)).cwiseProduct(along[2].col(k));
    shapes.degree.push_back(static_cast<double>(degree));
  }
  return shapes;
}

}  // namespace tunica::assembly
