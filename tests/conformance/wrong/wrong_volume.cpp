// SPDX-License-Identifier: Apache-2.0
// A compressible rubber with stress at rest, and a strip that wrongly declares support for such materials.
#include <memory>
#include <vector>

#include "right.hpp"

namespace {

using namespace tunica;

/// Yeoh's energy alone: S = 2 c10 1 at rest, a pressure that the whole stress of a compressible material may not have.
class Swelling final : public wrong::Right {
 public:
  explicit Swelling(const std::string& type) : Right(type), description_(Right::describe()) {
    description_.compressible = true;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }

 private:
  ModelDescription description_;
};

/// σ = λ² S_t − S_r/λ at C = diag(λ², 1/λ, 1/λ), of an incompressible material.
class Strip final : public Test {
 public:
  explicit Strip(const TestSetup& setup) {
    if (setup.rows.abscissae.empty()) throw InputError("half_strip: no column is mapped to 'stretch'");
    const auto& given = setup.rows.abscissae[0].values;
    stretch_.assign(given.begin(), given.end());
    rows_.count = stretch_.size();
    rows_.abscissae = {{"stretch", stretch_}};
    rows_.channels = {"stress"};
    description_.volume = TestDescription::Volume::either;
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }
  Status predict(const TestInput& input, const TestOutput& out) const override {
    if (input.model.describe().compressible) return Status::failed("half_strip: its volume changes");
    const std::size_t n = rows_.count;
    const auto& stretch = input.abscissae.empty() ? std::span<const double>(stretch_) : input.abscissae[0];
    std::vector<double> C(6 * n), S(6 * n);
    for (std::size_t i = 0; i < n; ++i) {
      C[i] = stretch[i] * stretch[i];
      C[n + i] = C[2 * n + i] = 1 / stretch[i];
    }
    const Status status = input.model.evaluate({n, C, input.model_parameters, {}, {}}, {{}, S, {}, {}, {}});
    for (std::size_t i = 0; i < n && !out.values.empty(); ++i)
      out.values[i] = stretch[i] * stretch[i] * S[i] - S[2 * n + i] / stretch[i];
    return status;
  }

 private:
  std::vector<double> stretch_;
  TestRows rows_;
  TestDescription description_;
};

}  // namespace

TUNICA_PLUGIN("wrong_volume", "0.1.0") {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  registry.add(wrong::factory<Swelling>("swelling", "Rubber that swells at rest."));
  registry.add(TestFactory{"half_strip",
                           "A strip of one kind of material.",
                           "",
                           {},
                           {{"stretch", "1", Role::abscissa, true, "Stretch along the strip.", Kind::stretch},
                            {"stress", "kPa", Role::channel, true, "Cauchy stress along the strip.", Kind::stress}},
                           [](const TestSetup& setup) { return std::make_unique<Strip>(setup); }});
}
