// SPDX-License-Identifier: Apache-2.0
#include "support.hpp"

#include <algorithm>

namespace tunica::fe {

template <std::size_t Order>
double contract_support(const Mesh& mesh, const Element<Order>& element, const Support& support, const State& state,
                        std::span<const double> right, std::span<double> by_free) {
  std::fill(by_free.begin(), by_free.end(), 0.0);
  double by_slope = 0;
  for (std::size_t row = 0; row < mesh.axial; ++row)
    for (std::size_t g = 0; g < Element<Order>::points_1d; ++g) {
      const EdgePoint<Order> at(mesh, element, support, state, row, g);
      const double w = element.weight_1d[g];
      double along_r = 0, along_z = 0;  // of `right`, at the point
      for (std::size_t k = 0; k < at.side; ++k) {
        along_r += element.shape_1d[g][k] * right[at.dof[k]];
        along_z += element.slope_1d[g][k] * right[at.dof[k] + 1];
      }
      by_slope -= w * (at.z * Support::pressed(at.r, at.rho) * along_r + Support::stored(at.r, at.rho) * along_z);
      const double change = w * support.slope * (at.z * at.r * along_r - Support::by_free(at.r, at.rho) * along_z);
      for (std::size_t k = 0; k < at.side; ++k) by_free[at.plane[k]] += change * element.shape_1d[g][k];
    }
  return by_slope;
}

template double contract_support<1>(const Mesh&, const Element<1>&, const Support&, const State&,
                                    std::span<const double>, std::span<double>);
template double contract_support<2>(const Mesh&, const Element<2>&, const Support&, const State&,
                                    std::span<const double>, std::span<double>);

}  // namespace tunica::fe
