// SPDX-License-Identifier: Apache-2.0
// Throws where it should answer with a status.
#include <stdexcept>

#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    if (points.count == 7) throw std::runtime_error("seven points are too many");
    return Right::evaluate(points, response);
  }
};

}  // namespace

TUNICA_PLUGIN("throwing", "0.1.0") { registry.add(wrong::factory<Wrong>("throwing", "Rubber that throws.")); }
