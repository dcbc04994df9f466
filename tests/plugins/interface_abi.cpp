// SPDX-License-Identifier: Apache-2.0
// A library whose one function names every type that crosses the plugin boundary, for abidw to write down.
#include "tunica/energy_part.hpp"
#include "tunica/mechanism.hpp"
#include "tunica/model.hpp"
#include "tunica/optimizer.hpp"
#include "tunica/options.hpp"
#include "tunica/plugin.hpp"
#include "tunica/test.hpp"

namespace tunica {

struct Boundary {
  const PluginHeader* header;
  Registry* registry;
  Model* model;
  Test* test;
  Optimizer* optimizer;
  Problem* problem;
  EnergyPart* part;
  ModelFactory* model_factory;
  TestFactory* test_factory;
  OptimizerFactory* optimizer_factory;
  MechanismFactory* mechanism_factory;
  Options* options;
  Status* status;
};

void across_the_boundary(const Boundary& boundary);
void across_the_boundary(const Boundary&) {}

}  // namespace tunica
