// SPDX-License-Identifier: Apache-2.0
// What memory costs: residuals and Jacobian of loops of VHB 4910 at three rates, with a model and with the same model
// under mechanisms that remember. Times are medians of interleaved rounds; ratios are to the model alone. Asked for: at
// most 5 with the Jacobian.
#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins.hpp"

namespace tunica::bench {
namespace {

using Names = std::vector<std::string>;

/// Residuals, with the Jacobian or without, at the initial point.
class Case {
 public:
  Case(const std::string& model, const Names& mechanisms, bool jacobian)
      : jacobian_(jacobian), assembly_(make(model, mechanisms)), workspace_(assembly_->evaluator().make_workspace()) {
    const auto& layout = assembly_->layout();
    for (const auto& parameter : layout.parameters) at_.push_back(parameter.initial);
    residuals_.resize(layout.residual_count);
    if (jacobian) J_.resize(layout.residual_count * at_.size());
    per_test_.resize(layout.test_count);
  }
  /// Seconds of one evaluation.
  double time() {
    constexpr int rounds = 20;
    const auto begun = std::chrono::steady_clock::now();
    for (int k = 0; k < rounds; ++k)
      if (!assembly_->evaluator().evaluate(at_, value_, per_test_, residuals_, J_, *workspace_).ok())
        throw std::runtime_error("an evaluation fails");
    seconds_.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() / rounds);
    return seconds_.back();
  }
  double median() {
    std::nth_element(seconds_.begin(), seconds_.begin() + static_cast<std::ptrdiff_t>(seconds_.size() / 2),
                     seconds_.end());
    return seconds_[seconds_.size() / 2];
  }
  [[nodiscard]] std::size_t rows() const { return residuals_.size(); }

 private:
  static std::unique_ptr<assembly::Assembly> make(const std::string& model, const Names& mechanisms) {
    auto experiment =
        experiment::read_experiment(TUNICA_SOURCE_DIR "/examples/vhb4910_cause/experiment.json", catalogue());
    experiment.models.front().type = model;
    experiment.models.front().parameters = {};
    experiment.models.front().options = options_of(catalogue().models().at(model).factory.options);
    for (const std::string& type : mechanisms) {
      auto& on = experiment.models.front().mechanisms;
      on.push_back({type,
                    options_of(catalogue().mechanisms().at(type).factory.options),
                    {},
                    fmt::format("{}_{}", type, on.size())});
    }
    return std::make_unique<assembly::Assembly>(experiment, experiment.runs.front(), catalogue());
  }

  bool jacobian_;
  std::unique_ptr<assembly::Assembly> assembly_;
  assembly::WorkspacePointer workspace_;
  std::vector<double> at_, residuals_, J_, per_test_, seconds_;
  double value_ = 0;
};

void compare(const std::string& model) {
  const std::vector<Names> extensions = {{},
                                         {"stress_softening"},
                                         {"viscoelasticity"},
                                         {"viscoelasticity", "viscoelasticity"},
                                         {"stress_softening", "viscoelasticity"}};
  for (const bool jacobian : {false, true}) {
    std::vector<std::unique_ptr<Case>> cases;
    for (const Names& names : extensions) cases.push_back(std::make_unique<Case>(model, names, jacobian));
    for (int round = 0; round < 60; ++round)
      for (auto& one : cases) one->time();
    for (std::size_t k = 0; k < cases.size(); ++k)
      fmt::print("{:<10} {:<22} {:<36} {:8.2f} µs  {:5.2f}\n", model, jacobian ? "residuals and Jacobian" : "residuals",
                 k == 0 ? fmt::format("{} rows", cases[k]->rows()) : fmt::format("{}", fmt::join(extensions[k], ", ")),
                 1e6 * cases[k]->median(), cases[k]->median() / cases[0]->median());
  }
}

}  // namespace
}  // namespace tunica::bench

int main() {
  for (const char* model : {"neo_hooke", "gho", "holzapfel_2015"}) tunica::bench::compare(model);
}
