// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "assembly/assembly.hpp"
#include "diagnosis/measured.hpp"
#include "tunica/random.hpp"

namespace tunica::trial {

/// Two strips and three sheets of a gho wall, in a folder of its own.
class Wall {
 public:
  Wall() {
    experiment = experiment_of_a_wall("wall", 38);
    for (const char* const direction : {"circumferential", "axial"})
      add(direction, {{"type", "uniaxial"}, {"direction", direction}}, {"stretch"}, {"stress"}, {0.5});
    int number = 0;
    for (const auto& [around, along] : {std::pair{0.35, 0.35}, {0.35, 0.15}, {0.15, 0.35}})
      add(fmt::format("sheet_{}", ++number), {{"type", "biaxial"}}, {"stretch_circumferential", "stretch_axial"},
          {"stress_circumferential", "stress_axial"}, {around, along});
  }

  struct Table {
    std::vector<std::string> stretches, stresses;
    std::map<std::string, std::vector<double>> values;
  };

  /// Numbers of what the model shows at its initial values once `hide` has changed a copy of the experiment.
  void measure(std::uint64_t seed, const std::function<void(nlohmann::json&)>& hide = {}) {
    nlohmann::json truth = experiment;
    if (hide) hide(truth);
    const auto read = experiment::read_experiment(folder.write("truth.json", truth.dump(2)), testing::catalogue());
    const assembly::Assembly assembly(read, read.runs.front(), testing::catalogue());
    std::vector<double> free(assembly.layout().parameters.size()), exact(assembly.layout().prediction_count);
    assembly.box().from_unit(assembly.box().initial(), free);
    if (!assembly.evaluator().predict(free, exact, {}, *assembly.evaluator().make_workspace()).ok())
      throw std::runtime_error("no prediction");
    for (const auto& view : assembly.layout().channels) {
      const auto from = exact.begin() + static_cast<std::ptrdiff_t>(view.offset);
      const auto to = from + static_cast<std::ptrdiff_t>(view.count);
      const auto [least, most] = std::minmax_element(from, to);
      const double sd = 0.01 * (*most - *least);
      std::mt19937_64 generator(derive_seed(seed, view.test + view.observable));
      std::normal_distribution<double> normal(0, sd);
      std::vector<double>& values = tables.at(view.test).values[view.observable];
      values.assign(from, to);
      for (double& value : values) value += normal(generator);
      experiment["tests"][view.test]["data"]["noise"][view.observable]["absolute"] = sd;
    }
    write();
  }

  /// Numbers of a channel, and their noise, times a factor.
  void scale(const std::string& test, const std::string& channel, double factor) {
    for (double& value : tables.at(test).values.at(channel)) value *= factor;
    nlohmann::json& sd = experiment["tests"][test]["data"]["noise"][channel]["absolute"];
    sd = sd.get<double>() * factor;
    write();
  }
  void rename(const std::string& test, const std::string& one, const std::string& other) {
    nlohmann::json& columns = experiment["tests"][test]["data"]["columns"];
    std::swap(columns[one], columns[other]);
  }

  [[nodiscard]] diagnosis::Diagnosis diagnose() const {
    folder.write("experiment.json", experiment.dump(2));
    return diagnose("experiment.json");
  }
  /// Another experiment file of the folder.
  [[nodiscard]] diagnosis::Diagnosis diagnose(const std::string& file) const {
    const auto own = experiment::read_experiment(folder.path() / file, testing::catalogue());
    diagnosis::Request request = diagnosis::request_of(own);
    request.quick = true;
    return diagnosis::diagnose(own, request, testing::catalogue());
  }

  void write() const {
    for (const auto& [name, table] : tables) {
      std::vector<std::string> columns = table.stretches;
      columns.insert(columns.end(), table.stresses.begin(), table.stresses.end());
      std::string text;
      for (const std::string& column : columns)
        text += fmt::format("{}{} [{}]", text.empty() ? "" : ",", column, column.starts_with("stretch") ? "1" : "kPa");
      text += '\n';
      for (std::size_t i = 0; i < table.values.at(columns.front()).size(); ++i)
        for (const std::string& column : columns)
          text += fmt::format("{}{}", table.values.at(column)[i], column == columns.back() ? '\n' : ',');
      folder.write(name + ".csv", text);
    }
  }

  nlohmann::json experiment;
  std::map<std::string, Table> tables;
  Folder folder;

 private:
  static constexpr std::size_t rows = 14;

  void add(const std::string& name, nlohmann::json entry, const std::vector<std::string>& stretches,
           const std::vector<std::string>& stresses, const std::vector<double>& most) {
    Table table{stretches, stresses, {}};
    entry["data"] = {{"file", name + ".csv"},
                     {"order", "loading"},
                     {"columns", nlohmann::json::object()},
                     {"noise", nlohmann::json::object()}};
    for (std::size_t k = 0; k < stretches.size(); ++k) {
      for (std::size_t i = 1; i <= rows; ++i)
        table.values[stretches[k]].push_back(1 + most[k] * static_cast<double>(i) / rows);
      entry["data"]["columns"][stretches[k]] = stretches[k];
    }
    for (const std::string& stress : stresses) {
      table.values[stress].assign(rows, 1.0);
      entry["data"]["columns"][stress] = stress;
      entry["data"]["noise"][stress]["absolute"] = 1;
    }
    experiment["tests"][name] = std::move(entry);
    tables[name] = std::move(table);
    write();
  }
};

}  // namespace tunica::trial
