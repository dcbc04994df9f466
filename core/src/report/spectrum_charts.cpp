// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "report/sections.hpp"

namespace tunica::report {

namespace {

/// A value with its 95 % interval: that of the posterior where there are draws, else the linearised one.
struct Bounded {
  double value = NAN, low = NAN, high = NAN;
};

Bounded bounded(const Json& run, const std::string& name) {
  const Json& estimate = entry(member(member(run, key::best), key::parameters), name);
  if (!estimate.is_object()) return {number(entry(member(run, key::fixed), name), key::value), NAN, NAN};
  Bounded found{number(estimate, key::value), NAN, NAN};
  for (const results::Key kind : {key::posterior_ci95, key::ci95}) {
    const Json& ends = member(estimate, kind);
    if (!ends.is_array() || ends.size() != 2 || !ends[0].is_number() || !ends[1].is_number()) continue;
    found.low = ends[0].get<double>();
    found.high = ends[1].get<double>();
    break;
  }
  return found;
}

/// What owns both a stiffness `g` and a time `tau`, fitted or held: the branches of a Prony series.
std::vector<std::string> branches_of(const Json& run) {
  constexpr std::string_view stiffness = ".g";
  const std::array<const Json*, 2> places{&member(member(run, key::best), key::parameters), &member(run, key::fixed)};
  const auto known = [&](const std::string& name) {
    return std::any_of(places.begin(), places.end(), [&](const Json* place) { return !entry(*place, name).is_null(); });
  };
  std::vector<std::string> found;
  for (const Json* place : places)
    if (place->is_object())
      for (const auto& [name, value] : place->items()) {
        if (!name.ends_with(stiffness)) continue;
        const std::string owner = name.substr(0, name.size() - stiffness.size());
        if (known(owner + ".tau")) found.push_back(owner);
      }
  return found;
}

/// One symbol a branch, with a bar along each axis.
void add_branches(Chart& chart, const Order::Run& run, int style, const std::vector<std::string>& branches) {
  Series points{run.label, "points", style}, bars{run.label, "bars", style}, across{run.label, "line", style};
  for (const std::string& branch : branches) {
    const Bounded g = bounded(*run.run, branch + ".g"), tau = bounded(*run.run, branch + ".tau");
    if (!std::isfinite(g.value) || !std::isfinite(tau.value)) continue;
    points.x.push_back(tau.value);
    points.y.push_back(g.value);
    if (std::isfinite(g.low)) {
      bars.x.push_back(tau.value);
      bars.y.push_back(g.value);
      bars.low.push_back(g.low);
      bars.high.push_back(g.high);
    }
    if (std::isfinite(tau.low)) {
      across.x.insert(across.x.end(), {tau.low, tau.high, tau.high});
      across.y.insert(across.y.end(), {g.value, g.value, NAN});
    }
  }
  if (points.x.empty()) return;
  for (Series* const series : {&bars, &across})
    if (!series->x.empty()) chart.series.push_back(std::move(*series));
  chart.series.push_back(std::move(points));
}

}  // namespace

void add_spectra(Page& page, const Folder& folder, const Order& order) {
  std::vector<const Order::Run*> models;  ///< the first run of each model
  for (const auto& run : order.runs())
    if (std::none_of(models.begin(), models.end(), [&](const Order::Run* one) { return one->model == run.model; }))
      models.push_back(&run);
  bool begun = false;
  for (const Order::Run* const first : models) {
    const std::string& model = first->model;
    const auto branches = branches_of(*first->run);
    if (branches.empty()) continue;
    Chart chart;
    chart.id = "spectrum_" + model;
    chart.title = "Relaxation spectrum of " + model;
    chart.about = fmt::format("Stiffness over relaxation time of the {} of {}, with 95 % intervals of both",
                              branches.size() == 1 ? "branch" : "branches", model);
    chart.note = "Stiffness relative to the equilibrium response; bars are 95 % intervals.";
    chart.files = {"result.json"};
    chart.x.title = "relaxation time [s]";
    chart.x.log = true;
    chart.y = {"stiffness of the branch [1]", false, {0}, {}};
    for (const auto& run : order.runs())
      if (run.model == model) add_branches(chart, run, static_cast<int>(order.place(run.label)), branches);
    if (chart.series.empty()) continue;
    if (!begun) {
      page.heading("What relaxes, and how fast");
      page.begin_pair();
      begun = true;
    }
    page.chart(chart, folder.address());
  }
  if (begun) page.end_pair();
}

}  // namespace tunica::report
