// SPDX-License-Identifier: Apache-2.0
// The energy lacks a factor two that its stress has.
#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    for (double& energy : response.energy) energy *= 0.5;
    return status;
  }
};

}  // namespace

TUNICA_PLUGIN("wrong_energy", "0.1.0") {
  registry.add(wrong::factory<Wrong>("wrong_energy", "Rubber with half its energy."));
}
