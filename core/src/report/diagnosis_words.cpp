// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/diagnosis_pieces.hpp"
#include "text/lists.hpp"

namespace tunica::report {

namespace {

std::vector<std::string> named_causes(const Json& diagnosis) {
  std::vector<std::string> ids;
  for (const Json& mechanism : list(member(diagnosis, "extension"), "mechanisms"))
    ids.push_back(word(mechanism, "type"));
  if (ids.empty() && !list(diagnosis, "causes").empty()) ids.push_back(word(list(diagnosis, "causes").front(), "id"));
  // Parallel instances, such as several relaxation times, are listed once.
  std::vector<std::string> named;
  for (auto at = ids.begin(); at != ids.end(); ++at) {
    if (std::find(ids.begin(), at, *at) != at) continue;
    const auto times = std::count(ids.begin(), ids.end(), *at);
    named.push_back(times == 1 ? *at : times == 2 ? *at + " twice" : fmt::format("{} {} times", *at, times));
  }
  return named;
}

std::string verdict_words(const Json& diagnosis) {
  std::string verdict = word(diagnosis, "verdict");
  const std::string reasons = text::joined(words(list(diagnosis, "reasons")));
  const auto reasons_of = words(list(diagnosis, "reasons")), codes = words(list(diagnosis, "reason_codes"));
  const auto misses = std::find(codes.begin(), codes.end(), "rows_miss_the_model");
  if (verdict == "nothing_detected" && misses != codes.end() && reasons_of.size() == codes.size())
    return fmt::format("Nothing detected: {}.", reasons_of[static_cast<std::size_t>(misses - codes.begin())]);
  if (verdict == "nothing_detected") return "Nothing detected: the model describes these data to within their noise.";
  if (verdict == "named")
    return fmt::format("Named: the misfit is consistent with {}.", text::joined(named_causes(diagnosis)));
  const bool unlisted = member(diagnosis, "unlisted") == true;
  const bool asks_the_file = word(member(diagnosis, "file"), "standing") == "near" ||
                             std::find(codes.begin(), codes.end(), "file_as_likely") != codes.end();
  if (verdict == "indistinguishable" && asks_the_file) return fmt::format("Indistinguishable: {}.", reasons);
  if (verdict == "indistinguishable" && unlisted && list(diagnosis, "explanations").size() < 2)
    return fmt::format("Indistinguishable: {} together, or an effect that the catalogue does not list. {}.",
                       text::joined(named_causes(diagnosis)), reasons);
  if (verdict == "indistinguishable") {
    const char* const said = list(diagnosis, "explanations").empty() ? "ambiguity_set" : "explanations";
    return fmt::format("Indistinguishable: {} explain the misfit about as well as each other{}.",
                       text::joined(words(list(diagnosis, said))),
                       unlisted ? ", or it is an effect that the catalogue does not list: " + reasons : "");
  }
  if (verdict == "leading") {
    std::string sentences;
    for (const std::string& reason : words(list(diagnosis, "reasons")))
      sentences += (sentences.empty() ? "" : " ") + text::capitalised(reason, {}) + '.';
    return sentences.empty() ? "One cause leads." : sentences;
  }
  if (verdict == "discovered") {
    return fmt::format("Discovered: {}. No mechanism of the catalogue explains it.",
                       reasons.empty() ? "terms of the energy" : reasons);
  }
  if (verdict == "suspect_data") return fmt::format("Suspect data: {}.", reasons);
  if (verdict == "unknown") return fmt::format("Unknown: something is wrong, and {}.", reasons);
  return verdict;
}

/// "tau = 12 s (10 … 14)"
std::string amplitude_words(const Json& one) {
  std::string text = fmt::format("{} = {}", word(one, "name"), amount(number(one, "value"), word(one, "unit")));
  if (const Json& interval = member(one, "ci95"); interval.is_array() && interval.size() == 2)
    text += fmt::format(" ({} … {})", figure(interval[0].is_number() ? interval[0].get<double>() : NAN),
                        figure(interval[1].is_number() ? interval[1].get<double>() : NAN));
  return text;
}

/// "fibre_dispersion of the material: 0.0165 (0.0135 … 0.0196), probability 0.997". No probability where it is not
/// believed, or where the causes leave more than noise: it is that of one among those that were tried.
std::string cause_words(const Json& cause, bool clean) {
  const Json& amplitude = member(cause, "amplitude");
  std::string text =
      fmt::format("{}{}: {}", word(cause, "id"), place_words(member(cause, "target")), amplitude_words(amplitude));
  for (const Json& one : list(cause, "nuisance")) text += ", " + amplitude_words(one);
  if (member(amplitude, "plausible") == false) return text + ", which is implausible";
  if (!clean) return text;
  return text + fmt::format(", probability {}", share(number(cause, "probability")));
}

std::string fitted_words(const Json& result, const Json& diagnosis) {
  const Json& base = member(diagnosis, "base");
  std::vector<std::string> tests, values;
  for (const Json& one : list(diagnosis, "noise"))
    if (const std::string test = word(one, "test"); std::find(tests.begin(), tests.end(), test) == tests.end())
      tests.push_back(test);
  for (const auto& [name, estimate] : member(base, "parameters").items())
    values.push_back(fmt::format("{} = {}", name, amount(number(estimate, "value"), word(estimate, "unit"))));
  if (values.empty()) return "";
  const double rows = number(base, "rows"), squares = number(base, "squares");
  return fmt::format("{} to {}, {} values, seed {}: {}. Root mean square of residual over noise: {}.",
                     word(base, "model"), tests.empty() ? "the data" : text::joined(tests), figure(rows),
                     figure(number(member(result, "provenance"), "seed")), fmt::join(values, ", "),
                     figure(std::sqrt(squares / rows)));
}

std::string gain_words(const Json& diagnosis) {
  const Json& gain = member(diagnosis, "gain");
  if (!gain.is_object()) return "";
  std::string text =
      fmt::format("Sum of squares over the noise: {} before, {} after, over {} values", figure(number(gain, "before")),
                  figure(number(gain, "after")), figure(number(member(diagnosis, "base"), "rows")));
  std::size_t better = 0;
  const Json& blocks = list(gain, "held_out");
  for (const Json& block : blocks) better += number(block, "after") < number(block, "before") ? 1 : 0;
  if (!blocks.empty()) text += fmt::format("; better on {} of {} blocks that were held out", better, blocks.size());
  std::vector<std::string> missed;
  for (const Json& block : blocks)
    if (word(block, "verdict") == "not_predicted")
      missed.push_back(fmt::format("{} ({} σ)", word(block, "block"), figure(number(block, "after"))));
  if (!missed.empty()) text += "; not predicted: " + text::joined(missed);
  return text + '.';
}

std::vector<std::string> next_words(const Folder& folder, const Json& diagnosis) {
  const Json& discovery = member(folder.result(), "discovery");
  const std::string verdict = word(diagnosis, "verdict");
  const Json& next = member(verdict == "discovered" ? discovery : diagnosis, "next_experiment");
  std::vector<std::string> lines;
  if (std::string text = word(next, "description"); !text.empty()) {
    if (const double repeats = number(next, "repeats"); repeats > 1)
      text += fmt::format(" Repeats: {}.", figure(repeats));
    lines.push_back(text::capitalised(std::move(text), words(list(next, "separates"))));
  }
  if (verdict == "discovered")
    lines.push_back(
        fmt::format("tunica run {} fits the model with the terms added.", folder.in_command("extended.json")));
  else if (const std::string file = word(member(diagnosis, "extension"), "experiment"); !file.empty())
    lines.push_back(fmt::format("tunica run {} fits the model with the cause added.", folder.in_command(file)));
  if (lines.empty() && verdict == "nothing_detected")
    lines.emplace_back("The fitted parameters can be used. Reach lists what could still hide below the noise.");
  return lines;
}

}  // namespace

std::string place_words(const Json& target) {
  if (!target.is_object()) return "";
  std::vector<std::string> tests = words(list(target, "tests"));
  if (tests.empty() && !word(target, "test").empty()) tests.push_back(word(target, "test"));
  std::string text = tests.empty() ? "" : " in " + text::joined(tests);
  if (const std::string model = word(target, "model"); !model.empty()) text += " in " + model;
  if (const std::string channel = word(target, "channel"); !channel.empty()) text += ", " + channel;
  if (const double row = number(target, "row"); std::isfinite(row)) text += fmt::format(", row {:.0f}", row);
  return text;
}

void add_verdict(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), "diagnosis");
  const std::string verdict = word(diagnosis, "verdict");
  page.section("Verdict");
  page.paragraph(verdict_words(diagnosis), "verdict");
  add_warnings(page, folder);
  std::vector<std::string> where, causes;
  for (const Json& misfit : list(diagnosis, "misfit"))
    where.push_back(fmt::format("{}, {}: {}", word(misfit, "test"), word(misfit, "channel"), word(misfit, "where")));
  const bool clean = word(diagnosis, "remainder") != "not_clean";
  for (const Json& cause : list(diagnosis, "causes")) causes.push_back(cause_words(cause, clean));
  const double p = number(diagnosis, "p_value");
  std::vector<std::string> sure{fmt::format("Noise alone would look like this with {}. Below {} counts as detected.",
                                            chance(p, member(diagnosis, "p_value_is_bound") == true),
                                            figure(number(diagnosis, "alpha")))};
  if (const double after = number(diagnosis, "p_after"); std::isfinite(after)) {
    const std::string remainder = word(diagnosis, "remainder");
    sure.push_back(fmt::format("With the cause added, noise alone would leave this much with {}{}.", chance(after),
                               remainder == "clean"       ? "; nothing is left to explain"
                               : remainder == "not_clean" ? "; something is still left to explain"
                                                          : ""));
  }
  const auto one = [](std::string text) {
    return text.empty() ? std::vector<std::string>{} : std::vector{std::move(text)};
  };
  page.word_lists({{"What was fitted", one(fitted_words(folder.result(), diagnosis))},
                   {"How sure", sure},
                   {"Where", where},
                   {causes.size() > 1 ? "Causes" : "Cause", causes},
                   {"Gain", one(gain_words(diagnosis))},
                   {"What to do next", next_words(folder, diagnosis)}});
  std::set<std::string> explained;  // of several of a kind, the first stands for all
  for (const Json& cause : list(diagnosis, "causes"))
    if (const std::string text = word(cause, "explanation");
        !text.empty() && explained.insert(word(cause, "id")).second)
      page.paragraph(text);
}

}  // namespace tunica::report
