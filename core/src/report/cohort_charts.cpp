// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "report/sections.hpp"
#include "report/thinning.hpp"
#include "text/units.hpp"

namespace tunica::report {

namespace {

constexpr std::size_t points_of_small = 60;  ///< of a small curve
constexpr std::size_t most_measured = 40;    ///< specimens whose data lie under a band
constexpr std::size_t most_fits = 500;       ///< small multiples
constexpr std::size_t most_intervals = 80;   ///< specimens of which a chart of estimates shows intervals

/// The name of a specimen's group as populations have it: its levels of the factors.
std::vector<std::string> factors_of(const Json& population) {
  std::vector<std::string> names;
  for (const Json& test : list(member(population, key::parameters), key::factors))
    names.push_back(word(test, key::factor));
  return names;
}

std::string group_of(const Table& table, std::size_t row, const std::vector<std::string>& factors) {
  std::string name;
  for (const std::string& factor : factors) name += (name.empty() ? "" : ", ") + table.text(row, factor);
  return name.empty() ? "all" : name;
}

const Json& cohort(const Folder& folder) { return member(folder.result(), key::cohort); }

/// One estimate of one specimen.
struct Point {
  std::string specimen, group;
  double value, low, high, shrunken;
};

/// Specimens one beside the other, groups apart: own estimate with interval, with the help of the others, and the
/// typical specimen with its interval.
Chart estimate_chart(const std::string& name, const std::string& unit, bool log, const std::vector<Point>& points,
                     const Json& means) {
  Chart chart;
  chart.title = name;
  chart.id = "estimates_" + name;
  chart.about = fmt::format("{} of every specimen, group by group", name);
  chart.x.title = "specimens, by group";
  chart.y = {text::titled(name, unit), log, {}, {}};
  const bool with_intervals = points.size() <= most_intervals;
  std::vector<std::string> groups;
  for (const auto& entry : means.items()) groups.push_back(entry.key());
  double at = 0;
  int style = 0;
  for (const std::string& group : groups) {
    Series own{group, "points", style}, helped{group + ", with the others' help", "points", style};
    Series typical{group, "line", style}, interval{group, "bars", style};
    interval.faint = true;
    helped.faint = true;
    const double begin = at;
    for (const Point& point : points) {
      if (point.group != group) continue;
      own.x.push_back(at);
      own.y.push_back(point.value);
      if (with_intervals && std::isfinite(point.low) && std::isfinite(point.high)) {
        interval.x.push_back(at);
        interval.y.push_back(point.value);
        interval.low.push_back(point.low);
        interval.high.push_back(point.high);
      }
      if (std::isfinite(point.shrunken)) {
        helped.x.push_back(at + 0.3);
        helped.y.push_back(point.shrunken);
      }
      at += 1;
    }
    const Json& mean = entry(means, group);
    const Json& ci = list(mean, key::ci95);
    for (const double x : {begin - 0.5, at - 0.5}) {
      typical.x.push_back(x);
      typical.y.push_back(number(mean, key::value));
      typical.low.push_back(ci.size() == 2 && ci[0].is_number() ? ci[0].get<double>() : NAN);
      typical.high.push_back(ci.size() == 2 && ci[1].is_number() ? ci[1].get<double>() : NAN);
    }
    if (!std::isfinite(typical.low.front())) {
      typical.low.clear();
      typical.high.clear();
    }
    chart.series.push_back(std::move(typical));
    if (!interval.x.empty()) chart.series.push_back(std::move(interval));
    chart.series.push_back(std::move(own));
    if (!helped.x.empty()) {
      helped.hidden = true;
      chart.series.push_back(std::move(helped));
    }
    at += 1.5;
    ++style;
  }
  chart.legend = true;
  chart.note = "Line and band: the typical specimen of the group with its 95 % interval.";
  if (with_intervals) chart.note += " Bars: 95 % intervals of the specimens by themselves.";
  return chart;
}

void add_parameters_of(Page& page, const Folder& folder, const Json& population) {
  const auto table = folder.table("parameters.csv");
  const auto shrunken = folder.table("shrunken.csv");
  if (!table) return;
  const std::string run = word(population, key::run);
  const auto factors = factors_of(population);
  std::map<std::pair<std::string, std::string>, double> helped;
  for (std::size_t row = 0; shrunken && row < shrunken->rows(); ++row)
    if (shrunken->text(row, "run") == run)
      helped[{shrunken->text(row, "specimen"), shrunken->text(row, "parameter")}] = shrunken->number(row, "estimate");
  for (const auto& [name, one] : member(member(population, key::parameters), key::of).items()) {
    std::vector<Point> points;
    for (std::size_t row = 0; row < table->rows(); ++row) {
      if (table->text(row, "run") != run || table->text(row, "parameter") != name) continue;
      const std::string specimen = table->text(row, "specimen");
      const auto with_help = helped.find({specimen, name});
      points.push_back({specimen, group_of(*table, row, factors), table->number(row, "estimate"),
                        table->number(row, "lower"), table->number(row, "upper"),
                        with_help == helped.end() ? NAN : with_help->second});
    }
    Chart chart = estimate_chart(name, word(one, key::unit), word(member(one, key::spread), key::scale) == "log",
                                 points, member(one, key::means));
    chart.id += "_" + run;
    chart.files = {"parameters.csv", "shrunken.csv"};
    page.chart(chart, folder.address());
  }
}

void add_readings_of(Page& page, const Folder& folder, const Json& population) {
  const auto table = folder.table("specimens.csv");
  if (!table) return;
  const auto factors = factors_of(population);
  std::map<std::string, std::string> group;
  for (std::size_t row = 0; row < table->rows(); ++row)
    group[table->text(row, "specimen")] = group_of(*table, row, factors);
  for (const auto& [name, one] : member(member(population, key::readings), key::of).items()) {
    if (!member(one, key::means).is_object()) continue;
    std::vector<Point> points;
    for (const auto& [specimen, value] : member(one, key::specimens).items())
      points.push_back({specimen, group[specimen], number(value, key::value), NAN, NAN, NAN});
    Chart chart = estimate_chart(name, word(one, key::unit), word(member(one, key::spread), key::scale) == "log",
                                 points, member(one, key::means));
    chart.id += "_" + word(population, key::run);
    chart.files = {"population.csv"};
    page.chart(chart, folder.address());
  }
}

/// A curve that turns, a loop for example, as one series a branch: a band that runs back over itself would be no area.
std::vector<Series> branches_of(const Series& whole) {
  std::vector<Series> branches;
  double direction = 0;
  for (std::size_t k = 0; k < whole.x.size(); ++k) {
    const double step = k > 0 ? whole.x[k] - whole.x[k - 1] : 0;
    const bool turns = step * direction < 0;
    if (step != 0) direction = step;
    if (k == 0 || turns) {
      branches.push_back({whole.name, whole.mark, whole.style});
      branches.back().label = branches.size() > 1 ? fmt::format("branch {}", branches.size()) : "";
    }
    for (const std::size_t from : {k - 1, k}) {
      if (from == k - 1 && (k == 0 || !turns)) continue;  // a branch begins where the last one ended
      branches.back().x.push_back(whole.x[from]);
      branches.back().y.push_back(whole.y[from]);
      branches.back().low.push_back(whole.low[from]);
      branches.back().high.push_back(whole.high[from]);
    }
  }
  return branches;
}

/// The measured values in the specimens of a group, below its band.
Series measured_of(const Folder& folder, const std::string& file, const std::string& channel,
                   const std::vector<std::string>& specimens) {
  Series data{"measured", "points", -1};
  data.faint = true;
  for (const std::string& specimen : specimens) {
    const auto fit = folder.table(fmt::format("{}/{}", specimen, file));
    const auto column = fit ? fit->find(channel) : std::nullopt;
    if (!column) continue;
    const auto rows = fit->groups("run").front().second;
    for (const std::size_t k : evenly(rows.size(), points_of_small)) {
      data.x.push_back(fit->number(rows[k], std::size_t{1}));
      data.y.push_back(fit->number(rows[k], *column));
    }
  }
  return data;
}

std::map<std::string, std::vector<std::string>> folders_by_group(const Folder& folder, const Json& population) {
  std::map<std::string, std::vector<std::string>> found;
  const auto table = folder.table("specimens.csv");
  for (std::size_t row = 0; table && row < table->rows(); ++row)
    if (table->text(row, "outcome") == "fitted" && table->text(row, "run") == word(population, key::run))
      found[group_of(*table, row, factors_of(population))].push_back("specimens/" + table->text(row, "folder"));
  return found;
}

}  // namespace

void add_bands(Page& page, const Folder& folder) {
  const auto files = folder.tables("band_");
  if (files.empty()) return;
  page.section("The next specimen");
  page.paragraph(
      "The curve of the typical material of each group. The band holds 95 % of new specimens of new animals. Points: "
      "what was measured in the specimens of the group.");
  for (const Json& population : list(cohort(folder), key::populations)) {
    const std::string run = word(population, key::run);
    const auto specimens = folders_by_group(folder, population);
    page.begin_pair();
    for (const std::string& file : files) {
      const auto table = folder.table(file);
      if (!table) continue;
      const std::string test = file.substr(5, file.size() - 9);
      for (const auto& [channel, in_channel] : table->groups("channel"))
        for (const auto& [group, in_group] : table->groups("group")) {
          Chart chart;
          chart.title = fmt::format("{}: {}, {}", test, channel, group);
          chart.id = fmt::format("band_{}_{}_{}_{}", test, channel, group, run);
          chart.about = fmt::format("{} of a typical and of a new specimen, {}", channel, group);
          chart.x.title = table->title(3);
          chart.files = {file};
          Series curve{"typical and new specimen", "line", 0};
          for (const std::size_t row : in_channel) {
            if (table->text(row, "group") != group || table->text(row, "run") != run) continue;
            curve.x.push_back(table->number(row, std::size_t{3}));
            curve.y.push_back(table->number(row, "mean"));
            curve.low.push_back(table->number(row, "lower"));
            curve.high.push_back(table->number(row, "upper"));
            chart.y.title = text::titled(channel, table->text(row, "unit"));
          }
          if (curve.x.empty()) continue;
          auto of_group = specimens.find(group);
          if (of_group != specimens.end()) {
            std::vector<std::string> some;
            for (const std::size_t k : evenly(of_group->second.size(), most_measured))
              some.push_back(of_group->second[k]);
            if (some.size() < of_group->second.size())
              chart.note = fmt::format("Data of {} of {} specimens.", some.size(), of_group->second.size());
            chart.series.push_back(measured_of(folder, "fit_" + test + ".csv", channel, some));
          }
          for (Series& branch : branches_of(curve)) chart.series.push_back(std::move(branch));
          page.chart(chart, folder.address());
        }
    }
    page.end_pair();
  }
}

void add_specimen_estimates(Page& page, const Folder& folder) {
  page.section("Parameters of the specimens");
  for (const Json& population : list(cohort(folder), key::populations)) {
    if (!word(population, key::problem).empty()) continue;
    page.heading(word(population, key::run));
    page.begin_pair();
    add_parameters_of(page, folder, population);
    add_readings_of(page, folder, population);
    page.end_pair();
  }
}

void add_specimen_fits(Page& page, const Folder& folder) {
  const Json& specimens = list(cohort(folder), key::specimens);
  std::size_t drawn = 0;
  for (const Json& one : specimens) drawn += word(one, key::outcome) == "fitted" ? 1 : 0;
  if (drawn == 0) return;
  page.begin_fold(fmt::format("Data and fit of {}", count_of(std::min(drawn, most_fits), "specimen", "specimens")));
  drawn = 0;
  for (const Json& one : specimens) {
    if (word(one, key::outcome) != "fitted" || drawn++ >= most_fits) continue;
    for (const std::string& file : folder.tables_in(word(one, key::folder), "fit_")) {
      const auto table = folder.table(file);
      if (!table) continue;
      for (std::size_t k = 2; k < table->columns().size(); ++k) {
        const auto predicted = table->find(table->columns()[k].name + ".predicted");
        if (!predicted) continue;
        Chart chart;
        chart.title = word(one, key::id);
        chart.id = fmt::format("fit_{}_{}", word(one, key::id), k);
        chart.about = fmt::format("Measured and fitted {} of {}", table->columns()[k].name, word(one, key::id));
        chart.x.title = table->title(1);
        chart.y.title = table->title(k);
        chart.low_height = true;
        int style = 0;
        for (const auto& [run, rows] : table->groups("run")) {
          Series data{"measured", "points", -1}, fit{run, "line", style};
          for (const std::size_t at : evenly(rows.size(), points_of_small)) {
            data.x.push_back(table->number(rows[at], std::size_t{1}));
            data.y.push_back(table->number(rows[at], k));
            fit.x.push_back(data.x.back());
            fit.y.push_back(table->number(rows[at], *predicted));
          }
          if (style++ == 0) chart.series.push_back(std::move(data));
          chart.series.push_back(std::move(fit));
        }
        page.chart(chart, folder.address());
      }
    }
  }
  page.end_fold();
}

}  // namespace tunica::report
