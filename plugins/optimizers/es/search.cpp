// SPDX-License-Identifier: Apache-2.0
#include "search.hpp"

#include <cmath>

namespace tunica::es {

Search::Search(Problem& problem, const Settings& settings, Random& random)
    : problem_(problem),
      settings_(settings),
      random_(random),
      n_(problem.dimension()),
      steps_(Variation::steps_each(settings.adaptation, n_)),
      parents_(settings.parents, n_, steps_),
      survivors_(settings.parents, n_, steps_),
      offspring_(settings.offspring, n_, steps_),
      variation_(settings_, n_),
      objectives_(settings.offspring),
      statuses_(settings.offspring),
      order_(settings.offspring) {}

End Search::run(bool from_start) {
  if (const auto end = initialise(from_start)) return *end;
  Fitness reference = *best_;
  std::size_t stalled = 0;
  while (true) {
    variation_.prepare(parents_, parent_count_);
    if (variation_.spread() < settings_.step_tolerance) return End::small_step;
    if (alike()) return End::alike;
    const std::size_t count = batch_size();
    for (std::size_t i = 0; i < count; ++i) variation_.make(parents_, parent_count_, offspring_, i, random_);
    evaluate(count);
    if (problem_.should_stop()) return End::stopped;
    const auto best = best_offspring(count);
    if (variation_.cumulative() && !best.empty()) variation_.follow(offspring_, best);
    select(best);
    if (!variation_.cumulative()) variation_.learn(parents_, parent_count_, first_mutant_);
    // Progress is measured from the last significant improvement, so a slow descent adds up.
    const double enough = settings_.tolerance * std::abs(reference.objective);
    if (best_->kind < reference.kind || best_->violation < reference.violation * (1 - settings_.tolerance) ||
        best_->objective < reference.objective - enough) {
      reference = *best_;
      stalled = 0;
    } else if (++stalled >= settings_.stall_generations) {
      return End::stalled;
    }
  }
}

/// Uniform in the box. Where little can be evaluated, several populations may have to be drawn.
std::optional<End> Search::initialise(bool from_start) {
  constexpr int attempts = 10;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::size_t count = batch_size();
    if (count == 0) return End::stopped;
    for (std::size_t i = 0; i < count; ++i) {
      std::ranges::generate(offspring_.position(i), [this] { return random_.uniform(); });
      std::ranges::fill(offspring_.steps(i), settings_.initial_step);
    }
    if (from_start && attempt == 0) std::ranges::copy(problem_.start(), offspring_.position(0).begin());
    evaluate(count);
    if (problem_.should_stop()) return End::stopped;
    select(best_offspring(count));
    first_mutant_ = index_;
    if (parent_count_ > 0) return std::nullopt;
  }
  return End::nothing_succeeded;
}

std::size_t Search::batch_size() const {
  if (problem_.should_stop()) return 0;
  return static_cast<std::size_t>(std::min<std::uint64_t>(settings_.offspring, problem_.budget()));
}

bool Search::alike() const {
  const Fitness &first = parents_.fitness(0), &last = parents_.fitness(parent_count_ - 1);
  return parent_count_ == settings_.parents && parent_count_ > 1 && first.kind == last.kind &&
         last.violation - first.violation <= Settings::alike * first.violation &&
         last.objective - first.objective <= Settings::alike * std::abs(first.objective);
}

void Search::evaluate(std::size_t count) {
  // Selection and learning look at the best μ of the offspring alone.
  problem_.evaluate_best(offspring_.positions(count), settings_.parents, {objectives_.data(), count},
                         {statuses_.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    const Status& status = statuses_[i];
    const bool failed = status.kind() == Status::Kind::failed;
    if (failed && first_failure_.empty()) first_failure_ = status.reason();
    const double violation = settings_.infeasible == Infeasible::rank_by_violation ? status.violation() : 0;
    offspring_.fitness(i) = {status.kind(), violation, failed ? 0.0 : objectives_[i], index_++};
    if (!failed && (!best_ || offspring_.fitness(i) < *best_)) best_ = offspring_.fitness(i);
  }
}

/// Ranks of the offspring alone, as many as there are parents at most; failed ones are left out.
std::span<const std::size_t> Search::best_offspring(std::size_t count) {
  std::size_t candidates = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (offspring_.fitness(i).kind != Status::Kind::failed) order_[candidates++] = i;
  }
  const std::size_t selected = std::min(settings_.parents, candidates);
  std::partial_sort(order_.begin(), order_.begin() + static_cast<std::ptrdiff_t>(selected),
                    order_.begin() + static_cast<std::ptrdiff_t>(candidates),
                    [&](std::size_t a, std::size_t b) { return offspring_.fitness(a) < offspring_.fitness(b); });
  return {order_.data(), selected};
}

/// Failed individuals are left out, so that there may be fewer parents than asked for; where a whole generation of
/// comma selection failed, its parents live on. Parents and `best` offspring both come by rank: they are merged.
void Search::select(std::span<const std::size_t> best) {
  const std::size_t old = settings_.selection == Selection::plus ? parent_count_ : 0;
  if (old + best.size() == 0) return;
  const std::size_t selected = std::min(settings_.parents, old + best.size());
  for (std::size_t k = 0, parent = 0, child = 0; k < selected; ++k) {
    if (child == best.size() || (parent < old && parents_.fitness(parent) < offspring_.fitness(best[child]))) {
      survivors_.copy(k, parents_, parent++);
    } else {
      survivors_.copy(k, offspring_, best[child++]);
    }
  }
  std::swap(parents_, survivors_);
  parent_count_ = selected;
}

}  // namespace tunica::es
