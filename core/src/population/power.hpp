// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "population/population.hpp"

namespace tunica::population {

/// What an experiment with two groups would show of one parameter: a specimen (nested: an animal with as many specimens
/// as now) scatters by `deviation` about its group, own errors included.
struct ParameterPower {
  std::size_t parameter = 0;
  double deviation = 0;  ///< infinite where the data of a typical specimen do not fix it
};

/// Per parameter: variance = [mean of W]⁻¹_jj with W = (A⁻¹ + Ω)⁻¹ of every specimen; nested: divided by the mean
/// number of specimens an animal, plus Ω_a.
std::vector<ParameterPower> deviations(const Population& population);

/// Probability that a two-sided t test at `level` shows a difference δ between groups of n each:
/// P(|t'| > t_{1−level/2}) with t' noncentral, 2n − 2 degrees of freedom, δ/(deviation √(2/n)).
/// J. Cohen, Statistical Power Analysis (1988), section 2.5. Numbers of groups' members from 2 on.
double power_of(double deviation, double difference, std::size_t n, double level = 0.05);

/// The fewest members a group with which the difference is shown with probability `power`; nothing above `most`.
std::optional<std::size_t> needed(double deviation, double difference, double power = 0.8, double level = 0.05,
                                  std::size_t most = 10000);

/// The smallest difference that n members a group show with probability `power`.
double detectable(double deviation, std::size_t n, double power = 0.8, double level = 0.05);

}  // namespace tunica::population
