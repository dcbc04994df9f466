// SPDX-License-Identifier: Apache-2.0
// Oscillation about a static state: storage and loss modulus over frequency and amplitude. Without an amplitude it is
// infinitely small. In tension the strip has free faces and a static stretch λ, and the modulus is that of nominal
// quantities, E* = dP*/dλ. With l = ln λ1, y = ln λ2² and σ, r as for a strip,
//
//   E* = (δσ/δl − δσ/δy (δr/δl)/(δr/δy) − σ)/λ²,
//
// all of them complex (Ferry, Viscoelastic Properties of Polymers, 1980, chapter 3; about a stretch: Lianis, Trans.
// Soc. Rheol. 9:387, 1965). In shear the block is unstretched, and G* = δS_ab/δC_ab + S_bb.
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <memory>

#include "../temperature_shift/temperature_shift.hpp"
#include "large_oscillation.hpp"
#include "tunica/detail/safeguarded_newton.hpp"
#include "tunica/plugin.hpp"

namespace tunica::dynamic_mechanical {
namespace {

using namespace temperature_shift;
using Complex = std::complex<double>;
constexpr double pi = 3.14159265358979323846;

enum class Channel { storage, loss, tangent, magnitude };

std::size_t axis_of(const std::string& name) { return name == "circumferential" ? 0 : name == "axial" ? 1 : 2; }

class DynamicMechanical final : public Test {
 public:
  explicit DynamicMechanical(const TestSetup& setup) {
    specimen_.along = axis_of(setup.options.text("direction"));
    specimen_.shear = setup.options.text("mode") == "shear";
    specimen_.normal = specimen_.shear ? axis_of(setup.options.text("normal")) : specimen_.along == 0 ? 1 : 0;
    if (specimen_.shear && specimen_.normal == specimen_.along)
      throw InputError(
          "dynamic_mechanical: \"direction\" and \"normal\" are the same, and a plate slides across its normal; give "
          "two different ones");
    shift_ = shift_named(setup.options.text("shift"));
    reference_ = setup.options.number("reference_temperature");
    static_stretch_ = setup.options.number("static_stretch");
    strain_amplitude_ = setup.options.number("strain_amplitude");
    frequency_ = column_of(setup, "frequency");
    stretch_ = column_of(setup, "static_stretch");
    amplitude_ = column_of(setup, "strain_amplitude");
    temperature_ = column_of(setup, "temperature");
    check();
    rows_.count = frequency_.size();
    for (const auto& column : setup.rows.abscissae)
      rows_.abscissae.push_back({column.observable, column.observable == "frequency"          ? frequency_
                                                    : column.observable == "static_stretch"   ? stretch_
                                                    : column.observable == "strain_amplitude" ? amplitude_
                                                                                              : temperature_});
    rows_.channels = setup.rows.channels;
    for (const std::string& channel : rows_.channels)
      channels_.push_back(channel == "storage_modulus" ? Channel::storage
                          : channel == "loss_modulus"  ? Channel::loss
                          : channel == "loss_tangent"  ? Channel::tangent
                                                       : Channel::magnitude);
    description_.parameters = shift_parameters(shift_);
    description_.nulls.assign(description_.parameters.size(), std::numeric_limits<double>::quiet_NaN());
    description_.differencing = {.step = 1e-4, .central = true};
  }
  [[nodiscard]] const TestDescription& describe() const override { return description_; }
  [[nodiscard]] const TestRows& rows() const override { return rows_; }

  Status predict(const TestInput& input, const TestOutput& output) const override {
    if (!output.jacobian.empty())
      return Status::failed("dynamic_mechanical: no exact Jacobian; difference the predictions");
    std::vector<std::vector<double>> columns;
    for (std::size_t k = 0; k < rows_.abscissae.size(); ++k) {
      const auto values = input.abscissae.empty() ? rows_.abscissae[k].values : input.abscissae[k];
      columns.emplace_back(values.begin(), values.end());
    }
    if (Status status = moduli(input, columns, output.values); !status.ok()) return status;
    // Rows stand apart, so that all move at once: f' = (8 (f₁ − f₋₁) − (f₂ − f₋₂))/12h.
    const std::size_t size = channels_.size() * rows_.count;
    for (std::size_t k = 0; k * size < output.abscissa_derivative.size(); ++k) {
      std::array<std::vector<double>, 4> moved;
      constexpr double step = 1e-4;
      const std::vector<double> at = columns[k];
      for (std::size_t s = 0; s < 4; ++s) {
        constexpr std::array shifts{1.0, -1.0, 2.0, -2.0};
        for (std::size_t i = 0; i < at.size(); ++i) columns[k][i] = at[i] * (1 + shifts[s] * step);
        moved[s].resize(size);
        if (Status status = moduli(input, columns, moved[s]); !status.ok()) return status;
      }
      columns[k] = at;
      // An amplitude of 0 moves nothing: moduli are even in it.
      for (std::size_t i = 0; i < size; ++i) {
        const double by = 12 * step * at[i % rows_.count];
        const double change = 8 * (moved[0][i] - moved[1][i]) - (moved[2][i] - moved[3][i]);
        output.abscissa_derivative[k * size + i] = by == 0 ? 0 : change / by;
      }
    }
    return {};
  }

 private:
  static std::vector<double> column_of(const TestSetup& setup, const std::string& name) {
    for (const auto& column : setup.rows.abscissae)
      if (column.observable == name) return {column.values.begin(), column.values.end()};
    return {};
  }

  void check() const {
    const std::string begin = "dynamic_mechanical: ";
    if (frequency_.empty())
      throw InputError(begin + "no rows, or no column mapped to 'frequency'; map one in \"columns\"");
    const auto positive = [&](const std::vector<double>& values, const char* name, const char* unit) {
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] > 0 && std::isfinite(values[i])))
          throw InputError(begin + "row " + std::to_string(i + 1) + " has " + name + " " + std::to_string(values[i]) +
                           unit + "; expected one above 0");
    };
    positive(frequency_, "the frequency", " Hz");
    positive(stretch_, "the static stretch", "");
    positive(temperature_, "the temperature", " K");
    if (!stretch_.empty() && static_stretch_ != 1)
      throw InputError(begin + "\"static_stretch\" is an option and a column; take one of them out");
    if (specimen_.shear && (!stretch_.empty() || static_stretch_ != 1))
      throw InputError(begin +
                       "\"mode\" is 'shear', and a block that is sheared here is not stretched; take "
                       "\"static_stretch\" out, or take the mode 'tension'");
    for (std::size_t i = 0; i < amplitude_.size(); ++i)
      if (!(amplitude_[i] >= 0 && std::isfinite(amplitude_[i])))
        throw InputError(begin + "row " + std::to_string(i + 1) + " has the strain amplitude " +
                         std::to_string(amplitude_[i]) +
                         "; expected 0, for an infinitely small oscillation, or an amplitude above 0");
    if (!amplitude_.empty() && strain_amplitude_ != 0)
      throw InputError(begin + "\"strain_amplitude\" is an option and a column; take one of them out");
    for (std::size_t i = 0; !specimen_.shear && i < frequency_.size(); ++i) {
      const double amplitude = amplitude_.empty() ? strain_amplitude_ : amplitude_[i];
      const double stretch = stretch_.empty() ? static_stretch_ : stretch_[i];
      if (amplitude >= stretch)
        throw InputError(begin + "row " + std::to_string(i + 1) + " has the strain amplitude " +
                         std::to_string(amplitude) + " about the stretch " + std::to_string(stretch) +
                         "; expected an amplitude below the stretch, which stays above 0. An amplitude in per cent "
                         "is to be divided by 100");
    }
    if (shift_ != Shift::none && temperature_.empty())
      throw InputError(begin + "\"shift\" needs the temperature of each row; map a column to 'temperature'");
    if (shift_ == Shift::none && !temperature_.empty())
      throw InputError(begin +
                       "the temperature changes nothing without \"shift\"; take 'wlf' or 'arrhenius', or leave "
                       "the column out");
    if (shift_ != Shift::none && !(reference_ > 0))
      throw InputError(begin + "\"shift\" needs \"reference_temperature\"; give it, for example as \"25 degC\"");
  }

  struct At {
    double frequency, stretch, amplitude;
  };
  [[nodiscard]] std::string name_of(std::size_t i, const At& at) const {
    return "dynamic_mechanical: row " + std::to_string(i + 1) + " (" + std::to_string(at.frequency) + " Hz, stretch " +
           std::to_string(at.stretch) + (at.amplitude > 0 ? ", amplitude " + std::to_string(at.amplitude) : "") + "): ";
  }

  /// The columns in the order of rows_.abscissae.
  Status moduli(const TestInput& input, const std::vector<std::vector<double>>& columns,
                std::span<double> values) const {
    const auto column = [&](const char* name) -> const std::vector<double>* {
      for (std::size_t k = 0; k < columns.size(); ++k)
        if (rows_.abscissae[k].observable == name) return &columns[k];
      return nullptr;
    };
    const std::vector<double>* const frequency = column("frequency");
    const std::vector<double>* const stretch = column("static_stretch");
    const std::vector<double>* const amplitude = column("strain_amplitude");
    const std::vector<double>* const temperature = column("temperature");
    SmallOscillation point(input.model, input.model_parameters);
    double settled = std::numeric_limits<double>::quiet_NaN(), y = 0;
    std::vector<Complex> found(rows_.count);
    std::vector<LargeOscillation::Row> large;
    std::vector<std::size_t> large_rows;
    for (std::size_t i = 0; i < rows_.count; ++i) {
      const At at{(*frequency)[i], stretch != nullptr ? (*stretch)[i] : static_stretch_,
                  amplitude != nullptr ? (*amplitude)[i] : strain_amplitude_};
      if (at.stretch != settled && !settle(point, at.stretch, y))
        return Status::failed(name_of(i, at) + "no equilibrium at the static stretch" +
                              (point.failure().empty() ? "" : ": " + point.failure()));
      settled = at.stretch;
      const double factor =
          temperature == nullptr ? 1 : shift_factor(shift_, (*temperature)[i], reference_, input.test_parameters);
      if (!(factor > 0 && std::isfinite(factor)))
        return Status::failed(name_of(i, at) +
                              "the temperature lies where the shift has no value; narrow the bounds of c2");
      if (at.amplitude > 0) {
        large.push_back({1 / (at.frequency * factor), specimen_.shear ? 0 : at.stretch, at.amplitude, y, point.C(),
                         point.state(), excess(point, 2 * pi * at.frequency * factor, at.stretch, y)});
        large_rows.push_back(i);
        continue;
      }
      const bool finite = modulus_at(point, 2 * pi * at.frequency * factor, at.stretch, y, found[i]);
      if (point.has_two_slopes())
        return Status::failed(name_of(i, at) +
                              "the material softens as it is loaded further than before, so that it has one modulus "
                              "where it is stretched more and another where it is stretched less; state the "
                              "\"strain_amplitude\", take the mechanism of softening or damage out, or oscillate about "
                              "a stretch of 1");
      if (!finite)
        return Status::failed(name_of(i, at) + "the response to an oscillation is not finite" +
                              (point.failure().empty() ? "" : ": " + point.failure()));
    }
    if (!large.empty()) {
      LargeOscillation cycles(input.model, input.model_parameters, specimen_);
      std::vector<Complex> moduli(large.size());
      if (!cycles.moduli(large, moduli)) {
        if (!cycles.failed_row()) return Status::failed("dynamic_mechanical: " + cycles.failure());
        const std::size_t i = large_rows[*cycles.failed_row()];
        return Status::failed(name_of(i, {(*frequency)[i], stretch != nullptr ? (*stretch)[i] : static_stretch_,
                                          large[*cycles.failed_row()].amplitude}) +
                              cycles.failure());
      }
      for (std::size_t k = 0; k < large.size(); ++k) found[large_rows[k]] = moduli[k];
    }
    for (std::size_t k = 0; k < channels_.size() && !values.empty(); ++k)
      for (std::size_t i = 0; i < rows_.count; ++i)
        values[k * rows_.count + i] = channels_[k] == Channel::storage   ? found[i].real()
                                      : channels_[k] == Channel::loss    ? found[i].imag()
                                      : channels_[k] == Channel::tangent ? found[i].imag() / found[i].real()
                                                                         : std::abs(found[i]);
    return {};
  }

  /// Goes to the static state: free faces of a strip, or rest.
  bool settle(SmallOscillation& point, double lambda, double& y) const {
    const double c1 = lambda * lambda;
    const auto at = [&](double trial) {
      Tensor C{};
      C[specimen_.along] = c1;
      C[specimen_.normal] = std::exp(trial);
      C[specimen_.third()] = 1 / (c1 * C[specimen_.normal]);
      return C;
    };
    y = -std::log(lambda);
    if (specimen_.shear) return point.settle(at(0));
    const auto residual = [&](double trial) -> detail::Residual {
      const Tensor C = at(trial);
      if (!point.settle(C)) return {std::numeric_limits<double>::quiet_NaN(), 0};
      const StripSlopes<double> slopes(specimen_, point.stress(), C, point.slow_change(direction(C, true)),
                                       point.slow_change(direction(C, false)));
      return {slopes.r, slopes.r_y};
    };
    return detail::safeguarded_newton(residual, y) && point.settle(at(y));
  }

  [[nodiscard]] Tensor direction(const Tensor& C, bool by_l) const {
    Tensor d{};
    d[specimen_.along] = by_l ? 2 * C[specimen_.along] : 0;
    d[specimen_.normal] = by_l ? 0 : C[specimen_.normal];
    d[specimen_.third()] = (by_l ? -2 : -1) * C[specimen_.third()];
    return d;
  }

  /// What steps as long as those of LargeOscillation add to the modulus of a small oscillation; nothing where that has
  /// two slopes.
  std::array<Complex, 2> excess(const SmallOscillation& point, double omega, double lambda, double y) const {
    std::array<Complex, 2> found{};
    Complex exact, stepped;
    if (!modulus_at(point, omega, lambda, y, exact)) return found;
    for (std::size_t k = 0; k < 2; ++k) {
      const double part = 2 * pi / static_cast<double>((k + 1) * LargeOscillation::steps);
      if (!modulus_at(point, omega, lambda, y, stepped, part)) return {};
      found[k] = stepped - exact;
    }
    return found;
  }

  bool modulus_at(const SmallOscillation& point, double omega, double lambda, double y, Complex& modulus,
                  double part = SmallOscillation::short_part) const {
    if (specimen_.shear) {
      Tensor d{};
      const std::size_t ab = specimen_.sheared();
      d[ab] = 1;
      std::array<ComplexTensor, 1> changes;
      if (!point.respond(omega, {&d, 1}, changes, part)) return false;
      modulus = changes[0][ab] + point.stress()[specimen_.normal];
    } else {
      Tensor C{};
      C[specimen_.along] = lambda * lambda;
      C[specimen_.normal] = std::exp(y);
      C[specimen_.third()] = 1 / (C[specimen_.along] * C[specimen_.normal]);
      const std::array<Tensor, 2> directions{direction(C, true), direction(C, false)};
      std::array<ComplexTensor, 2> changes;
      if (!point.respond(omega, directions, changes, part)) return false;
      const StripSlopes<Complex> s(specimen_, point.stress(), C, changes[0], changes[1]);
      modulus = (s.stress_l - s.stress_y * s.r_l / s.r_y - s.stress) / (lambda * lambda);
    }
    return std::isfinite(modulus.real()) && std::isfinite(modulus.imag());
  }

  Specimen specimen_;
  Shift shift_ = Shift::none;
  double reference_ = 0, static_stretch_ = 1, strain_amplitude_ = 0;
  std::vector<double> frequency_, stretch_, amplitude_, temperature_;
  std::vector<Channel> channels_;
  TestRows rows_;
  TestDescription description_;
};

TestFactory factory() {
  using Role = Observable::Role;
  using Kind = Observable::Kind;
  const std::vector<std::string> axes{"circumferential", "axial", "radial"};
  std::vector<Parameter> parameters = shift_parameters(Shift::wlf);
  for (Parameter& parameter : shift_parameters(Shift::arrhenius)) parameters.push_back(std::move(parameter));
  return {
      "dynamic_mechanical",
      "Oscillations about a static stretch, or in shear: storage and loss modulus over frequency, amplitude and "
      "temperature.",
      "Ferry, Viscoelastic Properties of Polymers (1980)",
      {Option::choice("mode", {"tension", "shear"}, "tension", "How the specimen is deformed."),
       Option::choice("direction", axes, "circumferential", "Where the strip is pulled, or the plate moves."),
       Option::choice("normal", axes, "axial", "Of shear: the normal of the plates."),
       Option::number("static_stretch", 1, {0.01, 100}, "Stretch that the oscillation is about, if no column has it."),
       Option::number("strain_amplitude", 0, {0, 100},
                      "Amplitude of the stretch, or of the shear, if no column has it; 0 = infinitely small."),
       shift_options()[0], shift_options()[1]},
      {{"frequency", "Hz", Role::abscissa, true, "Frequency of the oscillation.", Kind::plain},
       {"static_stretch", "1", Role::abscissa, false, "Stretch that the oscillation is about.", Kind::stretch},
       {"strain_amplitude", "1", Role::abscissa, false,
        "Amplitude of the stretch in tension, of the shear in shear; 0 = infinitely small.", Kind::plain},
       {"temperature", "K", Role::abscissa, false, "Temperature of the row; needs the option shift.", Kind::plain},
       {"storage_modulus", "kPa", Role::channel, false,
        "Part of the modulus in phase with the strain; of nominal stress and stretch in tension.", Kind::plain},
       {"loss_modulus", "kPa", Role::channel, false, "Part of the modulus ahead of the strain by a quarter cycle.",
        Kind::plain},
       {"loss_tangent", "1", Role::channel, false, "Loss over storage modulus.", Kind::plain},
       {"dynamic_modulus", "kPa", Role::channel, false, "Amplitude of stress over that of strain.", Kind::plain}},
      [](const TestSetup& setup) -> std::unique_ptr<Test> { return std::make_unique<DynamicMechanical>(setup); },
      std::move(parameters)};
}

}  // namespace
}  // namespace tunica::dynamic_mechanical

TUNICA_PLUGIN("dynamic_mechanical", TUNICA_PLUGIN_VERSION) { registry.add(tunica::dynamic_mechanical::factory()); }
