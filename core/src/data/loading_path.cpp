// SPDX-License-Identifier: Apache-2.0
#include "data/loading_path.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "data/cycles.hpp"

namespace tunica::data {
namespace {

constexpr double far_from_rest = 0.5, clearly_moved = 0.1, turned = 0.05;
constexpr double at_rest = 0.01;  ///< of a stretch, from 1
constexpr double held = 1e-3;     ///< of the farthest distance
constexpr std::size_t rows_held = 4;

const Observable* observable_of(const std::string& name, const std::vector<Observable>& observables) {
  for (const Observable& observable : observables)
    if (observable.name == name) return &observable;
  return nullptr;
}

double rest_of(const Observable& observable) { return observable.kind == Observable::Kind::stretch ? 1 : 0; }

/// |x − rest| of every row.
std::vector<double> distances(const std::vector<double>& path, double rest) {
  std::vector<double> found;
  for (const double x : path) found.push_back(std::abs(x - rest));
  return found;
}

bool starts_far(const std::vector<double>& distance) {
  return distance.front() > far_from_rest * *std::max_element(distance.begin(), distance.end());
}

bool starts_unloading(const std::vector<double>& path, double rest) {
  const std::vector<double> distance = distances(path, rest);
  if (!starts_far(distance)) return false;
  const double farthest = *std::max_element(distance.begin(), distance.end()), step = clearly_moved * farthest;
  // Creep and relaxation jump to where they are held: that is a loading, which no row is taken of.
  const auto left = std::find_if(distance.begin(), distance.end(),
                                 [&](double one) { return std::abs(one - distance.front()) > held * farthest; });
  if (left - distance.begin() >= static_cast<std::ptrdiff_t>(rows_held)) return false;
  const auto moved = std::find_if(distance.begin(), distance.end(),
                                  [&](double one) { return std::abs(one - distance.front()) > step; });
  return moved != distance.end() && *moved < distance.front();
}

/// Whether the path comes back over several rows, and no branch but the last has fewer. Rows in any other order than
/// the measured one turn at once; where a second curve begins, the path jumps back.
bool runs_to_and_fro(const std::vector<double>& path) {
  constexpr std::size_t several = 5;
  if (path.empty()) return false;
  const std::vector<Branch> found = branches_of(path, path.front());
  const auto is_long = [](const Branch& branch) { return branch.last - branch.first >= several; };
  return found.size() > 1 && std::all_of(found.begin(), found.end() - 1, is_long) &&
         std::any_of(found.begin(), found.end(),
                     [&](const Branch& branch) { return !branch.loading && is_long(branch); });
}

/// A branch ends at every turning point but the first.
std::size_t branches(const std::vector<double>& points) { return points.size() < 2 ? 0 : points.size() - 1; }

std::string start_words(const std::vector<double>& path, double rest) {
  const std::vector<double> distance = distances(path, rest);
  if (starts_unloading(path, rest)) return "starts far from rest and unloads";
  if (starts_far(distance)) return "starts far from rest";
  const double farthest = *std::max_element(distance.begin(), distance.end());
  const double near = rest == 0 ? turned * farthest : std::min(turned * farthest, at_rest);
  return distance.front() <= near ? "starts at rest" : "starts near rest";
}

}  // namespace

Past past_of(const Dataset& dataset, const std::vector<Observable>& observables) {
  if (!dataset.ordered) return Past::order_unknown;
  for (const auto& [name, path] : dataset.abscissae) {
    const Observable* const observable = observable_of(name, observables);
    if (observable != nullptr && !path.empty() && starts_unloading(path, rest_of(*observable)))
      return Past::starts_unloading;
  }
  return Past::known;
}

std::optional<LoadedStart> loaded_start_of(const Dataset& dataset, const std::vector<Observable>& observables) {
  const std::vector<double>& time = dataset.time;
  if (time.size() < 2 || !(time.front() > time[1] - time.front())) return std::nullopt;
  std::optional<LoadedStart> found;
  for (const auto& [name, path] : dataset.abscissae) {
    const Observable* const observable = observable_of(name, observables);
    if (observable == nullptr || observable->kind == Observable::Kind::plain || path.empty()) continue;
    if (!starts_far(distances(path, rest_of(*observable)))) return std::nullopt;
    if (!found) found = LoadedStart{name, path.front(), time.front()};
  }
  return found;
}

void sort_rows(Dataset& dataset) {
  if (dataset.abscissae.empty() || runs_to_and_fro(dataset.abscissae.front().second)) return;
  std::vector<std::pair<std::size_t, const std::vector<double>*>> keys;
  for (const auto& [name, values] : dataset.abscissae) {
    std::set<double> found;
    for (const double value : values)
      if (!std::isnan(value)) found.insert(value);
    const std::size_t different = found.size();
    keys.emplace_back(4 * different <= dataset.count ? different : dataset.count, &values);
  }
  std::stable_sort(keys.begin(), keys.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const Channel& channel : dataset.channels) keys.emplace_back(dataset.count, &channel.values);
  std::vector<std::size_t> rows(dataset.count);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    const auto key = [](double value) { return std::isnan(value) ? INFINITY : value; };  // a missing cell
    for (const auto& [different, values] : keys)
      if (key((*values)[a]) != key((*values)[b])) return key((*values)[a]) < key((*values)[b]);
    return false;
  });
  const auto sort = [&rows](auto& values) {
    if (values.empty()) return;
    auto sorted = values;
    for (std::size_t i = 0; i < rows.size(); ++i) sorted[i] = values[rows[i]];
    values = std::move(sorted);
  };
  for (auto& [name, values] : dataset.abscissae) sort(values);
  for (Channel& channel : dataset.channels) {
    sort(channel.values);
    for (auto& replicate : channel.replicates) sort(replicate);
  }
  sort(dataset.lines);
  sort(dataset.time);
  dataset.file_rows = std::move(rows);
}

std::vector<double> turning_points(std::span<const double> path) {
  if (path.empty()) return {};
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const double least = turned * (*high - *low);
  std::vector<double> points = {path.front()};
  double extreme = path.front();
  int direction = 0;  // of the branch that is under way
  for (const double x : path) {
    if (direction == 0) {
      if (std::abs(x - points.front()) > least) direction = x > points.front() ? 1 : -1;
      if (direction != 0) extreme = x;
      continue;
    }
    if (direction * (x - extreme) >= 0) {
      extreme = x;
    } else if (std::abs(x - extreme) > least) {
      points.push_back(extreme);
      extreme = x;
      direction = -direction;
    }
  }
  if (direction != 0) points.push_back(extreme);
  return points;
}

std::string path_words(const Dataset& dataset, const std::vector<Observable>& observables) {
  if (dataset.abscissae.empty() || dataset.count == 0) return {};
  const auto& [name, path] = dataset.abscissae.front();
  const std::vector<double> points = turning_points(path);
  constexpr std::size_t shown = 5;
  std::string words = name;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points.size() > shown && k == shown - 2) words += " → …";
    if (points.size() > shown && k >= shown - 2 && k + 1 < points.size()) continue;
    words += fmt::format("{}{:.4g}", k == 0 ? " " : " → ", points[k]);
  }
  if (const std::size_t cycles = branches(points) / 2; cycles > 0)
    words += fmt::format(", {} {}", cycles, cycles == 1 ? "cycle" : "cycles");
  words += fmt::format(", {} rows", dataset.count);
  if (const Observable* const observable = observable_of(name, observables))
    words += "; " + start_words(path, rest_of(*observable));
  return words;
}

std::string path_drawing(std::span<const double> path, std::size_t columns) {
  static constexpr const char* blocks[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
  if (path.empty()) return {};
  const auto [low, high] = std::minmax_element(path.begin(), path.end());
  const std::size_t count = std::min(columns, path.size());
  std::string drawing;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = path[count < 2 ? 0 : k * (path.size() - 1) / (count - 1)];
    const double share = *high > *low ? (x - *low) / (*high - *low) : 0;
    drawing += blocks[static_cast<std::size_t>(std::lround(7 * share))];
  }
  return drawing;
}

}  // namespace tunica::data
