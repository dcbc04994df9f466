// SPDX-License-Identifier: Apache-2.0
// In every rounding mode of the caller, models and tests give the numbers of the usual one, bit for bit: the guard sees
// to it. Without it the vector functions of the C library err by 1e-3. Seed 20261124; the outcome is deterministic.
#include <cfenv>
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
        EXPECT_EQ(usual.stress, found.stress) << type << where(*model, point) << " mode " << mode;
        EXPECT_EQ(usual.tangent, found.tangent) << type << where(*model, point) << " mode " << mode;
        EXPECT_EQ(usual.stress_dp, found.stress_dp) << type << where(*model, point) << " mode " << mode;
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
      EXPECT_EQ(usual.values, found.values) << type << " mode " << mode;
      EXPECT_EQ(usual.jacobian, found.jacobian) << type << " mode " << mode;
    }
  }
}

}  // namespace
}  // namespace tunica::testing
