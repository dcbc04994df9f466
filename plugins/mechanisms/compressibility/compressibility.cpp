// SPDX-License-Identifier: Apache-2.0
// The volume of a material that the base takes for incompressible changes: with C̄ = J^(−2/3) C and c the
// compressibility 1/κ,
//
//   isochoric  W = W₀(C̄) + u(J)/c,   full  W = W₀(C) − a ln J + u(J)/c,   a = S₀(1), so that nothing is stressed at
//   rest
//
//   S = J^(−2/3) Dev S̄ + u_θ/c C⁻¹,  Dev X = X − ⅓ (X : C) C⁻¹   (Flory 1961; Holzapfel 2000, Nonlinear Solid
//   Mechanics, §6.4; the laws u in Doll, Schweizerhof, J. Appl. Mech. 67:17, 2000)
//
// At c = 0 the base answers alone. Derivatives there are those at a bulk modulus of 10⁸ times the stiffness at rest.
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "tunica/models/isochoric.hpp"
#include "tunica/plugin.hpp"

namespace tunica::compressibility {
namespace {

using Tensor = VolumeEnergy::Tensor;
constexpr double stiffest = 1e8;
constexpr double least = 1e-12;  ///< 1/kPa

/// u with u_θ and u_θθ at θ = ln J; u_θθ = 1 at rest, so κ is the bulk modulus there.
struct VolumeLaw {
  double u, by_theta, by_theta_twice;
};
VolumeLaw volume_law(const std::string& name, double theta) {
  const double J = std::exp(theta);
  if (name == "logarithmic") return {0.5 * theta * theta, theta, 1};
  if (name == "simo") return {0.25 * (std::expm1(2 * theta) - 2 * theta), 0.5 * std::expm1(2 * theta), J * J};
  if (name == "ogden") {
    const double fall = std::expm1(-9 * theta);
    return {(9 * theta + fall) / 81, -fall / 9, fall + 1};
  }
  const double less = std::expm1(theta);
  return {0.5 * less * less, J * less, J * (2 * J - 1)};
}

class CompressibleModel final : public Model {
 public:
  CompressibleModel(std::unique_ptr<Model> base, const std::vector<Parameter>& own, std::string law, bool isochoric)
      : base_(std::move(base)),
        description_(base_->describe()),
        count_(description_.parameters.size()),
        law_(std::move(law)),
        isochoric_(isochoric) {
    description_.parameters.insert(description_.parameters.end(), own.begin(), own.end());
    description_.compressible = true;
    description_.principal_axes = false;
    description_.energy_derivatives = false;
  }

  [[nodiscard]] const ModelDescription& describe() const override { return description_; }
  [[nodiscard]] bool keeps_volume(std::span<const double> parameters) const override { return parameters[count_] == 0; }
  [[nodiscard]] const Model& incompressible() const override { return *base_; }

  Status evaluate(const MaterialPoints& points, const MaterialResponse& out) const override {
    const std::size_t n = points.count;
    const std::span<const double> of_base = points.parameters.first(count_);
    Scratch& s = scratch();
    s.at_rest_dp.resize(out.stress_dp.empty() ? 0 : 6 * count_);
    double at_rest = 0, c = points.parameters[count_];
    if (Status status = rest(of_base, at_rest, c, s.at_rest_dp); !status.ok()) return status;

    s.volumes.clear();
    s.C.assign(points.C.begin(), points.C.end());
    for (std::size_t i = 0; i < n; ++i) {
      Tensor at;
      for (std::size_t k = 0; k < 6; ++k) at[k] = points.C[k * n + i];
      s.volumes.emplace_back(at);
      const double scale = isochoric_ ? isochoric_factor(s.volumes[i]) : 1;
      for (std::size_t k = 0; k < 6; ++k) s.C[k * n + i] *= scale;
    }
    s.stress.resize(6 * n);
    MaterialResponse base = out;
    base.stress = s.stress;
    base.stress_dp = out.stress_dp.first(out.stress_dp.empty() ? 0 : 6 * count_ * n);
    if (Status status = base_->evaluate({n, s.C, of_base, {}, {}}, base); !status.ok()) return status;
    if (!out.stress_dp.empty()) std::fill(out.stress_dp.begin() + 6 * count_ * n, out.stress_dp.end(), 0.0);
    if (isochoric_)
      for (std::size_t i = 0; i < n; ++i) make_isochoric(points, s.volumes[i], base, n, i);
    if (!out.stress.empty()) std::copy(s.stress.begin(), s.stress.end(), out.stress.begin());
    for (std::size_t i = 0; i < n; ++i) {
      const double theta = s.volumes[i].log_volume();
      const VolumeLaw law = volume_law(law_, theta);
      const double a = isochoric_ ? 0 : at_rest;
      s.volumes[i].add(law.u / c - a * theta, law.by_theta / c - a, law.by_theta_twice / c, out, n, i);
      for (std::size_t j = 0; j < count_ && !isochoric_ && !out.stress_dp.empty(); ++j)
        s.volumes[i].add_parameter(j, -s.at_rest_dp[6 * j + 2], out, n, i);
      s.volumes[i].add_parameter(count_, -law.by_theta / (c * c), out, n, i);
    }
    return {};
  }

 private:
  /// Of one thread: predictions call with one point, thousands of times.
  struct Scratch {
    std::vector<VolumeEnergy> volumes;
    std::vector<double> C, stress, at_rest_dp;
  };
  static Scratch& scratch() {
    thread_local Scratch instance;
    return instance;
  }

  /// The pressure of the base at rest where invariants are full, and the least compressibility in place of none.
  Status rest(std::span<const double> parameters, double& stress_at_rest, double& compliance,
              std::span<double> stress_dp) const {
    const bool none = compliance == 0;
    compliance = std::max(compliance, least);
    if (isochoric_ && !none) return {};
    const std::array<double, 6> identity{1, 1, 1, 0, 0, 0};
    std::array<double, 6> S{};
    std::array<double, 36> A{};
    const Status status =
        base_->evaluate({1, identity, parameters, {}, {}}, {{}, S, {A.data(), none ? A.size() : 0}, stress_dp, {}});
    stress_at_rest = S[2];
    if (!none) return status;
    double stiffness = 0;
    for (const double entry : S) stiffness = std::max(stiffness, std::abs(entry));
    for (const double entry : A) stiffness = std::max(stiffness, std::abs(entry));
    compliance = 1 / (stiffest * (stiffness > 0 ? stiffness : 1));
    return status;
  }

  std::unique_ptr<Model> base_;
  ModelDescription description_;
  std::size_t count_;
  std::string law_;
  bool isochoric_;
};

MechanismFactory factory() {
  const std::vector<Parameter> own{{"compliance", "1/kPa", 1e-3, 0, 10, Scale::linear,
                                    "Compressibility 1/K, K the modulus of \"law\" (the bulk modulus where invariants "
                                    "are isochoric); 0 = incompressible.",
                                    "Flory 1961"}};
  MechanismFactory mechanism;
  mechanism.id = "compressibility";
  mechanism.cause = "The material changes its volume under load, as foams and porous tissues do.";
  mechanism.stage = Stage::stress;
  mechanism.parameters = own;
  mechanism.null = 0;
  mechanism.side = MechanismFactory::Side::positive;
  mechanism.plausible_max = 10;
  // The bulk modulus of a foam is a fraction of its shear modulus, so the linearised effect far exceeds the measured
  // one.
  mechanism.plausible_effect = 20;
  mechanism.look_alikes = {"force_scale_error", "force_offset"};
  mechanism.isolated_by = "confined compression beside free compression, or the volume measured in the same test";
  mechanism.reference = "Flory, Trans. Faraday Soc. 57:829 (1961)";
  // The defaults are those that take most of a foam's misfit. Programs of finite elements have the isochoric form.
  mechanism.options = {
      Option::choice("invariants", {"full", "isochoric"}, "full",
                     "Whether the base sees all of the strain (full) or the strain at constant volume (isochoric)."),
      Option::choice(
          "law", {"logarithmic", "quadratic", "simo", "ogden"}, "logarithmic",
          "Energy of the volume ratio J: K/2 (ln J)^2, K/2 (J-1)^2, K/4 (J^2-1-2 ln J), or Ogden's with beta = 9.")};
  mechanism.card_volume = [](const Options& options, std::span<const double> p) -> CardVolume {
    if (options.text("invariants") != "isochoric")
      throw InputError(
          "the mechanism 'compressibility' has full invariants, and the cards' materials have isochoric ones; fit it "
          "with \"invariants\": \"isochoric\" and the \"law\" of the program: \"logarithmic\" for FEBio, else "
          "\"quadratic\"");
    return {options.text("law"), p[0] > 0 ? 1 / p[0] : 0};
  };
  mechanism.wrap_model = [own](std::unique_ptr<Model> base, const Options& options) -> std::unique_ptr<Model> {
    const ModelDescription& model = base->describe();
    if (model.compressible)
      throw InputError("compressibility: the model '" + model.type + "' changes its volume by itself; take it out");
    if (model.history_size > 0)
      throw InputError("compressibility: the model '" + model.type + "' has memory; take one of the two out");
    return std::make_unique<CompressibleModel>(std::move(base), own, options.text("law"),
                                               options.text("invariants") == "isochoric");
  };
  return mechanism;
}

}  // namespace
}  // namespace tunica::compressibility

TUNICA_PLUGIN("compressibility", TUNICA_PLUGIN_VERSION) { registry.add(tunica::compressibility::factory()); }
