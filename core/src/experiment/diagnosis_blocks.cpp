// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "experiment/blocks.hpp"
#include "experiment/reader.hpp"
#include "experiment/tolerance_text.hpp"

namespace tunica::experiment {
namespace {

template <class T>
Key<T> alpha_key(std::optional<double> T::*member) {
  return member_key(
      "alpha",
      [] { return number_schema("Significance level: the share of false alarms that is accepted.", 0.0001, 0.5); },
      member,
      [](const Node& node) {
        const double alpha = node.number("a significance level");
        if (!(alpha >= 0.0001 && alpha <= 0.5))
          node.fail(fmt::format("the significance level is {}", alpha),
                    "Expected a number from 0.0001 to 0.5, for example 0.05. The draws of noise are too few for a "
                    "smaller one.");
        return alpha;
      });
}

template <class T>
Key<T> model_key(std::string doc, std::optional<std::string> T::*member, const Experiment& experiment) {
  return name_key("model", std::move(doc), member, entry_names(experiment.models));
}

Key<DiagnosisEntry> mechanisms_key(const plugins::Catalogue& catalogue) {
  return {"mechanisms",
          [] {
            Json schema = {{"description", "Which causes to consider (default all)."}};
            schema["anyOf"] =
                Json::array({choice_schema("Every one.", {"all"}), list_schema("Names.", Json{{"type", "string"}})});
            return schema;
          },
          [&catalogue](const Node& node, DiagnosisEntry& diagnosis) {
            if (node.is_text()) {
              const std::string& set = node.text("");
              if (set != "all")
                node.fail(fmt::format("unknown set of mechanisms '{}'", set),
                          fmt::format("Give \"all\" or a list, for example [\"{}\"].", set));
              diagnosis.all_mechanisms = true;
              return;
            }
            const auto names = node.elements("\"all\" or a list of mechanism names");
            if (names.empty())
              node.fail("the list is empty", "Leave \"mechanisms\" out, or give \"all\", to try every one.");
            for (const Node& name : names)
              diagnosis.mechanisms.push_back(name.one_of(names_of(catalogue.mechanisms()), "mechanism"));
          },
          [](const DiagnosisEntry& diagnosis) {
            if (!diagnosis.mechanisms.empty()) return Json(diagnosis.mechanisms);
            return diagnosis.all_mechanisms ? Json("all") : Json();
          }};
}

Key<DiagnosisEntry> groups_key() {
  const auto read = [](const Node& node) {
    std::vector<std::string> groups;
    for (const Node& name : node.elements("a list of groups of causes"))
      groups.push_back(name.one_of(cause_groups, "group"));
    const auto physical = [](const std::string& group) { return group != "file"; };
    if (std::none_of(groups.begin(), groups.end(), physical))
      node.fail("no group of physical causes is in the list",
                "Name \"material\", \"rig\" or both, or leave \"groups\" out to try every one.");
    return groups;
  };
  return silent_at(member_key(
                       "groups",
                       [] {
                         return list_schema("Where causes may lie (default: material, rig and file).",
                                            choice_schema("A group of causes.", cause_groups));
                       },
                       &DiagnosisEntry::groups, read),
                   Json::array());
}

Key<DiagnosisEntry> wrong_files_key() {
  return member_key(
      "wrong_files",
      [] {
        return number_schema("Share of files that are expected to say what is not so (default 0.1).", 0.0001, 0.9);
      },
      &DiagnosisEntry::wrong_files,
      [](const Node& node) {
        const double share = node.number("a share of files");
        if (!(share >= 0.0001 && share <= 0.9))
          node.fail(fmt::format("the share of files is {}", share),
                    "Expected a number from 0.0001 to 0.9, for example 0.1.");
        return share;
      });
}

constexpr const char* share_of_range = "a share of the range, as \"2 %\"";

std::string read_share(const Node& node) {
  const std::string text = node.text(share_of_range);
  try {
    return tolerance_text(text, "\"tolerance\"");
  } catch (const InputError&) {
    node.fail(fmt::format("'{}' is no tolerance", text),
              "Give a share of the range above 0 and up to 50 %, as \"2 %\".");
  }
}

/// The unit of an observable that some test of the file has; "" where none does.
std::string unit_of(const std::string& observable, const Experiment& experiment, const plugins::Catalogue& catalogue) {
  std::string unit;
  for (const TestEntry& test : experiment.tests)
    for (const Observable& known : catalogue.tests().at(test.type).factory.observables)
      if (known.name == observable) unit = known.unit;
  return unit;
}

/// A share of the range for all observables, or for each a share or a quantity in its unit.
Key<DiagnosisEntry> tolerance_key(const Experiment& experiment, const plugins::Catalogue& catalogue) {
  const auto read_one = [&](const std::string& observable, const Node& node) {
    const std::string text = node.text(share_of_range);
    if (text.ends_with('%')) return read_share(node);
    const std::string unit = unit_of(observable, experiment, catalogue);
    if (unit.empty())
      node.fail(fmt::format("no test of the file has the observable '{}'", observable),
                "Name one that the tests have, or give one share of the range for all.");
    if (!(node.quantity(unit, "a quantity with a unit, or a share of the range as \"2 %\"") > 0))
      node.fail("a tolerance is above 0", "Give a share of the range, as \"2 %\", or a quantity with a unit.");
    return text;
  };
  return {"tolerance",
          [] {
            Json schema = {{"description",
                            "The misfit that is not worth caring about (default: the scatter between repeats, else "
                            "2 % of the range)."}};
            Json each = {{"description", "By observable: a share, or a quantity in its unit."}, {"type", "object"}};
            each["additionalProperties"]["type"] = "string";
            schema["anyOf"] = Json::array({text_schema("A share of the range, as \"2 %\"."), std::move(each)});
            return schema;
          },
          [=](const Node& node, DiagnosisEntry& diagnosis) {
            if (node.is_text())
              diagnosis.tolerance = {{"", read_share(node)}};
            else
              for (const auto& [observable, one] : node.members(share_of_range))
                diagnosis.tolerance.emplace_back(observable, read_one(observable, one));
          },
          [](const DiagnosisEntry& diagnosis) {
            Json json;
            for (const auto& [observable, text] : diagnosis.tolerance)
              (observable.empty() ? json : json[observable]) = text;
            return json;
          }};
}

/// A list of names that is not empty.
Key<DiscoveryEntry> words_key(std::string name, std::string doc, std::vector<std::string> DiscoveryEntry::*member,
                              const std::vector<std::string>& known, std::string noun) {
  const auto read = [=](const Node& node) {
    std::vector<std::string> words;
    for (const Node& word : node.elements("a list of names")) words.push_back(word.one_of(known, noun));
    if (words.empty()) node.fail("the list is empty", fmt::format("Leave \"{}\" out to try every one.", name));
    return words;
  };
  const auto schema = [=] {
    return list_schema(doc, choice_schema(noun == "law" ? "A law." : "An invariant.", known));
  };
  return silent_at(member_key(name, schema, member, read), Json::array());
}

Key<DiscoveryEntry> most_key(std::string name, std::string doc, std::optional<std::size_t> DiscoveryEntry::*member,
                             std::int64_t most) {
  const auto read = [=](const Node& node) {
    const std::int64_t count = node.integer("a whole number");
    if (count < 1 || count > most)
      node.fail(fmt::format("{} is {}", name, count), fmt::format("Give a whole number from 1 to {}.", most));
    return static_cast<std::size_t>(count);
  };
  return member_key(
      name, [=] { return count_schema(doc, 1, most); }, member, read);
}

}  // namespace

Block<DiagnosisEntry> diagnosis_block(const Experiment& experiment, const plugins::Catalogue& catalogue) {
  return {
      "\"diagnosis\"",
      "What the simulation gets wrong, and why.",
      {model_key("Name of a model.", &DiagnosisEntry::model, experiment),
       name_key("optimizer", "Name of an optimizer.", &DiagnosisEntry::optimizer, entry_names(experiment.optimizers)),
       alpha_key(&DiagnosisEntry::alpha), mechanisms_key(catalogue),
       flag_key("admissibility", "Lost stability changes the verdict.", &DiagnosisEntry::admissibility), groups_key(),
       wrong_files_key(), tolerance_key(experiment, catalogue)}};
}

Block<DiscoveryEntry> discovery_block(const Experiment& experiment) {
  return {
      "\"discovery\"",
      "Which terms the energy lacks, or is made of.",
      {model_key("Name of a model: the base.", &DiscoveryEntry::model, experiment),
       flag_key("from_nothing", "The terms make up the whole energy; no base is kept.", &DiscoveryEntry::from_nothing),
       words_key("invariants", "What a term may be a function of (default: what suits the model).",
                 &DiscoveryEntry::invariants, discovery_invariants, "invariant"),
       words_key("laws", "How it may grow (default all).", &DiscoveryEntry::laws, discovery_laws, "law"),
       most_key("most_terms", "The most terms that are added (default 3; from nothing 4).", &DiscoveryEntry::most_terms,
                6),
       most_key("most_parameters", "The most parameters that the terms have together (default: as many as it takes).",
                &DiscoveryEntry::most_parameters, 20),
       alpha_key(&DiscoveryEntry::alpha)}};
}

}  // namespace tunica::experiment
