// SPDX-License-Identifier: Apache-2.0
// A rubber and a search that are in order with the default of their option, and with no other word.
#include <random>

#include "right.hpp"

namespace {

using namespace tunica;

class Rubber final : public wrong::Right {
 public:
  Rubber(const std::string& type, bool halved) : Right(type), halved_(halved) {}
  Status evaluate(const MaterialPoints& points, const MaterialResponse& response) const override {
    Status status = Right::evaluate(points, response);
    if (halved_)
      for (double& energy : response.energy) energy *= 0.5;
    return status;
  }

 private:
  bool halved_;
};

/// Points at random.
class Darts final : public Optimizer {
 public:
  explicit Darts(bool seeded) : seeded_(seeded) { needs_.random = true; }
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem& problem) override {
    static std::uint64_t searches = 0;
    std::mt19937_64 engine(problem.seed("darts") + (seeded_ ? 0 : searches++));
    std::vector<double> x(problem.dimension());
    double value = 0;
    for (std::uint64_t failed = 0; !problem.should_stop() && failed < 1000;) {
      for (double& one : x) one = std::uniform_real_distribution<double>()(engine);
      failed = problem.evaluate(x, value).kind() == Status::Kind::failed ? failed + 1 : 0;
      if (x.empty()) return {true, "nothing is free"};
    }
    return {false, "stopped"};
  }

 private:
  Needs needs_;
  bool seeded_;
};

}  // namespace

TUNICA_PLUGIN("wrong_choices", "0.1.0") {
  registry.add(ModelFactory{"wrong_choice",
                            "Rubber with half its energy, if it is asked for.",
                            "",
                            {Option::choice("energy", {"whole", "half"}, "whole", "How much of it there is.")},
                            [](const Options& options) {
                              return std::make_unique<Rubber>("wrong_choice", options.text("energy") == "half");
                            }});
  registry.add(OptimizerFactory{
      "darts",
      "Points at random.",
      "",
      {Option::choice("seed", {"given", "own"}, "given", "Where chance comes from.")},
      [](const Options& options) { return std::make_unique<Darts>(options.text("seed") == "given"); }});
}
