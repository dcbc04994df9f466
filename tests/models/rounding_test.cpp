// SPDX-License-Identifier: Apache-2.0
// Every rounding mode of the processor gives the numbers of the usual one, to rounding. What stands on the verge of
// its precision changes by more than that here. Seed 20261124; the outcome is deterministic.
#include <cfenv>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "conformance/material_point.hpp"
#include "support/strip.hpp"

namespace tunica::testing {
using namespace conformance;
namespace {

constexpr int modes[] = {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};

/// Another rounding mode while it lives.
class Rounding {
 public:
  explicit Rounding(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  ~Rounding() { std::fesetround(before_); }
  Rounding(const Rounding&) = delete;
  Rounding& operator=(const Rounding&) = delete;

 private:
  int before_;
};

template <class Numbers>
double largest(const Numbers& numbers) {
  double found = 0;
  for (const double value : numbers) found = std::max(found, std::abs(value));
  return found;
}

/// The largest difference, in units of the largest number.
template <class Numbers>
double apart(const Numbers& one, const Numbers& other) {
  double found = 0;
  for (std::size_t i = 0; i < one.size(); ++i) found = std::max(found, std::abs(one[i] - other[i]));
  const double scale = largest(one);
  return scale > 0 ? found / scale : found;
}

TEST(Rounding, InAnyDirectionLeavesEveryModelItsNumbers) {
  for (const auto& [type, entry] : catalogue().models()) {
    if (type == "composed") continue;  // it has no terms by itself
    const auto model = make_model(type);
    Sampler sampler(20261124);
    for (int draw = 0; draw < 20; ++draw) {
      const Point point = sampler.point(*model);
      const Evaluated usual = evaluate(*model, point.C, point.p);
      for (const int mode : modes) {
        const Rounding rounding(mode);
        const Evaluated found = evaluate(*model, point.C, point.p);
        // The stress of fibres is that of a difference of strains, which the exponential multiplies.
        EXPECT_LT(apart(usual.stress, found.stress), 1e-11) << type << where(*model, point) << " mode " << mode;
        EXPECT_LT(apart(usual.tangent, found.tangent), 1e-11) << type << where(*model, point) << " mode " << mode;
        EXPECT_LT(apart(usual.stress_dp, found.stress_dp), 1e-9) << type << where(*model, point) << " mode " << mode;
      }
    }
  }
}

TEST(Rounding, InAnyDirectionLeavesAStripItsCurve) {
  const auto strip = make_strip(evenly(1.01, 1.4, 40));
  for (const std::string type : {"neo_hooke", "gho", "holzapfel_2015", "ogden"}) {
    const auto model = make_model(type);
    std::vector<double> p;
    for (const Parameter& parameter : model->describe().parameters) p.push_back(parameter.initial);
    const Prediction usual = predict(*strip, *model, p, 0, true);
    ASSERT_TRUE(usual.status.ok()) << type << ": " << usual.status.reason();
    for (const int mode : modes) {
      const Rounding rounding(mode);
      const Prediction found = predict(*strip, *model, p, 0, true);
      ASSERT_TRUE(found.status.ok()) << type << ": " << found.status.reason();
      EXPECT_LT(apart(usual.values, found.values), 1e-9) << type << " mode " << mode;
      EXPECT_LT(apart(usual.jacobian, found.jacobian), 1e-7) << type << " mode " << mode;
    }
  }
}

}  // namespace
}  // namespace tunica::testing
