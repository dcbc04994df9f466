// SPDX-License-Identifier: Apache-2.0
// A strip of an isotropic material whose Jacobian forgets what the free faces take off.
#include <cmath>

#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

class Strip final : public Test {
 public:
  explicit Strip(const TestSetup& setup) {
    if (setup.rows.abscissae.empty()) throw InputError("wrong_strip: no column is mapped to 'stretch'");
    const auto& given = setup.rows.abscissae[0].values;
    stretch_.assign(given.begin(), given.end());
    rows_.count = stretch_.size();
    rows_.abscissae = {{"stretch", stretch_}};
    rows_.channels = {"stress"};
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  /// σ = λ² S_t − S_r/λ at C = diag(λ², 1/λ, 1/λ)
  Status predict(const TestInput& input, const TestOutput& out) const override {
    const std::span<const double> stretch =
        input.abscissae.empty() ? std::span<const double>(stretch_) : input.abscissae[0];
    const std::size_t n = rows_.count, m = input.model_parameters.size();
    std::vector<double> C(6 * n), S(6 * n), D(36 * n), dp(out.jacobian.empty() ? 0 : 6 * n * m);
    for (std::size_t i = 0; i < n; ++i) {
      C[i] = stretch[i] * stretch[i];
      C[n + i] = C[2 * n + i] = 1 / stretch[i];
    }
    const Status status = input.model.evaluate({n, C, input.model_parameters, {}, {}}, {{}, S, D, dp, {}});
    if (!status.ok()) return Status::failed("wrong_strip: " + status.reason());
    for (std::size_t i = 0; i < n; ++i) {
      const double l = stretch[i], along = l * l, across = 1 / l, value = along * S[i] - across * S[2 * n + i];
      if (!std::isfinite(value)) return Status::failed("wrong_strip: no stress at row " + std::to_string(i + 1));
      if (!out.values.empty()) out.values[i] = value;
      for (std::size_t j = 0; j < m && !out.jacobian.empty(); ++j) out.jacobian[j * n + i] = along * dp[6 * j * n + i];
      const auto by_stretch = [&](std::size_t a) {  // dS_a/dλ, the tangent being 2 dS/dC
        return 0.5 * (D[6 * a * n + i] * 2 * l - (D[(6 * a + 1) * n + i] + D[(6 * a + 2) * n + i]) / along);
      };
      if (!out.abscissa_derivative.empty())
        out.abscissa_derivative[i] =
            2 * l * S[i] + along * by_stretch(0) + S[2 * n + i] / along - across * by_stretch(2);
    }
    return {};
  }

 private:
  std::vector<double> stretch_;
  TestRows rows_;
  TestDescription description_;
};

}  // namespace

TUNICA_PLUGIN("wrong_jacobian", "0.1.0") {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  registry.add(TestFactory{"wrong_strip",
                           "A strip of an isotropic material.",
                           "",
                           {},
                           {{"stretch", "1", Role::abscissa, true, "Stretch along the strip.", Kind::stretch},
                            {"stress", "kPa", Role::channel, true, "Cauchy stress along the strip.", Kind::stress}},
                           [](const TestSetup& setup) { return std::make_unique<Strip>(setup); }});
}
