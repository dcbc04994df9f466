// SPDX-License-Identifier: Apache-2.0
#include "closing.hpp"

#include <algorithm>
#include <cmath>

#include "element.hpp"

namespace tunica::fe {
namespace {

using Vary = ceres::Jet<double, geometry_count>;

template <std::size_t Order>
std::vector<double> points_of(std::size_t lanes) {
  const Element<Order> element;
  std::vector<double> at;  // place of each point in its element, 0 … 1
  for (std::size_t g = 0; g < Element<Order>::points; ++g)
    for (std::size_t e = 0; e < lanes; ++e) at.push_back(0.5 * (1 + element.xi[g]));
  return at;
}

void take(const Vary& value, std::array<std::vector<double>, geometry_count>& by) {
  for (std::size_t k = 0; k < geometry_count; ++k) by[k].push_back(value.v[static_cast<int>(k)]);
}

}  // namespace

Closing::Closing(const Mesh& mesh, const thick_wall::Wall& wall, double ratio, bool derivatives)
    : opened(wall.K != 1), factored(ratio != 1) {
  const std::size_t n = mesh.radial;
  const Vary thickness = (wall.Ro - wall.Ri) * Vary(1, by_thickness), K(wall.K, by_closing), iota(wall.iota, by_sector);
  const Vary inner = wall.Ro - thickness, sector2 = exp(2.0 * iota);
  const auto radius = [&](double fraction) { return wall.Ro - thickness * (1 - fraction); };
  const auto fraction = [&](double R) { return (R - mesh.inner) / (mesh.outer - mesh.inner); };

  if (none() && !derivatives) return;
  const std::vector<double> place = mesh.order == 1 ? points_of<1>(n) : points_of<2>(n);
  if (opened || derivatives) {
    for (std::size_t i = 0; i < place.size(); ++i) {
      const std::size_t e = i % n;
      const Vary R = radius(fraction(mesh.edge(e) + place[i] * (mesh.edge(e + 1) - mesh.edge(e))));
      const Vary log_square = 2.0 * (log(K) + log(R)) - log(sector2 + K * (R * R - inner * inner));
      square.push_back(std::exp(log_square.a));
      if (derivatives) take(log_square, log_square_by);
    }
  }
  if (!(factored || derivatives)) return;
  // ρ s inside and s outside, with the mean over the thickness f ρ s + (1 − f) s = 1; see the long tube.
  Vary inside(1.), outside(1.), interface2(wall.Ri * wall.Ri);
  if (!wall.layered) {
    const double f = wall.interfaces[0];
    const Vary rho(ratio, by_ratio), mean = f * rho + (1 - f);
    inside = rho / mean;
    outside = 1.0 / mean;
    const Vary end = sqrt(sector2 + K * (wall.Ro * wall.Ro - inner * inner)), at = (1 - f) * sqrt(sector2) + f * end;
    interface2 = inner * inner + (at * at - sector2) / K;
  }
  std::vector<Vary> mean, slope;  // of the factor in each column, by ξ
  double farthest = 0;
  for (const double at : place) farthest = std::max(farthest, std::abs(2 * at - 1));
  const Vary jump = inside - outside, least = 0.1 * (inside < outside ? inside : outside);
  for (std::size_t e = 0; e < n; ++e) {
    const Vary from = radius(fraction(mesh.edge(e))), to = radius(fraction(mesh.edge(e + 1)));
    Vary cut = 2.0 * (sqrt(interface2) - from) / (to - from) - 1.0;
    if (cut.a <= -1) cut = Vary(-1.);
    if (cut.a >= 1) cut = Vary(1.);
    mean.push_back(outside + 0.5 * jump * (cut + 1.0));
    slope.push_back(0.75 * jump * (cut * cut - 1.0));
    if (mean[e].a - std::abs(slope[e].a) * farthest < least.a)
      slope[e] = (slope[e].a < 0 ? -1.0 : 1.0) / farthest * (mean[e] - least);
  }
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Vary at = mean[i % n] + slope[i % n] * (2 * place[i] - 1);
    factor.push_back(at.a);
    if (derivatives) take(log(at), log_factor_by);
  }
}

}  // namespace tunica::fe
