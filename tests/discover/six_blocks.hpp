// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "discover/made_up_terms.hpp"

/// What made-up searches have to find: six blocks, a base that is alike in all of them, and few laws.
namespace tunica::trial {

/// Two laws of I1, an error of the rig, and a mechanism that is nearly the second law.
inline std::map<std::string, MadeUpLaw> six_blocks() {
  return {{"base", over_blocks({1, 1, 1, 1, 1, 1})},
          {"linear", over_blocks({1, 2, 3, 4, 5, 6})},
          {"quadratic", over_blocks({0, 1, 0, 3, 0, 9})},
          {"rig", over_blocks({1, -1, 1, -1, 1, -1})},
          {"stiffer", over_blocks({0, 1, 0, 3, 0, 8})}};
}

/// Ten, and so many times the laws.
inline std::vector<double> levels_with(double second, double first = 0) {
  const std::vector<double> law{0, 1, 0, 3, 0, 9};
  std::vector<double> levels;
  for (std::size_t block = 0; block < 6; ++block)
    levels.push_back(10 + second * law[block] + first * static_cast<double>(block + 1));
  return levels;
}

/// Laws of I1 and one of fibres along the test; those of diagonal fibres do nothing.
inline std::map<std::string, MadeUpLaw> six_blocks_with_fibres() {
  auto laws = six_blocks();
  laws["quadratic"] = over_blocks({0, 0, 0, 1, 0, 0});
  laws["circumferential quadratic"] = over_blocks({0, 2, 0, 0, 1, 0});
  laws["diagonal quadratic"] = {[](std::size_t, double) { return 0.0; }, "theta"};
  return laws;
}

/// 3 times the first law, so many times that of fibres, and what no law has.
inline std::vector<double> levels_with_fibres(double fibres, double jagged = 0) {
  std::vector<double> levels;
  for (int block = 0; block < 6; ++block)
    levels.push_back(3 * (block + 1) +
                     fibres * (block == 1   ? 2
                               : block == 4 ? 1
                                            : 0) +
                     (block % 2 == 0 ? jagged : -jagged));
  return levels;
}

}  // namespace tunica::trial
