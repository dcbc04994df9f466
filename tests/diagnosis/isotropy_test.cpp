// SPDX-License-Identifier: Apache-2.0
// Whether a model has directions, of fibres that pull in a small range of stretches only.
#include "diagnosis/hypotheses/isotropy.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace tunica::diagnosis::isotropy_test {
namespace {

/// S = 1 + fibres along an axis that pull while their stretch lies in a window.
class Windowed : public Model {
 public:
  Windowed(std::size_t axis, double from, double to) : axis_(axis), from_(from), to_(to) {
    description_.parameters = {{"k", "kPa", 1, 0, 10, Scale::linear, "", ""}};
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    for (std::size_t i = 0; i < points.count; ++i)
      for (std::size_t c = 0; c < 6; ++c) {
        const double stretch = std::sqrt(points.C[axis_ * points.count + i]);
        const bool pulls = c == axis_ && stretch > from_ && stretch < to_;
        response.stress[c * points.count + i] = (c < 3 ? 1 : 0) + (pulls ? points.parameters[0] : 0);
      }
    return {};
  }

 private:
  ModelDescription description_;
  std::size_t axis_;
  double from_, to_;
};

// Along any axis: those that a moderate stretch recruits and a larger one breaks, those of small stretches, and those
// that bear in compression only.
TEST(IsotropyOfFibres, IsNoneHoweverSmallTheirRange) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(is_isotropic(Windowed(axis, 1.19, 1.21))) << axis;
    EXPECT_FALSE(is_isotropic(Windowed(axis, 1.04, 1.06))) << axis;
    EXPECT_FALSE(is_isotropic(Windowed(axis, 0.79, 0.8))) << axis;
  }
  EXPECT_TRUE(is_isotropic(Windowed(0, 8, 9))) << "they never pull";
}

/// S = C, and a little more along the first axis.
class NearlyIsotropic : public Windowed {
 public:
  NearlyIsotropic(double size, double more) : Windowed(0, 8, 9), size_(size), more_(more) {}
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    for (std::size_t k = 0; k < 6 * points.count; ++k)
      response.stress[k] = size_ * points.C[k] * (k < points.count ? 1 + more_ : 1);
    return {};
  }

 private:
  double size_, more_;
};

TEST(IsotropyOfFibres, IsToldFromRoundingWhateverTheUnit) {
  for (const double unit : {1e-4, 1.0, 1e4}) {
    EXPECT_TRUE(is_isotropic(NearlyIsotropic(unit, 1e-9))) << unit;
    EXPECT_FALSE(is_isotropic(NearlyIsotropic(unit, 1e-5))) << unit;
    EXPECT_FALSE(is_isotropic(NearlyIsotropic(unit, NAN))) << unit;
  }
}

}  // namespace
}  // namespace tunica::diagnosis::isotropy_test
