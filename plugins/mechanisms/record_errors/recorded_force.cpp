// SPDX-License-Identifier: Apache-2.0
#include "recorded_force.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tunica/tests/decorated_test.hpp"

namespace tunica::record_errors {
namespace {

/// Force over unloaded area, row by row, at true stretches; its slope by the true stretch, and columns of derivatives
/// by the parameters of the base. Other channels as the base has them.
struct Pulled {
  std::vector<double> stretch, values, slopes, jacobian;
  std::vector<double> force, force_slope;
};

class RecordedTest : public DecoratedTest {
 public:
  RecordedTest(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip)
      : DecoratedTest(std::move(base), amplitude, 0), strip_(strip) {}

 protected:
  [[nodiscard]] const Strip& strip() const { return strip_; }
  [[nodiscard]] std::vector<double> recorded(const TestInput& input) const {
    const auto columns = abscissae(input, rows());
    return {columns[strip_.abscissa].begin(), columns[strip_.abscissa].end()};
  }

  /// With slopes for fits without memory; `width` columns of the Jacobian.
  Status pull(const TestInput& input, bool sloped, std::size_t width, Pulled& pulled,
              std::span<double> diagnostics = {}) const {
    const std::size_t n = rows().count, size = prediction_count();
    TestInput at = bare(input);
    std::vector<std::span<const double>> columns = abscissae(input, rows());
    columns[strip_.abscissa] = pulled.stretch;
    at.abscissae = columns;
    pulled.values.resize(size);
    pulled.slopes.resize(sloped ? rows().abscissae.size() * size : 0);
    pulled.jacobian.resize(width * size);
    if (Status status = base().predict(at, {pulled.values, pulled.jacobian, pulled.slopes, diagnostics}); !status.ok())
      return status;
    pulled.force.resize(n);
    pulled.force_slope.resize(sloped ? n : 0);
    for (std::size_t i = 0; i < n; ++i) {
      const double stretch = pulled.stretch[i], value = pulled.values[strip_.channel * n + i];
      const double factor = std::pow(stretch, strip_.power);
      pulled.force[i] = value * factor;
      if (sloped)
        pulled.force_slope[i] = pulled.slopes[strip_.abscissa * size + strip_.channel * n + i] * factor +
                                strip_.power * value * factor / stretch;
    }
    return {};
  }

  /// σ/λ is the nominal stress where the volume is kept.
  [[nodiscard]] Status carries(const TestInput& input) const {
    if (strip_.power != -1 || input.model.keeps_volume(input.model_parameters)) return {};
    return Status::failed(
        "the force of a material that changes its volume does not follow from Cauchy stress; give "
        "\"stress_measure\": \"first_piola_kirchhoff\"");
  }

  /// The base's own numbers, and the column of the amplitude.
  template <class Column>
  Status at_null(const TestInput& input, const TestOutput& output, const Column& column) const {
    TestOutput inner = output;
    inner.jacobian = base_jacobian(output);
    if (Status status = base().predict(bare(input), inner); !status.ok()) return status;
    return output.jacobian.empty() ? Status() : column(own_jacobian(output));
  }

 private:
  Strip strip_;
};

class ZeroedTest final : public RecordedTest {
 public:
  using RecordedTest::RecordedTest;

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double a = amplitude(input);
    if (Status status = carries(input); !status.ok()) return status;
    const bool path = remembers(input);
    if (a == 0)
      return at_null(input, output, [&](std::span<double> column) {
        return path ? difference_by_amplitude(input, column) : by_amplitude(input, a, column);
      });
    const std::size_t n = rows().count, size = prediction_count(), first = strip().channel * n;
    const bool sloped = !output.abscissa_derivative.empty() && !path;
    const std::size_t width = base_jacobian(output).size() / size;
    const std::vector<double> m = recorded(input);
    Pulled there, zero;
    for (const double value : m) there.stretch.push_back((1 + a) * value);
    zero.stretch.assign(n, 1 + a);
    if (Status status = pull(input, sloped, width, there, output.diagnostics); !status.ok()) return status;
    if (Status status = pull(input, false, width, zero); !status.ok()) return status;
    std::copy_n(there.values.begin(), output.values.size(), output.values.begin());
    std::copy(there.jacobian.begin(), there.jacobian.end(), output.jacobian.begin());
    std::copy_n(there.slopes.begin(), sloped ? there.slopes.size() : 0, output.abscissa_derivative.begin());
    const std::span<double> by_stretch =
        sloped ? output.abscissa_derivative.subspan(strip().abscissa * size, size) : std::span<double>();
    for (double& slope : by_stretch) slope *= 1 + a;
    for (std::size_t i = 0; i < n; ++i) {
      const double back = std::pow(m[i], -strip().power), force = there.force[i] - zero.force[i];
      const double factor = std::pow(there.stretch[i], strip().power), of_zero = std::pow(1 + a, strip().power);
      if (!output.values.empty()) output.values[first + i] = force * back;
      for (std::size_t k = 0; k < width; ++k)
        output.jacobian[k * size + first + i] =
            (there.jacobian[k * size + first + i] * factor - zero.jacobian[k * size + first + i] * of_zero) * back;
      if (sloped) by_stretch[first + i] = (there.force_slope[i] * (1 + a) - strip().power * force / m[i]) * back;
    }
    if (output.jacobian.empty()) return {};
    return path ? difference_by_amplitude(input, own_jacobian(output)) : by_amplitude(input, a, own_jacobian(output));
  }

 private:
  /// m P′(λ0 m) − P′(λ0), and m ∂/∂λ of other channels.
  Status by_amplitude(const TestInput& input, double a, std::span<double> column) const {
    const std::size_t n = rows().count, size = prediction_count(), first = strip().channel * n;
    const std::vector<double> m = recorded(input);
    Pulled there, zero;
    for (const double value : m) there.stretch.push_back((1 + a) * value);
    zero.stretch.assign(n, 1 + a);
    if (Status status = pull(input, true, 0, there); !status.ok()) return status;
    if (Status status = pull(input, true, 0, zero); !status.ok()) return status;
    for (std::size_t i = 0; i < size; ++i) column[i] = there.slopes[strip().abscissa * size + i] * m[i % n];
    for (std::size_t i = 0; i < n; ++i)
      column[first + i] = (there.force_slope[i] * m[i] - zero.force_slope[i]) * std::pow(m[i], -strip().power);
    return {};
  }
};

class YieldingTest final : public RecordedTest {
 public:
  using RecordedTest::RecordedTest;

  Status predict(const TestInput& input, const TestOutput& output) const override {
    const double a = amplitude(input);
    if (Status status = carries(input); !status.ok()) return status;
    if (remembers(input))
      return Status::failed("the compliance of the machine is not known beside a material with memory");
    const std::size_t n = rows().count, size = prediction_count(), first = strip().channel * n;
    const std::vector<double> m = recorded(input);
    if (a == 0)
      return at_null(input, output, [&](std::span<double> column) {
        Pulled there;
        there.stretch = m;
        if (Status status = pull(input, true, 0, there); !status.ok()) return status;
        by_amplitude(there, m, a, column);
        return Status();
      });
    Pulled there;
    there.stretch = m;
    if (Status status = settle(input, m, a, there); !status.ok()) return status;
    const std::size_t width = base_jacobian(output).size() / size;
    if (Status status = pull(input, true, width, there, output.diagnostics); !status.ok()) return status;
    std::copy_n(there.values.begin(), output.values.size(), output.values.begin());
    std::copy_n(there.slopes.begin(), output.abscissa_derivative.size(), output.abscissa_derivative.begin());
    const std::span<double> by_stretch = output.abscissa_derivative.empty()
                                             ? std::span<double>()
                                             : output.abscissa_derivative.subspan(strip().abscissa * size, size);
    for (std::size_t i = 0; i < n; ++i) {
      const double back = std::pow(m[i], -strip().power), factor = std::pow(there.stretch[i], strip().power);
      const double taken = 1 + a * there.force_slope[i];
      if (!output.values.empty()) output.values[first + i] = there.force[i] * back;
      for (std::size_t k = 0; k < width; ++k) {
        const double by_parameter = there.jacobian[k * size + first + i] * factor;
        for (std::size_t c = i; c < size; c += n)
          output.jacobian[k * size + c] =
              c == first + i
                  ? by_parameter / taken * back
                  : there.jacobian[k * size + c] - there.slopes[strip().abscissa * size + c] * a * by_parameter / taken;
      }
      for (std::size_t c = i; c < by_stretch.size(); c += n)
        by_stretch[c] = c == first + i ? (there.force_slope[i] / taken - strip().power * there.force[i] / m[i]) * back
                                       : by_stretch[c] / taken;
    }
    if (!output.jacobian.empty()) by_amplitude(there, m, a, own_jacobian(output));
    return {};
  }

 private:
  /// Newton's method in each row on λ + a P(λ) − m = 0, which rises with λ where the strip does not soften.
  Status settle(const TestInput& input, const std::vector<double>& m, double a, Pulled& there) const {
    constexpr std::size_t most_steps = 60;
    constexpr double settled = 1e-14, least = 0.05;
    for (std::size_t step = 0; step < most_steps; ++step) {
      if (Status status = pull(input, true, 0, there); !status.ok()) return status;
      double largest = 0;
      for (std::size_t i = 0; i < m.size(); ++i) {
        const double move = (there.stretch[i] + a * there.force[i] - m[i]) / (1 + a * there.force_slope[i]);
        if (!std::isfinite(move)) return Status::failed("no stretch bears the force that the machine gives way to");
        there.stretch[i] = std::max(there.stretch[i] - move, least);
        largest = std::max(largest, std::abs(move) / m[i]);
      }
      if (largest < settled * 10) return {};
    }
    return Status::failed("no stretch bears the force that the machine gives way to");
  }

  /// dλ/da = −P/(1 + a P′)
  void by_amplitude(const Pulled& there, const std::vector<double>& m, double a, std::span<double> column) const {
    const std::size_t n = rows().count, size = column.size();
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t row = i % n;
      const double moved = -there.force[row] / (1 + a * there.force_slope[row]);
      column[i] = i / n == strip().channel ? there.force_slope[row] * moved * std::pow(m[row], -strip().power)
                                           : there.slopes[strip().abscissa * size + i] * moved;
    }
  }
};

}  // namespace

std::unique_ptr<Test> zeroed_under_load(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip) {
  return std::make_unique<ZeroedTest>(std::move(base), amplitude, strip);
}
std::unique_ptr<Test> given_way(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip) {
  return std::make_unique<YieldingTest>(std::move(base), amplitude, strip);
}

}  // namespace tunica::record_errors
