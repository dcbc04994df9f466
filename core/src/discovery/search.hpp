// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "discovery/common/common_fit.hpp"

namespace tunica::discovery {

/// Whether what a set leaves is noise.
using IsClean = std::function<bool(const CommonFit&)>;

struct Search {
  std::size_t most_terms;
  std::size_t most_parameters = 0;  ///< 0 = no limit
  /// Of the same rows with another noise: fits begin where these ended.
  const std::vector<CommonFit>* before = nullptr;
  /// Whether the best of these are the answer where even they are far.
  bool ends_where_far = false;
  std::size_t beam = 16;      ///< sets that larger ones grow from
  std::size_t exchanged = 6;  ///< sets in which terms make room for others
  /// Sets grow by kinds that are linear in their parameters, which add up to any law nearly; the others take their
  /// places in the best sets.
  bool linear_first = false;
};

/// Whether a set leaves ten times what noise does, as root mean square.
bool is_far(const CommonFit& fit);

/// Sets of terms that were fitted, likeliest first. All single terms are tried, and all pairs that promise enough: the
/// best single term often belongs to no pair. Larger sets grow from the best of the smaller ones, while what these
/// leave is not noise, or while the last term was worth more than it costs. In the best sets each term then makes room
/// for every other kind. The outcome does not depend on threads.
std::vector<CommonFit> search(const CommonFitter& fitter, const Search& request, const IsClean& is_clean);

}  // namespace tunica::discovery
