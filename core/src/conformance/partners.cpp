// SPDX-License-Identifier: Apache-2.0
#include "conformance/partners.hpp"

#include <algorithm>

#include "tunica/models/arterial_fibres.hpp"
#include "tunica/models/convex_laws.hpp"
#include "tunica/models/volume_energy.hpp"

namespace tunica::conformance {
namespace {

enum { mu, k1, k2, theta, k_across, parameter_count };

/// M·C e_r, which shear across the wall alone makes.
struct Across {
  template <class T>
  static InvariantOf<T> invariant(std::span<const T> p) {
    return {.across = T(1), .angle = p[theta] * degree};
  }
};

/// W = μ/2 (I1 − 3) − μ ln J + μ (ln J)², a compressible neo-Hookean rubber (Simo, Pister 1984).
class CompressibleRubber final : public Model {
 public:
  CompressibleRubber() {
    description_.type = "compressible rubber";
    description_.parameters = {arterial::mu()};
    description_.compressible = true;
  }
  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    const double stiffness = points.parameters[0];
    for (const auto& values : {out.energy, out.stress, out.tangent, out.stress_dp})
      std::fill(values.begin(), values.end(), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      VolumeEnergy::Tensor C;
      for (std::size_t c = 0; c < 6; ++c) C[c] = points.C[c * n + i];
      const VolumeEnergy volume(C);
      const double theta = volume.log_volume();
      if (!out.energy.empty()) out.energy[i] = stiffness * (0.5 * (C[0] + C[1] + C[2] - 3));
      for (std::size_t c = 0; c < 3 && !out.stress.empty(); ++c) out.stress[c * n + i] = stiffness;
      for (std::size_t c = 0; c < 3 && !out.stress_dp.empty(); ++c) out.stress_dp[c * n + i] = 1;
      volume.add(stiffness * (theta * theta - theta), stiffness * (2 * theta - 1), 2 * stiffness, out, n, i);
      volume.add_parameter(0, 2 * theta - 1, out, n, i);
    }
    return {};
  }

 private:
  ModelDescription description_;
};

std::unique_ptr<Model> with_fibres(const std::string& fibre_switch) {
  ModelDescription description;
  description.type = "fibrous";
  description.parameters = {arterial::mu(), arterial::k1(), arterial::k2(), arterial::theta()};
  description.parameters.push_back({"k_across", "kPa", 15, 1, 100, Scale::log, "Coupling of fibres and normal.", ""});
  Options options;
  options.set("fibre_switch", fibre_switch);
  using Diagonal = arterial::AlignedFibres<theta>;
  return std::make_unique<Hyperelastic>(
      std::move(description),
      energy_parts(
          isotropic::neo_hookean<parameter_count>(mu),
          arterial::fibres<Diagonal, parameter_count>({theta}, {k1, k2}, options),
          std::make_unique<LawPart<laws::Quadratic, Across, parameter_count>>(EnergyPart::Description{
              "coupling", EnergyPart::Role::matrix, EnergyPart::Active::always, true, {theta}, {k_across}, false})));
}

}  // namespace

std::unique_ptr<Model> rubber() {
  ModelDescription description;
  description.type = "rubber";
  description.parameters = {arterial::mu()};
  return std::make_unique<Hyperelastic>(std::move(description), energy_parts(isotropic::neo_hookean<1>(mu)));
}
std::unique_ptr<Model> fibrous() { return with_fibres("none"); }
std::unique_ptr<Model> slack_fibrous() { return with_fibres("strain"); }

std::unique_ptr<Model> compressible_rubber() { return std::make_unique<CompressibleRubber>(); }

std::vector<Material> materials() {
  const std::vector<double> wall{30, 20, 0.6, 42, 15};
  return {{"a neo-Hookean matrix with fibres", fibrous(), wall},
          {"a neo-Hookean matrix with fibres that only pull", slack_fibrous(), wall},
          {"a neo-Hookean rubber", rubber(), {60}}};
}

Options plausible_options(const std::vector<Option>& declared) {
  Options options;
  for (const Option& option : declared) {
    if (option.fallback)
      options.set(option.name, *option.fallback);
    else if (option.kind == Option::Kind::choice && !option.choices.empty())
      options.set(option.name, option.choices.front());
    else if (option.kind == Option::Kind::number || option.kind == Option::Kind::quantity)
      options.set(option.name, std::clamp(1.0, option.min.value_or(1.0),
                                          std::max(option.min.value_or(1.0), option.max.value_or(1.0))));
    else if (option.kind == Option::Kind::integer)
      options.set(option.name, static_cast<std::int64_t>(option.min.value_or(1.0)));
    else if (option.kind == Option::Kind::flag)
      options.set(option.name, false);
    else if (option.kind == Option::Kind::json)
      options.set(option.name, std::string("null"));
    else
      options.set(option.name, std::string());
  }
  return options;
}

std::vector<double> initial_values(const std::vector<Parameter>& parameters) {
  std::vector<double> values;
  for (const Parameter& parameter : parameters) values.push_back(parameter.initial);
  return values;
}

}  // namespace tunica::conformance
