// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/remedy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace tunica::uncertainty {
namespace {

constexpr double worth_it = 3;        // times as sensitive as the present tests
constexpr double nearly_best = 0.7;   // of the best: then the simpler test is named
constexpr std::size_t stretches = 8;  // looked at in each test

/// A sheet with stretches λ^along and λ^across in its plane, the first at an angle to the circumference.
struct Sheet {
  const char* words;
  double along, across, angle;
};
constexpr Sheet sheets[] = {
    {"A sheet stretched equally along both axes", 1, 1, 0},
    {"A sheet stretched along the circumference at fixed axial length", 1, 0, 0},
    {"A sheet stretched along the axis at fixed circumference", 1, 0, std::numbers::pi / 2},
    {"A sheet or strip cut at 45 deg to the axes, with its shear measured,", 1, 0, std::numbers::pi / 4}};

/// In-plane stresses tt, zz, tz of the sheet at its stretches, and their derivatives along each step.
struct SheetChange {
  double largest = 0;
  std::vector<double> change;  ///< by step, of the largest
};

bool sheet_change(const assembly::Assembly& assembly, std::size_t number, std::span<const double> free,
                  const std::vector<std::vector<double>>& steps, const Sheet& sheet, double stretch,
                  SheetChange& change) {
  const Model& model = assembly.models().model(number);
  const std::vector<double> parameters = assembly.models().parameters(number, free);
  std::vector<double> C(6 * stretches, 0.0), stress(6 * stretches, 0.0), by(parameters.size() * 6 * stretches, 0.0);
  const double c = std::cos(sheet.angle), s = std::sin(sheet.angle);
  for (std::size_t i = 0; i < stretches; ++i) {
    const double lambda = 1 + (stretch - 1) * static_cast<double>(i + 1) / static_cast<double>(stretches);
    const double a = std::pow(lambda, 2 * sheet.along), b = std::pow(lambda, 2 * sheet.across);
    C[i] = a * c * c + b * s * s;
    C[stretches + i] = a * s * s + b * c * c;
    C[2 * stretches + i] = 1 / (a * b);
    C[3 * stretches + i] = (a - b) * c * s;
  }
  MaterialPoints points;
  points.count = stretches;
  points.C = C;
  points.parameters = parameters;
  MaterialResponse response;
  response.stress = stress;
  response.stress_dp = by;
  if (!model.evaluate(points, response).ok()) return false;

  // In-plane part of S − S_rr C_rr C⁻¹ from six components at point i; det of the in-plane block is 1/C_rr.
  const auto in_plane = [&](const double* S, std::size_t i, double(&out)[3]) {
    const double rr = S[2 * stretches + i] * C[2 * stretches + i] * C[2 * stretches + i];
    out[0] = S[i] - rr * C[stretches + i];
    out[1] = S[stretches + i] - rr * C[i];
    out[2] = S[3 * stretches + i] + rr * C[3 * stretches + i];
  };
  change.change.assign(steps.size(), 0.0);
  for (std::size_t i = 0; i < stretches; ++i) {
    double S[3];
    in_plane(stress.data(), i, S);
    for (const double value : S) change.largest = std::max(change.largest, std::abs(value));
    for (std::size_t k = 0; k < steps.size(); ++k) {
      std::vector<double> moved(free.begin(), free.end());
      for (std::size_t j = 0; j < moved.size(); ++j) moved[j] += steps[k][j];
      const std::vector<double> there = assembly.models().parameters(number, moved);
      double sum[3] = {}, dS[3];
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        in_plane(by.data() + 6 * p * stretches, i, dS);
        for (int component = 0; component < 3; ++component)
          sum[component] += dS[component] * (there[p] - parameters[p]);
      }
      for (const double value : sum) change.change[k] = std::max(change.change[k], std::abs(value));
    }
  }
  return std::isfinite(change.largest) && change.largest > 0 &&
         std::all_of(change.change.begin(), change.change.end(), [](double value) { return std::isfinite(value); });
}

/// The largest relative change that some channel of the present tests shows, by step.
std::vector<double> present(const assembly::Assembly& assembly, std::span<const double> free,
                            const std::vector<std::vector<double>>& steps) {
  const std::size_t n = free.size();
  std::vector<double> values(assembly.layout().prediction_count), by_free(values.size() * n), found(steps.size(), 0.0);
  const auto workspace = assembly.evaluator().make_workspace();
  if (!assembly.evaluator().predict(free, values, by_free, *workspace).ok()) return {};
  for (const assembly::MeasuredChannel& view : assembly.layout().channels) {
    double largest = 0;
    for (std::size_t i = 0; i < view.count; ++i) largest = std::max(largest, std::abs(values[view.offset + i]));
    if (!(largest > 0) || view.weight == 0) continue;
    for (std::size_t k = 0; k < steps.size(); ++k)
      for (std::size_t i = 0; i < view.count; ++i) {
        if (!view.fitted[i]) continue;
        double change = 0;
        for (std::size_t j = 0; j < n; ++j) change += by_free[(view.offset + i) * n + j] * steps[k][j];
        found[k] = std::max(found[k], std::abs(change) / largest);
      }
  }
  return found;
}

const char* const elsewhere =
    " To fix it, take the value of one of them from elsewhere, or add data of another kind: another direction, both "
    "directions at once, a larger stretch.";

}  // namespace

std::string remedy_in_words(const assembly::Assembly& assembly, std::span<const double> free,
                            const std::vector<std::vector<double>>& steps) {
  const double stretch = assembly.models().largest_stretch();
  if (!(stretch > 1) || steps.empty()) return elsewhere;
  const std::vector<double> now = present(assembly, free, steps);
  if (now.empty()) return elsewhere;
  // How many times as well as the present tests the worst direction is seen. Exact valleys: as well as rounding lets
  // us tell.
  std::vector<double> gains;  // by model, then by sheet
  for (std::size_t model = 0; model < assembly.models().count(); ++model) {
    if (!assembly.models().model(model).describe().parameter_derivatives) return elsewhere;
    for (const Sheet& sheet : sheets) {
      SheetChange change;
      double gain = std::numeric_limits<double>::infinity();
      if (!sheet_change(assembly, model, free, steps, sheet, stretch, change)) gain = 0;
      for (std::size_t k = 0; k < change.change.size() && gain > 0; ++k)
        gain = std::min(gain, change.change[k] / change.largest / std::max(now[k], 1e-9));
      gains.push_back(gain);
    }
  }
  const double best = *std::max_element(gains.begin(), gains.end());
  if (best < worth_it)
    return fmt::format(" No in-plane test of a sheet to stretch {:.3g} would see it {:g} times as well.{}", stretch,
                       worth_it, elsewhere);
  const auto chosen = static_cast<std::size_t>(
      std::find_if(gains.begin(), gains.end(), [&](double gain) { return gain >= nearly_best * best; }) -
      gains.begin());
  const double gain = gains[chosen];
  const std::string of_model =
      assembly.models().count() > 1
          ? fmt::format(" of the material '{}' alone", assembly.models().name(chosen / std::size(sheets)))
          : "";
  return fmt::format(
      " {}{} to stretch {:.3g} would show it {}: relative to their largest value, its stresses change {}.",
      sheets[chosen % std::size(sheets)].words, of_model, stretch, gain > 1e3 ? "at all" : "best",
      gain > 1e3
          ? std::string("along it, and those of the present tests do not")
          : fmt::format("{:.{}f} times as much along it as those of the present tests", gain, gain < 10 ? 1 : 0));
}

}  // namespace tunica::uncertainty
