// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/sections.hpp"
#include "text/lists.hpp"
#include "text/misfit_words.hpp"

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
  return text::joined(parts);
}

/// The fitted rows, and separately the held-out rows.
std::vector<std::string> fit_words(const Json& best) {
  std::vector<Scored> fitted, held_out;
  const Json& tests = member(best, key::per_test);
  for (const auto& [test, fit] : tests.items())
    for (const Json& channel : list(fit, key::channels))
      (member(channel, key::held_out) == true ? held_out : fitted)
          .push_back(
              {number(channel, key::r2),
               fmt::format("R² {} in {} ({}, RMSE {})", figure(number(channel, key::r2)), test,
                           word(channel, key::channel), amount(number(channel, key::rmse), word(channel, key::unit)))});
  std::vector<std::string> lines;
  if (!fitted.empty()) lines.push_back((held_out.empty() ? "" : "Fitted: ") + scored_words(std::move(fitted)) + '.');
  if (const Json& misfit = member(best, key::misfit); misfit.is_object())
    lines.push_back(fmt::format("χ²/ν {} against the stated noise (χ² {}, {} rows).",
                                figure(number(misfit, key::reduced_chi_square)),
                                figure(number(misfit, key::chi_square)), figure(number(misfit, key::rows))));
  if (const Json& size = member(best, key::misfit_size); size.is_object()) {
    std::string text = fmt::format("It {} beyond noise", text::misses_by(number(size, key::rms)));
    if (const double tolerance = number(size, key::tolerance); std::isfinite(tolerance))
      text += "; " + text::against_tolerance(number(size, key::rms), number(size, key::rms_upper), tolerance, "stated");
    lines.push_back(text + '.');
  }
  if (!held_out.empty()) lines.push_back("Held out: " + scored_words(std::move(held_out)) + '.');
  return lines;
}

std::string what_was_fitted(const Json& result, const Order& order) {
  std::set<std::string> models, optimizers, tests;
  double evaluations = 0, realisations = 0;
  for (const auto& run : order.runs()) {
    models.insert(run.model);
    optimizers.insert(run.optimizer);
    for (const auto& test : words(list(*run.run, key::tests))) tests.insert(test);
    const double spent = number(*run.run, key::evaluations), searches = number(*run.run, key::realisations);
    evaluations += std::isfinite(spent) ? spent : 0;
    realisations += std::isfinite(searches) ? searches : 0;
  }
  const auto named = [](const std::set<std::string>& names, const char* one, const char* many) {
    if (names.size() > 6) return fmt::format("{} {}", names.size(), many);
    return fmt::format("{} {}", names.size() == 1 ? one : many,
                       text::joined(std::vector<std::string>(names.begin(), names.end())));
  };
  return fmt::format("{} calibrated to {} with {}: {}, {}, {:.0f} evaluations, seed {}.",
                     text::capitalised(named(models, "model", "models")), named(tests, "test", "tests"),
                     named(optimizers, "optimiser", "optimisers"), count_of(order.runs().size(), "run", "runs"),
                     count_of(static_cast<std::size_t>(realisations), "realisation", "realisations"), evaluations,
                     figure(number(member(result, key::provenance), key::seed)));
}

/// What stands against the best run, and what to do about each.
struct Doubts {
  std::vector<std::string> wrong, next;  ///< clauses; sentences
  void add(std::string what, std::string remedy) {
    wrong.push_back(std::move(what));
    if (std::find(next.begin(), next.end(), remedy) == next.end()) next.push_back(std::move(remedy));
  }
};

/// A diagnosis fits without constraints, so it does not explain a misfit that only constraints cause.
std::string diagnosis_advised(const Json& best) {
  const std::string imposed = word(member(best, key::stability), key::imposed);
  if (imposed.empty()) return "Run tunica diagnose EXPERIMENT.";
  return fmt::format(
      "Fit once without the constraints ({}). What misfit is left then is for tunica diagnose EXPERIMENT "
      "to explain, which drops them.",
      imposed);
}

/// χ² against stated noise or, without, against what smooth shapes leave of the data; without either R².
void fit_in_doubt(const Json& best, Doubts& doubts) {
  const std::string diagnose = diagnosis_advised(best);
  constexpr double poor = 0.95;
  const Json &stated = member(best, key::misfit), &estimated = member(best, key::misfit_estimated);
  const bool known = stated.is_object();
  const Json& misfit = known ? stated : estimated;
  if (misfit.is_object()) {
    if (member(misfit, key::contradicts_noise) == true)
      doubts.add(fmt::format("the model misses the data by {} times the {} (χ²/ν {})",
                             figure(number(misfit, key::times_the_noise)),
                             known ? "noise" : "noise that is estimated from the rows",
                             figure(number(misfit, key::reduced_chi_square))),
                 known ? diagnose : diagnose + " State the noise where it is known.");
    else if (member(misfit, key::small_but_real) == true)
      doubts.add(
          fmt::format("the model misses the data by a little, and really (χ²/ν {}, chance {}): parameters may be "
                      "off by more than their intervals",
                      figure(number(misfit, key::reduced_chi_square)), figure(number(misfit, key::chance))),
          diagnose);
    return;
  }
  double worst = 1;
  const Json& tests = member(best, key::per_test);
  for (const auto& [test, fit] : tests.items())
    for (const Json& channel : list(fit, key::channels))
      if (const double r2 = number(channel, key::r2); member(channel, key::held_out) != true && r2 < worst) worst = r2;
  if (worst < poor)
    doubts.add(fmt::format("R² is only {} in the worst curve", figure(worst)), diagnose + " Or take another model.");
}

void parameters_in_doubt(const Json& best, Doubts& doubts) {
  std::vector<std::string> bound, natural, loose, one_sided, unreliable, fixed, coarse;
  for (const auto& [name, estimate] : member(best, key::parameters).items()) {
    const Json& interval = member(estimate, key::ci95);
    if (const double bias = number(estimate, key::mesh_bias);
        std::isfinite(bias) && interval.is_array() &&
        std::abs(bias) > (interval[1].get<double>() - interval[0].get<double>()) / 6)
      coarse.push_back(name);
    if (const std::string kind = word(estimate, key::bound_kind); kind == "symmetry" || kind == "physical")
      natural.push_back(name);
    else if (member(estimate, key::at_bound).is_string())
      bound.push_back(name);
    else if (const Json& profile = member(estimate, key::profile_ci95); profile.is_array() && profile.size() == 2)
      (profile[0].is_null() && profile[1].is_null()   ? loose
       : profile[0].is_null() || profile[1].is_null() ? one_sided
                                                      : fixed)
          .push_back(name);
    else if (member(estimate, key::ci95).is_null() && !member(best, key::intervals_withheld).is_string())
      loose.push_back(name);
    else if (member(estimate, key::ci95_reliable) == false && member(estimate, key::ci95).is_array() &&
             !member(estimate, key::bootstrap_ci95).is_array())
      unreliable.push_back(name);
  }
  if (!coarse.empty())
    doubts.add(fmt::format("the mesh moves {} by more than a third of the half width of {}", text::joined(coarse),
                           text::agreeing(coarse.size(), "its interval", "their intervals")),
               "Take smaller elements.");
  if (!bound.empty())
    doubts.add(fmt::format("{} {} at a bound", text::joined(bound), text::agreeing(bound.size(), "lies", "lie")),
               "Widen the bounds where physics allows it, otherwise doubt the model.");
  if (!natural.empty())
    doubts.add(
        fmt::format("{} {} at the natural end of {} range", text::joined(natural),
                    text::agreeing(natural.size(), "lies", "lie"), text::agreeing(natural.size(), "its", "their")),
        "There is nothing to widen: leave out what the parameter stands for, or doubt the model.");
  if (!loose.empty())
    doubts.add(fmt::format("{} {} no interval", text::joined(loose), text::agreeing(loose.size(), "has", "have")),
               "Read under Parameters what the data fix, and add the test that is named there.");
  if (!one_sided.empty())
    doubts.add(fmt::format("the data limit {} on one side only", text::joined(one_sided)),
               "Read under Parameters what the data fix, and add the test that is named there.");
  if (!unreliable.empty())
    doubts.add(fmt::format("the {} of {} {} rough", text::agreeing(unreliable.size(), "interval", "intervals"),
                           text::joined(unreliable), text::agreeing(unreliable.size(), "is", "are")),
               fmt::format("Run tunica run EXPERIMENT --profiles {}.", fmt::join(unreliable, ",")));
}

/// By its code; a result that is older than the codes has the figures it follows from.
bool is_no_optimum(const Json& certificate) {
  if (const Json& verdict = member(certificate, key::verdict_code); verdict.is_string())
    return verdict == "not_an_optimum";
  constexpr double success = 1e-3;  // relative
  const Json& neighbours = member(certificate, key::neighbours);
  const double here = number(member(certificate, key::fresh_process), key::objective),
               lowest = number(member(neighbours, key::lowest), key::objective);
  return member(neighbours, key::better) == true && here - lowest > success * std::abs(here);
}

bool predicts_worse(const Json& best) {
  const Json& channels = list(best, key::hold_out);
  return std::any_of(channels.begin(), channels.end(),
                     [](const Json& channel) { return word(channel, key::verdict) == "worse_than_fitted"; });
}

/// Of one run, by its warnings: figures of its own do not tell.
void noise_in_doubt(const Json& result, const std::string& run, Doubts& doubts) {
  const Json& warnings = list(result, key::warning_details);
  if (std::any_of(warnings.begin(), warnings.end(), [&](const Json& warning) {
        return word(warning, key::kind) == "noise_too_large" && word(warning, key::run) == run;
      }))
    doubts.add("the rows scatter far less than the stated noise says", "Correct the noise, or the unit of the data.");
}

/// The outcome of a run that is not a fit; the sentence names the key that lets the search continue.
void ending_in_doubt(const Json& result, const std::string& run, Doubts& doubts) {
  for (const Json& one : list(result, key::runs)) {
    const std::string code = word(one, key::ending_code);
    if (word(one, key::run) != run) continue;
    if (code == "mostly_failed" || code == "not_a_fit" || code == "misses" || code == "not_converged")
      doubts.add(word(one, key::ending), code == "not_converged" ? "Raise the limit that ended the search."
                                                                 : "Take another model, or other bounds.");
  }
}

Doubts doubts_of(const Json& result, const std::string& run, const Json& best) {
  Doubts doubts;
  fit_in_doubt(best, doubts);
  noise_in_doubt(result, run, doubts);
  if (predicts_worse(best))
    doubts.add("the run fits better than it predicts what was held out",
               "Fit more of the tests together, or take a model with fewer parameters.");
  if (word(best, key::status) == "infeasible")
    doubts.add("the best point breaks its constraints", "Relax the constraints.");
  if (member(best, key::stable) == false)
    doubts.add("the material is unstable within the measured range", "Impose the constraint transverse_stability.");
  ending_in_doubt(result, run, doubts);
  const Json& certificate = member(best, key::certificate);
  if (is_no_optimum(certificate))
    doubts.add("a neighbouring point is better, so this is not an optimum",
               "Give the optimiser more evaluations, or refine with lm.");
  const Json& agreement = member(certificate, key::realisations);
  const double agree = number(agreement, key::agree), of = number(agreement, key::of);
  if (of > 1 && agree < 0.5 * of)
    doubts.add(fmt::format("only {:.0f} of {:.0f} realisations reached the best objective", agree, of),
               "Take more realisations, or a larger budget.");
  parameters_in_doubt(best, doubts);
  return doubts;
}

}  // namespace

void add_summary(Page& page, const Folder& folder, const Order& order) {
  const Json& result = folder.result();
  page.paragraph(what_was_fitted(result, order));
  const auto groups = order.groups();
  for (const std::string& group : groups) {
    const auto first = std::find_if(order.runs().begin(), order.runs().end(),
                                    [&](const auto& run) { return run.group == group && run.rank == 1; });
    const Json& best = first == order.runs().end() ? entry(Json(), "") : member(*first->run, key::best);
    if (best.is_null()) continue;
    if (groups.size() > 1) page.heading(fmt::format("Best of {}", order.title(group)));
    const auto rivals =
        std::count_if(order.runs().begin(), order.runs().end(), [&](const auto& run) { return run.group == group; });
    const std::string model = word(*first->run, key::model);
    const bool layered = model.empty() || model.find('+') != std::string::npos;
    const Doubts doubts = doubts_of(result, word(*first->run, key::run), best);
    std::vector<std::string> names;
    for (const auto& entry : member(best, key::parameters).items()) names.push_back(entry.key());
    page.word_lists(
        {{"Best run",
          {fmt::format("{}{}, objective {}", first->label, rivals > 1 ? fmt::format(", first of {}", rivals) : "",
                       figure(number(best, key::objective)))}},
         {"How well", fit_words(best)},
         {"What is wrong",
          {doubts.wrong.empty() ? "Nothing was found."
                                : text::capitalised(fmt::format("{}.", fmt::join(doubts.wrong, "; ")), names)}},
         {"What to do next",
          {doubts.next.empty() ? fmt::format("Use it: tunica simulate EXPERIMENT{} --parameters {} -o FOLDER",
                                             layered ? "" : " --model " + model, folder.in_command("result.json"))
                               : fmt::format("{}", fmt::join(doubts.next, " "))}}});
  }
  if (std::none_of(order.runs().begin(), order.runs().end(), [](const auto& run) { return run.rank > 0; }))
    page.box(
        "bad", "No run has a result.",
        {"tunica check EXPERIMENT evaluates the initial point and shows what fails; where a test starts a program, add "
         "--run-external."});
}

}  // namespace tunica::report
