// SPDX-License-Identifier: Apache-2.0
#include "cli/bench.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace tunica::trial {

Bench::Bench() {
  for (const auto& [name, stiffness] : {std::pair{"circ", 30.0}, std::pair{"axial", 22.0}}) {
    std::string text = "stretch [1],stress [kPa]\n";
    for (int i = 1; i <= 20; ++i) {
      const double stretch = 1 + 0.02 * i;
      // A neo-Hookean curve with a ripple, so that the fit is never perfect.
      const double stress = stiffness * (stretch * stretch - 1 / stretch) + 0.2 * std::sin(7.0 * i);
      text += fmt::format("{},{}\n", stretch, stress);
    }
    folder.write(fmt::format("{}.csv", name), text);
  }
  const auto strip = [](const char* direction, const char* file) -> nlohmann::json {
    return {
        {"type", "uniaxial"},
        {"direction", direction},
        {"data",
         {{"file", file}, {"columns", {{"stretch", "stretch"}, {"stress", "stress"}}}, {"stress_measure", "cauchy"}}}};
  };
  experiment = {
      {"format", 1},
      {"name", "bench"},
      {"seed", 7},
      {"models",
       {{"gho",
         {{"type", "gho"}, {"parameters", {{"mu", {{"min", "0.5 kPa"}, {"max", "200 kPa"}, {"scale", "log"}}}}}}},
        {"neo", {{"type", "neo_hooke"}}}}},
      {"tests", {{"circ", strip("circumferential", "circ.csv")}, {"axial", strip("axial", "axial.csv")}}},
      {"objective", {{"type", "least_squares"}}},
      {"optimizers", {{"es", {{"type", "es"}}}, {"lm", {{"type", "ceres_lm"}, {"starts", 4}}}}},
      {"stop", {{"max_evaluations", 600}}},
      {"runs",
       {{{"model", "neo"}, {"optimizer", "lm"}}, {{"model", "gho"}, {"optimizer", "es"}, {"realisations", 3}}}}};
}

nlohmann::json without_times(nlohmann::json result) {
  for (auto& run : result["runs"]) {
    run.erase("seconds");
    run["statistics"].erase("seconds");
  }
  result["provenance"].erase("date");
  return result;
}

std::string without_times(const std::string& evaluations) {
  std::string text;
  std::istringstream stream(evaluations);
  for (std::string line; std::getline(stream, line);)
    text += line.substr(0, line.rfind(',', line.rfind(',') - 1)) + '\n';
  return text;
}

}  // namespace tunica::trial
