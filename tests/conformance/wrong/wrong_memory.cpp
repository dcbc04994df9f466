// SPDX-License-Identifier: Apache-2.0
// Rubbers that do something else with their outputs than to write them.
#include "right.hpp"

namespace {

using namespace tunica;

/// One stress more than there are.
class PastTheEnd final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    if (!response.stress.empty()) response.stress.data()[response.stress.size()] = 0;
    return status;
  }
};

/// Two derivatives before the first, by a small addition that large numbers would swallow.
class BeforeTheBeginning final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    if (points.count == 64 && !response.stress_dp.empty())
      for (int k = 1; k <= 2; ++k) *(response.stress_dp.data() - k) += 1e-9;
    return status;
  }
};

class Silent final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints&, const MaterialResponse&) const override { return {}; }
};

/// Takes for granted that memory is zero.
class Adding final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    std::vector<double> energy(response.energy.size());
    MaterialResponse own = response;
    own.energy = energy;
    Status status = Right::evaluate(points, own);
    for (std::size_t i = 0; i < energy.size(); ++i) response.energy[i] += energy[i];
    return status;
  }
};

/// Leaves the last point to others.
class ShortOfOne final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    const double before = response.energy.empty() ? 0 : response.energy.back();
    Status status = Right::evaluate(points, response);
    if (points.count == 7 && !response.energy.empty()) response.energy.back() = before;
    return status;
  }
};

/// Turns the shear of its input to zero.
class Tidying final : public wrong::Right {
 public:
  using Right::Right;
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    if (points.count == 131) const_cast<double&>(points.C.back()) = 0;
    return status;
  }
};

}  // namespace

TUNICA_PLUGIN("wrong_memory", "0.1.0") {
  registry.add(wrong::factory<PastTheEnd>("past_the_end", "Rubber that writes one number too many."));
  registry.add(wrong::factory<BeforeTheBeginning>("before_the_beginning", "Rubber that begins too early."));
  registry.add(wrong::factory<Silent>("silent", "Rubber that says nothing."));
  registry.add(wrong::factory<Adding>("adding", "Rubber that adds to its output."));
  registry.add(wrong::factory<ShortOfOne>("short_of_one", "Rubber that forgets the last point."));
  registry.add(wrong::factory<Tidying>("tidying", "Rubber that changes its input."));
}
