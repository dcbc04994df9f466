// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"
#include "search/calibration_problem.hpp"

/// Models, tests and mechanisms small enough to check by hand. A fake model answers S_tt(x) for C_tt = x:
///
///   parabola   S = a + b x + c x²; parameters a (linear, 0 … 10), b (log, 0.1 … 10), c (linear, −5 … 5)
///   bordered   the same with the inequality a − b ≥ −1; jagged: with one that has no derivative
///   valley     S = (2p + q) x + r x², which no data can take apart into p and q; declares 2p + q
///
/// The fake test "curve" predicts y = gain S(x) + tilt x and, if mapped, z = 10 y; tilt is a native imperfection;
/// "costly_curve" says of itself that it is costly; "stack" predicts y = gain Σ thickness S(x) over layers of models.
/// Mechanisms: cubic (energy, S + beta x³), doubling (stress, S·factor), memory (history, without derivatives),
/// offset (test, y + value), scale_error (data, y·(1 + value)), strip_only (test, applies to "strip" alone).
namespace tunica::fakes {

void register_all(plugins::Catalogue::Registration& stage);
plugins::Catalogue catalogue();

/// What the fake test does at a given model parameter a, to provoke failures; thread-safe only if the function is.
using Behaviour = std::function<void(double a, std::span<double> values, Status& status)>;
void set_behaviour(Behaviour behaviour);  ///< {} = none
/// The test that stands in for "costly_curve": "rough_curve", which is a few per cent off, unless told otherwise; empty
/// = none.
void set_stand_in(std::string type);

/// An experiment with one model entry "m" and tests whose data are written to a temporary folder.
class Bench {
 public:
  explicit Bench(std::string model_type = "parabola");
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// Adds a test with rows (x, y); `second` maps z = 10 y too.
  experiment::TestEntry& add_test(const std::string& name, const std::vector<double>& x, const std::vector<double>& y,
                                  bool second = false);
  experiment::ModelEntry& model() { return experiment.models.front(); }
  experiment::ParameterSetting& parameter(const std::string& name);
  [[nodiscard]] assembly::Assembly assemble() const { return {experiment, run, shelf}; }

  experiment::Experiment experiment;
  experiment::RunEntry run;
  plugins::Catalogue shelf = catalogue();

 private:
  std::filesystem::path folder_;
};

std::vector<double> grid(double first, double last, std::size_t count);
std::vector<double> map(const std::vector<double>& x, const std::function<double(double)>& f);

/// The message of the exception that `call` throws; fails the test when it throws none.
std::string message_of(const std::function<void()>& call);

}  // namespace tunica::fakes
