// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t shown_runs_of_draws = 3, most_pairs = 10, most_points_of_pair = 400, bins = 40;

/// The draws of one parameter, chain after chain.
struct Draws {
  std::string name, title;
  std::vector<double> values;
};

std::vector<Draws> draws_of(const Json& document, const Json& parameters) {
  std::vector<Draws> found;
  for (const auto& [name, chains] : member(document, key::posterior).items()) {
    Draws one{name, text::titled(name, word(entry(parameters, name), key::unit)), {}};
    if (chains.is_array())
      for (const Json& chain : chains)
        if (chain.is_array())
          for (const Json& value : chain) one.values.push_back(value.is_number() ? value.get<double>() : NAN);
    const bool whole =
        std::all_of(one.values.begin(), one.values.end(), [](double value) { return std::isfinite(value); });
    if (!one.values.empty() && whole) found.push_back(std::move(one));
  }
  return found;
}

/// The share of the draws in bins of equal width, as a curve of steps; the limits of the intervals stand in it.
Chart histogram(const Draws& draws, const Json& estimate, const std::string& run, const std::string& file) {
  const auto [low, high] = std::minmax_element(draws.values.begin(), draws.values.end());
  const double width = (*high - *low) / static_cast<double>(bins);
  std::vector<double> shares(bins, 0);
  for (const double value : draws.values)
    shares[std::min(bins - 1, static_cast<std::size_t>((value - *low) / width))] +=
        100 / static_cast<double>(draws.values.size());
  Chart chart;
  chart.id = "posterior_" + run + '_' + draws.name;
  chart.title = draws.name;
  chart.about =
      fmt::format("Histogram of {} draws of {} from the posterior of {}", draws.values.size(), draws.name, run);
  chart.x.title = draws.title;
  chart.y = {"% of the draws", false, {0}, {}};
  chart.files = {file};
  Series series{"draws", "step", 0};
  for (std::size_t k = 0; k <= bins; ++k) {
    series.x.push_back(*low + static_cast<double>(k) * width);
    series.y.push_back(k < bins ? shares[k] : 0);
  }
  chart.series.push_back(std::move(series));
  for (const auto& [of, label] : {std::pair{key::ci95, "linearised"}, std::pair{key::posterior_ci95, "95 %"}})
    for (const Json& end : list(estimate, of))
      if (end.is_number()) chart.rule(end.get<double>(), label, 'x');
  return chart;
}

Chart pair(const Draws& a, const Draws& b, const std::string& run, const std::string& file) {
  Chart chart;
  chart.id = fmt::format("posterior_{}_{}_{}", run, a.name, b.name);
  chart.title = a.name + " and " + b.name;
  chart.about = "Draws from the posterior, one symbol a draw";
  chart.x.title = a.title;
  chart.y.title = b.title;
  chart.files = {file};
  Series series{"draws", "points", 0};
  const auto chosen = evenly(a.values.size(), most_points_of_pair);
  for (const std::size_t k : chosen) {
    series.x.push_back(a.values[k]);
    series.y.push_back(b.values[k]);
  }
  if (a.values.size() > chosen.size())
    chart.note = fmt::format("{} of {} draws are shown.", chosen.size(), a.values.size());
  chart.series.push_back(std::move(series));
  return chart;
}

}  // namespace

void add_posterior(Page& page, const Folder& folder, const Order& order) {
  std::size_t shown = 0;
  for (const Order::Run& run : order.runs()) {
    const Json& best = member(*run.run, key::best);
    const std::string file = word(member(best, key::posterior), key::file);
    if (!file.starts_with("posterior_") || file.find('/') != std::string::npos || shown == shown_runs_of_draws)
      continue;
    const auto document = folder.document(file);
    if (!document) continue;
    const Json& parameters = member(best, key::parameters);
    const auto draws = draws_of(*document, parameters);
    if (draws.empty()) continue;
    ++shown;
    page.heading("Posterior of " + run.label);
    page.begin_pair();
    for (const Draws& one : draws) {
      const auto [low, high] = std::minmax_element(one.values.begin(), one.values.end());
      if (*high > *low) page.chart(histogram(one, entry(parameters, one.name), run.label, file), folder.address());
    }
    std::size_t made = 0;
    for (std::size_t a = 0; a < draws.size(); ++a)
      for (std::size_t b = a + 1; b < draws.size() && made < most_pairs; ++b)
        if (draws[a].values.size() == draws[b].values.size()) {
          page.chart(pair(draws[a], draws[b], run.label, file), folder.address());
          ++made;
        }
    page.end_pair();
    if (made == most_pairs) page.paragraph(fmt::format("The first ten pairs; {} has every draw.", file), "muted");
  }
}

}  // namespace tunica::report
