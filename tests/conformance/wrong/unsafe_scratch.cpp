// SPDX-License-Identifier: Apache-2.0
// Invariants in a member, which every thread writes to.
#include <algorithm>
#include <array>

#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    const std::size_t n = points.count;
    const auto at = [n](std::size_t i) { return i % size; };
    for (std::size_t i = 0; i < n; ++i) scratch_[at(i)] = points.C[i] + points.C[n + i] + points.C[2 * n + i];
    for (std::size_t i = n < size ? 0 : n - size; i < n && !response.energy.empty(); ++i) {
      const double x = scratch_[at(i)] - 3, *p = points.parameters.data();
      response.energy[i] = x * (p[0] + x * (p[1] + x * p[2]));
    }
    return status;
  }

 private:
  static constexpr std::size_t size = 512;
  mutable std::array<double, size> scratch_{};
};

}  // namespace

TUNICA_PLUGIN("unsafe_scratch", "0.1.0") {
  registry.add(wrong::factory<Wrong>("unsafe_scratch", "Rubber with scratch of its own."));
}
