// SPDX-License-Identifier: Apache-2.0
// Rubbers that stiffen with the longest step so far, each with another mistake.
#include <algorithm>
#include <limits>

#include "right.hpp"

namespace {

using namespace tunica;

enum class Mistake { none, state_unwritten, state_half, state_no_number, tangent };

/// S = (1 + m/2) S₀ with m₊ = max(m, Δt/(1 + Δt)), so the tangent is that of S₀ but for the factor. A second number of
/// the state is 1.
template <Mistake mistake>
class Stiffening final : public Model {
 public:
  explicit Stiffening(const std::string& type) : base_(type), description_(base_.describe()) {
    description_.history_size = 2;
    description_.parameter_derivatives = false;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    std::vector<double> energy(n);
    if (Status status = base_.evaluate(points, {energy, out.stress, out.tangent, {}, {}}); !status.ok()) return status;
    std::copy_n(energy.begin(), out.energy.size(), out.energy.begin());
    for (std::size_t i = 0; i < n; ++i) {
      const double before = points.state.empty() ? 0 : points.state[i];
      const double time = points.time_step.empty() ? 0 : points.time_step[i];
      const double after = std::max(before, time / (1 + time)), factor = 1 + 0.5 * after;
      const bool wrong_tangent = mistake == Mistake::tangent && before > 0;
      for (std::size_t c = 0; c < 6 && !out.stress.empty(); ++c) out.stress[c * n + i] *= factor;
      for (std::size_t c = 0; c < 36 && !out.tangent.empty(); ++c) out.tangent[c * n + i] *= wrong_tangent ? 1 : factor;
      if (out.state.empty() || mistake == Mistake::state_unwritten) continue;
      out.state[i] = after;
      if (mistake == Mistake::state_half) continue;
      out.state[n + i] =
          mistake == Mistake::state_no_number && time > 0.5 ? std::numeric_limits<double>::quiet_NaN() : 1;
    }
    return {};
  }

 private:
  wrong::Right base_;
  ModelDescription description_;
};

}  // namespace

TUNICA_PLUGIN("wrong_state", "0.1.0") {
  registry.add(wrong::factory<Stiffening<Mistake::none>>("state_right", "Rubber that stiffens."));
  registry.add(wrong::factory<Stiffening<Mistake::state_unwritten>>("state_unwritten", "Rubber without a state."));
  registry.add(wrong::factory<Stiffening<Mistake::state_half>>("state_half", "Rubber with half a state."));
  registry.add(wrong::factory<Stiffening<Mistake::state_no_number>>("state_no_number", "Rubber that loses count."));
  registry.add(wrong::factory<Stiffening<Mistake::tangent>>("history_tangent", "Rubber with a tangent of before."));
}
