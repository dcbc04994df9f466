// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <fmt/format.h>

#include "data/cycles.hpp"
#include "data/strip.hpp"
#include "execution/share.hpp"
#include "properties.hpp"

namespace tunica::data {
namespace {

RC_GTEST_PROP(Branches, AreTogetherAllRowsAndTurnEachTime, ()) {
  const auto path = *rc::gen::nonEmpty(rc::gen::container<std::vector<double>>(properties::number()));
  const auto branches = branches_of(path, 0);
  std::size_t row = 0, cycle = 0;
  for (std::size_t k = 0; k < branches.size(); ++k) {
    RC_ASSERT(branches[k].first == row);
    RC_ASSERT(branches[k].last > row);
    // The last row of a valley begins the next loading, so that an unloading may have no row of its own.
    RC_ASSERT(k == 0 || branches[k].loading || branches[k - 1].loading);
    RC_ASSERT(branches[k].cycle == (branches[k].loading ? cycle + 1 : cycle));
    cycle = branches[k].cycle;
    row = branches[k].last;
  }
  RC_ASSERT(row == path.size());
  RC_ASSERT(cycles_in(branches) == cycle);
}

/// Local regression reproduces a straight line exactly; the points go evenly from the first row to the last.
RC_GTEST_PROP(Resampling, KeepsAStraightLineAndItsEnds, ()) {
  const auto points = *rc::gen::inRange<std::size_t>(5, 20);
  const auto steps = *rc::gen::resize(
      60, rc::gen::suchThat(rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 20)),
                            [points](const std::vector<int>& drawn) { return drawn.size() > 2 * points; }));
  const double slope = *properties::number(), reach = *rc::gen::inRange(5, 100) / 100.0;
  double whole = 0;
  for (const int step : steps) whole += step;
  std::string text = "stretch,stress [kPa]\n";
  std::vector<double> stretches;
  double gone = 0;
  for (std::size_t row = 0; row <= steps.size(); ++row) {
    const double stretch = 1 + reach * gone / whole;
    stretches.push_back(stretch);
    text += fmt::format("{},{}\n", stretch, slope * (stretch - 1));
    if (row < steps.size()) gone += steps[row];
  }
  DataRequest request;
  request.resample = points;
  const Dataset found = testing::read_strip(text, {}, request);
  RC_ASSERT(found.count == points);
  const auto& at = found.abscissae.front().second;
  for (std::size_t k = 0; k < points; ++k) {
    const double expected = 1 + reach * static_cast<double>(k) / static_cast<double>(points - 1);
    RC_ASSERT(std::abs(at[k] - expected) < 1e-12);
    RC_ASSERT(std::abs(found.channels[0].values[k] - slope * (at[k] - 1)) <= 1e-9 * std::abs(slope) * reach);
  }
}

RC_GTEST_PROP(Shards, HoldEveryEntryOnce, ()) {
  const auto of = *rc::gen::inRange<std::size_t>(1, 40), entries = *rc::gen::inRange<std::size_t>(0, 200);
  std::vector<std::size_t> holders(entries), sizes(of);
  for (std::size_t part = 1; part <= of; ++part) {
    const execution::Share share = execution::parse_share(fmt::format("{}/{}", part, of));
    for (std::size_t entry = 0; entry < entries; ++entry) {
      holders[entry] += share.holds(entry);
      sizes[part - 1] += share.holds(entry);
    }
  }
  for (const std::size_t count : holders) RC_ASSERT(count == 1u);
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  RC_ASSERT(*most - *least <= 1u);
}

}  // namespace
}  // namespace tunica::data
