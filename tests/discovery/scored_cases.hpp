// SPDX-License-Identifier: Apache-2.0
// Cases as the scorer opens them, for tests of its tables.
#pragma once

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <vector>

#include "scorer/figures.hpp"

namespace blind::score::trial {

/// A scored case: the hidden effect and the verdict on it.
inline Case single(const std::string& id, double lambda, const std::string& verdict,
                   const std::vector<std::string>& said) {
  Case one;
  one.truth.set = "singles";
  one.truth.noise = "white";
  one.truth.asked = lambda;
  one.truth.effects = {{.id = id, .target = {}, .amplitude = 2}};
  one.verdict.verdict = verdict;
  if (!said.empty())
    one.verdict.causes = {
        {.id = said.front(), .target = {}, .probability = {}, .amplitude = {}, .low = {}, .high = {}}};
  one.verdict.ambiguity_set = said;
  return one;
}
inline Case of_set(const std::string& set, const std::string& noise, const std::string& verdict) {
  Case one;
  one.truth.set = set;
  one.truth.noise = noise;
  one.verdict.verdict = verdict;
  return one;
}
/// The amplitude of the first cause and its interval.
inline void state_amplitude(Case& one, double amplitude, double low, double high) {
  Cause& cause = one.verdict.causes.front();
  cause.amplitude = amplitude;
  cause.low = low;
  cause.high = high;
}
inline std::vector<Case> times(std::size_t count, const Case& one) { return std::vector<Case>(count, one); }
inline std::vector<Case> together(std::initializer_list<std::vector<Case>> parts) {
  std::vector<Case> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

inline Figure figure(const std::vector<Case>& cases, const std::string& name, const LookAlikes& look_alikes = {}) {
  for (const Figure& one : figures(cases, look_alikes))
    if (one.name == name) return one;
  throw std::runtime_error("no figure " + name);
}

}  // namespace blind::score::trial
