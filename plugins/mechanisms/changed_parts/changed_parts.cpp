// SPDX-License-Identifier: Apache-2.0
// Mechanisms that change parts of the energy: a neo-Hookean matrix that stiffens, or whose chains have an end, and
// fibres that are taken up late.
#include <cmath>
#include <functional>
#include <limits>

#include "tunica/models/decorated_model.hpp"
#include "tunica/models/laws.hpp"
#include "tunica/plugin.hpp"

namespace {

using namespace tunica;

/// (μ/2) x → (μ/2) x v(a x), x = I1 − 3, a the amplitude; v(0) = 1. With y = a x, w(y) = d(y v)/dy:
///   ψ' = (μ/2) w,  ψ'' = (μ/2) a w',  ∂ψ/∂a = (μ/2) x² v',  ∂ψ'/∂a = (μ/2) x w'.
struct Stiffening {
  double (*value)(double y);        ///< v
  double (*value_slope)(double y);  ///< v'
  double (*first)(double y);        ///< w
  double (*first_slope)(double y);  ///< w'
};

/// μ/(2b) [exp(b x) − 1] (Demiray 1972): v = (e^y − 1)/y, w = e^y.
constexpr Stiffening exponential{[](double y) { return laws::Exponential::phi(y); },
                                 [](double y) { return laws::Exponential::phi_prime(y); },
                                 [](double y) { return std::exp(y); }, [](double y) { return std::exp(y); }};

/// −(μ Jm/2) ln(1 − x/Jm) (Gent 1996) with y = x/Jm: v = −ln(1 − y)/y, w = 1/(1 − y); no energy beyond y = 1.
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Stiffening limited{
    [](double y) { return y >= 1               ? infinite
                          : std::abs(y) < 1e-5 ? 1 + y / 2 + y * y / 3
                                               : -std::log1p(-y) / y; },
    [](double y) {
      if (y >= 1) return infinite;
      if (std::abs(y) < 1e-2)
        return 1. / 2 + y * (2. / 3 + y * (3. / 4 + y * (4. / 5 + y * (5. / 6 + y * (6. / 7 + y * 7. / 8)))));
      return (1 / (1 - y) + std::log1p(-y) / y) / y;
    },
    [](double y) { return y >= 1 ? infinite : 1 / (1 - y); },
    [](double y) { return y >= 1 ? infinite : 1 / ((1 - y) * (1 - y)); }};

class StiffenedMatrix final : public ForwardedPart {
 public:
  StiffenedMatrix(std::shared_ptr<const Model> base, const EnergyPart& part, const Stiffening& law)
      : ForwardedPart(std::move(base), part), law_(law) {
    description_.response_parameters.push_back(base_count());
    description_.linear = false;
  }

  void respond(std::span<const double> parameters, const ResponseBatch& batch) const override {
    const std::size_t n = batch.x.size(), old = description_.response_parameters.size() - 1;
    const double amplitude = parameters[base_count()];
    const std::size_t bare_value = batch.value_dp.empty() ? 0 : old * n,
                      bare_first = batch.first_dp.empty() ? 0 : old * n;
    ForwardedPart::respond(
        parameters,
        {batch.x, batch.value, batch.first, {}, batch.value_dp.first(bare_value), batch.first_dp.first(bare_first)});
    double half_modulus = 0;  // ψ' of the linear part, the same at any x
    const double anywhere[] = {1};
    ForwardedPart::respond(parameters, {anywhere, {}, {&half_modulus, 1}, {}, {}, {}});
    for (std::size_t i = 0; i < n; ++i) {
      const double x = batch.x[i], y = amplitude * x;
      if (!batch.value.empty()) batch.value[i] *= law_.value(y);
      if (!batch.first.empty()) batch.first[i] *= law_.first(y);
      if (!batch.second.empty()) batch.second[i] = half_modulus * amplitude * law_.first_slope(y);
      for (std::size_t j = 0; j * n < bare_value; ++j) batch.value_dp[j * n + i] *= law_.value(y);
      for (std::size_t j = 0; j * n < bare_first; ++j) batch.first_dp[j * n + i] *= law_.first(y);
      if (!batch.value_dp.empty()) batch.value_dp[old * n + i] = half_modulus * x * x * law_.value_slope(y);
      if (!batch.first_dp.empty()) batch.first_dp[old * n + i] = half_modulus * x * law_.first_slope(y);
    }
  }

 private:
  const Stiffening& law_;
};

/// Fibres slack until their stretch is λs: M·CM → M·CM/λs².
class RecruitedFibres final : public ForwardedPart {
 public:
  RecruitedFibres(std::shared_ptr<const Model> base, const EnergyPart& part) : ForwardedPart(std::move(base), part) {
    description_.invariant_parameters.push_back(base_count());
  }

  void invariant(std::span<const double> parameters, Invariant& value,
                 std::span<Invariant> derivatives) const override {
    const double s = parameters[base_count()];
    const std::size_t own = derivatives.empty() ? 0 : derivatives.size() - 1;
    ForwardedPart::invariant(parameters, value, derivatives.first(own));
    if (!derivatives.empty()) {
      derivatives[own] = {.fibre = -2 * value.fibre / (s * s * s)};
      for (Invariant& derivative : derivatives.first(own)) derivative.fibre /= s * s;
    }
    value.fibre /= s * s;
  }
};

bool is_neo_hookean(const Model& model, const EnergyPart& part) {
  if (!part.describe().linear || !part.describe().invariant_parameters.empty()) return false;
  std::vector<double> start;
  for (const Parameter& parameter : model.describe().parameters) start.push_back(parameter.initial);
  Invariant x;
  part.invariant(start, x, {});
  return x.i1 == 1 && x.offset == -3 && x.i2 == 0 && x.fibre == 0 && x.normal == 0 && x.across == 0;
}

using Change = std::function<std::unique_ptr<EnergyPart>(const std::shared_ptr<const Model>&, const EnergyPart&)>;

/// A mechanism that changes every part for which `change` returns another; there has to be one.
MechanismFactory changing(MechanismFactory mechanism, const std::string& expected, Change change) {
  mechanism.side = MechanismFactory::Side::positive;
  mechanism.wrap_model = [id = mechanism.id, own = mechanism.parameters, null = mechanism.null, expected,
                          change = std::move(change)](std::unique_ptr<Model> given,
                                                      const Options&) -> std::unique_ptr<Model> {
    const std::shared_ptr<const Model> base(std::move(given));
    if (base->describe().history_size > 0)
      throw InputError(id + ": model '" + base->describe().type +
                       "' has memory, which its parts do not carry; expected a model without memory; take the "
                       "mechanism out or choose another model");
    std::vector<std::unique_ptr<EnergyPart>> parts;
    std::size_t changed = 0;
    for (const auto& part : base->parts()) {
      parts.push_back(change(base, *part));
      changed += parts.back() != nullptr;
      if (!parts.back()) parts.back() = std::make_unique<ForwardedPart>(base, *part);
    }
    if (changed == 0)
      throw InputError(id + ": model '" + base->describe().type + "' has no part that it could change; expected " +
                       expected + "; take the mechanism out or choose another model");
    return std::make_unique<DecoratedModel>(base, own, null, std::move(parts));
  };
  return mechanism;
}

Change stiffened(const Stiffening& law) {
  return [&law](const std::shared_ptr<const Model>& base, const EnergyPart& part) -> std::unique_ptr<EnergyPart> {
    if (!is_neo_hookean(*base, part)) return nullptr;
    return std::make_unique<StiffenedMatrix>(base, part, law);
  };
}

/// Fibres that carry load where their strain is negative, or by their own stretch, are never slack up to λs.
std::unique_ptr<EnergyPart> recruited(const std::shared_ptr<const Model>& base, const EnergyPart& part) {
  if (part.describe().role != EnergyPart::Role::fibre) return nullptr;
  if (part.describe().active != EnergyPart::Active::argument_positive)
    throw InputError("fibre_recruitment: the fibres of model '" + base->describe().type +
                     "' are not slack until they are taken up; expected \"fibre_switch\": \"strain\", by which they "
                     "carry load while their strain is positive");
  return std::make_unique<RecruitedFibres>(base, part);
}

std::vector<MechanismFactory> factories() {
  const std::string matrix = "a neo-Hookean matrix, for example in hgo, gho or neo_hooke";
  return {
      changing({.id = "matrix_stiffening",
                .cause = "The matrix stiffens as it is stretched, instead of keeping its modulus.",
                .stage = tunica::Stage::energy,
                .parameters = {{"b", "1", 0.1, 0, 20, Scale::linear, "How fast the matrix stiffens.", "Demiray 1972"}},
                .null = 0,
                .side = MechanismFactory::Side::positive,
                .plausible_min = 0,
                .plausible_max = 5,
                .look_alikes = {"chain_extensibility", "fibre_dispersion", "axial_fibres"},
                .isolated_by = "a specimen without its collagen, or large stretches of the matrix alone",
                .reference = "Demiray, J. Biomech. 5:309 (1972)"},
               matrix, stiffened(exponential)),
      changing({.id = "chain_extensibility",
                .cause = "The chains of the network come to the end of their length.",
                .stage = tunica::Stage::energy,
                .parameters = {{"inverse_limit", "1", 0.01, 0, 0.3, Scale::linear,
                                "1/Jm: one over the I1 - 3 at which the chains are fully stretched.", "Gent 1996"}},
                .null = 0,
                .side = MechanismFactory::Side::positive,
                .plausible_min = 0,
                .plausible_max = 0.2,
                .look_alikes = {"matrix_stiffening", "fibre_dispersion", "second_invariant"},
                .isolated_by = "stretches near the limit",
                .reference = "Gent, Rubber Chem. Technol. 69:59 (1996)"},
               matrix, stiffened(limited)),
      changing({.id = "fibre_recruitment",
                .cause = "The fibres are crimped: they carry load only from a stretch beyond 1 on.",
                .stage = tunica::Stage::invariants,
                .parameters = {{"stretch", "1", 1.05, 1, 2, Scale::linear, "Stretch at which the fibres are taken up.",
                                "Lanir 1983"}},
                .null = 1,
                .side = MechanismFactory::Side::positive,
                .plausible_min = 1,
                .plausible_max = 1.5,
                .look_alikes = {"fibre_dispersion", "axial_fibres", "matrix_stiffening"},
                .isolated_by = "imaging of the fibres' waviness, or small stretches",
                .reference = "Lanir, J. Biomech. 16:1 (1983)",
                .directional = true},
               "fibres, for example in hgo or gho", recruited)};
}

}  // namespace

TUNICA_PLUGIN("changed_parts", TUNICA_PLUGIN_VERSION) {
  for (auto& mechanism : factories()) registry.add(std::move(mechanism));
}
