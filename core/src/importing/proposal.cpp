// SPDX-License-Identifier: Apache-2.0
#include "importing/proposal.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "importing/first_choices.hpp"
#include "importing/tests_of_file.hpp"
#include "tunica/error.hpp"

namespace tunica::importing {

Proposal propose(const Answers& answers, const std::filesystem::path& folder, const plugins::Catalogue& catalogue,
                 const Ask& ask) {
  Proposal proposal;
  Json tests = Json::object(), runs = Json::array();
  Json models;
  bool mixed = false;
  std::optional<Specimen> first;
  for (const std::filesystem::path& file : answers.files) {
    auto [specimen, proposed] = tests_of_file(file, answers, folder, catalogue, ask, proposal.notes);
    mixed = mixed || specimen != first.value_or(specimen);
    first = first.value_or(specimen);
    if (models.empty()) models = chosen_model(answers.model, specimen, catalogue);
    Json names = Json::array();
    for (auto& [name, entry] : proposed) {
      if (tests.contains(name))
        throw InputError(fmt::format("{}: two tests would be called '{}'. Rename a file, or import it by itself.",
                                     file.string(), name));
      names.push_back(name);
      tests[name] = std::move(entry);
    }
    if (answers.together && !runs.empty())
      runs.front()["tests"].insert(runs.front()["tests"].end(), names.begin(), names.end());
    else
      runs.push_back({{"model", models.begin().key()}, {"optimizer", "lm"}, {"tests", std::move(names)}});
  }
  if (runs.size() > 1)
    proposal.notes.push_back(
        "each file is fitted by itself, as a different specimen. If they are one specimen, say --together");
  if (mixed && answers.model.empty())
    proposal.notes.push_back(
        fmt::format("the files are of different kinds of specimen, and the model of the first one is proposed for all: "
                    "{}. Name another with --model",
                    models.begin()->at("type").get<std::string>()));
  proposal.experiment = {{"format", 1}};
  proposal.experiment["models"] = std::move(models);
  proposal.experiment["tests"] = std::move(tests);
  proposal.experiment["optimizers"] = chosen_optimizer(catalogue);
  proposal.experiment["runs"] = std::move(runs);
  return proposal;
}

}  // namespace tunica::importing
