// SPDX-License-Identifier: Apache-2.0
#include "search.hpp"

#include <algorithm>
#include <cmath>

namespace tunica::pagmo_plugin {
namespace {

constexpr double failed = std::numeric_limits<double>::max();

/// Rounding may carry a point over its bound.
void into_box(std::span<double> xs) {
  for (double& value : xs) value = std::clamp(value, 0.0, 1.0);
}

}  // namespace

double Search::fitness(const pagmo::vector_double& x) {
  end_if_due();
  pagmo::vector_double point = x;
  into_box(point);
  double objective = 0;
  const Status status = problem_.evaluate(point, objective);
  return note(point, status, objective);
}

pagmo::vector_double Search::fitnesses(const pagmo::vector_double& xs) {
  end_if_due();
  const std::size_t n = dimension(), asked = xs.size() / n;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(asked, problem_.budget()));
  pagmo::vector_double points = xs, objectives(count);
  into_box(points);
  std::vector<Status> statuses(count);
  problem_.evaluate_batch(std::span(points).first(count * n), objectives, statuses);
  for (std::size_t k = 0; k < count; ++k) {
    objectives[k] = note(std::span(points).subspan(k * n, n), statuses[k], objectives[k]);
  }
  if (count < asked) throw Stopped();
  return objectives;
}

double Search::note(std::span<const double> x, const Status& status, double objective) {
  ++evaluated_;
  if (status.kind() == Status::Kind::failed) {
    if (failure_.empty()) failure_ = status.reason();
    return failed;
  }
  const double fitness = status.violation() > 0 ? status.violation() : -1 / (objective + 1e-300);
  if (fitness < best_.fitness) {
    best_.fitness = fitness;
    best_.x.assign(x.begin(), x.end());
    // Progress is measured from the last significant improvement, so a slow descent adds up.
    if (fitness < progress_from_ - tolerance_ * std::abs(progress_from_)) {
      progress_from_ = fitness;
      progress_at_ = evaluated_;
    }
  }
  return fitness;
}

void Search::end_if_due() const {
  if (problem_.should_stop()) throw Stopped();
  if (best_.x.empty() && evaluated_ >= gives_up_after) throw NothingSucceeded();
  if (evaluated_ - progress_at_ >= stall_) throw Stalled();
}

}  // namespace tunica::pagmo_plugin
