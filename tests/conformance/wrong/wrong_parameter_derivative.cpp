// SPDX-License-Identifier: Apache-2.0
// The derivative by the second coefficient has the wrong sign.
#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    if (!response.stress_dp.empty())
      for (std::size_t k = 6 * points.count; k < 12 * points.count; ++k) response.stress_dp[k] *= -1;
    return status;
  }
};

}  // namespace

TUNICA_PLUGIN("wrong_parameter_derivative", "0.1.0") {
  registry.add(wrong::factory<Wrong>("wrong_parameter_derivative", "Rubber that falls where it should rise."));
}
