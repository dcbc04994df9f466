// SPDX-License-Identifier: Apache-2.0
#include "posterior/posterior.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "plugins/calls.hpp"
#include "tunica/random.hpp"

namespace tunica::posterior {
namespace {

Marginal marginal(const std::vector<Chain>& chains, std::size_t parameter) {
  Chains values;
  std::vector<double> all;
  for (const Chain& chain : chains) {
    auto& own = values.emplace_back();
    for (std::size_t k = 0; k < chain.draws(); ++k) own.push_back(chain.value(k, parameter));
    all.insert(all.end(), own.begin(), own.end());
  }
  Marginal found;
  const auto count = static_cast<double>(all.size());
  found.mean = std::accumulate(all.begin(), all.end(), 0.0) / count;
  double squares = 0;
  for (const double value : all) squares += (value - found.mean) * (value - found.mean);
  found.sd = std::sqrt(squares / (count - 1));
  std::sort(all.begin(), all.end());
  found.lower = quantile_of(all, 0.025);
  found.median = quantile_of(all, 0.5);
  found.upper = quantile_of(all, 0.975);
  found.convergence = convergence(values);
  return found;
}

/// What the steps of all chains depend on, beside the program. The centre stands for data, model and bounds. The scheme
/// is the number of the moves, to be raised with any change to them that makes other draws.
std::string name_of(const Question& question, const Centre& from, std::span<const double> best, std::uint64_t seed) {
  constexpr int scheme = 2;
  std::string name =
      fmt::format("scheme {}, seed {}, discrepancy {}, best", scheme, seed, question.discrepancy.has_value());
  for (const double value : best) name += fmt::format(" {}", value);
  name += fmt::format(", log density {}, centre", from.point.log_density);
  for (const double value : from.point.z) name += fmt::format(" {}", value);
  return name;
}

}  // namespace

double Posterior::r_hat() const {
  double worst = 0;
  for (const Marginal& one : parameters) worst = std::max(worst, one.convergence.r_hat);
  return worst;
}

double Posterior::effective_size() const {
  double least = static_cast<double>(draws());
  for (const Marginal& one : parameters) least = std::min({least, one.convergence.bulk, one.convergence.tail});
  return least;
}

Posterior sample(const assembly::Assembly& assembly, std::span<const double> best, std::size_t draws,
                 std::uint64_t seed, const std::function<bool()>& interrupted, std::span<const double> measured,
                 bool discrepancy, Memory* memory) {
  Posterior found;
  if (best.empty()) {
    found.status = Status::failed("no parameter is free");
    return found;
  }
  const auto question = question_at(assembly, best, measured, found.status, discrepancy);
  if (!question) return found;
  found.factor_known = question->factor_known;
  found.factor_assumed = question->discrepancy && question->discrepancy->factor_assumed();
  const plugins::Clock::time_point deadline = plugins::deadline_of_this_thread();
  const std::function<bool()> is_over = [&] {
    return (interrupted && interrupted()) || plugins::Clock::now() >= deadline;
  };
  const Centre from = centre(*question, best);
  found.status = from.status;
  if (!found.status.ok()) return found;
  found.chains.resize(chain_count);
  const std::size_t each = (draws + chain_count - 1) / chain_count;
  std::vector<std::vector<Step>> known(chain_count);
  if (memory) known = memory->recall(name_of(*question, from, best, seed), chain_count, best.size());
  tbb::parallel_for(std::size_t{0}, chain_count, [&](std::size_t k) {
    const plugins::Call part{nullptr, "analysis", nullptr, nullptr, deadline};
    const plugins::CallScope scope(part);
    const auto keep = [&](std::size_t index, const Step& step) {
      if (memory) memory->keep(k, index, step);
    };
    found.chains[k] = chain(*question, from, each, derive_seed(seed, fmt::format("posterior chain {}", k + 1)), is_over,
                            known[k], keep);
  });
  found.evaluations = from.evaluations;
  for (const Chain& chain : found.chains) {
    found.evaluations += chain.evaluations;
    found.failures += chain.failures;
  }
  found.complete = std::all_of(found.chains.begin(), found.chains.end(),
                               [each](const Chain& chain) { return chain.draws() == each; });
  if (found.complete) found.bands = bands(*question, found.chains, is_over, found.complete);
  if (!found.complete) {
    found.chains.clear();
    return found;
  }
  for (std::size_t j = 0; j < best.size(); ++j) found.parameters.push_back(marginal(found.chains, j));
  return found;
}

}  // namespace tunica::posterior
