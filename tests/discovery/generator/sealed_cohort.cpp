// SPDX-License-Identifier: Apache-2.0
#include "sealed_cohort.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "bases.hpp"
#include "seal.hpp"

namespace blind {
namespace {

namespace fs = std::filesystem;

constexpr double amplitude_spread = 0.3;
/// What the mean Λ may miss of what was asked, and below which share of it the effect cannot be shown.
constexpr double close_enough = 0.03, shown = 0.8;

double normal(std::mt19937_64& random) {
  const double u = between(random, 1e-12, 1), v = between(random, 0, 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

Tissue relative_of(Tissue tissue, double spread, std::mt19937_64& random) {
  for (const BaseParameter& one : fitted(tissue.base)) {
    double& value = tissue.*one.member;
    const double z = std::clamp(normal(random), -2.0, 2.0);
    if (one.name == "theta")
      value = std::clamp(value + 15 * spread * z, 25.0, 65.0);
    else
      value = std::clamp(value * std::exp(spread * z), value > 0 ? one.low : 1.02 * one.low,
                         value > 0 ? 0.98 * one.high : one.high);
  }
  return tissue;
}

/// One effect as every specimen has it; distances are shares of a common one.
struct Shared {
  std::vector<std::size_t> who;
  std::vector<HiddenEffect> hidden;
  std::vector<double> share;
};

void set_distance(Shared& effect, double distance) {
  for (std::size_t k = 0; k < effect.who.size(); ++k)
    effect.hidden[k].distance = std::min(distance * effect.share[k], effect.hidden[k].largest);
}

double mean_lambda(const SealedCohort& made, const Shared& effect, std::vector<double>& each) {
  double sum = 0;
  each.clear();
  for (std::size_t k = 0; k < effect.who.size(); ++k) {
    const SealedCase& one = made.specimens[effect.who[k]];
    each.push_back(refit_with(one.specimen, one.noise, {effect.hidden[k]}, one.specimen.tissue).misfit);
    sum += each.back();
  }
  return sum / static_cast<double>(effect.who.size());
}

/// The common distance at which the mean of Λ is as asked; as in dial().
bool dial_together(const SealedCohort& made, Shared& effect, double lambda, std::vector<double>& each) {
  double distance =
      dial(made.specimens[effect.who[0]].specimen, made.specimens[effect.who[0]].noise, effect.hidden[0], lambda)
          .hidden.distance;
  double power = effect.hidden[0].effect->even ? 2 : 1, before = 0, root_before = 0, found = 0;
  for (int trial = 0; trial < 10; ++trial) {
    set_distance(effect, distance);
    found = mean_lambda(made, effect, each);
    if (!std::isfinite(found)) {
      distance *= 0.6;
      before = 0;
      continue;
    }
    if (std::abs(found / lambda - 1) < close_enough) return true;
    const double root = std::sqrt(found);
    if (before > 0 && root != root_before && distance != before) {
      const double read = std::log(root / root_before) / std::log(distance / before);
      if (std::isfinite(read)) power = std::clamp(read, 0.4, 4.0);
    }
    before = distance;
    root_before = root;
    distance *= std::clamp(std::pow(std::sqrt(lambda / found), 1 / power), 0.2, 5.0);
  }
  return std::isfinite(found) && found >= shown * lambda && found <= lambda / shown;
}

Shared share_out(const SealedCohort& made, const Effect& effect, std::mt19937_64& random, bool& own_sides) {
  Shared shared;
  own_sides = effect.low < effect.null && !effect.even && between(random, 0, 1) < 0.5;
  const std::mt19937_64 same = random;
  for (std::size_t s = 0; s < made.specimens.size(); ++s) {
    if (!made.affected.empty() && made.group[s] != made.affected) continue;
    std::mt19937_64 copy = same;
    HiddenEffect hidden = draw(effect, made.specimens[s].specimen, copy);
    random = copy;
    shared.who.push_back(s);
    shared.hidden.push_back(std::move(hidden));
  }
  for (HiddenEffect& hidden : shared.hidden) {
    shared.share.push_back(std::exp(amplitude_spread * std::clamp(normal(random), -2.0, 2.0)));
    if (!own_sides || between(random, 0, 1) < 0.5) continue;
    hidden.sign = -hidden.sign;
    // As far on the other side as is plausible there: channels are alike on both.
    if (!hidden.target.channel) {
      const double end = hidden.sign > 0 ? effect.high : effect.low;
      hidden.largest = effect.logarithmic ? std::abs(std::log(end / effect.null)) : std::abs(end - effect.null);
    }
  }
  return shared;
}

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

void put_in(SealedCohort& made, const Shared& effect, const std::vector<double>& each) {
  double sum = 0;
  for (std::size_t k = 0; k < effect.who.size(); ++k) {
    made.specimens[effect.who[k]].hidden.push_back({effect.hidden[k], each[k], true});
    sum += each[k];
  }
  made.mean_lambda.push_back(sum / static_cast<double>(effect.who.size()));
}

/// Mean of the squared likeness of what the base model leaves of each of two, over the specimens.
double squared_likeness(const SealedCohort& made) {
  double sum = 0;
  for (const SealedCase& one : made.specimens) {
    Eigen::VectorXd left[2];
    for (int k = 0; k < 2; ++k)
      left[k] =
          refit_with(one.specimen, one.noise, {one.hidden[static_cast<std::size_t>(k)].hidden}, one.specimen.tissue)
              .residual;
    sum += std::pow(left[0].dot(left[1]) / (left[0].norm() * left[1].norm()), 2);
  }
  return sum / static_cast<double>(made.specimens.size());
}

bool observable(SealedCohort& made) {
  for (SealedCase& one : made.specimens) {
    std::vector<HiddenEffect> hidden;
    for (const ScaledEffect& effect : one.hidden) hidden.push_back(effect.hidden);
    one.truth = observe(one.specimen.protocol, world_with(one.specimen, hidden));
    if (!finite(one.truth)) return false;
  }
  return true;
}

bool hide_pair_in(SealedCohort& made, std::mt19937_64& random) {
  const auto& all = catalogue();
  const Specimen& like = made.specimens.front().specimen;
  for (int trial = 0; trial < 100; ++trial) {
    const auto pick = [&]() -> const Effect& {
      return all[std::uniform_int_distribution<std::size_t>(0, all.size() - 1)(random)];
    };
    const Effect &one = pick(), &other = pick();
    if (!compatible(one.id, other.id) || !makes_sense(one, like) || !makes_sense(other, like)) continue;
    made.mean_lambda.clear();
    for (SealedCase& specimen : made.specimens) specimen.hidden.clear();
    bool good = true;
    for (const Effect* effect : {&one, &other}) {
      std::vector<double> each;
      Shared shared = share_out(made, *effect, random, made.own_sides);
      good = good && dial_together(made, shared, made.order.lambda, each);
      if (good) put_in(made, shared, each);
    }
    // As for one specimen: half of Λ at least is not explained by the other effect.
    if (good && squared_likeness(made) <= 0.5 && observable(made)) return true;
  }
  return false;
}

std::string truth_text(const SealedCohort& made, const std::string& name) {
  nlohmann::ordered_json all{{"format", 1},
                             {"cohort", name},
                             {"seed", made.order.seed},
                             {"set", made.order.set},
                             {"effect", made.order.effect},
                             {"index", made.order.index},
                             {"lambda_asked", made.order.lambda},
                             {"mean_lambda", made.mean_lambda},
                             {"affected_group", made.affected},
                             {"own_sides", made.own_sides},
                             {"reached", made.reached},
                             {"specimens", nlohmann::ordered_json::array()}};
  for (std::size_t s = 0; s < made.specimens.size(); ++s)
    all["specimens"].push_back(nlohmann::ordered_json::parse(truth_of(made.specimens[s], fmt::format("s{}", s + 1))));
  return all.dump(1) + "\n";
}

void put_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  if (!out.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace

std::string CohortOrder::text() const {
  return fmt::format("cohort {} {} {} {:g} {} {} {} {} {}", seed, set, effect, lambda, index, specimens,
                     fmt::join(noise, "+"), name_of(base), protocol);
}
std::string CohortOrder::name() const { return "cohort-" + sha256("name of " + text()).substr(0, 12); }

SealedCohort make(const CohortOrder& order) {
  std::mt19937_64 random = stream(order.text());
  SealedCohort made;
  made.order = order;
  const Tissue tissue = draw_specimen(random, order.base, order.protocol).tissue;
  const double spread = between(random, 0.2, 0.4);
  const auto kind = std::uniform_int_distribution<std::size_t>(0, order.noise.size() - 1)(random);
  const std::mt19937_64 geometry = random;
  for (std::size_t s = 0; s < order.specimens; ++s) {
    SealedCase one;
    one.order = {order.seed,   order.set == "nulls" ? "nulls" : "singles",
                 order.effect, order.lambda,
                 order.index,  order.noise,
                 order.base,   order.protocol};
    std::mt19937_64 same = geometry;
    one.specimen = laid_out(relative_of(tissue, spread, random), order.protocol, same);
    one.noise = draw_noise(order.noise[kind], one.specimen, random);
    made.specimens.push_back(std::move(one));
    made.group.push_back(s < order.specimens / 2 ? "a" : "b");
  }
  std::shuffle(made.group.begin(), made.group.end(), random);
  if (order.set == "groups") made.affected = between(random, 0, 1) < 0.5 ? "a" : "b";
  if (order.set == "singles" || order.set == "groups") {
    const Effect& asked = effect(order.effect);
    if (!makes_sense(asked, made.specimens.front().specimen))
      throw std::invalid_argument(fmt::format("{} cannot be hidden in {}", asked.id, name_of(order.base)));
    std::vector<double> each;
    Shared shared = share_out(made, asked, random, made.own_sides);
    made.reached = dial_together(made, shared, order.lambda, each);
    put_in(made, shared, each);
  }
  if (order.set == "pairs") made.reached = hide_pair_in(made, random);
  made.reached = observable(made) && made.reached;
  for (SealedCase& one : made.specimens) one.records = add_noise(one.noise, one.specimen.protocol, one.truth, random);
  return made;
}

bool write(const CohortOrder& order, const fs::path& folder) {
  const std::string name = order.name();
  const fs::path place = folder / name, truth = folder / "sealed" / (name + ".json");
  if (fs::exists(place) && fs::exists(truth)) return false;
  const SealedCohort made = make(order);
  fs::create_directories(folder / "sealed");
  const fs::path unfinished = folder / fmt::format(".{}-{}", name, ::getpid());
  fs::remove_all(unfinished);
  fs::remove_all(place);
  fs::create_directories(unfinished);
  const std::string text = truth_text(made, name);
  put_text(truth, text);
  put_text(unfinished / "truth.sha256", sha256(text) + "\n");
  std::string table = "id,group\n";
  for (std::size_t s = 0; s < made.specimens.size(); ++s) {
    const std::string id = fmt::format("s{}", s + 1);
    table += fmt::format("{},{}\n", id, made.group[s]);
    write_measured(made.specimens[s], id, unfinished / id);
  }
  put_text(unfinished / "specimens.csv", table);
  fs::rename(unfinished, place);
  return true;
}

}  // namespace blind
