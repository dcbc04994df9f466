// SPDX-License-Identifier: Apache-2.0
// Writes the schema composed from the fake catalogue, for the independent validator in check_schemas.py.
#include <fstream>
#include <iostream>

#include "experiment/design_example.hpp"
#include "experiment/experiment.hpp"
#include "experiment/fake_catalogue.hpp"

int main(int count, char** arguments) {
  if (count != 3) return std::cerr << "usage: print_schema SCHEMA EXAMPLE\n", 2;
  std::ofstream(arguments[1]) << tunica::experiment::compose_schema(tunica::testing::fake_catalogue());
  std::ofstream(arguments[2]) << tunica::testing::design_example;
  return 0;
}
