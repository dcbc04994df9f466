// SPDX-License-Identifier: Apache-2.0
#include "support.hpp"

#include <algorithm>

namespace tunica::fe {
namespace {

/// A Gauss point of the outer edge of a row of elements.
template <std::size_t Order>
struct EdgePoint {
  static constexpr std::size_t side = Element<Order>::side;
  double r = 0, z = 0, rho = 0;  ///< z: its derivative along the edge
  std::array<std::size_t, side> dof{}, plane{};

  EdgePoint(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
            std::size_t row, std::size_t g) {
    for (std::size_t k = 0; k < side; ++k) {
      plane[k] = row * Order + k;
      dof[k] = 2 * mesh.node(mesh.across() - 1, plane[k]);
      r += element.shape_1d[g][k] * state.x[dof[k]];
      z += element.slope_1d[g][k] * state.x[dof[k] + 1];
      rho += element.shape_1d[g][k] * support.free[plane[k]];
    }
  }
};

/// Calls `body` with every Gauss point of the outer edge, and with its number in the row.
template <std::size_t Order, class Body>
void along_edge(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                const Body& body) {
  for (std::size_t row = 0; row < mesh.axial; ++row)
    for (std::size_t g = 0; g < Element<Order>::points_1d; ++g)
      body(EdgePoint<Order>(mesh, element, support, state, row, g), g);
}

}  // namespace

template <std::size_t Order>
void add_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                 std::vector<double>& force) {
  along_edge(mesh, element, support, state, [&](const EdgePoint<Order>& at, std::size_t g) {
    const auto& N = element.shape_1d[g];
    const auto& D = element.slope_1d[g];
    const double w = element.weight_1d[g] * support.slope, pressed = Support::pressed(at.r, at.rho);
    for (std::size_t k = 0; k < at.side; ++k) {
      force[at.dof[k]] += w * at.z * pressed * N[k];
      force[at.dof[k] + 1] += w * Support::stored(at.r, at.rho) * D[k];
    }
  });
}

template <std::size_t Order>
void stiffen_by_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::vector<Entry>& matrix) {
  along_edge(mesh, element, support, state, [&](const EdgePoint<Order>& at, std::size_t g) {
    const auto& N = element.shape_1d[g];
    const auto& D = element.slope_1d[g];
    const double w = element.weight_1d[g] * support.slope, pressed = Support::pressed(at.r, at.rho);
    for (std::size_t k = 0; k < at.side; ++k)
      for (std::size_t l = 0; l < at.side; ++l) {
        if (k <= l) matrix.push_back({at.dof[k], at.dof[l], w * at.z * (2 * at.r - at.rho) * N[k] * N[l]});
        matrix.push_back({at.dof[k], at.dof[l] + 1, w * pressed * N[k] * D[l]});
      }
  });
}

template <std::size_t Order>
double contract_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::span<const double> right, std::span<double> by_free) {
  std::fill(by_free.begin(), by_free.end(), 0.0);
  double by_slope = 0;
  along_edge(mesh, element, support, state, [&](const EdgePoint<Order>& at, std::size_t g) {
    const double w = element.weight_1d[g];
    double along_r = 0, along_z = 0;  // of `right`, at the point
    for (std::size_t k = 0; k < at.side; ++k) {
      along_r += element.shape_1d[g][k] * right[at.dof[k]];
      along_z += element.slope_1d[g][k] * right[at.dof[k] + 1];
    }
    by_slope -= w * (at.z * Support::pressed(at.r, at.rho) * along_r + Support::stored(at.r, at.rho) * along_z);
    const double change = w * support.slope * (at.z * at.r * along_r - Support::by_free(at.r, at.rho) * along_z);
    for (std::size_t k = 0; k < at.side; ++k) by_free[at.plane[k]] += change * element.shape_1d[g][k];
  });
  return by_slope;
}

template void add_support<1>(const Mesh&, const Element<1>&, const Support&, const State&, std::vector<double>&);
template void add_support<2>(const Mesh&, const Element<2>&, const Support&, const State&, std::vector<double>&);
template void stiffen_by_support<1>(const Mesh&, const Element<1>&, const Support&, const State&, std::vector<Entry>&);
template void stiffen_by_support<2>(const Mesh&, const Element<2>&, const Support&, const State&, std::vector<Entry>&);
template double contract_support<1>(const Mesh&, const Element<1>&, const Support&, const State&,
                                    std::span<const double>, std::span<double>);
template double contract_support<2>(const Mesh&, const Element<2>&, const Support&, const State&,
                                    std::span<const double>, std::span<double>);

}  // namespace tunica::fe
