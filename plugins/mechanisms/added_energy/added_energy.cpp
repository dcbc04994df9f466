// SPDX-License-Identifier: Apache-2.0
// Mechanisms that add a part to the energy, W + ψ(x; amplitude, …): a family of fibres along an axis, a second
// invariant in the matrix, the tone of the smooth muscle.
#include <functional>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/decorated_model.hpp"
#include "tunica/models/model_sum.hpp"
#include "tunica/models/rubber_laws.hpp"

namespace {

using namespace tunica;

/// ψ = (T/2) ln(1 + x) = T ln λt with x = C_tt − 1: a circumferential Cauchy stress T.
struct Tone {
  static constexpr std::size_t parameter_count = 1;

  template <class T>
  static T energy(const T& x, std::span<const T> p) {
    using std::log;
    return 0.5 * p[0] * log(1.0 + x);
  }
};

using MakePart = std::function<std::unique_ptr<EnergyPart>()>;

MechanismFactory adding(MechanismFactory mechanism, MakePart make) {
  mechanism.stage = tunica::Stage::energy;
  mechanism.side = MechanismFactory::Side::positive;
  mechanism.null = 0;
  // What a refit of gho to two strips leaves of the fibres' effect: any other k2 has a shape that correlates with one
  // of these by 0.75 or more.
  if (mechanism.parameters.size() > 1) mechanism.scan = {{{"k2", 0.01}}, {{"k2", 0.3}}, {{"k2", 1}}, {{"k2", 10}}};
  mechanism.wrap_model = [parameters = mechanism.parameters, make = std::move(make)](
                             std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    const std::shared_ptr<const Model> shared(std::move(base));
    if (shared->parts().empty() || shared->describe().history_size > 0)
      return std::make_unique<ModelSum>(
          shared, parameters, 0,
          std::make_unique<Hyperelastic>(ModelDescription{.parameters = parameters}, energy_parts(make())));
    EnergyParts parts;
    for (const auto& part : shared->parts()) parts.push_back(std::make_unique<ForwardedPart>(shared, *part));
    parts.push_back(std::make_unique<AddedPart>(shared->describe().parameters.size(), make()));
    return std::make_unique<DecoratedModel>(shared, parameters, 0, std::move(parts));
  };
  return mechanism;
}

std::vector<Parameter> family(const std::string& axis) {
  const char* const source = "Baek, Gleason, Rajagopal, Humphrey 2007";
  return {{"k", "kPa", 1, 0, 100, Scale::linear, "Stiffness of the " + axis + " fibres.", source},
          {"k2", "1", 1, 0.001, 100, Scale::log, "How fast the " + axis + " fibres stiffen.", source}};
}

/// Fibres carry load while stretched: λ > 1 along the axis.
template <int degrees>
std::unique_ptr<EnergyPart> fibres(const std::string& name) {
  return std::make_unique<LawPart<laws::Exponential, arterial::FixedFibres<degrees>, 2>>(EnergyPart::Description{
      name, EnergyPart::Role::fibre, EnergyPart::Active::argument_positive, false, {}, {0, 1}, false});
}

/// It acts along an axis of the material.
MechanismFactory directional(MechanismFactory mechanism) {
  mechanism.directional = true;
  return mechanism;
}

/// Plausible effects. What fibres or a second invariant add, a softer rest makes up for in part, so by themselves they
/// may do more than is measured. The tone of a muscle does not exceed the largest stress.
constexpr double of_fibres = 2, of_tone = 1;

std::vector<MechanismFactory> factories() {
  const auto stated = [](std::string id, std::string cause, std::vector<Parameter> parameters, double plausible_max,
                         double plausible_effect, std::vector<std::string> look_alikes, std::string isolated_by,
                         std::string reference) -> MechanismFactory {
    return {.id = std::move(id),
            .cause = std::move(cause),
            .parameters = std::move(parameters),
            .plausible_max = plausible_max,
            .plausible_effect = plausible_effect,
            .look_alikes = std::move(look_alikes),
            .isolated_by = std::move(isolated_by),
            .reference = std::move(reference)};
  };
  const std::string four = "Baek, Gleason, Rajagopal, Humphrey, Comput. Methods Appl. Mech. Eng. 196:3070 (2007)";
  return {directional(adding(
              stated("axial_fibres", "A family of fibres runs along the axis, beside the diagonal ones.",
                     family("axial"), 50, of_fibres, {"fibre_dispersion", "matrix_stiffening", "axial_force_offset"},
                     "an axial strip beside a circumferential one, or imaging of the fibre directions", four),
              [] { return fibres<0>("axial_fibres"); })),
          directional(
              adding(stated("circumferential_fibres",
                            "A family of fibres runs around the circumference, beside the diagonal ones.",
                            family("circumferential"), 50, of_fibres,
                            {"specimen_misalignment", "force_scale_error", "fibre_dispersion"},
                            "a circumferential strip beside an axial one, or imaging of the fibre directions", four),
                     [] { return fibres<90>("circumferential_fibres"); })),
          adding(stated("second_invariant", "The matrix resists the stretching of areas, not only of lengths.",
                        {{"c2", "kPa", 1, 0, 100, Scale::linear, "Stiffness in the second invariant.", "Mooney 1940"}},
                        50, of_fibres, {"circumferential_fibres", "matrix_stiffening", "chain_extensibility"},
                        "equibiaxial beside uniaxial extension", "Mooney, J. Appl. Phys. 11:582 (1940)"),
                 [] {
                   return isotropic::part<laws::Proportional, isotropic::SecondInvariant, 1>("second_invariant", {0});
                 }),
          directional(
              adding(stated("active_tone", "The smooth muscle was not fully relaxed: it adds a circumferential stress.",
                            {{"tone", "kPa", 1, 0, 200, Scale::linear, "Circumferential Cauchy stress of the muscle.",
                              "Rachev, Hayashi 1999"}},
                            100, of_tone, {"force_offset", "circumferential_fibres", "axial_force_offset"},
                            "the same test in a relaxing bath", "Rachev, Hayashi, Ann. Biomed. Eng. 27:459 (1999)"),
                     [] {
                       return std::make_unique<LawPart<Tone, arterial::FixedFibres<90>, 1>>(EnergyPart::Description{
                           "active_tone", EnergyPart::Role::fibre, EnergyPart::Active::always, false, {}, {0}, false});
                     }))};
}

}  // namespace

TUNICA_PLUGIN("added_energy", TUNICA_PLUGIN_VERSION) {
  for (auto& mechanism : factories()) registry.add(std::move(mechanism));
}
