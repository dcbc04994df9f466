// SPDX-License-Identifier: Apache-2.0
// Begins where the call before has ended, as an iteration may that is not taken to its end.
#include <atomic>
#include <cmath>

#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    const double before = last_.exchange(points.C[0]);
    for (double& stress : response.stress) stress *= 1 + 1e-11 * (before - 1);
    return status;
  }

 private:
  mutable std::atomic<double> last_ = 1;
};

}  // namespace

TUNICA_PLUGIN("leaking_state", "0.1.0") {
  registry.add(wrong::factory<Wrong>("leaking_state", "Rubber that remembers the last caller."));
}
