// SPDX-License-Identifier: Apache-2.0
#include "assembly/evaluator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/constraints.hpp"
#include "assembly/models.hpp"
#include "assembly/objective.hpp"
#include "assembly/run_test.hpp"
#include "assembly/secant.hpp"
#include "assembly/workspace.hpp"
#include "plugins/guarded_model.hpp"
#include "text/escaped.hpp"
#include "tunica/detail/vector_math.hpp"

namespace tunica::assembly {
namespace {

/// A plugin's reason for a failure, which is kept for every evaluation.
std::string bounded(const std::string& reason) {
  constexpr std::size_t longest = 2000;  // bytes
  return reason.size() <= longest ? reason : text::excerpt(reason, longest);
}

/// Whether a model returns finite numbers at rest.
bool answers_at_rest(const Model& model, std::span<const double> parameters) {
  constexpr std::array<double, 6> C{1, 1, 1, 0, 0, 0};
  std::array<double, 6> S{};
  return model.evaluate({1, C, parameters, {}, {}}, {{}, S, {}, {}, {}}).ok() &&
         std::all_of(S.begin(), S.end(), [](double s) { return std::isfinite(s); });
}

/// Appends to the reason which layer's material failed: the one whose call failed, or one without a finite stress even
/// at rest. It appends nothing if neither applies, for example if an energy overflows under load.
std::string failed_layer(const RunTest& test, std::span<const double> materials) {
  const Model* const failed = plugins::last_failed_model();
  std::size_t first = 0;
  for (std::size_t k = 0; k < test.layers.size(); ++k) {
    const std::size_t count = test.layers[k]->describe().parameters.size();
    if (failed != nullptr ? failed == test.layers[k]
                          : !answers_at_rest(*test.layers[k], materials.subspan(first, count)))
      return fmt::format(" (layer {}, model '{}')", k + 1, test.layer_names[k]);
    first += count;
  }
  return "";
}

/// Position of the first number that is not finite, or the size.
std::size_t first_not_finite(std::span<const double> values) {
  if (detail::all_finite(values.data(), values.size())) return values.size();
  const auto found = std::find_if_not(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  return static_cast<std::size_t>(found - values.begin());
}

/// Rows of the residuals' Jacobian of one channel, column by column; `out` is its first row, n free parameters long.
void write_rows(const ChannelObjective& channel, const RunTest& test, const double* by_slot, double* out,
                std::size_t n) {
  const std::size_t count = channel.rows.size();
  const std::size_t* const rows = channel.rows.data();
  const double* const own = channel.own.data();
  if (count == 0) return;
  // Usually all rows of a channel are fitted, and are then contiguous.
  const bool in_a_row = rows[count - 1] - rows[0] == count - 1;
  for (const auto& [free, slot] : test.columns) {
    const double* const values = by_slot + slot * test.size();
    if (in_a_row) {
      const double* __restrict const from = values + (rows[0] - test.offset);
      double* __restrict const to = out + free;
#pragma GCC unroll 4
      for (std::size_t k = 0; k < count; ++k) to[k * n] = own[k] * from[k];
    } else {
      for (std::size_t k = 0; k < count; ++k) out[k * n + free] = own[k] * values[rows[k] - test.offset];
    }
    if (channel.previous.empty()) continue;
    for (std::size_t k = 1; k < count; ++k) {
      out[k * n + free] -= channel.previous[k] * values[rows[k - 1] - test.offset];
    }
  }
  for (const std::size_t free : test.untouched) {
    for (std::size_t k = 0; k < count; ++k) out[k * n + free] = 0;
  }
}

}  // namespace

void WorkspaceDeleter::operator()(Workspace* workspace) const { delete workspace; }

Evaluator::Evaluator(const Layout& layout, const Models& models, const Constraints& constraints,
                     std::vector<RunTest> tests, std::vector<ChannelObjective> fitted, std::vector<PriorRow> priors)
    : layout_(layout),
      models_(models),
      constraints_(constraints),
      tests_(std::move(tests)),
      fitted_(std::move(fitted)),
      priors_(std::move(priors)) {}

Evaluator::~Evaluator() = default;

WorkspacePointer Evaluator::make_workspace() const {
  WorkspacePointer workspace(new Workspace);
  const std::size_t n = layout_.parameters.size();
  for (std::size_t m = 0; m < models_.count(); ++m) workspace->model_parameters.push_back(models_.vector(m).values);
  std::size_t largest = 0, jacobian_size = 0;
  for (const RunTest& test : tests_) {
    workspace->materials.push_back(test.materials.values);
    workspace->own.push_back(test.own.values);
    largest = std::max(largest, test.size());
    jacobian_size = std::max(jacobian_size, test.size() * std::max(test.slots(), n));
  }
  workspace->predictions.resize(layout_.prediction_count);
  workspace->jacobian.resize(jacobian_size);
  workspace->ahead.resize(largest);
  workspace->behind.resize(largest);
  workspace->shifted.resize(n);
  workspace->constraints.resize(constraints_.count());
  return workspace;
}

std::string Evaluator::place(const RunTest& test, std::size_t position) const {
  const std::size_t channel = position / test.rows, row = position % test.rows;
  const auto view = std::find_if(
      layout_.channels.begin(), layout_.channels.end(),
      [&](const MeasuredChannel& candidate) { return candidate.offset == test.offset + channel * test.rows; });
  return fmt::format("channel '{}', row {} ({} {:.6g})", view->observable, row, view->abscissa_name,
                     view->abscissa[row]);
}

TestInput Evaluator::input(const RunTest& test, std::span<const double> at, Workspace& workspace) const {
  const auto number = static_cast<std::size_t>(&test - tests_.data());
  std::vector<double>& materials = workspace.materials[number];
  std::vector<double>& own = workspace.own[number];
  for (const Link& link : test.materials.links) materials[link.position] = at[link.index];
  for (const Link& link : test.own.links) own[link.position] = at[link.index];
  return {*test.model, materials, own, {}, test.layers};
}

Status Evaluator::call(const RunTest& test, std::span<const double> at, std::span<double> values,
                       std::span<double> jacobian, Workspace& workspace) const {
  const TestInput bound = input(test, at, workspace);
  plugins::last_failed_model() = nullptr;
  if (Status status = test.test->predict(bound, {values, jacobian, {}, {}}); !status.ok())
    return Status::failed(fmt::format("test '{}': {}{}", test.name, bounded(status.reason()),
                                      failed_layer(test, bound.model_parameters)));
  if (const std::size_t bad = first_not_finite(values); bad < values.size()) {
    return Status::failed(fmt::format("test '{}': the prediction is {} in {}{}", test.name, values[bad],
                                      place(test, bad), failed_layer(test, bound.model_parameters)));
  }
  return {};
}

Status Evaluator::predict_test(const RunTest& test, std::span<const double> at, std::span<double> values, bool jacobian,
                               Workspace& workspace) const {
  const std::size_t size = test.size();
  if (!jacobian || test.differenced) {
    if (Status status = call(test, at, values, {}, workspace); !status.ok() || !jacobian) return status;
    return difference(test, at, values, workspace);
  }
  const std::span<double> by_slot(workspace.jacobian.data(), test.slots() * size);
  if (Status status = call(test, at, values, by_slot, workspace); !status.ok()) {
    // A path without derivatives can still be simulated.
    if (test.model->describe().history_size == 0 || !call(test, at, values, {}, workspace).ok()) return status;
    return difference(test, at, values, workspace);
  }
  for (const auto& [into, from] : test.sums) {
    for (std::size_t i = 0; i < size; ++i) by_slot[into * size + i] += by_slot[from * size + i];
  }
  if (detail::all_finite(by_slot.data(), by_slot.size())) return {};
  // Derivatives by held parameters are not used, so only the others are checked.
  for (const auto& [index, slot] : test.columns) {
    const auto column = by_slot.subspan(slot * size, size);
    if (const std::size_t bad = first_not_finite(column); bad < size) {
      return Status::failed(fmt::format("test '{}': the derivative by '{}' is {} in {}", test.name,
                                        layout_.parameters[index].name, column[bad], place(test, bad)));
    }
  }
  return {};
}

Status Evaluator::predict(std::span<const double> free, std::span<double> predictions, std::span<double> jacobian,
                          Workspace& workspace) const {
  const std::size_t n = free.size();
  for (const RunTest& test : tests_) {
    const auto values = predictions.subspan(test.offset, test.size());
    if (Status status = predict_test(test, free, values, !jacobian.empty(), workspace); !status.ok()) return status;
    if (jacobian.empty()) continue;
    double* const out = &jacobian[test.offset * n];
    for (const auto& [index, slot] : test.columns) {
      const double* const column = workspace.jacobian.data() + slot * test.size();
      for (std::size_t i = 0; i < test.size(); ++i) out[i * n + index] = column[i];
    }
    for (const std::size_t index : test.untouched) {
      for (std::size_t i = 0; i < test.size(); ++i) out[i * n + index] = 0;
    }
  }
  return {};
}

Status Evaluator::add_costs(bool costly, std::span<const double> at, double& total, const Wanted& wanted,
                            Workspace& workspace) const {
  const std::size_t n = layout_.parameters.size();
  auto channel = fitted_.begin();  // sorted by test
  for (std::size_t t = 0; t < tests_.size(); ++t) {
    const RunTest& test = tests_[t];
    const auto behind =
        std::find_if(channel, fitted_.end(), [t](const ChannelObjective& candidate) { return candidate.test != t; });
    if (test.costly != costly) {
      channel = behind;
      continue;
    }
    double cost = 0;
    if (channel != behind) {
      const auto values = std::span(workspace.predictions).subspan(test.offset, test.size());
      if (Status status = predict_test(test, at, values, !wanted.jacobian.empty(), workspace); !status.ok())
        return status;
    }
    for (; channel != behind; ++channel) {
      const auto number = static_cast<std::size_t>(channel - fitted_.begin());
      cost += channel_cost(*channel, workspace.measured.empty() ? channel->measured : workspace.measured[number],
                           workspace.predictions, wanted.residuals);
      if (wanted.jacobian.empty()) continue;
      write_rows(*channel, test, workspace.jacobian.data(), &wanted.jacobian[channel->block.offset * n], n);
    }
    if (!wanted.per_test.empty()) wanted.per_test[t] = cost;
    total += cost;
  }
  return {};
}

void Evaluator::add_priors(std::span<const double> at, double& total, const Wanted& wanted) const {
  const std::size_t n = layout_.parameters.size();
  std::size_t row = layout_.residual_count - priors_.size();
  for (const PriorRow& prior : priors_) {
    const double residual = (at[prior.index] - prior.mean) / prior.sd;
    total += residual * residual;
    if (!wanted.residuals.empty()) wanted.residuals[row] = residual;
    if (!wanted.jacobian.empty()) {
      std::fill_n(&wanted.jacobian[row * n], n, 0.0);
      wanted.jacobian[row * n + prior.index] = 1 / prior.sd;
    }
    ++row;
  }
}

Status Evaluator::evaluate(std::span<const double> free, double& objective, std::span<double> per_test,
                           std::span<double> residuals, std::span<double> jacobian, Workspace& workspace,
                           CostlyTests costly) const {
  const Wanted wanted{per_test, residuals, jacobian};
  double total = 0;
  if (Status status = add_costs(false, free, total, wanted, workspace); !status.ok()) return status;
  Status verdict = constraints_.feasibility(free, workspace);
  if (verdict.kind() == Status::Kind::failed) return verdict;
  const bool simulated = costly == CostlyTests::everywhere || (costly == CostlyTests::where_feasible && verdict.ok());
  if (simulated || !residuals.empty()) {
    if (Status status = add_costs(true, free, total, wanted, workspace); !status.ok()) return status;
  } else if (!per_test.empty()) {
    for (std::size_t t = 0; t < tests_.size(); ++t)
      if (tests_[t].costly) per_test[t] = std::numeric_limits<double>::quiet_NaN();
  }
  add_priors(free, total, wanted);
  if (!std::isfinite(total))
    return Status::failed("the objective overflows: predictions are finite, their squares are not");
  objective = total;
  return verdict;
}

void Evaluator::measure(std::span<const double> values, Workspace& workspace) const {
  workspace.measured.clear();
  if (values.empty()) return;
  for (const ChannelObjective& channel : fitted_) {
    auto& measured = workspace.measured.emplace_back();
    for (const std::size_t row : channel.rows) measured.push_back(values[row]);
  }
}

void Evaluator::remember(SecantMemory* memory, Workspace& workspace) const {
  workspace.secant = memory;
  if (memory != nullptr) memory->tests.resize(tests_.size());
}

std::vector<std::pair<std::string, std::vector<Effort>>> Evaluator::efforts() const {
  std::vector<std::pair<std::string, std::vector<Effort>>> found;
  for (const RunTest& test : tests_) found.emplace_back(test.name, test.test->efforts());
  return found;
}

void Evaluator::transpose_residuals(std::span<const double> by_residual, std::span<double> by_prediction) const {
  std::fill(by_prediction.begin(), by_prediction.end(), 0.0);
  for (const ChannelObjective& channel : fitted_)
    for (std::size_t k = 0; k < channel.rows.size(); ++k) {
      const double value = by_residual[channel.block.offset + k];
      by_prediction[channel.rows[k]] += channel.own[k] * value;
      if (k > 0 && !channel.previous.empty()) by_prediction[channel.rows[k - 1]] -= channel.previous[k] * value;
    }
}

Status Evaluator::ask(std::size_t number, std::span<const double> free,
                      const std::function<Status(const Test&, const TestInput&)>& question) const {
  const RunTest& test = tests_.at(number);
  const WorkspacePointer workspace = make_workspace();
  return question(*test.test, input(test, free, *workspace));
}

Status Evaluator::diagnostics(std::size_t number, std::span<const double> free,
                              std::vector<std::pair<std::string, std::vector<double>>>& rows) const {
  const RunTest& test = tests_.at(number);
  const auto& names = test.test->describe().diagnostics;
  std::vector<double> predictions(test.size()), values(names.size() * test.rows);
  Status status = ask(number, free, [&](const Test& asked, const TestInput& input) {
    return asked.predict(input, {predictions, {}, {}, values});
  });
  if (!status.ok()) return status;
  rows.clear();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(k * test.rows);
    rows.emplace_back(names[k], std::vector<double>(first, first + static_cast<std::ptrdiff_t>(test.rows)));
  }
  return {};
}

}  // namespace tunica::assembly
