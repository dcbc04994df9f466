// SPDX-License-Identifier: Apache-2.0
#include "edges.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::field {
namespace {

constexpr double band = 2.5;  ///< in spacings of points
constexpr std::size_t slopes = 3;

/// P_k(s), k ≤ degree.
std::vector<double> legendre(std::size_t degree, double s) {
  std::vector<double> P{1, s};
  for (std::size_t k = 1; k < degree; ++k)
    P.push_back((static_cast<double>(2 * k + 1) * s * P[k] - static_cast<double>(k) * P[k - 1]) /
                static_cast<double>(k + 1));
  P.resize(degree + 1);
  return P;
}

/// The functions of a displacement near a side, at s along it and d from it.
Eigen::VectorXd functions(std::size_t degree, double s, double d) {
  std::vector<double> all = legendre(degree, s);
  for (const double P : legendre(slopes - 1, s)) all.push_back(d * P);
  all.push_back(d * d);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

}  // namespace

std::vector<double> prescribed(const Specimen& specimen, const Edges& edges, const Frame& frame, std::size_t degree) {
  std::vector<double> u(specimen.dofs(), 0.0);
  double area = 0;
  for (const auto& point : specimen.elements().gauss) area += point.weight;
  const double near = band * std::sqrt(area / static_cast<double>(std::max<std::size_t>(frame.points.size(), 1)));
  for (std::size_t side = 0; side < 4; ++side)
    for (std::size_t c = 0; c < 2; ++c) {
      if (edges[side][c] != Edge::uniform && edges[side][c] != Edge::measured) continue;
      const auto& nodes = specimen.nodes_on(side);
      const std::size_t axis = axis_of(side), along = 1 - axis;
      const auto& all = specimen.mesh().nodes;
      const double end = all[nodes.front()][axis];
      double low = 1e300, high = -1e300;
      for (const std::size_t a : nodes) {
        low = std::min(low, all[a][along]);
        high = std::max(high, all[a][along]);
      }
      const auto place = [&](const Vector& at) {
        return Vector{(2 * at[along] - low - high) / (high - low), (at[axis] - end) / near};
      };
      const std::size_t order = edges[side][c] == Edge::uniform ? 0 : degree;
      const auto size = static_cast<Eigen::Index>(order + 1 + slopes + 1);
      std::vector<std::size_t> used;
      for (std::size_t k = 0; k < frame.points.size(); ++k) {
        const auto [s, d] = place(frame.points[k]);
        if (std::abs(d) <= 1 && std::abs(s) <= 1.05 && std::isfinite(frame.displacements[c][k])) used.push_back(k);
      }
      if (static_cast<Eigen::Index>(used.size()) < 2 * size)
        throw InputError(fmt::format(
            "full_field: the {} side is '{}' in {}, and {} points lie within {:.3g} mm of it where {} are needed; end "
            "the mesh where points were measured, or give a smaller \"smoothing\"",
            side_names[side], order == 0 ? "uniform" : "measured", c == 0 ? "x" : "y", used.size(), near, 2 * size));
      Eigen::MatrixXd A(static_cast<Eigen::Index>(used.size()), size);
      Eigen::VectorXd b(A.rows());
      for (Eigen::Index r = 0; r < A.rows(); ++r) {
        const std::size_t k = used[static_cast<std::size_t>(r)];
        const auto [s, d] = place(frame.points[k]);
        A.row(r) = functions(order, s, d);
        b[r] = frame.displacements[c][k];
      }
      const Eigen::VectorXd fit = A.colPivHouseholderQr().solve(b);
      for (const std::size_t a : nodes) u[2 * a + c] = functions(order, place(all[a])[0], 0).dot(fit);
    }
  return u;
}

}  // namespace tunica::field
