// SPDX-License-Identifier: Apache-2.0
// One more part of the energy, 2 C_tt, which pulls at rest.
#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    for (std::size_t i = 0; i < points.count; ++i) {
      if (!response.energy.empty()) response.energy[i] += 2 * points.C[i];
      if (!response.stress.empty()) response.stress[i] += 4;
    }
    return status;
  }
};

}  // namespace

TUNICA_PLUGIN("stress_at_rest", "0.1.0") {
  registry.add(wrong::factory<Wrong>("stress_at_rest", "Rubber that pulls at rest."));
}
