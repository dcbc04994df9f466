// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/measured.hpp"

#include <random>
#include <regex>

#include <fmt/format.h>

#include "assembly/assembly.hpp"
#include "tunica/random.hpp"

namespace tunica::trial {

using nlohmann::json;

json experiment_of_a_wall(const std::string& name, double theta) {
  return {{"format", 1},
          {"name", name},
          {"seed", 1},
          {"models",
           {{"gho",
             {{"type", "gho"},
              {"parameters",
               {{"mu", {{"min", 1}, {"max", 100}, {"scale", "log"}, {"initial", 18.668}}},
                {"kappa", {{"fixed", 0.1367}}},
                {"k1", {{"min", 1}, {"max", 200}, {"scale", "log"}, {"initial", 24.905}}},
                {"k2", {{"min", 0.01}, {"max", 5}, {"scale", "log"}, {"initial", 0.2912}}},
                {"theta", {{"fixed", theta}}}}}}}}},
          {"tests", json::object()},
          {"objective", "least_squares"},
          {"optimizers", {{"lm", {{"type", "ceres_lm"}}}}},
          {"runs", {{{"model", "gho"}, {"optimizer", "lm"}}}}};
}

Measured::Measured(std::vector<Strip> wanted) : strips(std::move(wanted)) {
  experiment = experiment_of_a_wall("measured", 46.44);
  for (const Strip& strip : strips) {
    json columns = {{"stretch", "stretch"}, {"stress", "stress"}};
    if (!strip.time.empty()) columns["time"] = "time";
    experiment["tests"][strip.name] = {{"type", "uniaxial"},
                                       {"direction", strip.name.substr(0, strip.name.find('_'))},
                                       {"data",
                                        {{"file", strip.name + ".csv"},
                                         {"columns", columns},
                                         {"order", "loading"},
                                         {"noise", {{"absolute", strip.sd}}}}}};
    write(strip, std::vector<double>(strip.stretch.size(), 0.0));
  }
}

void Measured::write(const Strip& strip, const std::vector<double>& stress) const {
  std::string text = strip.time.empty() ? "stretch [1],stress [kPa]\n" : "stretch [1],stress [kPa],time [s]\n";
  for (std::size_t i = 0; i < stress.size(); ++i) {
    text += fmt::format("{},{}", strip.stretch[i], stress[i]);
    text += strip.time.empty() ? "\n" : fmt::format(",{}\n", strip.time[i]);
  }
  folder.write(strip.name + ".csv", text);
}

void Measured::measure(std::uint64_t seed, const Hide& hide, const Add& add) const {
  json truth = experiment;
  if (hide) hide(truth);
  const auto read = experiment::read_experiment(folder.write("truth.json", truth.dump(2)), testing::catalogue());
  const assembly::Assembly assembly(read, read.runs.front(), testing::catalogue());
  std::vector<double> free(assembly.layout().parameters.size()), exact(assembly.layout().prediction_count);
  assembly.box().from_unit(assembly.box().initial(), free);
  if (const Status status = assembly.evaluator().predict(free, exact, {}, *assembly.evaluator().make_workspace());
      !status.ok())
    throw std::runtime_error(status.reason());
  for (const auto& view : assembly.layout().channels)
    for (const Strip& strip : strips) {
      if (strip.name != view.test) continue;
      std::mt19937_64 generator(derive_seed(seed, strip.name));
      std::normal_distribution<double> normal(0, strip.sd);
      std::vector<double> stress;
      for (std::size_t i = 0; i < view.count; ++i)
        stress.push_back(exact[view.offset + i] + (add ? add(strip, strip.stretch[i]) : 0) + normal(generator));
      write(strip, stress);
    }
}

experiment::Experiment Measured::read() const {
  save();
  return experiment::read_experiment(folder.path() / "experiment.json", testing::catalogue());
}

diagnosis::Diagnosis Measured::diagnose(bool quick) const {
  const experiment::Experiment own = read();
  diagnosis::Request request = diagnosis::request_of(own);
  request.quick = quick;
  return diagnosis::diagnose(own, request, testing::catalogue());
}

const diagnosis::Candidate& candidate(const diagnosis::Diagnosis& found, const std::string& id) {
  for (const diagnosis::Candidate& one : found.analysis.hypotheses.candidates)
    if (one.id == id) return one;
  throw std::runtime_error("no candidate " + id);
}

std::vector<std::string> warning_texts(const diagnosis::Diagnosis& found) {
  std::vector<std::string> texts;
  for (const diagnosis::Warning& warning : found.warnings()) texts.push_back(warning.text);
  return texts;
}

json mechanism(const std::string& type, const std::string& parameter, double value, json more) {
  more["type"] = type;
  more["parameters"][parameter]["initial"] = value;
  return more;
}

std::string in_one_line(const std::string& text) { return std::regex_replace(text, std::regex("\\s+"), " "); }

}  // namespace tunica::trial
