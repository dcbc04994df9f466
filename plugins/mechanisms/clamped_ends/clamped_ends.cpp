// SPDX-License-Identifier: Apache-2.0
// A strip in clamps cannot contract at its ends. With H of the homogeneous strip and K of the clamped one, and the
// share s of the contraction that the clamps hold back,
//
//     prediction = base + s (K − H),
//
// exact at s = 1, and at any s where strains are small, since the displacements at the ends are linear in s. K − H is
// computed with the model itself (clamped_strip.hpp); of a model that remembers, with its elastic part.
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "../abscissa_errors/stress_measure.hpp"
#include "clamped_strip.hpp"
#include "tunica/plugin.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::clamped_ends {
namespace {

/// The position of a channel and its formula: data = difference · λ^power.
struct Target {
  std::size_t channel;
  ClampedStrip::Channel of;
  double power;
};

class ClampedTest final : public DecoratedTest {
 public:
  ClampedTest(std::unique_ptr<Test> base, const Parameter& amplitude, std::size_t stretch, std::vector<Target> targets,
              std::unique_ptr<const ClampedStrip> strip)
      : DecoratedTest(std::move(base), amplitude, 0),
        stretch_(stretch),
        targets_(std::move(targets)),
        strip_(std::move(strip)) {}

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double share = amplitude(input);
    TestOutput inner = output;
    inner.jacobian = base_jacobian(output);
    if (Status status = base().predict(bare(input), inner); !status.ok()) return status;
    if (share == 0 && output.jacobian.empty()) return {};

    const bool remembers = input.model.describe().history_size > 0;
    const Model& model = remembers ? input.model.elastic() : input.model;
    const std::size_t count = model.describe().parameters.size(), places = strip_->places().size();
    const std::size_t n = rows().count, size = prediction_count(), of_places = ClampedStrip::channels * places;
    const bool by_parameters = share != 0 && !output.jacobian.empty();
    std::vector<double> values(of_places), jacobian(by_parameters ? count * of_places : 0);
    if (Status status =
            strip_->differences({model, input.model_parameters.first(count), {}}, {values, jacobian, {}, {}});
        !status.ok())
      return status;

    const std::span<double> own = own_jacobian(output);
    std::fill(own.begin(), own.end(), 0.0);
    const std::vector<std::span<const double>> x = abscissae(input, rows());
    for (std::size_t i = 0; i < n; ++i) {
      const double stretch = x[stretch_][i];
      const ClampedStrip::Weights weights = strip_->weights(stretch);
      const auto sum = [places](const std::vector<double>& weight, const double* at) {
        double total = 0;
        for (std::size_t k = 0; k < places; ++k) total += weight[k] * at[k];
        return total;
      };
      for (const auto& [channel, of, power] : targets_) {
        const std::size_t row = channel * n + i;
        const double factor = std::pow(stretch, power);
        const double difference = sum(weights.of_place, &values[of * places]);
        if (!own.empty()) own[row] = factor * difference;
        if (share == 0) continue;
        if (!output.values.empty()) output.values[row] += share * factor * difference;
        if (!output.abscissa_derivative.empty())
          output.abscissa_derivative[stretch_ * size + row] +=
              share * factor * (sum(weights.slope, &values[of * places]) + power / stretch * difference);
        for (std::size_t j = 0; by_parameters && j < count; ++j)
          output.jacobian[j * size + row] +=
              share * factor * sum(weights.of_place, &jacobian[j * of_places + of * places]);
      }
    }
    return {};
  }

 private:
  std::size_t stretch_;
  std::vector<Target> targets_;
  std::unique_ptr<const ClampedStrip> strip_;
};

Size size_of(const Options& options) {
  const Size size{options.number("length"), options.number("width"), options.number("gauge_length")};
  if (!(size.length > 0 && size.width > 0))
    throw InputError(
        "clamped_ends: the test does not say how long and how wide the strip is; give its unloaded \"length\" between "
        "the clamps and its \"width\", for example \"20 mm\" and \"5 mm\"");
  if (size.gauge > size.length)
    throw InputError(
        "clamped_ends: \"gauge_length\" is above \"length\", the distance of the clamps; give the distance of the "
        "marks on the unloaded strip, or leave it out where the stretch is that of the clamps");
  return size;
}

std::unique_ptr<Test> in_clamps(const Parameter& amplitude, std::unique_ptr<Test> base, const Options& options) {
  const Size size = size_of(options);
  if (options.text("direction") == "radial")
    throw InputError(
        "clamped_ends: the strip is pulled through the thickness of the wall, and clamps are simulated in its plane; "
        "take the mechanism out");
  const TestRows& rows = base->rows();
  const std::optional<std::size_t> stretch = abscissa_index(rows, "stretch"), stress = channel_index(rows, "stress"),
                                   width = channel_index(rows, "transverse_stretch");
  if (channel_index(rows, "normal_stretch") || channel_index(rows, "volume_ratio"))
    throw InputError(
        "clamped_ends: it corrects the stress and the transverse stretch of a strip, and the data have its normal "
        "stretch or volume too; take that channel out, or simulate the strip as \"plane_specimen\"");
  std::vector<Target> targets;
  if (width) targets.push_back({*width, ClampedStrip::width, 0});
  if (stress) {
    const std::optional<int> power = stretch ? abscissa_errors::force_power(*base, *stretch, *stress) : std::nullopt;
    if (!power)
      throw InputError(
          "clamped_ends: the test's stress is no Cauchy, first or second Piola-Kirchhoff stress of a strip with free "
          "lateral faces; expected a test such as uniaxial; take the mechanism out");
    targets.push_back({*stress, ClampedStrip::force, -static_cast<double>(*power)});
  }
  const double turn = options.number("angle") * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
  const std::array<double, 2> along =
      options.text("direction") == "circumferential" ? std::array{c, -s} : std::array{s, c};
  auto strip = std::make_unique<const ClampedStrip>(size, along, std::abs(std::sin(2 * turn)) > 1e-12,
                                                    rows.abscissae[*stretch].values);
  return std::make_unique<ClampedTest>(std::move(base), amplitude, *stretch, std::move(targets), std::move(strip));
}

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "clamped_ends",
      .cause = "The strip is short, and its clamps keep the ends from contracting.",
      .stage = tunica::Stage::test,
      .applies_to = {"uniaxial"},
      .parameters =
          {{"share", "1", 0, 0, 4, Scale::linear,
            "Share of the contraction at the ends that the clamps hold back: 1 = all of it in a thin strip, more in a "
            "thick one.",
            ""}},
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 2.5,
      .look_alikes = {"force_scale_error", "reference_length_error", "specimen_misalignment"},
      .isolated_by = "a longer strip of the same specimen, or its width read in the middle",
      .reference = "Horgan, Appl. Mech. Rev. 42:295 (1989)",
      .sizes = {"length", "width"},
      .shared = true};
  mechanism.wrap_test = [amplitude = mechanism.parameters.front()](std::unique_ptr<Test> base, const Options& options) {
    return in_clamps(amplitude, std::move(base), options);
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::clamped_ends

TUNICA_PLUGIN("clamped_ends", TUNICA_PLUGIN_VERSION) { registry.add(tunica::clamped_ends::factory()); }
