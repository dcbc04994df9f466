// SPDX-License-Identifier: Apache-2.0
// Fibres scattered about their mean direction (Gasser, Ogden, Holzapfel 2006, doi 10.1098/rsif.2005.0073, eq. 4.4):
// each fibre's own invariant M·CM in the energy becomes κ I1 + (1 − 3κ) M·CM.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "tunica/models/decorated_model.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

Parameter kappa() {
  return {"kappa",
          "1",
          0.1,
          0,
          1. / 3,
          Scale::linear,
          "Fibre dispersion: 0 = perfectly aligned, 1/3 = isotropic.",
          "Gasser, Ogden, Holzapfel 2006, eq. 4.2"};
}

/// A fibre part with fibre (M·CM) → fibre (κ I1 + (1 − 3κ) M·CM).
class Dispersed final : public ForwardedPart {
 public:
  Dispersed(std::shared_ptr<const Model> base, const EnergyPart& part) : ForwardedPart(std::move(base), part) {
    description_.invariant_parameters.push_back(base_count());
  }

  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    const double k = parameters[base_count()];
    const std::size_t own = derivatives.empty() ? 0 : derivatives.size() - 1;
    ForwardedPart::invariant(parameters, value, derivatives.first(own));
    if (!derivatives.empty()) {
      derivatives[own] = {.i1 = value.fibre, .fibre = -3 * value.fibre};
      for (Invariant& derivative : derivatives.first(own)) mix(derivative, k);
    }
    mix(value, k);
  }

 private:
  static void mix(Invariant& v, double k) {
    v.i1 += k * v.fibre;
    v.fibre *= 1 - 3 * k;
  }
};

/// Whether the invariant has other directions than the fibre's in it, at the start or by one of the parameters.
bool is_dispersed(const EnergyPart& part, const ModelDescription& model) {
  std::vector<double> start;
  for (const Parameter& parameter : model.parameters) start.push_back(parameter.initial);
  Invariant value;
  std::vector<Invariant> derivatives(part.describe().invariant_parameters.size());
  part.invariant(start, value, derivatives);
  derivatives.push_back(value);
  for (const Invariant& v : derivatives) {
    if (v.i1 != 0 || v.normal != 0) return true;
  }
  return false;
}

std::vector<std::unique_ptr<EnergyPart>> dispersed(const std::shared_ptr<const Model>& base) {
  const ModelDescription& model = base->describe();
  if (model.history_size > 0)
    throw InputError("fibre_dispersion: model '" + model.type +
                     "' has memory, which its parts do not carry; expected a model without memory; take the mechanism "
                     "out or choose another model");
  std::vector<std::unique_ptr<EnergyPart>> parts;
  std::size_t fibres = 0;
  for (const auto& part : base->parts()) {
    if (part->describe().role != EnergyPart::Role::fibre) {
      parts.push_back(std::make_unique<ForwardedPart>(base, *part));
      continue;
    }
    if (is_dispersed(*part, model)) {
      throw InputError("fibre_dispersion: the fibres of model '" + model.type + "' (part '" + part->describe().name +
                       "') are dispersed already; expected a model with aligned fibres, for example hgo; use the "
                       "model's own dispersion parameters, or take the mechanism out");
    }
    parts.push_back(std::make_unique<Dispersed>(base, *part));
    ++fibres;
  }
  if (fibres == 0) {
    throw InputError("fibre_dispersion: model '" + model.type +
                     "' has no fibre parts to disperse; expected a model with fibres, for example hgo; take the "
                     "mechanism out or choose another model");
  }
  return parts;
}

MechanismFactory factory() {
  MechanismFactory mechanism{
      .id = "fibre_dispersion",
      .cause = "The collagen fibres scatter about their mean direction instead of being perfectly aligned.",
      .stage = tunica::Stage::invariants,
      .parameters = {kappa()},
      .null = 0,
      .side = MechanismFactory::Side::positive,
      .plausible_min = 0,
      .plausible_max = 1. / 3,
      .look_alikes = {"matrix_stiffening", "chain_extensibility", "fibre_recruitment"},
      .isolated_by = "transverse stretch of a strip, or imaging of the fibre directions",
      .reference = "Gasser, Ogden, Holzapfel, J. R. Soc. Interface 3:15 (2006)",
      .directional = true};
  mechanism.wrap_model = [](std::unique_ptr<Model> base, const Options&) -> std::unique_ptr<Model> {
    const std::shared_ptr<const Model> shared(std::move(base));
    return std::make_unique<DecoratedModel>(shared, std::vector<Parameter>{kappa()}, 0, dispersed(shared));
  };
  return mechanism;
}

}  // namespace

TUNICA_PLUGIN("fibre_dispersion", TUNICA_PLUGIN_VERSION) { registry.add(factory()); }
