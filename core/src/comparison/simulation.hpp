// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "assembly/assembly.hpp"
#include "experiment/experiment.hpp"
#include "plugins/catalogue.hpp"

/// The predictions of a model for the tests of an experiment, in the form of the data.
namespace tunica::comparison {

struct SimulationRequest {
  std::string model;                                ///< of the tests that name no layers; empty where every one does
  std::optional<std::filesystem::path> parameters;  ///< a result.json, or {name: value or "value unit"}
  std::string run = {};                             ///< of the result.json; empty = the best-ranked of the model
  double noise = 0;                                 ///< relative
  std::uint64_t seed = 1;
};

/// The model of the request with every test of the experiment, and the values its free parameters take.
struct Subject {
  std::string model;  ///< what results call it
  std::unique_ptr<assembly::Assembly> assembly;
  std::vector<double> free;
  std::string source;  ///< of the values: "run 'gho/lm' of out/result.json"
  std::string origin;  ///< the same with the values: "run 'gho/lm' of out/result.json: mu = 18.7 kPa, …"
  std::vector<std::string> warnings;  ///< values outside the declared ranges
};
Subject subject_of(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                   const SimulationRequest& request);

/// One test, with the column names and units of its data file.
struct SimulatedTable {
  std::string test;
  std::vector<std::string> headers;  ///< "stretch [1]"
  std::vector<std::vector<double>> columns;
  /// A predicted column and the prescribed column that it is drawn over, by their names in the data file.
  struct Curve {
    std::string column, over;
  };
  std::vector<Curve> curves = {};
  std::vector<std::string> prescribed = {};  ///< columns, in the order of the headers
};

/// Every test of the experiment with the model. Parameters that the file does not name keep their fixed or initial
/// value; a name that the model does not have is an error. Noise is drawn per test and channel by name, so that one
/// test's does not depend on which others there are. Throws InputError.
std::vector<SimulatedTable> simulate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                     const SimulationRequest& request);
/// The same of a subject that is there already.
std::vector<SimulatedTable> simulate(const experiment::Experiment& experiment, const plugins::Catalogue& catalogue,
                                     const SimulationRequest& request, const Subject& subject);

/// Writes directory/<test>.csv and returns its path.
std::filesystem::path write_table(const std::filesystem::path& directory, const SimulatedTable& table);

}  // namespace tunica::comparison
