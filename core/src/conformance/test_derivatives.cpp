// SPDX-License-Identifier: Apache-2.0
// Jacobians of tests against differences.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "conformance/differences.hpp"
#include "conformance/predictions.hpp"

namespace tunica::conformance {
namespace {

constexpr double tolerance = 1e-6;
/// Differences that settle no better than to this say nothing.
constexpr double useless = 1e-2;

/// The median of what differences are unsure of in each channel. Rounding meets all rows of a channel alike, and at one
/// of them two estimates may agree by chance.
Values typical_uncertainty(const Simulation& s, const std::vector<Difference>& differences) {
  const std::size_t n = s.test.rows().count;
  Values typical;
  for (std::size_t begin = 0; n > 0 && begin < differences.size(); begin += n) {
    Values of_channel;
    for (std::size_t i = begin; i < begin + n; ++i) of_channel.push_back(differences[i].uncertainty);
    const auto middle = of_channel.begin() + static_cast<std::ptrdiff_t>(n / 2);
    std::nth_element(of_channel.begin(), middle, of_channel.end());
    typical.push_back(*middle);
  }
  return typical;
}

/// As values_at(). Beyond its declared bounds a parameter may mean nothing: no numbers where the test cannot answer
/// then.
Values values_near(const Simulation& s, const Values& p, const Values& q) {
  const auto& own = s.test.describe().parameters;
  bool beyond = false;
  for (std::size_t k = 0; k < std::min(q.size(), own.size()); ++k)
    beyond = beyond || q[k] < own[k].min || q[k] > own[k].max;
  if (!beyond) return values_at(s, p, q);
  const Prediction found = predict(s.test, {s.model, p, q, {}, s.layers});
  return found.status.ok() ? found.values : Values(size_of(s), std::numeric_limits<double>::quiet_NaN());
}

/// One column of derivatives against differences. Where these settle less sharply than the tolerance – iterations leave
/// noise – they are not asked for more than they know.
struct Comparison {
  std::size_t entries = 0, vague = 0;

  void column(const Simulation& s, Meter& meter, std::span<const double> given, std::span<const double> values,
              const std::vector<Difference>& expected, const std::string& name) {
    Values sizes(given.begin(), given.end());
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (std::isfinite(expected[i].value)) sizes[i] = std::max(std::abs(sizes[i]), std::abs(expected[i].value));
    const Values typical = typical_uncertainty(s, expected);
    for (std::size_t i = 0; i < given.size(); ++i) {
      const double scale = channel_scale(s, sizes, i);
      const double unsure = std::max(4 * expected[i].uncertainty, 10 * typical[i / s.test.rows().count]);
      ++entries;
      if (!(unsure <= useless * scale + 1e-9 * channel_scale(s, values, i))) {
        ++vague;
        if (std::isfinite(given[i])) continue;
      }
      const double off = std::abs(given[i] - expected[i].value);
      meter.see(std::isfinite(off) ? std::max(0.0, off - unsure) / scale : off, [&] {
        return fmt::format("the derivative by {} at {} is {:.10g}, differences give {:.10g}", name, place(s, i),
                           given[i], expected[i].value);
      });
    }
  }

  Verdict verdict(const Meter& meter) const {
    if (entries > 0 && vague == entries && meter.verdict().counter_example.empty())
      return not_checked(meter.verdict().compared, "differences settle nowhere: the predictions are noisy");
    Verdict found = meter.verdict();
    if (vague > 0)
      found.note = fmt::format("{} of {} entries left out, where differences do not settle", vague, entries);
    return found;
  }
};

}  // namespace

Verdict jacobian_matches_differences(const Simulation& s, std::uint64_t) {
  const std::size_t rows = size_of(s), models = s.model_parameters.size(), all = models + s.test_parameters.size();
  Meter meter("the Jacobian with differences of the predictions", tolerance);
  if (s.test.describe().differencing)
    return not_checked(meter.verdict().compared, "the test has no derivatives: the host differences it as stated");
  const auto [status, values, jacobian, by_abscissae, shown] = predict(s.test, s.input(), {.jacobian = true});
  if (!status.ok()) {
    if (!s.model.describe().parameter_derivatives)
      return not_checked(meter.verdict().compared, "the model has no parameter derivatives");
    return broken(meter.verdict().compared, "no Jacobian: " + status.reason());
  }
  Comparison comparison;
  for (std::size_t j = 0; j < all; ++j) {
    const double at = j < models ? s.model_parameters[j] : s.test_parameters[j - models];
    const auto expected = differentiate(
        [&](double t) {
          Values p = s.model_parameters, q = s.test_parameters;
          (j < models ? p[j] : q[j - models]) += t;
          return values_near(s, p, q);
        },
        at == 0 ? 1e-3 : 1e-3 * std::abs(at));
    comparison.column(s, meter, std::span(jacobian).subspan(j * rows, rows), values, expected, parameter_name(s, j));
  }
  return comparison.verdict(meter);
}

Verdict abscissa_derivative_matches_differences(const Simulation& s, std::uint64_t) {
  const std::size_t rows = size_of(s), count = s.test.rows().abscissae.size();
  Meter meter("derivatives by the abscissae with differences of the predictions", tolerance);
  const auto [status, values, none, derivative, shown] = predict(s.test, s.input(), {.abscissa_derivative = true});
  if (!status.ok() && s.test.describe().differencing)
    return not_checked(meter.verdict().compared, "the test has no derivatives: " + status.reason());
  if (!status.ok() && s.model.describe().history_size > 0)
    return not_checked(meter.verdict().compared, "rows depend on those before: " + status.reason());
  if (!status.ok()) return broken(meter.verdict().compared, "no derivative: " + status.reason());
  Comparison comparison;
  for (std::size_t k = 0; k < count; ++k) {
    const auto bound = s.test.rows().abscissae[k].values;
    // All rows move together; each prediction depends on the abscissa of its own row, history apart.
    const auto expected = differentiate(
        [&](double t) {
          Values moved(bound.begin(), bound.end());
          for (double& one : moved) one += t;
          return values_at(s, s.model_parameters, s.test_parameters, moved, k);
        },
        1e-3);
    comparison.column(s, meter, std::span(derivative).subspan(k * rows, rows), values, expected,
                      "the abscissa " + s.test.rows().abscissae[k].observable);
  }
  return comparison.verdict(meter);
}

}  // namespace tunica::conformance
