// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "diagnosis/diagnosis.hpp"
#include "execution/folder.hpp"
#include "support/loaded.hpp"
#include "support/strip.hpp"

namespace tunica::trial {

/// A strip of a wall, measured at these stretches with noise of standard deviation `sd`, which the file states.
struct Strip {
  std::string name = "circumferential";
  std::vector<double> stretch = testing::evenly(1.02, 1.6, 30);
  double sd = 0.3;  ///< kPa
  std::vector<double> time = {};
};

/// A gho wall (set S of Canales et al. 2023, theta in degrees) without tests; mu, k1, k2 are searched for.
nlohmann::json experiment_of_a_wall(const std::string& name, double theta);

/// An experiment on strips of one gho wall (set S of Canales et al. 2023; mu, k1, k2 are searched for, kappa and theta
/// known) in a folder of its own, and data that show what the model does not have.
class Measured {
 public:
  /// Strips along the direction that they are named after: "axial", "axial_2".
  explicit Measured(std::vector<Strip> strips = {{}, {.name = "axial"}});

  /// Writes the data: what the model shows at its initial values after `hide` has put into a copy of the experiment
  /// what shall not be known, what `add` says besides, and seeded noise.
  using Hide = std::function<void(nlohmann::json& experiment)>;
  using Add = std::function<double(const Strip& strip, double stretch)>;
  void measure(std::uint64_t seed, const Hide& hide = {}, const Add& add = {}) const;
  /// Writes `experiment`.
  void save() const { folder.write("experiment.json", experiment.dump(2)); }
  [[nodiscard]] experiment::Experiment read() const;
  /// In this process, after save(); quick, unless said otherwise.
  [[nodiscard]] diagnosis::Diagnosis diagnose(bool quick = true) const;

  nlohmann::json experiment;
  std::vector<Strip> strips;
  Folder folder;

 private:
  void write(const Strip& strip, const std::vector<double>& stress) const;
};

/// The candidate of this id; throws where there is none.
const diagnosis::Candidate& candidate(const diagnosis::Diagnosis& found, const std::string& id);

/// The sentences of its warnings.
std::vector<std::string> warning_texts(const diagnosis::Diagnosis& found);

/// {"type": type, "parameters": {name: {"initial": value}}}, and more keys.
nlohmann::json mechanism(const std::string& type, const std::string& parameter, double value,
                         nlohmann::json more = nlohmann::json::object());

/// With a blank for every line break and what is indented behind it.
std::string in_one_line(const std::string& text);

}  // namespace tunica::trial
