// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/evidence/misfit_size.hpp"

#include <algorithm>
#include <utility>

namespace tunica::diagnosis {
namespace {

std::vector<assembly::MisfitSize::Channel> measured(const Evidence& evidence) {
  const auto& views = evidence.base->layout().channels;
  const std::vector<double> ranges = assembly::observable_ranges(evidence.base->layout(), evidence.experiment);
  std::vector<assembly::MisfitSize::Channel> channels;
  for (const Curve& curve : evidence.curves) {
    const auto view = std::find_if(views.begin(), views.end(), [&](const assembly::MeasuredChannel& one) {
      return one.test == curve.test && one.observable == curve.channel;
    });
    channels.push_back({curve.test, curve.channel, view->unit, ranges[static_cast<std::size_t>(view - views.begin())],
                        row_noise(*view), assembly::counted_rows(*view)});
  }
  return channels;
}

}  // namespace

MisfitSize::MisfitSize(const Evidence& evidence) : size_(measured(evidence)) {}

std::size_t MisfitSize::free(const Fit& fit) {
  return static_cast<std::size_t>(std::count(fit.at_bound.begin(), fit.at_bound.end(), false));
}

}  // namespace tunica::diagnosis
