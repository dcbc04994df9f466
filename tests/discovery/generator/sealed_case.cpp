// SPDX-License-Identifier: Apache-2.0
#include "sealed_case.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bases.hpp"
#include "seal.hpp"

namespace blind {
namespace {

/// What one of two effects has to leave unexplained by the other, Λ (1 − c²), for the data to tell that both are there.
constexpr double least_remainder = 25;

ScaledEffect hide(const SealedCase& made, const Effect& effect, std::mt19937_64& random) {
  return dial(made.specimen, made.noise, draw(effect, made.specimen, random), made.order.lambda);
}

/// Correlation of what the base model leaves of each of the two.
double likeness(const SealedCase& made) {
  const auto left = [&](const ScaledEffect& one) {
    return refit_with(made.specimen, made.noise, {one.hidden}, made.specimen.tissue).residual;
  };
  const Eigen::VectorXd a = left(made.hidden[0]), b = left(made.hidden[1]);
  return a.dot(b) / (a.norm() * b.norm());
}

void hide_pair(SealedCase& made, std::mt19937_64& random) {
  const auto& all = catalogue();
  for (int trial = 0; trial < 100; ++trial) {
    const auto pick = [&]() -> const Effect& {
      return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random)];
    };
    const Effect &one = pick(), &other = pick();
    if (!compatible(one.id, other.id)) continue;
    if (!makes_sense(one, made.specimen) || !makes_sense(other, made.specimen)) continue;
    made.hidden = {hide(made, one, random), hide(made, other, random)};
    if (!made.hidden[0].reached || !made.hidden[1].reached) continue;
    made.correlation = likeness(made);
    made.truth =
        observe(made.specimen.protocol, world_with(made.specimen, {made.hidden[0].hidden, made.hidden[1].hidden}));
    const double c = made.correlation;
    bool good = made.order.lambda * (1 - c * c) >= std::min(least_remainder, 0.5 * made.order.lambda);
    for (const double value : made.truth) good &= std::isfinite(value);
    if (good) return;
  }
  throw std::runtime_error("no pair of effects found for " + made.order.text());
}

/// Half of the tests are reversed, half shuffled.
std::map<std::string, std::vector<std::size_t>> mixed_rows(const Protocol& protocol, std::mt19937_64& random) {
  std::map<std::string, std::vector<std::size_t>> all;
  for (const Channel& channel : channels(protocol)) {
    if (all.contains(channel.test)) continue;
    std::vector<std::size_t>& rows = all[channel.test];
    rows.resize(channel.count);
    std::iota(rows.rbegin(), rows.rend(), std::size_t{0});
    if (between(random, 0, 1) < 0.5) std::shuffle(rows.begin(), rows.end(), random);
  }
  return all;
}

}  // namespace

std::mt19937_64 stream(const std::string& text) {
  std::seed_seq sequence(text.begin(), text.end());
  return std::mt19937_64(sequence);
}

bool compatible(const std::string& a, const std::string& b) {
  const auto is = [&](const char* x, const char* y) { return (a == x && b == y) || (a == y && b == x); };
  return a != b && !is("matrix_stiffening", "chain_extensibility") && !is("fibre_dispersion", "fibre_recruitment") &&
         !is("stress_softening", "viscoelasticity") && !is("permanent_set", "stress_softening") &&
         !is("permanent_set", "viscoelasticity") && !is("permanent_set", "reference_length_error") &&
         !is("permanent_set", "force_offset") && !is("permanent_set", "signal_drift") &&
         !is("permanent_set", "outliers");
}

std::string CaseOrder::text() const {
  std::string words = fmt::format("{} {} {} {:g} {} {}", seed, set, effect, lambda, index, fmt::join(noise, "+"));
  if (base != Base::hgo || protocol != "artery") words += fmt::format(" {} {}", name_of(base), protocol);
  if (!order_recorded) words += " order not recorded";
  return words + (noise_stated ? "" : " noise not stated");
}
CaseOrder CaseOrder::stated() const {
  CaseOrder same = *this;
  same.noise_stated = true;
  return same;
}
std::string CaseOrder::name() const { return "case-" + sha256("name of " + text()).substr(0, 12); }

SealedCase make(const CaseOrder& order) {
  auto random = stream(order.stated().text());
  SealedCase made;
  made.order = order;
  made.specimen = draw_specimen(random, order.base, order.protocol);
  const auto kind = std::uniform_int_distribution<std::size_t>(0, order.noise.size() - 1)(random);
  made.noise = draw_noise(order.noise[kind], made.specimen, random);
  if (order.set == "pairs") hide_pair(made, random);
  if (!order.effect.empty()) {
    const Effect& asked = effect(order.effect);
    if (!makes_sense(asked, made.specimen) || (!order.order_recorded && remembers(asked)))
      throw std::invalid_argument(fmt::format("{} cannot be hidden in {} and protocol {}{}", asked.id,
                                              name_of(order.base), order.protocol,
                                              order.order_recorded ? "" : " without the order of rows"));
  }
  if (order.set == "singles" || order.set == "outside") made.hidden = {hide(made, effect(order.effect), random)};
  std::vector<HiddenEffect> hidden;
  for (const ScaledEffect& one : made.hidden) hidden.push_back(one.hidden);
  made.truth = observe(made.specimen.protocol, world_with(made.specimen, hidden));
  if (made.hidden.size() == 1) made.lambda = made.hidden[0].lambda;
  if (made.hidden.size() == 2 || order.set == "outside") {
    const Refit fit = refit_with(made.specimen, made.noise, hidden, made.specimen.tissue);
    made.lambda = fit.misfit;
    if (order.set == "outside") {
      const Noise noise = made.noise.about(made.specimen.protocol, made.truth);
      made.account = best_account(signatures(made.specimen, fit.tissue, noise, fit.jacobian), fit.residual);
    }
  }
  made.records = add_noise(made.noise, made.specimen.protocol, made.truth, random);
  if (!order.order_recorded) made.rows = mixed_rows(made.specimen.protocol, random);
  return made;
}

}  // namespace blind
