// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <boost/math/distributions/chi_squared.hpp>
#include <fmt/format.h>

#include "rows.hpp"

namespace blind::score {

/// Effects that are found at their target. 1/√Λ is the limit where the amplitude is the only unknown; a nuisance
/// parameter that the data hardly fix takes any amplitude with it, and those are told apart.
void amplitude_rows(const Cases& cases, std::vector<Figure>& table) {
  Share covered;
  struct Spread {
    double squares = 0;
    std::size_t count = 0;
    void add(double error) {
      squares += error * error;
      ++count;
    }
    /// With the interval of the standard deviation of so many normal errors.
    [[nodiscard]] Figure figure(std::string name, std::optional<Bar> pass, std::optional<Bar> stretch,
                                std::string remark) const {
      if (count == 0) return number(std::move(name), 0, 0, pass, stretch);
      const double n = static_cast<double>(count);
      Figure made = number(std::move(name), count, std::sqrt(squares / n), pass, stretch, std::move(remark));
      const boost::math::chi_squared chi(n);
      made.low = std::sqrt(squares / boost::math::quantile(chi, 0.975));
      made.high = std::sqrt(squares / boost::math::quantile(chi, 0.025));
      return made;
    }
  };
  const auto row = [&](double lambda, double pass, double stretch) {
    Spread alone, with_nuisance;
    for (const Case& one : cases) {
      if (!single(one) || one.truth.asked != lambda) continue;
      const Verdict verdict = judged(one);
      const TrueEffect& truth = one.truth.effects.front();
      if (!named_first(verdict, truth.id)) continue;
      const Cause& cause = verdict.causes.front();
      if (!cause.amplitude || !truth.target.met_by(cause.target)) continue;
      const double sign = truth.even && *cause.amplitude * truth.amplitude < 0 ? -1 : 1;
      (truth.nuisance ? with_nuisance : alone)
          .add((sign * *cause.amplitude - truth.amplitude) / (truth.amplitude - truth.null));
      if (!cause.low || !cause.high) continue;
      const auto [low, high] = std::minmax({sign * *cause.low, sign * *cause.high});
      covered.add(low <= truth.amplitude && truth.amplitude <= high);
    }
    const std::string name = fmt::format("amplitude, relative rms at Λ {:g}", lambda);
    table.push_back(alone.figure(name, at_most(pass), at_most(stretch),
                                 fmt::format("1/√Λ = {:.2f} is the limit", 1 / std::sqrt(lambda))));
    table.push_back(with_nuisance.figure(name + ", effects with a nuisance parameter", {}, {}, {}));
  };
  row(25, 0.28, 0.23);
  row(60, 0.17, 0.145);
  table.push_back(share("amplitude, coverage of the 95 % interval", covered, Bar{0.92, 0.98}, Bar{0.94, 0.96}));
}

}  // namespace blind::score
