// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "data/dataset.hpp"
#include "data/signal.hpp"

/// The interpretation of an experiment's data, before any fit.
namespace tunica::report {

struct TestData {
  std::string name;
  std::string words;  ///< "uniaxial; stretch 1 → 1.3, 126 rows; starts at rest"
  std::vector<data::Signal> signals;
  data::Dataset dataset;
  std::vector<std::pair<std::string, std::string>> units;  ///< observable → base unit
};

/// The document: for each test the signal of each file with the rows that are used, and the curves that result.
std::string data_page(const std::string& title, const std::vector<TestData>& tests);

}  // namespace tunica::report
