// SPDX-License-Identifier: Apache-2.0
#include "experiment/fake_catalogue.hpp"

namespace tunica::testing {
namespace {

class FakeModel final : public Model {
 public:
  FakeModel(std::string type, std::vector<Parameter> parameters, bool fibres) : fibres_(fibres) {
    description_.type = std::move(type);
    description_.parameters = std::move(parameters);
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints&, const MaterialResponse&) const override { return Status::failed("a fake"); }
  [[nodiscard]] bool fibres() const { return fibres_; }

 private:
  ModelDescription description_;
  bool fibres_;
};

class FakeOptimizer final : public Optimizer {
 public:
  [[nodiscard]] const Needs& needs() const override { return needs_; }
  Outcome minimise(Problem&) override { return {}; }

 private:
  Needs needs_;
};

const std::vector<Parameter> gho_parameters = {
    {"mu", "kPa", 10, 0.1, 500, Scale::log, "Shear modulus of the matrix", "Gasser et al. 2006"},
    {"kappa", "1", 0.1, 0, 1.0 / 3, Scale::linear, "Dispersion", ""},
    {"k1", "kPa", 20, 0.1, 500, Scale::log, "Fibre stiffness", ""},
    {"k2", "1", 1, 1e-3, 100, Scale::log, "Fibre exponent", ""},
    {"theta", "deg", 45, 0, 90, Scale::linear, "Fibre angle from the axial direction", ""}};

using Role = Observable::Role;
using Kind = Observable::Kind;

void add_models(Registry& registry) {
  const Option fibre_switch{
      "fibre_switch", Option::Kind::choice, "strain", "When fibres act", "", {}, {}, {"strain", "stretch", "none"}};
  registry.add(ModelFactory{"gho", "Dispersed fibres", "", {fibre_switch}, [](const Options&) {
                              return std::make_unique<FakeModel>("gho", gho_parameters, true);
                            }});
  registry.add(ModelFactory{"plain", "No fibres", "", {}, [](const Options&) {
                              return std::make_unique<FakeModel>("plain", std::vector<Parameter>{gho_parameters[0]},
                                                                 false);
                            }});
  const Option terms{"terms", Option::Kind::integer, std::int64_t{2}, "Number of terms", "", 1, 4, {}};
  registry.add(ModelFactory{"series", "As many parameters as terms", "", {terms}, [](const Options& options) {
                              std::vector<Parameter> parameters;
                              for (std::int64_t k = 1; k <= options.integer("terms"); ++k) {
                                parameters.push_back(gho_parameters[0]);
                                parameters.back().name = "c_" + std::to_string(k);
                              }
                              return std::make_unique<FakeModel>("series", std::move(parameters), false);
                            }});
}

void add_tests(Registry& registry) {
  const Option direction{"direction", Option::Kind::choice,        {}, "The loading axis", "", {},
                         {},          {"circumferential", "axial"}};
  const std::vector<Observable> strip = {
      {"stretch", "1", Role::abscissa, true, "stretch along the strip", Kind::stretch},
      {"stress", "kPa", Role::channel, false, "stress along the strip", Kind::stress},
      {"transverse_stretch", "1", Role::channel, false, "stretch across", Kind::stretch},
      {"time", "s", Role::time, false, "time since rest", Kind::plain}};
  registry.add(TestFactory{"uniaxial",
                           "A strip pulled",
                           "",
                           {direction},
                           strip,
                           [](const TestSetup&) { return nullptr; },
                           {{"misalignment", "deg", 0, -15, 15, Scale::linear, "", ""},
                            {"gain", "1", 0, -1, 1, Scale::linear, "", ""},
                            {"p", "kPa", 1, 0, 100, Scale::linear, "", ""}}});
  const std::vector<Option> tube_options = {
      {"inner_radius", Option::Kind::quantity, {}, "Unloaded inner radius", "mm", 1e-3, {}, {}},
      {"thickness", Option::Kind::quantity, {}, "Unloaded wall thickness", "mm", 1e-3, {}, {}},
      {"axial_stretch", Option::Kind::number, 1.0, "Axial stretch held", "", 0.1, 10.0, {}},
      {"remarks", Option::Kind::json, "[]", "What was seen", "", {}, {}, {}}};
  const std::vector<Observable> tube = {
      {"pressure", "kPa", Role::abscissa, true, "inner pressure", Kind::plain},
      {"outer_diameter_stretch", "1", Role::channel, false, "D/D0", Kind::stretch},
      {"axial_force", "mN", Role::channel, false, "reduced axial force", Kind::plain}};
  registry.add(TestFactory{"thick_wall_pressurisation",
                           "A tube inflated",
                           "",
                           tube_options,
                           tube,
                           [](const TestSetup&) { return nullptr; },
                           {{"opening_angle", "deg", 0, -90, 330, Scale::linear, "", ""}},
                           true});
}

void add_optimizers(Registry& registry) {
  const std::vector<Option> es = {
      {"parents", Option::Kind::integer, std::int64_t{15}, "Parents a generation", "", 1.0, 10000.0, {}},
      {"offspring", Option::Kind::integer, std::int64_t{100}, "Children a generation", "", 1.0, {}, {}},
      {"selection", Option::Kind::choice, "plus", "Who survives", "", {}, {}, {"plus", "comma"}},
      {"note", Option::Kind::text, "", "A remark", "", {}, {}, {}}};
  registry.add(OptimizerFactory{
      "es", "Evolution strategy", "", es, [](const Options& options) -> std::unique_ptr<Optimizer> {
        if (options.integer("parents") > options.integer("offspring") && options.text("selection") == "comma")
          throw InputError("comma selection needs more offspring than parents");
        return std::make_unique<FakeOptimizer>();
      }});
  const std::vector<Option> lm = {
      {"starts", Option::Kind::integer, std::int64_t{1}, "Starting points", "", 1.0, {}, {}},
      {"polish", Option::Kind::flag, true, "Refine the best", "", {}, {}, {}}};
  registry.add(OptimizerFactory{"ceres_lm", "Levenberg-Marquardt", "", lm,
                                [](const Options&) { return std::make_unique<FakeOptimizer>(); }, true});
}

MechanismFactory mechanism(std::string id, Stage stage, std::vector<Parameter> parameters,
                           std::vector<std::string> applies_to) {
  MechanismFactory factory{};
  factory.id = std::move(id);
  factory.cause = "Something happens.";
  factory.stage = stage;
  factory.applies_to = std::move(applies_to);
  factory.parameters = std::move(parameters);
  if (stage >= Stage::test)
    factory.wrap_test = [](std::unique_ptr<Test> test, const Options&) { return test; };
  else
    factory.wrap_model = [](std::unique_ptr<Model> model, const Options&) { return model; };
  return factory;
}

void add_mechanisms(Registry& registry) {
  MechanismFactory recruitment = mechanism("fibre_recruitment", Stage::invariants,
                                           {{"stretch", "1", 1.1, 1, 2, Scale::linear, "Recruitment stretch", ""}}, {});
  recruitment.wrap_model = [](std::unique_ptr<Model> model, const Options&) {
    if (!dynamic_cast<FakeModel&>(*model).fibres()) throw InputError("it needs fibres, and this energy has none");
    return model;
  };
  registry.add(recruitment);
  registry.add(mechanism("viscoelasticity", Stage::history,
                         {{"g", "1", 0.1, 0, 5, Scale::linear, "Overstress", ""},
                          {"tau", "s", 10, 0.1, 1e4, Scale::log, "Relaxation time", ""}},
                         {}));
  registry.add(mechanism("force_offset", Stage::test, {{"value", "kPa", 0, -10, 10, Scale::linear, "Offset", ""}},
                         {"uniaxial"}));
  MechanismFactory outliers =
      mechanism("outliers", Stage::data, {{"shift", "1", 0, -1, 1, Scale::linear, "Shift", ""}}, {});
  outliers.options = {{"rows", Option::Kind::text, "", "Rows concerned", "", {}, {}, {}}};
  registry.add(outliers);
}

}  // namespace

const plugins::Catalogue& fake_catalogue() {
  static const plugins::Catalogue catalogue = [] {
    plugins::Catalogue made;
    plugins::Catalogue::Registration stage;
    add_models(stage);
    add_tests(stage);
    add_optimizers(stage);
    add_mechanisms(stage);
    made.commit(std::move(stage), "fake 0.1.0");
    return made;
  }();
  return catalogue;
}

}  // namespace tunica::testing
