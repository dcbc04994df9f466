// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "execution/plan.hpp"
#include "plugins/last_words.hpp"

/// Checks before the first evaluation whether an experiment fits into the machine's memory.
namespace tunica::execution {

/// The memory need of one part of an experiment.
struct MemoryShare {
  double bytes = 0;
  std::string what, remedy;  ///< "1000000 realisations"; "Lower \"realisations\""
};

/// A rough estimate, right within a factor of about two: results and checkpoint of every realisation, draws of the
/// bootstrap, predictions and their derivatives in each thread.
std::vector<MemoryShare> memory_need(const Plan& plan, unsigned threads);

using plugins::memory_limit;

/// Throws InputError with both figures if the sum exceeds the memory.
void refuse_excess(const std::vector<MemoryShare>& need, double limit);

}  // namespace tunica::execution
