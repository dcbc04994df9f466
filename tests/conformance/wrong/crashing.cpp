// SPDX-License-Identifier: Apache-2.0
// Ends the process for a batch of more than a hundred points.
#include <csignal>

#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    if (points.count > 100) std::raise(SIGSEGV);
    return Right::evaluate(points, response);
  }
};

}  // namespace

TUNICA_PLUGIN("crashing", "0.1.0") { registry.add(wrong::factory<Wrong>("crashing", "Rubber that crashes.")); }
