// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/process.hpp"
#include "execution/folder.hpp"

namespace tunica::trial {

/// A free strip of Gent's rubber, force over displacement, by a program of its own: 40 mm long, 4 mm² in section.
///   F = A μ Jm/(Jm − I1 + 3) (λ − λ⁻²),  λ = 1 + u/40,  I1 = λ² + 2/λ
inline double gent_force(double mu, double jm, double displacement) {
  const double stretch = 1 + displacement / 40, first = stretch * stretch + 2 / stretch;
  return 4 * mu * jm / (jm - first + 3) * (stretch - 1 / (stretch * stretch));
}

inline constexpr const char* gent_program = R"(#!/bin/sh
# TRICK
awk -F= '/mu_MPa/ {mu = $2} /Jm/ {jm = $2}
END {
  if (!mu || !jm) exit 1
  print "u [mm];F [N]"
  for (k = 1; k <= 100; ++k) {
    u = 0.8 * k; l = 1 + u / 40
    printf "%.9g;%.9g\n", u, 4 * mu * jm / (jm - l * l - 2 / l + 3) * (l - 1 / (l * l))
  }
}' input.txt > curve.csv && echo 'done'
)";

/// An experiment with that program: mu 310 kPa, Jm 12 made the data, 30 rows to a displacement of 80 mm.
class SolverBench {
 public:
  explicit SolverBench(double mu = 310, double jm = 12, const std::string& trick = "") {
    std::string text = "u [mm],F [mN]\n", program = gent_program;
    for (int i = 1; i <= 20; ++i) text += fmt::format("{},{:.15g}\n", 4 * i, gent_force(mu, jm, 4.0 * i));
    program.replace(program.find("# TRICK"), 7, trick);
    folder.write("data.csv", text);
    folder.write("gent.sh", program);
    folder.write("input.in", "mu_MPa={{mu MPa}}\nJm={{Jm}}\n");
    test = {{"type", "external"},
            {"command", {"sh", "gent.sh"}},
            {"templates", {{"input.txt", "input.in"}}},
            {"files", {"gent.sh"}},
            {"results",
             {{"displacement", {{"file", "curve.csv"}, {"column", "u [mm]"}, {"start", 0}}},
              {"force", {{"file", "curve.csv"}, {"column", "F [N]"}, {"unit", "N"}, {"start", 0}}}}},
            {"scratch", "scratch"},
            {"data", {{"file", "data.csv"}, {"columns", {{"displacement", "u"}, {"force", "F"}}}}}};
    experiment = {
        {"format", 1},
        {"name", "bench"},
        {"seed", 7},
        {"models",
         {{"gent", {{"type", "gent"}, {"parameters", {{"mu", {{"initial", 100}}}, {"Jm", {{"initial", 40}}}}}}}}},
        {"objective", {{"type", "least_squares"}}},
        {"optimizers", {{"lm", {{"type", "ceres_lm"}, {"starts", 1}, {"function_tolerance", 1e-6}}}}},
        {"stop", {{"max_evaluations", 100}}},
        {"runs", {{{"model", "gent"}, {"optimizer", "lm"}}}}};
  }
  Ended tunica(std::vector<std::string> arguments) {
    experiment["tests"]["strip"] = test;
    folder.write("experiment.json", experiment.dump(2));
    return trial::tunica(std::move(arguments), folder.path());
  }
  Ended run(const std::string& output = "out") { return tunica({"run", "experiment.json", "-o", output}); }
  [[nodiscard]] nlohmann::json result(const std::string& output = "out") const {
    return nlohmann::json::parse(text_of(folder.path() / output / "result.json"))["runs"][0];
  }
  [[nodiscard]] double parameter(const std::string& name, const std::string& output = "out") const {
    return result(output)["best"]["parameters"][name]["value"];
  }
  [[nodiscard]] std::uint64_t solver_runs(const std::string& output = "out") const {
    return result(output)["efforts"]["strip"]["solver_runs"];
  }

  Folder folder;
  nlohmann::json test, experiment;
};

}  // namespace tunica::trial
