// SPDX-License-Identifier: Apache-2.0
// Tests that break a promise about their outputs, beside one that keeps all: the stress of a point in pure shear.
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "tunica/plugin.hpp"
#include "tunica/tests/point_test.hpp"

namespace {

using namespace tunica;

struct Shear {
  static constexpr const char *type = "shear", *doc = "A block in simple shear.", *reference = "",
                              *admitted = "a finite shear";
  static std::vector<Option> options() { return {}; }
  static std::vector<Observable> observables() {
    using Role = Observable::Role;
    return {{"shear", "1", Role::abscissa, true, "Displacement over the distance of the plates."},
            {"shear_stress", "kPa", Role::channel, true, "Force along the plate over its area."}};
  }
  explicit Shear(const TestSetup&) {}
  /// C = 1 + γ (t⊗z + z⊗t) + γ² z⊗z
  template <class T>
  std::array<T, 6> deformation(const T& gamma) const {
    return {T(1.0), 1.0 + gamma * gamma, T(1.0), gamma, T(0.0), T(0.0)};
  }
  /// τ = S_tz + γ S_zz
  template <class T>
  T channel(std::size_t, const T& gamma, const std::array<T, 6>& S) const {
    return S[3] + gamma * S[1];
  }
  [[nodiscard]] bool admits(double gamma) const { return std::isfinite(gamma); }
};

enum class Mistake { none, silent, past_the_end, no_number, throwing, leaking_jacobian };

template <Mistake mistake>
class Wrong final : public Test {
 public:
  explicit Wrong(std::unique_ptr<Test> right) : right_(std::move(right)) {}
  [[nodiscard]] const TestDescription& describe() const override { return right_->describe(); }
  [[nodiscard]] const TestRows& rows() const override { return right_->rows(); }
  Status predict(const TestInput& input, const TestOutput& out) const override {
    if (mistake == Mistake::silent) return {};
    if (mistake == Mistake::throwing) throw std::runtime_error("nobody catches this");
    Status status = right_->predict(input, out);
    if (mistake == Mistake::past_the_end && !out.jacobian.empty()) out.jacobian.data()[out.jacobian.size()] = 1;
    if (mistake == Mistake::no_number && !out.values.empty())
      out.values.back() = std::numeric_limits<double>::quiet_NaN();
    if (mistake == Mistake::leaking_jacobian && !out.jacobian.empty()) {
      const double own = input.model_parameters[0];
      out.jacobian[0] *= 1 + 1e-10 * (last_.exchange(own) - own);
    }
    return status;
  }

 private:
  std::unique_ptr<Test> right_;
  mutable std::atomic<double> last_ = 0;
};

template <Mistake mistake>
TestFactory wrong(const std::string& type) {
  TestFactory factory = point_test_factory<Shear>();
  factory.type = type;
  factory.create = [make = factory.create](const TestSetup& setup) {
    return std::make_unique<Wrong<mistake>>(make(setup));
  };
  return factory;
}

}  // namespace

TUNICA_PLUGIN("wrong_answers", "0.1.0") {
  registry.add(wrong<Mistake::none>("shear_right"));
  registry.add(wrong<Mistake::silent>("shear_silent"));
  registry.add(wrong<Mistake::past_the_end>("shear_past_the_end"));
  registry.add(wrong<Mistake::no_number>("shear_no_number"));
  registry.add(wrong<Mistake::throwing>("shear_throwing"));
  registry.add(wrong<Mistake::leaking_jacobian>("shear_leaking_jacobian"));
}
