// SPDX-License-Identifier: Apache-2.0
// Oscillation of small amplitude about a static state: storage and loss modulus over frequency. In tension the strip
// has free faces and a static stretch λ, and the modulus is that of nominal quantities, E* = dP*/dλ. With l = ln λ1, y
// = ln λ2² and σ, r as for a strip,
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
#include "small_oscillation.hpp"
#include "tunica/detail/safeguarded_newton.hpp"
#include "tunica/plugin.hpp"

namespace tunica::dynamic_mechanical {
namespace {

using namespace temperature_shift;
using Complex = std::complex<double>;
constexpr double pi = 3.14159265358979323846;

enum class Channel { storage, loss, tangent, magnitude };

std::size_t axis_of(const std::string& name) { return name == "circumferential" ? 0 : name == "axial" ? 1 : 2; }
std::size_t shear_component(std::size_t a, std::size_t b) { return a + b == 1 ? 3 : a + b == 3 ? 4 : 5; }

class DynamicMechanical final : public Test {
 public:
  explicit DynamicMechanical(const TestSetup& setup) {
    along_ = axis_of(setup.options.text("direction"));
    shear_ = setup.options.text("mode") == "shear";
    normal_ = shear_ ? axis_of(setup.options.text("normal")) : along_ == 0 ? 1 : 0;
    if (shear_ && normal_ == along_)
      throw InputError(
          "dynamic_mechanical: \"direction\" and \"normal\" are the same, and a plate slides across its normal; give "
          "two different ones");
    shift_ = shift_named(setup.options.text("shift"));
    reference_ = setup.options.number("reference_temperature");
    static_stretch_ = setup.options.number("static_stretch");
    frequency_ = column_of(setup, "frequency");
    stretch_ = column_of(setup, "static_stretch");
    temperature_ = column_of(setup, "temperature");
    check();
    rows_.count = frequency_.size();
    for (const auto& column : setup.rows.abscissae)
      rows_.abscissae.push_back({column.observable, column.observable == "frequency"        ? frequency_
                                                    : column.observable == "static_stretch" ? stretch_
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
      for (std::size_t i = 0; i < size; ++i)
        output.abscissa_derivative[k * size + i] =
            (8 * (moved[0][i] - moved[1][i]) - (moved[2][i] - moved[3][i])) / (12 * step * at[i % rows_.count]);
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
    if (shear_ && (!stretch_.empty() || static_stretch_ != 1))
      throw InputError(begin +
                       "\"mode\" is 'shear', and a block that is sheared here is not stretched; take "
                       "\"static_stretch\" out, or take the mode 'tension'");
    if (shift_ != Shift::none && temperature_.empty())
      throw InputError(begin + "\"shift\" needs the temperature of each row; map a column to 'temperature'");
    if (shift_ == Shift::none && !temperature_.empty())
      throw InputError(begin +
                       "the temperature changes nothing without \"shift\"; take 'wlf' or 'arrhenius', or leave "
                       "the column out");
    if (shift_ != Shift::none && !(reference_ > 0))
      throw InputError(begin + "\"shift\" needs \"reference_temperature\"; give it, for example as \"25 degC\"");
  }

  /// The columns in the order of rows_.abscissae.
  Status moduli(const TestInput& input, const std::vector<std::vector<double>>& columns,
                std::span<double> values) const {
    const std::vector<double>* frequency = nullptr;
    const std::vector<double>* stretch = nullptr;
    const std::vector<double>* temperature = nullptr;
    for (std::size_t k = 0; k < columns.size(); ++k)
      (rows_.abscissae[k].observable == "frequency"        ? frequency
       : rows_.abscissae[k].observable == "static_stretch" ? stretch
                                                           : temperature) = &columns[k];
    SmallOscillation point(input.model, input.model_parameters);
    double settled = std::numeric_limits<double>::quiet_NaN(), y = 0;
    for (std::size_t i = 0; i < rows_.count; ++i) {
      const double lambda = stretch != nullptr ? (*stretch)[i] : static_stretch_;
      const std::string row = "dynamic_mechanical: row " + std::to_string(i + 1) + " (" +
                              std::to_string((*frequency)[i]) + " Hz, stretch " + std::to_string(lambda) + "): ";
      if (lambda != settled && !settle(point, lambda, y))
        return Status::failed(row + "no equilibrium at the static stretch" +
                              (point.failure().empty() ? "" : ": " + point.failure()));
      settled = lambda;
      const double factor =
          temperature == nullptr ? 1 : shift_factor(shift_, (*temperature)[i], reference_, input.test_parameters);
      Complex modulus;
      if (!(factor > 0 && std::isfinite(factor)))
        return Status::failed(row + "the temperature lies where the shift has no value; narrow the bounds of c2");
      const bool found = modulus_at(point, 2 * pi * (*frequency)[i] * factor, lambda, y, modulus);
      if (point.has_two_slopes())
        return Status::failed(row +
                              "the material softens as it is loaded further than before, so that it has one modulus "
                              "where it is stretched more and another where it is stretched less; take the mechanism "
                              "of softening or damage out, or oscillate about a stretch of 1");
      if (!found)
        return Status::failed(row + "the response to an oscillation is not finite" +
                              (point.failure().empty() ? "" : ": " + point.failure()));
      for (std::size_t k = 0; k < channels_.size() && !values.empty(); ++k)
        values[k * rows_.count + i] = channels_[k] == Channel::storage   ? modulus.real()
                                      : channels_[k] == Channel::loss    ? modulus.imag()
                                      : channels_[k] == Channel::tangent ? modulus.imag() / modulus.real()
                                                                         : std::abs(modulus);
    }
    return {};
  }

  [[nodiscard]] std::size_t third() const { return 3 - along_ - normal_; }

  /// Goes to the static state: free faces of a strip, or rest.
  bool settle(SmallOscillation& point, double lambda, double& y) const {
    const double c1 = lambda * lambda;
    const auto at = [&](double trial) {
      Tensor C{};
      C[along_] = c1;
      C[normal_] = std::exp(trial);
      C[third()] = 1 / (c1 * C[normal_]);
      return C;
    };
    y = -std::log(lambda);
    if (shear_) return point.settle(at(0));
    const auto residual = [&](double trial) -> detail::Residual {
      const Tensor C = at(trial);
      if (!point.settle(C)) return {std::numeric_limits<double>::quiet_NaN(), 0};
      const auto slopes =
          slopes_of(point.stress(), C, point.slow_change(direction(C, true)), point.slow_change(direction(C, false)));
      return {slopes.r, slopes.r_y};
    };
    return detail::safeguarded_newton(residual, y) && point.settle(at(y));
  }

  /// σ, r and their changes by l and y, real or complex.
  template <class T>
  struct SlopesOf {
    double stress, r;
    T stress_l, stress_y, r_l, r_y;
  };

  /// σ = c1 S1 − c3 S3, r = c2 S2 − c3 S3 with δc/δl = (2 c1, 0, −2 c3), δc/δy = (0, c2, −c3).
  template <class T>
  SlopesOf<T> slopes_of(const Tensor& S, const Tensor& C, const std::array<T, 6>& by_l,
                        const std::array<T, 6>& by_y) const {
    const double c1 = C[along_], c2 = C[normal_], c3 = C[third()];
    const double S1 = S[along_], S2 = S[normal_], S3 = S[third()];
    const T n_l = c3 * by_l[third()], n_y = c3 * by_y[third()];
    return {c1 * S1 - c3 * S3,
            c2 * S2 - c3 * S3,
            c1 * by_l[along_] + 2 * c1 * S1 - n_l + 2 * c3 * S3,
            c1 * by_y[along_] - n_y + c3 * S3,
            c2 * by_l[normal_] - n_l + 2 * c3 * S3,
            c2 * by_y[normal_] + c2 * S2 - n_y + c3 * S3};
  }
  [[nodiscard]] Tensor direction(const Tensor& C, bool by_l) const {
    Tensor d{};
    d[along_] = by_l ? 2 * C[along_] : 0;
    d[normal_] = by_l ? 0 : C[normal_];
    d[third()] = (by_l ? -2 : -1) * C[third()];
    return d;
  }

  bool modulus_at(const SmallOscillation& point, double omega, double lambda, double y, Complex& modulus) const {
    if (shear_) {
      Tensor d{};
      const std::size_t ab = shear_component(along_, normal_);
      d[ab] = 1;
      std::array<ComplexTensor, 1> changes;
      if (!point.respond(omega, {&d, 1}, changes)) return false;
      modulus = changes[0][ab] + point.stress()[normal_];
    } else {
      Tensor C{};
      C[along_] = lambda * lambda;
      C[normal_] = std::exp(y);
      C[third()] = 1 / (C[along_] * C[normal_]);
      const std::array<Tensor, 2> directions{direction(C, true), direction(C, false)};
      std::array<ComplexTensor, 2> changes;
      if (!point.respond(omega, directions, changes)) return false;
      const auto s = slopes_of(point.stress(), C, changes[0], changes[1]);
      modulus = (s.stress_l - s.stress_y * s.r_l / s.r_y - s.stress) / (lambda * lambda);
    }
    return std::isfinite(modulus.real()) && std::isfinite(modulus.imag());
  }

  std::size_t along_ = 0, normal_ = 1;
  bool shear_ = false;
  Shift shift_ = Shift::none;
  double reference_ = 0, static_stretch_ = 1;
  std::vector<double> frequency_, stretch_, temperature_;
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
      "Small oscillations about a static stretch, or in shear: storage and loss modulus over frequency and "
      "temperature.",
      "Ferry, Viscoelastic Properties of Polymers (1980)",
      {Option::choice("mode", {"tension", "shear"}, "tension", "How the specimen is deformed."),
       Option::choice("direction", axes, "circumferential", "Where the strip is pulled, or the plate moves."),
       Option::choice("normal", axes, "axial", "Of shear: the normal of the plates."),
       Option::number("static_stretch", 1, {0.01, 100}, "Stretch that the oscillation is about, if no column has it."),
       shift_options()[0], shift_options()[1]},
      {{"frequency", "Hz", Role::abscissa, true, "Frequency of the oscillation.", Kind::plain},
       {"static_stretch", "1", Role::abscissa, false, "Stretch that the oscillation is about.", Kind::stretch},
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
