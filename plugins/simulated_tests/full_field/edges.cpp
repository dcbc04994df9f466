// SPDX-License-Identifier: Apache-2.0
#include "edges.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <fmt/format.h>

#include "tunica/error.hpp"

namespace tunica::field {
namespace {

constexpr double band = 4;        ///< in spacings of points
constexpr double widest_gap = 4;  ///< along a measured side, in spacings
constexpr std::size_t least = 2;  ///< degree of what changes across the band

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
  for (const double P : legendre(std::max(degree, least), s)) all.push_back(d * P);
  for (const double P : legendre(least, s)) all.push_back(d * d * P);
  all.push_back(d * d * d);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

/// One side: where along it and how far from it a point lies, in a box from −1 to 1.
struct Strip {
  std::size_t axis, along;
  double end, low, high, near;  ///< mm; near: the width of the band
  Strip(const Specimen& specimen, std::size_t side, double spacing)
      : axis(axis_of(side)), along(1 - axis), end(0), low(1e300), high(-1e300), near(band * spacing) {
    const auto& all = specimen.mesh().nodes;
    for (const std::size_t a : specimen.nodes_on(side)) {
      end = all[a][axis];
      low = std::min(low, all[a][along]);
      high = std::max(high, all[a][along]);
    }
  }
  [[nodiscard]] Vector place(const Vector& at) const {
    return {(2 * at[along] - low - high) / (high - low), (at[axis] - end) / near};
  }
};

/// The points of a side that measure a component. Throws InputError where they leave a part of it open.
std::vector<std::size_t> points_of(const Strip& strip, const Frame& frame, std::size_t c, bool uniform,
                                   Eigen::Index unknowns, const std::string& side) {
  std::vector<std::size_t> used;
  std::vector<double> along{strip.low, strip.high};
  for (std::size_t k = 0; k < frame.points.size(); ++k) {
    const auto [s, d] = strip.place(frame.points[k]);
    if (!(std::abs(d) <= 1 && std::abs(s) <= 1.05 && std::isfinite(frame.displacements[c][k]))) continue;
    used.push_back(k);
    along.push_back(frame.points[k][strip.along]);
  }
  if (static_cast<Eigen::Index>(used.size()) < 2 * unknowns)
    throw InputError(
        fmt::format("full_field: {}, and {} points lie within {:.3g} mm of it where {} are needed; give a mesh that "
                    "ends where points "
                    "were measured{}",
                    side, used.size(), strip.near, 2 * unknowns, uniform ? "" : ", or give a smaller \"smoothing\""));
  std::sort(along.begin(), along.end());
  for (std::size_t k = 1; k < along.size() && !uniform; ++k)
    if (along[k] - along[k - 1] > widest_gap * strip.near / band)
      throw InputError(
          fmt::format("full_field: {}, and no point lies near it from {:.4g} to {:.4g} mm along it; give a mesh that "
                      "ends where points "
                      "were measured, or say \"uniform\" where a grip moves that side",
                      side, along[k - 1], along[k]));
  return used;
}

/// Whether a node of a side moves with it in a component: no fixed side has it too, and no later moved one if `alone`.
bool moves(const Specimen& specimen, const Edges& edges, std::size_t side, std::size_t c, std::size_t node,
           bool alone) {
  for (std::size_t other = 0; other < 4; ++other) {
    const bool stops = edges[other][c] == Edge::fixed || (alone && other > side && edges[other][c] != Edge::free);
    if (other != side && stops && std::ranges::find(specimen.nodes_on(other), node) != specimen.nodes_on(other).end())
      return false;
  }
  return true;
}

}  // namespace

std::vector<std::size_t> moved_nodes(const Specimen& specimen, const Edges& edges, std::size_t side, std::size_t c) {
  std::vector<std::size_t> found;
  for (const std::size_t a : specimen.nodes_on(side))
    if (moves(specimen, edges, side, c, a, true)) found.push_back(a);
  return found;
}

std::vector<Mode> modes(const Specimen& specimen, const Edges& edges, std::size_t degree) {
  std::vector<Mode> found;
  for (std::size_t side = 0; side < 4; ++side)
    for (std::size_t c = 0; c < 2; ++c) {
      if (edges[side][c] != Edge::uniform && edges[side][c] != Edge::measured) continue;
      const Strip strip(specimen, side, 1);
      const std::size_t order = edges[side][c] == Edge::uniform ? 0 : degree, first = found.size();
      found.resize(first + order + 1);
      for (const std::size_t a : moved_nodes(specimen, edges, side, c)) {
        const std::vector<double> P = legendre(order, strip.place(specimen.mesh().nodes[a])[0]);
        for (std::size_t k = 0; k <= order; ++k) found[first + k].emplace_back(2 * a + c, P[k]);
      }
    }
  return found;
}

std::vector<double> beginning(const Specimen& specimen, const Edges& edges, const Frame& frame, std::size_t degree) {
  std::vector<double> u(specimen.dofs(), 0.0);
  const double spacing =
      std::sqrt(specimen.area() / static_cast<double>(std::max<std::size_t>(frame.points.size(), 1)));
  const auto& all = specimen.mesh().nodes;
  for (std::size_t side = 0; side < 4; ++side)
    for (std::size_t c = 0; c < 2; ++c) {
      if (edges[side][c] != Edge::uniform && edges[side][c] != Edge::measured) continue;
      const bool uniform = edges[side][c] == Edge::uniform;
      const std::string words = fmt::format("the {} side is '{}' in {}", side_names[side],
                                            uniform ? "uniform" : "measured", c == 0 ? "x" : "y");
      if (specimen.nodes_on(side).size() < 3)
        throw InputError(
            fmt::format("full_field: {}, and the mesh has no straight side there; give a mesh with one", words));
      const Strip strip(specimen, side, spacing);
      const std::size_t order = uniform ? 0 : degree;
      const auto size = functions(order, 0, 0).size();
      const std::vector<std::size_t> used = points_of(strip, frame, c, uniform, size, words);
      Eigen::MatrixXd A(static_cast<Eigen::Index>(used.size()), size);
      Eigen::VectorXd b(A.rows());
      for (Eigen::Index r = 0; r < A.rows(); ++r) {
        const std::size_t k = used[static_cast<std::size_t>(r)];
        const auto [s, d] = strip.place(frame.points[k]);
        A.row(r) = functions(order, s, d);
        b[r] = frame.displacements[c][k];
      }
      const Eigen::VectorXd fit = A.colPivHouseholderQr().solve(b);
      for (const std::size_t a : specimen.nodes_on(side))
        if (moves(specimen, edges, side, c, a, false))
          u[2 * a + c] = functions(order, strip.place(all[a])[0], 0).dot(fit);
    }
  return u;
}

}  // namespace tunica::field
