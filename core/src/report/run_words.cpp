// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "report/sections.hpp"

namespace tunica::report {

namespace {

struct Scored {
  double r2;
  std::string text;  ///< "R² 0.998 in circ (stress, RMSE 1.2 kPa)"
};

/// Of all of them where they are few, else of the worst and the best.
std::string scored_words(std::vector<Scored> all) {
  std::vector<std::string> parts;
  if (all.size() > 3) {
    const auto worse = [](const Scored& a, const Scored& b) { return a.r2 < b.r2; };
    const auto [low, high] = std::minmax_element(all.begin(), all.end(), worse);
    return fmt::format("{} curves, the worst {}, the best {}", all.size(), low->text, high->text);
  }
  for (Scored& one : all) parts.push_back(std::move(one.text));
  return joined(parts);
}

/// What was fitted, and apart from it what was held out.
std::vector<std::string> fit_words(const Json& best) {
  std::vector<Scored> fitted, held_out;
  const Json& tests = member(best, "per_test");
  for (const auto& [test, fit] : tests.items())
    for (const Json& channel : list(fit, "channels"))
      (member(channel, "held_out") == true ? held_out : fitted)
          .push_back({number(channel, "r2"),
                      fmt::format("R² {} in {} ({}, RMSE {})", figure(number(channel, "r2")), test,
                                  word(channel, "channel"), amount(number(channel, "rmse"), word(channel, "unit")))});
  std::vector<std::string> lines;
  if (!fitted.empty()) lines.push_back((held_out.empty() ? "" : "Fitted: ") + scored_words(std::move(fitted)) + '.');
  if (!held_out.empty()) lines.push_back("Held out: " + scored_words(std::move(held_out)) + '.');
  return lines;
}

std::string what_was_fitted(const Json& result, const Order& order) {
  std::set<std::string> models, optimizers, tests;
  double evaluations = 0, realisations = 0;
  for (const auto& run : order.runs()) {
    models.insert(run.model);
    optimizers.insert(run.optimizer);
    for (const auto& test : words(list(*run.run, "tests"))) tests.insert(test);
    const double spent = number(*run.run, "evaluations"), searches = number(*run.run, "realisations");
    evaluations += std::isfinite(spent) ? spent : 0;
    realisations += std::isfinite(searches) ? searches : 0;
  }
  const auto named = [](const std::set<std::string>& names, const char* one, const char* many) {
    if (names.size() > 6) return fmt::format("{} {}", names.size(), many);
    return fmt::format("{} {}", names.size() == 1 ? one : many, joined({names.begin(), names.end()}));
  };
  return fmt::format("{} calibrated to {} with {}: {}, {}, {:.0f} evaluations, seed {}.",
                     capitalised(named(models, "model", "models")), named(tests, "test", "tests"),
                     named(optimizers, "optimizer", "optimizers"), count_of(order.runs().size(), "run", "runs"),
                     count_of(static_cast<std::size_t>(realisations), "realisation", "realisations"), evaluations,
                     figure(number(member(result, "provenance"), "seed")));
}

/// What stands against the best run, and what to do about each.
struct Doubts {
  std::vector<std::string> wrong, next;
  void add(std::string what, std::string remedy) {
    wrong.push_back(std::move(what));
    if (!remedy.empty() && std::find(next.begin(), next.end(), remedy) == next.end()) next.push_back(std::move(remedy));
  }
};

void parameters_in_doubt(const Json& best, Doubts& doubts) {
  std::vector<std::string> bound, loose, one_sided, unreliable, fixed;
  for (const auto& [name, estimate] : member(best, "parameters").items()) {
    if (member(estimate, "at_bound").is_string())
      bound.push_back(name);
    else if (const Json& profile = member(estimate, "profile_ci95"); profile.is_array() && profile.size() == 2)
      (profile[0].is_null() && profile[1].is_null()   ? loose
       : profile[0].is_null() || profile[1].is_null() ? one_sided
                                                      : fixed)
          .push_back(name);
    else if (member(estimate, "ci95").is_null())
      loose.push_back(name);
    else if (member(estimate, "ci95_reliable") == false && !member(estimate, "bootstrap_ci95").is_array())
      unreliable.push_back(name);
  }
  if (!bound.empty())
    doubts.add(fmt::format("{} at a bound", joined(bound)),
               "widen the bounds where physics allows, else doubt the model");
  if (!loose.empty())
    doubts.add(fmt::format("no interval for {}", joined(loose)),
               "read what the data fix under Parameters, and add the test it names");
  if (!one_sided.empty())
    doubts.add(fmt::format("{} limited on one side only", joined(one_sided)),
               "read what the data fix under Parameters, and add the test it names");
  if (!unreliable.empty())
    doubts.add(fmt::format("rough intervals of {}", joined(unreliable)),
               fmt::format("tunica run EXPERIMENT --profiles {}", fmt::format("{}", fmt::join(unreliable, ","))));
}

Doubts doubts_of(const Json& result, const std::string& run, const Json& best) {
  Doubts doubts;
  for (const std::string& warning : words(list(result, "warnings")))
    if (warning.starts_with(run + ": FITS BETTER THAN IT PREDICTS"))
      doubts.add("it fits better than it predicts what was held out",
                 "fit more of the tests together, or take a model with fewer parameters");
  if (word(best, "status") == "infeasible")
    doubts.add("the best point breaks its constraints", "relax the constraints");
  if (member(best, "stable") == false)
    doubts.add("the material is unstable within the measured range",
               "impose the constraint transverse_stability, or take a model with dispersed fibres");
  const Json& certificate = member(best, "certificate");
  const std::string verdict = word(certificate, "verdict");
  if (verdict.find("NOT AN OPTIMUM") != std::string::npos)
    doubts.add("a neighbouring point is better: this is no optimum",
               "give the optimizer more evaluations, or refine with lm");
  const Json& agreement = member(certificate, "realisations");
  const double agree = number(agreement, "agree"), of = number(agreement, "of");
  if (of > 1 && agree < 0.5 * of)
    doubts.add(fmt::format("only {:.0f} of {:.0f} realisations came to the best objective", agree, of),
               "more realisations, or a larger budget");
  parameters_in_doubt(best, doubts);
  return doubts;
}

std::string next_steps(const std::vector<std::string>& steps) {
  if (steps.empty()) return "Use it: tunica simulate EXPERIMENT --parameters result.json";
  std::string text;
  for (const std::string& step : steps) {
    const bool command = step.starts_with("tunica ");
    text += (text.empty() ? "" : " ") + (command ? "Run " + step : capitalised(step)) + '.';
  }
  return text;
}

}  // namespace

void add_summary(Page& page, const Folder& folder, const Order& order) {
  const Json& result = folder.result();
  page.paragraph(what_was_fitted(result, order));
  const auto groups = order.groups();
  for (const std::string& group : groups) {
    const auto first = std::find_if(order.runs().begin(), order.runs().end(),
                                    [&](const auto& run) { return run.group == group && run.rank == 1; });
    const Json& best = first == order.runs().end() ? member(Json(), "") : member(*first->run, "best");
    if (best.is_null()) continue;
    if (groups.size() > 1) page.heading(fmt::format("Best of {}", order.title(group)));
    const auto rivals =
        std::count_if(order.runs().begin(), order.runs().end(), [&](const auto& run) { return run.group == group; });
    const Doubts doubts = doubts_of(result, first->label, best);
    page.word_lists(
        {{"Best run",
          {fmt::format("{}{}, objective {}", first->label, rivals > 1 ? fmt::format(", first of {}", rivals) : "",
                       figure(number(best, "objective")))}},
         {"How well", fit_words(best)},
         {"What is wrong",
          {doubts.wrong.empty() ? "Nothing was found."
                                : capitalised(fmt::format("{}", fmt::join(doubts.wrong, "; "))) + '.'}},
         {"What to do next", {next_steps(doubts.next)}}});
  }
  if (std::none_of(order.runs().begin(), order.runs().end(), [](const auto& run) { return run.rank > 0; }))
    page.box("bad", "No run has a result.",
             {"tunica check EXPERIMENT evaluates the initial point and shows what fails"});
}

}  // namespace tunica::report
