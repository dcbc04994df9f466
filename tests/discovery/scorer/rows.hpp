// SPDX-License-Identifier: Apache-2.0
// What the rows of the table are written with, and those that have a file of their own.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"

namespace blind::score {

using Cases = std::vector<Case>;

constexpr double infinite = std::numeric_limits<double>::infinity();

inline Bar at_least(double low) { return {low, infinite}; }
inline Bar at_most(double high) { return {-infinite, high}; }

inline Figure share(std::string name, const Share& of, std::optional<Bar> pass, std::optional<Bar> stretch,
                    std::string remark = {}) {
  return {std::move(name), of.total,         of.total == 0 ? 0 : of.value(), of.low(), of.high(), pass,
          stretch,         std::move(remark)};
}
inline Figure number(std::string name, std::size_t cases, double value, std::optional<Bar> pass,
                     std::optional<Bar> stretch, std::string remark = {}) {
  return {std::move(name), cases, value, value, value, pass, stretch, std::move(remark)};
}

/// Noise that files state as it is, without gross errors.
inline bool ordinary(const std::string& noise) {
  return noise != "ar1" && noise != "outliers" && noise != "correlated";
}

/// Cases with one effect of the catalogue that its amplitude could be dialled for.
inline bool single(const Case& one) { return one.truth.set == "singles" && one.truth.effects.front().reached; }
inline const std::string& hidden(const Case& one) { return one.truth.effects.front().id; }

void pair_rows(const Cases& cases, const LookAlikes& look_alikes, std::vector<Figure>& table);
void outside_rows(const Cases& cases, std::vector<Figure>& table);
void amplitude_rows(const Cases& cases, std::vector<Figure>& table);
void probability_rows(const Cases& cases, std::vector<Figure>& table);

}  // namespace blind::score
