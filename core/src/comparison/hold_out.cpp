// SPDX-License-Identifier: Apache-2.0
#include "comparison/hold_out.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "text/units.hpp"
#include "text/wrapping.hpp"

namespace tunica::comparison {

namespace {

constexpr double much_worse = 2, negligible = 1;  ///< times the error in sample; per cent
constexpr std::size_t name_width = 38, cell_width = 20;

std::string value_text(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}", value, text::unit_suffix(unit));
}

std::string r2_text(std::optional<double> r2) {
  if (!r2) return "-";
  return *r2 > 0.99 ? fmt::format("{:.5f}", *r2) : fmt::format("{:.3g}", *r2);
}

std::string cell(const Quality& quality) {
  return fmt::format("{}, R² {}", value_text(quality.agreement.rmse, quality.unit), r2_text(quality.agreement.r2));
}

std::string line(const std::string& name, const std::string& fitted, const std::string& held_out) {
  std::string text = "  ";
  if (text::columns(name) > name_width) text += name + "\n  ";
  text += text::pad(text::columns(name) > name_width ? "" : name, name_width) + text::pad(fitted + ' ', cell_width) +
          held_out;
  return text.substr(0, text.find_last_not_of(' ') + 1) + '\n';
}

double pooled(const std::vector<Quality>& quality, const std::string& channel, bool held_out) {
  double squares = 0, rows = 0;
  for (const Quality& one : quality)
    if (one.channel == channel && one.held_out == held_out) {
      const auto n = static_cast<double>(one.agreement.rows);
      squares += n * one.agreement.rmse * one.agreement.rmse;
      rows += n;
    }
  return std::sqrt(squares / rows);
}

bool worse(const Quality& a, const Quality& b) {
  if (a.agreement.r2 && b.agreement.r2) return *a.agreement.r2 < *b.agreement.r2;
  return a.agreement.rmse > b.agreement.rmse;
}

HoldOutVerdict hold_out_verdict(const Transfer& transfer) {
  const bool worse =
      transfer.held_out > much_worse * transfer.in_sample && transfer.worst->agreement.nmad.value_or(0) > negligible;
  return worse ? HoldOutVerdict::worse_than_fitted : HoldOutVerdict::predicted;
}

}  // namespace

std::vector<Transfer> transfers(const std::vector<Quality>& quality) {
  std::vector<Transfer> all;
  for (const Quality& one : quality) {
    const auto same = [&](const auto& other) { return other.channel == one.channel; };
    if (std::any_of(all.begin(), all.end(), same)) continue;
    Transfer transfer{one.channel, one.unit};
    bool fitted = false;
    for (const Quality& other : quality) {
      if (!same(other)) continue;
      fitted = fitted || !other.held_out;
      if (other.held_out && (transfer.worst == nullptr || worse(other, *transfer.worst))) transfer.worst = &other;
    }
    if (!fitted || transfer.worst == nullptr) continue;
    transfer.in_sample = pooled(quality, one.channel, false);
    transfer.held_out = pooled(quality, one.channel, true);
    transfer.verdict = hold_out_verdict(transfer);
    all.push_back(std::move(transfer));
  }
  return all;
}

std::optional<execution::Warning> transfer_warning(const std::string& label, const std::vector<Quality>& quality) {
  std::vector<std::string> channels, misses;
  for (const Transfer& transfer : transfers(quality)) {
    if (transfer.verdict != HoldOutVerdict::worse_than_fitted) continue;
    channels.push_back(transfer.channel);
    misses.push_back(fmt::format("its {} error is {} in sample and {} held out (root mean square; worst in {}, R² {})",
                                 transfer.channel, value_text(transfer.in_sample, transfer.unit),
                                 value_text(transfer.held_out, transfer.unit), transfer.worst->test,
                                 r2_text(transfer.worst->agreement.r2)));
  }
  if (misses.empty()) return {};
  return execution::Warning{execution::WarningKind::predicts_worse,
                            fmt::format("the run fits better than it predicts: {}", fmt::join(misses, "; ")), label,
                            std::move(channels)};
}

std::string hold_out_table(const std::vector<Quality>& quality) {
  if (std::none_of(quality.begin(), quality.end(), [](const Quality& one) { return one.held_out; })) return {};
  std::string text = line("root mean square errors", "in sample", "held out");
  for (std::size_t i = 0; i < quality.size(); ++i) {
    const Quality& one = quality[i];
    const std::string name = fmt::format("{}, {}", one.test, one.channel);
    const Quality* const next = i + 1 < quality.size() ? &quality[i + 1] : nullptr;
    const bool both = !one.held_out && next && next->held_out && next->test == one.test && next->channel == one.channel;
    text += line(name, one.held_out ? "" : cell(one), one.held_out ? cell(one) : both ? cell(*next) : "");
    i += both;
  }
  for (const Transfer& transfer : transfers(quality))
    text += line(fmt::format("all tests, {}", transfer.channel), value_text(transfer.in_sample, transfer.unit),
                 fmt::format("{}{}", value_text(transfer.held_out, transfer.unit),
                             transfer.verdict == HoldOutVerdict::worse_than_fitted
                                 ? fmt::format(", {:.2g} times", transfer.held_out / transfer.in_sample)
                                 : std::string()));
  return text;
}

}  // namespace tunica::comparison
