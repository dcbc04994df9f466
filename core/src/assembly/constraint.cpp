// SPDX-License-Identifier: Apache-2.0
#include "assembly/constraint.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "stability/transverse.hpp"
#include "tunica/error.hpp"

namespace tunica::assembly {
namespace {

const char* direction(std::size_t axis) { return axis == 0 ? "circumferential" : "axial"; }

/// h over stretch: a number, or linear between the points of a table, constant outside.
double factor(const experiment::StabilityFactor& table, double stretch) {
  const auto above = std::find_if(table.begin(), table.end(), [&](const auto& row) { return row.first >= stretch; });
  if (above == table.begin()) return table.front().second;
  if (above == table.end()) return table.back().second;
  const auto& [x1, h1] = *above;
  const auto& [x0, h0] = *(above - 1);
  return h0 + (h1 - h0) * (stretch - x0) / (x1 - x0);
}

/// c = (dΨ/dλ1) λ1/(2Ψ) − h at every stretch of one direction.
class TransverseStability final : public Constraint {
 public:
  TransverseStability(const Model& model, std::size_t axis, const std::vector<double>& stretches,
                      const experiment::StabilityFactor& h)
      : path_(model, axis, stretches) {
    for (const double stretch : stretches) h_.push_back(factor(h, stretch));
  }
  [[nodiscard]] std::size_t count() const override { return h_.size(); }
  Status evaluate(std::span<const double> parameters, std::span<double> values,
                  std::span<double> derivatives) const override {
    Status status = path_.slopes(parameters, values, derivatives);
    if (!status.ok()) return Status::failed("transverse stability: " + status.reason());
    for (std::size_t i = 0; i < h_.size(); ++i) values[i] -= h_[i];
    return status;
  }
  [[nodiscard]] std::string words(std::size_t i, double value) const override {
    return fmt::format(
        "transverse stability: {} strip at stretch {:.4g}: d ln λ3/d ln λ1 = {:.3g}, at most {:.3g} "
        "allowed (h = {:g})",
        direction(path_.axis()), path_.stretches()[i], (value + h_[i] - 1) / 2, (h_[i] - 1) / 2, h_[i]);
  }

 private:
  stability::FreePath path_;
  std::vector<double> h_;
};

/// −value of each inequality value ≥ 0 that the model declares; derivatives by differences of these plain formulas.
class AdmissibleParameters final : public Constraint {
 public:
  explicit AdmissibleParameters(const Model& model) : inequalities_(model.describe().admissible) {}
  [[nodiscard]] std::size_t count() const override { return inequalities_.size(); }
  Status evaluate(std::span<const double> parameters, std::span<double> values,
                  std::span<double> derivatives) const override {
    const std::size_t n = inequalities_.size();
    for (std::size_t i = 0; i < n; ++i) values[i] = -inequalities_[i].value(parameters);
    if (derivatives.empty()) return {};
    std::fill(derivatives.begin(), derivatives.end(), 0.0);
    std::vector<double> moved(parameters.begin(), parameters.end());
    for (std::size_t i = 0; i < n; ++i)
      for (const std::size_t j : inequalities_[i].arguments) {
        const double step = 1e-6 * std::max(1.0, std::abs(parameters[j]));
        moved[j] = parameters[j] + step;
        const double above = inequalities_[i].value(moved);
        moved[j] = parameters[j] - step;
        derivatives[j * n + i] = -(above - inequalities_[i].value(moved)) / (2 * step);
        moved[j] = parameters[j];
      }
    return {};
  }
  [[nodiscard]] std::string words(std::size_t i, double value) const override {
    return fmt::format("admissible parameters: {} = {:.3g}, but must not be negative", inequalities_[i].name, -value);
  }

 private:
  std::vector<Combination> inequalities_;
};

/// Sorted, each once; closer than 1e-6 counts as the same.
void unite(std::vector<double>& stretches) {
  std::sort(stretches.begin(), stretches.end());
  const auto same = [](double a, double b) { return b - a < 1e-6; };
  stretches.erase(std::unique(stretches.begin(), stretches.end(), same), stretches.end());
}

std::vector<double> evenly(double first, double last, std::size_t count) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(first + (last - first) * static_cast<double>(k) / static_cast<double>(count - 1));
  return values;
}

void add_transverse(const experiment::ConstraintEntry& entry, std::size_t number, const Model& model,
                    const std::vector<Strip>& strips, std::vector<ModelConstraint>& all) {
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    if (!entry.directions[axis]) continue;
    std::vector<double> stretches;
    for (const Strip& strip : strips)
      if (strip.model == number && strip.axis == axis)
        stretches.insert(stretches.end(), strip.stretches.begin(), strip.stretches.end());
    unite(stretches);
    constexpr std::size_t default_points = 41;
    if (entry.points && !stretches.empty()) stretches = evenly(stretches.front(), stretches.back(), *entry.points);
    if (entry.range) {
      const auto stated = evenly(entry.range->first, entry.range->second, entry.points.value_or(default_points));
      stretches.insert(stretches.end(), stated.begin(), stated.end());
      unite(stretches);
    }
    if (!stretches.empty())
      all.push_back({number, std::make_unique<TransverseStability>(model, axis, stretches, entry.h)});
  }
}

void refuse_empty(const experiment::ConstraintEntry& entry, const std::vector<const Model*>& models) {
  if (entry.type == "transverse_stability")
    throw InputError(
        fmt::format("{}: the run has no free strip in the requested direction, so transverse stability has no "
                    "stretches to be asked at; add a test of type 'uniaxial', or state the stretches: "
                    "\"range\": [1, 1.5]",
                    entry.pointer));
  const std::string who = models.size() == 1 ? fmt::format("the model '{}' declares", models[0]->describe().type)
                                             : std::string("the models of the run declare");
  throw InputError(
      fmt::format("{}: {} no inequality between {} parameters; bounds are enough. Leave the constraint out",
                  entry.pointer, who, models.size() == 1 ? "its" : "their"));
}

}  // namespace

std::vector<ModelConstraint> make_constraints(const std::vector<experiment::ConstraintEntry>& entries,
                                              const std::vector<const Model*>& models,
                                              const std::vector<Strip>& strips) {
  std::vector<ModelConstraint> all;
  for (const auto& entry : entries) {
    const std::size_t before = all.size();
    for (std::size_t m = 0; m < models.size(); ++m) {
      if (entry.type == "transverse_stability" && models[m]->describe().compressible)
        throw InputError(
            fmt::format("{}: the model '{}' changes its volume, and transverse stability is that of an incompressible "
                        "material. Leave the constraint out",
                        entry.pointer, models[m]->describe().type));
      if (entry.type == "transverse_stability")
        add_transverse(entry, m, *models[m], strips, all);
      else if (!models[m]->describe().admissible.empty())
        all.push_back({m, std::make_unique<AdmissibleParameters>(*models[m])});
    }
    if (all.size() == before) refuse_empty(entry, models);
  }
  return all;
}

double stated_range(const std::vector<experiment::ConstraintEntry>& entries) {
  double largest = 1;
  for (const auto& entry : entries)
    if (entry.range) largest = std::max(largest, entry.range->second);
  return largest;
}

}  // namespace tunica::assembly
