// SPDX-License-Identifier: Apache-2.0
// One number in a member, which every thread writes to.
#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    const std::size_t n = points.count;
    for (std::size_t i = 0; i < n && !response.energy.empty(); ++i) {
      first_invariant_ = points.C[i] + points.C[n + i] + points.C[2 * n + i];
      const double x = first_invariant_ - 3, *p = points.parameters.data();
      response.energy[i] = x * (p[0] + x * (p[1] + x * p[2]));
    }
    return status;
  }

 private:
  mutable volatile double first_invariant_ = 0;
};

}  // namespace

TUNICA_PLUGIN("unsafe_number", "0.1.0") {
  registry.add(wrong::factory<Wrong>("unsafe_number", "Rubber with a number of its own."));
}
