// SPDX-License-Identifier: Apache-2.0
// A strip that has been stretched stays longer than it was. Its rest length grows with the largest stretch Λ borne so
// far, in the order of the rows,
//
//   p = 1 + s (Λ − 1),
//
// and the material feels λ = m/p of the measured stretch m (Diani, Fayolle, Gilormini 2009 review set and softening by
// earlier stretch). Below its rest length a strip is slack: its stress is 0. The set keeps the
// volume, so the section shrinks by 1/p and transverse stretches by p^(−1/2). The Cauchy stress is that of λ; with the
// force over the section before the set, the first Piola–Kirchhoff stress is P(λ)/p and the second S(λ)/p².
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "../abscissa_errors/stress_measure.hpp"
#include "tunica/plugin.hpp"
#include "tunica/tests/decorated_test.hpp"

namespace tunica::permanent_set {
namespace {

constexpr const char* id = "permanent_set";

/// The powers of p that predictions are multiplied with, one a channel, and which channels a slack strip has none of.
struct Channels {
  std::vector<double> powers;
  std::vector<bool> stress;
};

/// The effect of the largest stretch so far on one row.
struct Row {
  double rest = 1, grown = 0;  ///< p and Λ − 1
  bool taut = true;            ///< longer than at rest
  bool leads = false;          ///< Λ is the stretch of this row
  double felt = 1;             ///< by the material

  /// Hanging loose after a stretch: nothing is felt. At its first length, never stretched, a strip is not.
  [[nodiscard]] bool slack() const { return !taut && grown > 0 && felt == 1; }
};

std::vector<Row> rows_of(std::span<const double> measured, double s) {
  std::vector<Row> rows(measured.size());
  double largest = 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double m = measured[i];
    Row& row = rows[i];
    row.leads = m > largest;
    largest = std::max(largest, m);
    row.grown = largest - 1;
    row.rest = 1 + s * row.grown;
    row.taut = m > row.rest;
    // A slack strip has its rest length; pushed below the first one it is as it was.
    row.felt = row.taut ? m / row.rest : std::min(m, 1.0);
  }
  return rows;
}

class PermanentSetTest final : public DecoratedTest {
 public:
  PermanentSetTest(std::unique_ptr<Test> base, const Parameter& amplitude, std::size_t abscissa, Channels channels)
      : DecoratedTest(std::move(base), amplitude, 0), abscissa_(abscissa), channels_(std::move(channels)) {}

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double s = amplitude(input);
    const std::size_t size = prediction_count();
    TestInput bare = DecoratedTest::bare(input);
    const TestOutput of_base{output.values, base_jacobian(output), output.abscissa_derivative, output.diagnostics};
    std::vector<std::span<const double>> columns = abscissae(input, rows());
    const std::vector<Row> states = rows_of(columns[abscissa_], s);
    std::vector<double> values, slopes;
    const bool followed = !output.jacobian.empty() && remembers(input);
    if (!output.jacobian.empty() && !followed) {
      values.resize(size);
      slopes.resize(columns.size() * size);
    }
    if (s == 0) {
      if (Status status = base().predict(bare, of_base); !status.ok() || output.jacobian.empty()) return status;
      if (followed) return difference_by_amplitude(input, own_jacobian(output));
      if (Status status = base().predict(bare, {values, {}, slopes, {}}); !status.ok()) return status;
      set_by_amplitude(states, columns[abscissa_], values, slopes, own_jacobian(output));
      return {};
    }
    std::vector<double> felt;
    for (const Row& row : states) felt.push_back(row.felt);
    const std::span<const double> measured = columns[abscissa_];
    columns[abscissa_] = felt;
    bare.abscissae = columns;
    TestOutput wanted = of_base;
    if (output.values.empty()) {
      values.resize(size);
      wanted.values = values;
    }
    if (output.abscissa_derivative.empty() && !output.jacobian.empty() && !followed)
      wanted.abscissa_derivative = slopes;
    if (Status status = base().predict(bare, wanted); !status.ok()) return status;
    if (!output.jacobian.empty() && !followed)
      set_by_amplitude(states, measured, wanted.values, wanted.abscissa_derivative, own_jacobian(output));
    if (!output.abscissa_derivative.empty()) set_by_stretch(states, measured, s, wanted);
    scale(states, base_jacobian(output));
    scale(states, output.values);
    if (followed) return difference_by_amplitude(input, own_jacobian(output));
    return {};
  }

 private:
  [[nodiscard]] bool gone(std::size_t channel, const Row& row) const {
    return channels_.stress[channel] && row.slack();
  }

  /// y = p^a v(λ): dy/ds = p^a (v' dλ/ds + a (Λ − 1)/p v), with dλ/ds = −m (Λ − 1)/p² while the strip is taut.
  void set_by_amplitude(const std::vector<Row>& states, std::span<const double> measured,
                        std::span<const double> values, std::span<const double> slopes,
                        std::span<double> column) const {
    const std::size_t n = states.size(), size = prediction_count();
    for (std::size_t i = 0; i < size; ++i) {
      const Row& row = states[i % n];
      const std::size_t channel = i / n;
      const double a = channels_.powers[channel], share = row.grown / row.rest;
      const double felt = row.taut ? -measured[i % n] * share / row.rest : 0;
      column[i] = gone(channel, row)
                      ? 0
                      : std::pow(row.rest, a) * (slopes[abscissa_ * size + i] * felt + a * share * values[i]);
    }
  }

  /// By the stretch of the same row, which is the largest so far or not: dp/dm = s or 0.
  void set_by_stretch(const std::vector<Row>& states, std::span<const double> measured, double s,
                      const TestOutput& inner) const {
    const std::size_t n = states.size(), size = prediction_count();
    const std::span<double> all = inner.abscissa_derivative;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Row& row = states[i % n];
      const std::size_t channel = i % size / n;
      const double a = channels_.powers[channel], factor = std::pow(row.rest, a), grows = row.leads ? s : 0;
      if (gone(channel, row)) {
        all[i] = 0;
        continue;
      }
      all[i] *= factor;
      if (i / size != abscissa_) continue;
      const double by_measured = row.taut ? (1 - measured[i % n] * grows / row.rest) / row.rest : row.slack() ? 0 : 1;
      all[i] = all[i] * by_measured + a * grows / row.rest * factor * inner.values[i % size];
    }
  }

  /// The base's numbers at the stretch that is felt, to those of the data.
  void scale(const std::vector<Row>& states, std::span<double> columns) const {
    const std::size_t n = states.size(), size = prediction_count();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Row& row = states[i % n];
      const std::size_t channel = i % size / n;
      columns[i] = gone(channel, row) ? 0 : columns[i] * std::pow(row.rest, channels_.powers[channel]);
    }
  }

  std::size_t abscissa_;
  Channels channels_;
};

/// Powers of p for the channels of a strip: σ, P/p, S/p², lengths across it p^(−1/2), J.
Channels channels_of(const Test& strip, std::size_t abscissa) {
  Channels channels;
  for (std::size_t k = 0; k < strip.rows().channels.size(); ++k) {
    const bool stress = strip.rows().channels[k] == "stress";
    channels.stress.push_back(stress);
    channels.powers.push_back(strip.rows().channels[k] == "volume_ratio" ? 0 : -0.5);
    if (!stress) continue;
    const std::optional<int> power = abscissa_errors::force_power(strip, abscissa, k);
    if (!power)
      throw InputError(std::string(id) +
                       ": the test's stress is no Cauchy, first or second Piola-Kirchhoff stress of a strip with "
                       "free lateral faces; expected a test such as uniaxial; take the mechanism out");
    channels.powers.back() = -(*power + 1);
  }
  return channels;
}

MechanismFactory factory() {
  const Parameter amplitude{"s",
                            "1",
                            0.1,
                            0,
                            0.9,
                            Scale::linear,
                            "Part of the largest stretch less one by which the strip stays longer.",
                            "Diani, Fayolle, Gilormini 2009"};
  MechanismFactory mechanism{.id = id,
                             .cause = "The specimen stays longer after it has been stretched: its rest length grows.",
                             .stage = tunica::Stage::test,
                             .applies_to = {"uniaxial"},
                             .parameters = {amplitude},
                             .null = 0,
                             .side = MechanismFactory::Side::positive,
                             .plausible_min = 0,
                             .plausible_max = 0.6,
                             .look_alikes = {"stress_softening", "reference_length_error", "force_scale_error"},
                             .isolated_by = "marks on the specimen, measured unloaded before and after the test",
                             .reference = "Diani, Fayolle, Gilormini, Eur. Polym. J. 45:601 (2009)",
                             .origin = MechanismFactory::Origin::material,
                             .memory = true};
  mechanism.wrap_test = [amplitude](std::unique_ptr<Test> base, const Options&) -> std::unique_ptr<Test> {
    const std::optional<std::size_t> stretch = abscissa_index(base->rows(), "stretch");
    if (!stretch)
      throw InputError(std::string(id) +
                       ": the test's data have no 'stretch', which the mechanism corrects; map a column to 'stretch', "
                       "or take the mechanism out");
    Channels channels = channels_of(*base, *stretch);
    return std::make_unique<PermanentSetTest>(std::move(base), amplitude, *stretch, std::move(channels));
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::permanent_set

TUNICA_PLUGIN("permanent_set", TUNICA_PLUGIN_VERSION) { registry.add(tunica::permanent_set::factory()); }
