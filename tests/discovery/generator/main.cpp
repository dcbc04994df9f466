// SPDX-License-Identifier: Apache-2.0
// Writes cases of the blind benchmark of diagnosis: experiment files and data with an effect hidden in them, the truth
// apart. Nothing of tunica is in it. The same orders give the same cases; those that are there are left alone.
#include <charconv>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bases.hpp"
#include "sealed_case.hpp"

namespace {

using namespace blind;

/// "A:B", B not included.
std::pair<std::size_t, std::size_t> range(const std::string& text) {
  const auto colon = text.find(':');
  std::size_t from = 0, to = 0;
  const auto read = [](std::string_view part, std::size_t& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size();
  };
  if (colon == std::string::npos || !read(std::string_view(text).substr(0, colon), from) ||
      !read(std::string_view(text).substr(colon + 1), to) || to < from)
    throw CLI::ValidationError("--cases", fmt::format("found '{}', expected \"first:last\", last not included, for "
                                                      "example 0:40",
                                                      text));
  return {from, to};
}

void list() {
  for (const auto* effects : {&catalogue(), &outsiders()}) {
    for (const Effect& effect : *effects)
      fmt::print("{}{}{}\n", effect.id, effects == &outsiders() ? " (outside)" : "",
                 effect.look_alike.empty() ? "" : ", like " + effect.look_alike);
  }
}

/// Of the effects that nobody named one by one, those that make sense in this class.
bool offered(const Effect& effect, const CaseOrder& like) {
  std::mt19937_64 random(1);
  return makes_sense(effect, draw_specimen(random, like.base, like.protocol)) &&
         (like.order_recorded || !remembers(effect));
}

/// `like` is an order whose set, effect, Λ and index are filled in.
std::vector<CaseOrder> orders(CaseOrder like, std::vector<std::string> effects, std::vector<double> lambdas,
                              std::pair<std::size_t, std::size_t> cases) {
  const std::string& set = like.set;
  if (set == "nulls") {
    effects = {""};
    lambdas = {0};
  }
  if (set == "pairs") effects = {""};
  if (effects.empty())
    for (const Effect& effect : set == "outside" ? outsiders() : catalogue())
      if (offered(effect, like)) effects.push_back(effect.id);
  if (lambdas.empty()) lambdas = set == "pairs" ? std::vector<double>{60} : std::vector<double>{10, 25, 60, 150};
  std::vector<CaseOrder> all;
  for (std::size_t index = cases.first; index < cases.second; ++index)
    for (const std::string& effect : effects)
      for (const double lambda : lambdas) {
        like.effect = effect;
        like.lambda = lambda;
        like.index = index;
        all.push_back(like);
      }
  return all;
}

}  // namespace

int main(int count, char** arguments) {
  CLI::App app("Cases of the blind benchmark of diagnosis, their truth sealed");
  std::string out, set = "nulls", cases = "0:1";
  std::uint64_t seed = 1;
  std::vector<std::string> effects, noise{"white", "relative", "quantised"};
  std::vector<double> lambdas;
  std::string base = "hgo", protocol = "artery";
  bool only_list = false, oracle = false, unstated = false, unordered = false;
  app.add_option("--out", out, "folder of the cases; truths go to its folder 'sealed'");
  app.add_option("--seed", seed, "root of all random numbers");
  app.add_option("--set", set, "what is hidden")->check(CLI::IsMember({"nulls", "singles", "pairs", "outside"}));
  app.add_option("--cases", cases, "first:last of each effect and Λ, last not included");
  app.add_option("--effect", effects, "ids, for singles and outside; default: all");
  app.add_option("--lambda", lambdas, "squared misfit that each effect alone leaves; default 10 25 60 150, pairs 60")
      ->check(CLI::PositiveNumber);
  app.add_option("--noise", noise, "kinds to draw from; default: white relative quantised")
      ->check(CLI::IsMember(noise_kinds()));
  app.add_option("--base", base, "model of the specimen")->check(CLI::IsMember(base_names()));
  app.add_option("--protocol", protocol,
                 "artery: strips and tubes; sheets: biaxial; rubber: uniaxial, equibiaxial, shear")
      ->check(CLI::IsMember(protocol_names()));
  app.add_flag("--noise-not-stated", unstated, "the same data, but the files say nothing of their noise");
  app.add_flag("--order-not-recorded", unordered, "rows reversed or shuffled, no time; no effect that has a memory");
  app.add_flag("--oracle", oracle, "write beside each truth what could be found by who knew noise and base parameters");
  app.add_flag("--list", only_list, "list the effects and end");
  try {
    app.parse(count, arguments);
    if (only_list) {
      list();
      return 0;
    }
    if (out.empty()) throw CLI::RequiredError("--out");
    for (const std::string& id : effects) (void)effect(id);
    std::size_t written = 0;
    const auto all = orders({seed, set, "", 0, 0, noise, base_called(base), protocol, !unstated, !unordered}, effects,
                            lambdas, range(cases));
    for (const CaseOrder& order : all) written += write(order, out, oracle);
    fmt::print("{} cases in {}, {} of them new\n", all.size(), out, written);
    return 0;
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const std::invalid_argument& problem) {
    fmt::print(stderr, "discovery_generator: {}\n", problem.what());
    return 2;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "discovery_generator: {}\n", problem.what());
    return 1;
  }
}
