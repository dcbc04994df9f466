// SPDX-License-Identifier: Apache-2.0
#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <boost/math/interpolators/makima.hpp>
#include <fmt/format.h>

namespace tunica::external {
namespace {

struct Lines {
  std::vector<double> x, y;
  [[nodiscard]] std::size_t piece(double at) const {
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
    return static_cast<std::size_t>(above - x.begin()) - 1;
  }
  [[nodiscard]] double slope(double at) const {
    const std::size_t k = piece(at);
    return (y[k + 1] - y[k]) / (x[k + 1] - x[k]);
  }
  [[nodiscard]] double value(double at) const {
    const std::size_t k = piece(at);
    return y[k] + (at - x[k]) * slope(at);
  }
};

}  // namespace

Curve::Curve(std::vector<double> x, std::vector<double> y) {
  if (x.size() < 2 || y.size() != x.size()) {
    problem_ = fmt::format("a curve needs two points or more, and as many ordinates as abscissae: found {} and {}",
                           y.size(), x.size());
    return;
  }
  if (x.front() > x.back()) {
    std::reverse(x.begin(), x.end());
    std::reverse(y.begin(), y.end());
  }
  for (std::size_t k = 1; k < x.size(); ++k)
    if (!(x[k] > x[k - 1])) {
      problem_ = fmt::format(
          "the abscissa goes from {:g} to {:g} and turns: only a curve that rises or falls all along "
          "can be read between its points",
          x[k - 1], x[k]);
      return;
    }
  first_ = x.front();
  last_ = x.back();
  if (x.size() < 4) {
    auto lines = std::make_shared<Lines>(Lines{std::move(x), std::move(y)});
    value_ = [lines](double at) { return lines->value(at); };
    slope_ = [lines](double at) { return lines->slope(at); };
    return;
  }
  using Cubic = boost::math::interpolators::makima<std::vector<double>>;
  auto cubic = std::make_shared<Cubic>(std::move(x), std::move(y));
  value_ = [cubic](double at) { return (*cubic)(at); };
  slope_ = [cubic](double at) { return cubic->prime(at); };
}

bool Curve::reaches(double x) const {
  const double rounding = 1e-5 * (last_ - first_);
  return x >= first_ - rounding && x <= last_ + rounding;
}

double Curve::inside(double x) const { return std::clamp(x, first_, last_); }
double Curve::operator()(double x) const { return value_(inside(x)); }
double Curve::slope(double x) const { return slope_(inside(x)); }

}  // namespace tunica::external
