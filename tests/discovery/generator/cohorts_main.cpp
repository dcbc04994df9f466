// SPDX-License-Identifier: Apache-2.0
// Writes cohorts of the blind benchmark: several specimens of one tissue with the same effect hidden in them, the truth
// apart. Nothing of tunica is in it.
#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bases.hpp"
#include "sealed_cohort.hpp"

int main(int count, char** arguments) {
  using namespace blind;
  CLI::App app("Cohorts of the blind benchmark of diagnosis, their truth sealed");
  CohortOrder like;
  like.noise = {"white", "relative", "quantised"};
  std::string out, base = "hgo";
  std::vector<std::string> effects;
  std::size_t first = 0, number = 1;
  like.lambda = 25;
  app.add_option("--out", out, "folder of the cohorts; truths go to its folder 'sealed'")->required();
  app.add_option("--seed", like.seed, "root of all random numbers");
  app.add_option("--set", like.set, "what is hidden")
      ->check(CLI::IsMember({"nulls", "singles", "pairs", "groups"}))
      ->required();
  app.add_option("--first", first, "number of the first cohort of each effect");
  app.add_option("--count", number, "cohorts of each effect");
  app.add_option("--effect", effects, "ids, for singles and groups; default: all");
  app.add_option("--lambda", like.lambda, "mean squared misfit that each effect alone leaves")
      ->check(CLI::PositiveNumber);
  app.add_option("--specimens", like.specimens, "in each cohort")->check(CLI::Range(2, 200));
  app.add_option("--noise", like.noise, "kinds to draw from")->check(CLI::IsMember(noise_kinds()));
  app.add_option("--base", base, "model of the specimens")->check(CLI::IsMember(base_names()));
  app.add_option("--protocol", like.protocol, "artery, sheets, rubber")->check(CLI::IsMember(protocol_names()));
  try {
    app.parse(count, arguments);
    like.base = base_called(base);
    const bool one_each = like.set == "nulls" || like.set == "pairs";
    if (one_each) effects = {""};
    if (like.set == "nulls") like.lambda = 0;
    if (effects.empty()) {
      std::mt19937_64 random(1);
      const Specimen specimen = draw_specimen(random, like.base, like.protocol);
      for (const Effect& effect : catalogue())
        if (makes_sense(effect, specimen)) effects.push_back(effect.id);
    }
    std::size_t written = 0;
    for (std::size_t index = first; index < first + number; ++index)
      for (const std::string& id : effects) {
        like.effect = id;
        like.index = index;
        written += write(like, out);
      }
    fmt::print("{} cohorts in {}, {} of them new\n", number * effects.size(), out, written);
    return 0;
  } catch (const CLI::ParseError& problem) {
    return app.exit(problem) == 0 ? 0 : 2;
  } catch (const std::invalid_argument& problem) {
    fmt::print(stderr, "discovery_cohorts: {}\n", problem.what());
    return 2;
  } catch (const std::exception& problem) {
    fmt::print(stderr, "discovery_cohorts: {}\n", problem.what());
    return 1;
  }
}
