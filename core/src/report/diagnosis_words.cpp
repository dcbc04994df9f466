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
  for (const Json& mechanism : list(member(diagnosis, key::extension), key::mechanisms))
    ids.push_back(word(mechanism, key::type));
  if (ids.empty() && !list(diagnosis, key::causes).empty())
    ids.push_back(word(list(diagnosis, key::causes).front(), key::id));
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
  std::string verdict = word(diagnosis, key::verdict);
  const std::string reasons = text::joined(words(list(diagnosis, key::reasons)));
  const auto reasons_of = words(list(diagnosis, key::reasons)), codes = words(list(diagnosis, key::reason_codes));
  const auto misses = std::find(codes.begin(), codes.end(), "rows_miss_the_model");
  if (verdict == "nothing_detected" && misses != codes.end() && reasons_of.size() == codes.size())
    return fmt::format("Nothing detected: {}.", reasons_of[static_cast<std::size_t>(misses - codes.begin())]);
  if (verdict == "nothing_detected") return "Nothing detected: the model describes these data to within their noise.";
  if (verdict == "named")
    return fmt::format("Named: the misfit is consistent with {}.", text::joined(named_causes(diagnosis)));
  const bool unlisted = member(diagnosis, key::unlisted) == true;
  const bool asks_the_file = word(member(diagnosis, key::file), key::standing) == "near" ||
                             std::find(codes.begin(), codes.end(), "file_as_likely") != codes.end();
  if (verdict == "indistinguishable" && asks_the_file) return fmt::format("Indistinguishable: {}.", reasons);
  if (verdict == "indistinguishable" && unlisted && list(diagnosis, key::explanations).size() < 2)
    return fmt::format("Indistinguishable: {} together, or an effect that the catalogue does not list. {}.",
                       text::joined(named_causes(diagnosis)), reasons);
  if (verdict == "indistinguishable") {
    const results::Key said = list(diagnosis, key::explanations).empty() ? key::ambiguity_set : key::explanations;
    return fmt::format("Indistinguishable: {} explain the misfit about as well as each other{}.",
                       text::joined(words(list(diagnosis, said))),
                       unlisted ? ", or it is an effect that the catalogue does not list: " + reasons : "");
  }
  if (verdict == "leading") {
    std::string sentences;
    for (const std::string& reason : words(list(diagnosis, key::reasons)))
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
  std::string text =
      fmt::format("{} = {}", word(one, key::name), amount(number(one, key::value), word(one, key::unit)));
  if (const Json& interval = member(one, key::ci95); interval.is_array() && interval.size() == 2)
    text += fmt::format(" ({} … {})", figure(interval[0].is_number() ? interval[0].get<double>() : NAN),
                        figure(interval[1].is_number() ? interval[1].get<double>() : NAN));
  return text;
}

/// "fibre_dispersion of the material: 0.0165 (0.0135 … 0.0196), probability 0.997". No probability where it is not
/// believed, or where the causes leave more than noise: it is that of one among those that were tried.
std::string cause_words(const Json& cause, bool clean) {
  const Json& amplitude = member(cause, key::amplitude);
  std::string text = fmt::format("{}{}: {}", word(cause, key::id), place_words(member(cause, key::target)),
                                 amplitude_words(amplitude));
  for (const Json& one : list(cause, key::nuisance)) text += ", " + amplitude_words(one);
  if (member(amplitude, key::plausible) == false) return text + ", which is implausible";
  if (!clean) return text;
  return text + fmt::format(", probability {}", share(number(cause, key::probability)));
}

std::string fitted_words(const Json& result, const Json& diagnosis) {
  const Json& base = member(diagnosis, key::base);
  std::vector<std::string> tests, values;
  for (const Json& one : list(diagnosis, key::noise))
    if (const std::string test = word(one, key::test); std::find(tests.begin(), tests.end(), test) == tests.end())
      tests.push_back(test);
  for (const auto& [name, estimate] : member(base, key::parameters).items())
    values.push_back(fmt::format("{} = {}", name, amount(number(estimate, key::value), word(estimate, key::unit))));
  if (values.empty()) return "";
  const double rows = number(base, key::rows), squares = number(base, key::squares);
  return fmt::format("{} to {}, {} values, seed {}: {}. Root mean square of residual over noise: {}.",
                     word(base, key::model), tests.empty() ? "the data" : text::joined(tests), figure(rows),
                     figure(number(member(result, key::provenance), key::seed)), fmt::join(values, ", "),
                     figure(std::sqrt(squares / rows)));
}

std::string gain_words(const Json& diagnosis) {
  const Json& gain = member(diagnosis, key::gain);
  if (!gain.is_object()) return "";
  std::string text = fmt::format("Sum of squares over the noise: {} before, {} after, over {} values",
                                 figure(number(gain, key::before)), figure(number(gain, key::after)),
                                 figure(number(member(diagnosis, key::base), key::rows)));
  std::size_t better = 0;
  const Json& blocks = list(gain, key::held_out);
  for (const Json& block : blocks) better += number(block, key::after) < number(block, key::before) ? 1 : 0;
  if (!blocks.empty()) text += fmt::format("; better on {} of {} blocks that were held out", better, blocks.size());
  std::vector<std::string> missed;
  for (const Json& block : blocks)
    if (word(block, key::verdict) == "not_predicted")
      missed.push_back(fmt::format("{} ({} σ)", word(block, key::block), figure(number(block, key::after))));
  if (!missed.empty()) text += "; not predicted: " + text::joined(missed);
  return text + '.';
}

std::vector<std::string> next_words(const Folder& folder, const Json& diagnosis) {
  const Json& discovery = member(folder.result(), key::discovery);
  const std::string verdict = word(diagnosis, key::verdict);
  const Json& next = member(verdict == "discovered" ? discovery : diagnosis, key::next_experiment);
  std::vector<std::string> lines;
  if (std::string text = word(next, key::description); !text.empty()) {
    if (const double repeats = number(next, key::repeats); repeats > 1)
      text += fmt::format(" Repeats: {}.", figure(repeats));
    lines.push_back(text::capitalised(std::move(text), words(list(next, key::separates))));
  }
  if (verdict == "discovered")
    lines.push_back(
        fmt::format("tunica run {} fits the model with the terms added.", folder.in_command("extended.json")));
  else if (const std::string file = word(member(diagnosis, key::extension), key::experiment); !file.empty())
    lines.push_back(fmt::format("tunica run {} fits the model with the cause added.", folder.in_command(file)));
  if (lines.empty() && verdict == "nothing_detected")
    lines.emplace_back("The fitted parameters can be used. Reach lists what could still hide below the noise.");
  return lines;
}

}  // namespace

std::string place_words(const Json& target) {
  if (!target.is_object()) return "";
  std::vector<std::string> tests = words(list(target, key::tests));
  if (tests.empty() && !word(target, key::test).empty()) tests.push_back(word(target, key::test));
  std::string text = tests.empty() ? "" : " in " + text::joined(tests);
  if (const std::string model = word(target, key::model); !model.empty()) text += " in " + model;
  if (const std::string channel = word(target, key::channel); !channel.empty()) text += ", " + channel;
  if (const double row = number(target, key::row); std::isfinite(row)) text += fmt::format(", row {:.0f}", row);
  return text;
}

void add_verdict(Page& page, const Folder& folder) {
  const Json& diagnosis = member(folder.result(), key::diagnosis);
  const std::string verdict = word(diagnosis, key::verdict);
  page.section("Verdict");
  page.paragraph(verdict_words(diagnosis), "verdict");
  add_warnings(page, folder);
  std::vector<std::string> where, causes;
  for (const Json& misfit : list(diagnosis, key::misfit))
    where.push_back(
        fmt::format("{}, {}: {}", word(misfit, key::test), word(misfit, key::channel), word(misfit, key::where)));
  const bool clean = word(diagnosis, key::remainder) != "not_clean";
  for (const Json& cause : list(diagnosis, key::causes)) causes.push_back(cause_words(cause, clean));
  const double p = number(diagnosis, key::p_value);
  std::vector<std::string> sure{fmt::format("Noise alone would look like this with {}. Below {} counts as detected.",
                                            chance(p, member(diagnosis, key::p_value_is_bound) == true),
                                            figure(number(diagnosis, key::alpha)))};
  if (const double after = number(diagnosis, key::p_after); std::isfinite(after)) {
    const std::string remainder = word(diagnosis, key::remainder);
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
  for (const Json& cause : list(diagnosis, key::causes))
    if (const std::string text = word(cause, key::explanation);
        !text.empty() && explained.insert(word(cause, key::id)).second)
      page.paragraph(text);
}

}  // namespace tunica::report
