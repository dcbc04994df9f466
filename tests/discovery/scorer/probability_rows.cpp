// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "rows.hpp"

namespace blind::score {
namespace {

/// Σ over ten bins of n_b/n |mean probability − share right| (Naeini, Cooper, Hauskrecht, AAAI 2015).
void calibration(const Cases& cases, std::vector<Figure>& table) {
  struct Bin {
    double stated = 0;
    Share right;
  };
  std::array<Bin, 10> bins;
  std::size_t count = 0;
  for (const Case& one : cases) {
    if (!single(one)) continue;
    const Verdict verdict = judged(one);
    if (!verdict.detected() || verdict.causes.empty() || !verdict.causes.front().probability) continue;
    const double p = *verdict.causes.front().probability;
    Bin& bin = bins[std::min<std::size_t>(9, static_cast<std::size_t>(10 * std::clamp(p, 0.0, 1.0)))];
    bin.stated += p;
    bin.right.add(verdict.causes.front().id == hidden(one));
    ++count;
  }
  double error = 0, chance = 0;
  for (const Bin& bin : bins) {
    if (bin.right.total == 0) continue;
    error += std::abs(bin.stated - static_cast<double>(bin.right.hits));
    const double n = static_cast<double>(bin.right.total), p = std::clamp(bin.stated / n, 0.02, 0.98);
    chance += std::sqrt(n * p * (1 - p));
  }
  const double n = count == 0 ? 1 : static_cast<double>(count);
  Figure figure = number("expected calibration error of the stated probability", count, error / n, at_most(0.05),
                         at_most(0.03), "interval: two binomial deviations of every bin");
  figure.low = std::max(0.0, (error - 2 * chance) / n);
  figure.high = (error + 2 * chance) / n;
  table.push_back(figure);
}

void held_out(const Cases& cases, std::vector<Figure>& table) {
  Share good;
  for (const Case& one : cases) {
    if (!single(one) || !named_first(judged(one), hidden(one))) continue;
    for (const double p : one.verdict.held_out) good.add(p > 0.05);
  }
  table.push_back(share("held-out predictive p-value above 0.05 with the named mechanism", good, Bar{0.90, 0.98},
                        Bar{0.93, 0.97}, "blocks"));
}

}  // namespace

void probability_rows(const Cases& cases, std::vector<Figure>& table) {
  calibration(cases, table);
  held_out(cases, table);
}

}  // namespace blind::score
