// SPDX-License-Identifier: Apache-2.0
// Mooney's energy, c1 (I1 − 3) + c2 (I2 − 3), with the shear components forgotten in I2: a function of C that depends
// on the axes in which C is written.
#include "right.hpp"

namespace {

using namespace tunica;

class Wrong final : public Model {
 public:
  explicit Wrong(const std::string& type) {
    description_.type = type;
    for (const char* name : {"c1", "c2"})
      description_.parameters.push_back({name, "kPa", 1, 0.1, 10, Scale::log, "A coefficient.", ""});
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    const double c1 = points.parameters[0], c2 = points.parameters[1];
    for (const auto& span : {out.energy, out.stress, out.tangent, out.stress_dp})
      for (double& value : span) value = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double C[3] = {points.C[i], points.C[n + i], points.C[2 * n + i]};
      if (!out.energy.empty())
        out.energy[i] = c1 * (C[0] + C[1] + C[2] - 3) + c2 * (C[0] * C[1] + C[1] * C[2] + C[2] * C[0] - 3);
      for (std::size_t a = 0; a < 3; ++a) {
        const double others = C[(a + 1) % 3] + C[(a + 2) % 3];
        if (!out.stress.empty()) out.stress[a * n + i] = 2 * c1 + 2 * c2 * others;
        for (std::size_t b = 0; b < 3 && !out.tangent.empty(); ++b)
          if (a != b) out.tangent[(6 * a + b) * n + i] = 4 * c2;
        if (!out.stress_dp.empty()) {
          out.stress_dp[a * n + i] = 2;
          out.stress_dp[(6 + a) * n + i] = 2 * others;
        }
      }
    }
    return {};
  }

 private:
  ModelDescription description_;
};

}  // namespace

TUNICA_PLUGIN("not_objective", "0.1.0") {
  registry.add(wrong::factory<Wrong>("not_objective", "Rubber that knows its axes."));
}
