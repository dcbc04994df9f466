// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>

#include <fmt/format.h>

#include "calibration/assembly_parts.hpp"

namespace tunica::calibration {
namespace {

/// Position of the first number that is not finite, or the size. 0·v is NaN exactly for those; eight sums side by side
/// keep the check far below the cost of what it checks.
std::size_t first_not_finite(std::span<const double> values) {
  constexpr std::size_t lanes = 8;
  double sums[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= values.size(); i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += 0 * values[i + lane];
  }
  for (; i < values.size(); ++i) sums[0] += 0 * values[i];
  double sum = 0;
  for (const double part : sums) sum += part;
  if (sum == 0) return values.size();
  const auto found = std::find_if_not(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
  return static_cast<std::size_t>(found - values.begin());
}

/// Rows of the residuals' Jacobian of one channel, column by column; `out` is its first row, n free parameters long.
void write_rows(const FittedChannel& channel, const BoundTest& test, const double* by_slot, double* out,
                std::size_t n) {
  const std::size_t count = channel.rows.size();
  const std::size_t* const rows = channel.rows.data();
  const double* const own = channel.own.data();
  for (const auto& [free, slot] : test.columns) {
    const double* const values = by_slot + slot * test.size();
    for (std::size_t k = 0; k < count; ++k) out[k * n + free] = own[k] * values[rows[k] - test.offset];
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

Assembly::Workspace::Workspace(const Parts& parts) {
  for (const BoundModel& model : parts.models) model_parameters.push_back(model.parameters.values);
  std::size_t largest = 0, jacobian_size = 0;
  for (const BoundTest& test : parts.tests) {
    materials.push_back(test.materials.values), own.push_back(test.own.values);
    largest = std::max(largest, test.size());
    jacobian_size = std::max(jacobian_size, test.size() * std::max(test.slots(), parts.free.size()));
  }
  predictions.resize(parts.prediction_count);
  jacobian.resize(jacobian_size);
  ahead.resize(largest), behind.resize(largest), shifted.resize(parts.free.size());
  constraints.resize(parts.constraint_count);
}

std::string Assembly::Parts::place(const BoundTest& test, std::size_t position) const {
  const std::size_t channel = position / test.rows, row = position % test.rows;
  const auto view = std::find_if(channels.begin(), channels.end(), [&](const ChannelView& candidate) {
    return candidate.offset == test.offset + channel * test.rows;
  });
  return fmt::format("channel '{}', row {} ({} {:.6g})", view->observable, row, view->abscissa_name,
                     view->abscissa[row]);
}

TestInput Assembly::Parts::input(const BoundTest& test, std::span<const double> at, Workspace& workspace) const {
  const auto number = static_cast<std::size_t>(&test - tests.data());
  std::vector<double>&materials = workspace.materials[number], &own = workspace.own[number];
  for (const Link& link : test.materials.links) materials[link.position] = at[link.index];
  for (const Link& link : test.own.links) own[link.position] = at[link.index];
  return {*test.model, materials, own, {}, test.layers};
}

Status Assembly::Parts::call(const BoundTest& test, std::span<const double> at, std::span<double> values,
                             std::span<double> jacobian, Workspace& workspace) const {
  try {
    if (Status status = test.test->predict(input(test, at, workspace), {values, jacobian, {}, {}}); !status.ok()) {
      return Status::failed(fmt::format("test '{}': {}", test.name, status.reason()));
    }
  } catch (const std::exception& problem) {
    return Status::failed(fmt::format("test '{}': plugin '{}' with model plugin '{}' threw: {}", test.name, test.plugin,
                                      test.model_plugins, problem.what()));
  } catch (...) {
    return Status::failed(
        fmt::format("test '{}': plugin '{}' with model plugin '{}' threw something that is no "
                    "std::exception",
                    test.name, test.plugin, test.model_plugins));
  }
  if (const std::size_t bad = first_not_finite(values); bad < values.size()) {
    return Status::failed(
        fmt::format("test '{}': the prediction is {} in {}", test.name, values[bad], place(test, bad)));
  }
  return {};
}

Status Assembly::Parts::predict(const BoundTest& test, std::span<const double> at, std::span<double> values,
                                bool jacobian, Workspace& workspace) const {
  const std::size_t size = test.size();
  if (!jacobian || test.differenced) {
    if (Status status = call(test, at, values, {}, workspace); !status.ok() || !jacobian) return status;
    return difference(test, at, values, workspace);
  }
  const std::span<double> by_slot(workspace.jacobian.data(), test.slots() * size);
  if (Status status = call(test, at, values, by_slot, workspace); !status.ok()) return status;
  for (const auto& [into, from] : test.sums) {
    for (std::size_t i = 0; i < size; ++i) by_slot[into * size + i] += by_slot[from * size + i];
  }
  // Derivatives by held parameters are nobody's business: only those that count are checked.
  for (const auto& [index, slot] : test.columns) {
    const auto column = by_slot.subspan(slot * size, size);
    if (const std::size_t bad = first_not_finite(column); bad < size) {
      return Status::failed(fmt::format("test '{}': the derivative by '{}' is {} in {}", test.name, free[index].name,
                                        column[bad], place(test, bad)));
    }
  }
  return {};
}

Status Assembly::predict(std::span<const double> free, std::span<double> predictions, std::span<double> jacobian,
                         Workspace& workspace) const {
  const std::size_t n = parts_->free.size();
  for (const BoundTest& test : parts_->tests) {
    const auto values = predictions.subspan(test.offset, test.size());
    if (Status status = parts_->predict(test, free, values, !jacobian.empty(), workspace); !status.ok()) return status;
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

Status Assembly::Parts::add_costs(bool costly, std::span<const double> at, double& total, const Wanted& wanted,
                                  Workspace& workspace) const {
  const std::size_t n = free.size();
  auto channel = fitted.begin();  // sorted by test
  for (std::size_t t = 0; t < tests.size(); ++t) {
    const BoundTest& test = tests[t];
    const auto behind =
        std::find_if(channel, fitted.end(), [t](const FittedChannel& candidate) { return candidate.test != t; });
    if (test.costly != costly) {
      channel = behind;
      continue;
    }
    double cost = 0;
    if (channel != behind) {
      const auto values = std::span(workspace.predictions).subspan(test.offset, test.size());
      if (Status status = predict(test, at, values, !wanted.jacobian.empty(), workspace); !status.ok()) return status;
    }
    for (; channel != behind; ++channel) {
      const auto number = static_cast<std::size_t>(channel - fitted.begin());
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

void Assembly::Parts::add_priors(std::span<const double> at, double& total, const Wanted& wanted) const {
  const std::size_t n = free.size();
  std::size_t row = residual_count - priors.size();
  for (const PriorRow& prior : priors) {
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

Status Assembly::evaluate(std::span<const double> free, double& objective, std::span<double> per_test,
                          std::span<double> residuals, std::span<double> jacobian, Workspace& workspace,
                          bool skip_costly) const {
  const Parts::Wanted wanted{per_test, residuals, jacobian};
  double total = 0;
  if (Status status = parts_->add_costs(false, free, total, wanted, workspace); !status.ok()) return status;
  Status verdict = parts_->constraints.empty() ? Status() : parts_->feasibility(free, workspace);
  if (verdict.kind() == Status::Kind::failed) return verdict;
  if (verdict.ok() || !skip_costly || !residuals.empty()) {
    if (Status status = parts_->add_costs(true, free, total, wanted, workspace); !status.ok()) return status;
  } else if (!per_test.empty()) {
    for (std::size_t t = 0; t < parts_->tests.size(); ++t)
      if (parts_->tests[t].costly) per_test[t] = std::numeric_limits<double>::quiet_NaN();
  }
  parts_->add_priors(free, total, wanted);
  if (!std::isfinite(total))
    return Status::failed("the objective overflows: predictions are finite, their squares are not");
  objective = total;
  return verdict;
}

void Assembly::measure(std::span<const double> values, Workspace& workspace) const {
  workspace.measured.clear();
  if (values.empty()) return;
  for (const FittedChannel& channel : parts_->fitted) {
    auto& measured = workspace.measured.emplace_back();
    for (const std::size_t row : channel.rows) measured.push_back(values[row]);
  }
}

void Assembly::transpose_residuals(std::span<const double> by_residual, std::span<double> by_prediction) const {
  std::fill(by_prediction.begin(), by_prediction.end(), 0.0);
  for (const FittedChannel& channel : parts_->fitted)
    for (std::size_t k = 0; k < channel.rows.size(); ++k) {
      const double value = by_residual[channel.block.offset + k];
      by_prediction[channel.rows[k]] += channel.own[k] * value;
      if (k > 0 && !channel.previous.empty()) by_prediction[channel.rows[k - 1]] -= channel.previous[k] * value;
    }
}

void Assembly::jacobian_to_unit(std::span<const double> free, std::span<double> jacobian, Workspace& workspace) const {
  const std::size_t n = parts_->free.size();
  double* const slope = workspace.shifted.data();
  for (std::size_t j = 0; j < n; ++j) {
    const Map& map = parts_->maps[j];
    slope[j] = map.logarithmic ? free[j] * map.log_span : map.max - map.min;
  }
  for (std::size_t at = 0; at < jacobian.size(); at += n) {
    for (std::size_t j = 0; j < n; ++j) jacobian[at + j] *= slope[j];
  }
}

Status Assembly::ask(std::size_t number, std::span<const double> free,
                     const std::function<Status(const Test&, const TestInput&)>& question) const {
  const BoundTest& test = parts_->tests.at(number);
  Workspace workspace(*parts_);
  try {
    return question(*test.test, parts_->input(test, free, workspace));
  } catch (const std::exception& problem) {
    return Status::failed(fmt::format("test '{}': plugin '{}' threw: {}", test.name, test.plugin, problem.what()));
  } catch (...) {
    return Status::failed(
        fmt::format("test '{}': plugin '{}' threw something that is no std::exception", test.name, test.plugin));
  }
}

Status Assembly::diagnostics(std::size_t number, std::span<const double> free,
                             std::vector<std::pair<std::string, std::vector<double>>>& rows) const {
  const BoundTest& test = parts_->tests.at(number);
  const auto& names = test.test->describe().diagnostics;
  std::vector<double> predictions(test.size()), values(names.size() * test.rows);
  const Status status = ask(number, free, [&](const Test& asked, const TestInput& input) {
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

}  // namespace tunica::calibration
