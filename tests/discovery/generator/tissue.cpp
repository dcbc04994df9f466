// SPDX-License-Identifier: Apache-2.0
#include "tissue.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>
#include <boost/math/tools/roots.hpp>

namespace blind {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// Moments of the density exp(2b cos²Θ) over the sphere, by Simpson's rule in v = 1 − cos Θ over half of it. The
/// density dies off over v ~ 1/(4b), and so does the rule.
Scatter moments(double b) {
  constexpr int n = 400;
  const double end = std::min(1.0, 10 / b), step = end / n;
  double all = 0, along = 0;
  for (int i = 0; i <= n; ++i) {
    const double u = 1 - i * step, weight = (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * std::exp(2 * b * (u * u - 1));
    all += weight;
    along += weight * u * u;
  }
  const double across = (1 - along / all) / 2;
  return {along / all, across, across};
}

Triple diagonal(const Eigen::Matrix3d& H) { return {H(0, 0), H(1, 1), H(2, 2)}; }

/// Structure tensor of fibres scattered about the in-plane direction at `angle` from the first axis.
Eigen::Matrix3d structure(const Scatter& by, double angle) {
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return Q * Eigen::Vector3d(by.along, by.across, by.normal).asDiagonal() * Q.transpose();
}

double contract(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

Scatter scatter(double kappa) {
  constexpr double as_good_as = 1e-8;  // at either end: the trace tells what no quadrature resolves
  if (kappa <= 0) return {};
  if (kappa < as_good_as) return {1 - 2 * kappa, kappa, kappa};
  if (kappa >= 1. / 3 - as_good_as) return {1. / 3, 1. / 3, 1. / 3};
  const auto miss = [kappa](double log_b) { return std::log(moments(std::exp(log_b)).across / kappa); };
  std::uintmax_t budget = 100;
  const auto [low, high] = boost::math::tools::toms748_solve(miss, std::log(1e-9), std::log(1e9),
                                                             boost::math::tools::eps_tolerance<double>(48), budget);
  return moments(std::exp(0.5 * (low + high)));
}

/// Midpoint rule: the integrands are periodic in Φ, and vanish with all that counts at the ends of Θ.
Scatter scatter_in_and_out(double a, double b) {
  constexpr int n = 2000;
  double in_all = 0, in_along = 0, out_all = 0, out_normal = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = (i + 0.5) * std::numbers::pi / n, elevation = phi - std::numbers::pi / 2;
    const double in = std::exp(a * (std::cos(2 * phi) - 1));
    in_all += in;
    in_along += in * std::cos(phi) * std::cos(phi);
    const double out = std::exp(b * (std::cos(2 * elevation) - 1)) * std::cos(elevation);
    out_all += out;
    out_normal += out * std::sin(elevation) * std::sin(elevation);
  }
  const double along = in_along / in_all, normal = out_normal / out_all;
  return {along * (1 - normal), (1 - along) * (1 - normal), normal};
}

Material::Material(const Tissue& tissue, First first, double turn) : tissue_(tissue) {
  const bool pulled_around = first == First::circumferential;
  const auto from_axial = [&](double angle) { return (pulled_around ? 90 - angle : angle) * degree + turn * degree; };
  around_ = diagonal(structure({}, from_axial(90)));
  along_ = diagonal(structure({}, from_axial(0)));
  if (tissue.base == Base::yeoh || tissue.base == Base::ogden) return;
  const Scatter by = tissue.base == Base::holzapfel_2015
                         ? Scatter{tissue.A + tissue.B, tissue.A, 1 - 2 * tissue.A - tissue.B}
                         : scatter(tissue.kappa);
  const double slack = 1 / (tissue.recruitment * tissue.recruitment);
  const auto add = [&](double angle, double strength, double k1, double k2) {
    Triple h = diagonal(structure(by, from_axial(angle)));
    if (slack != 1) {  // κ I1 + (1 − 3κ) I/λs²: only what belongs to the direction is slack
      const double own = by.along - by.across;
      const Triple aligned = diagonal(structure({}, from_axial(angle)));
      for (std::size_t a = 0; a < 3; ++a) h[a] += own * (slack - 1) * aligned[a];
    }
    families_.push_back({h, k1, k2, strength, tissue.fibre_power});
  };
  if (turn == 0) {
    add(tissue.theta, 2, tissue.k1, tissue.k2);  // the mirrored family has the same diagonal
  } else {
    add(tissue.theta, 1, tissue.k1, tissue.k2);
    add(-tissue.theta, 1, tissue.k1, tissue.k2);
  }
  if (tissue.base == Base::four_fibre) {
    add(0, 1, tissue.axial_k, tissue.axial_k2);
    add(90, 1, tissue.around_k, tissue.around_k2);
    return;
  }
  if (tissue.axial_k != 0) families_.push_back({along_, tissue.axial_k, tissue.axial_k2, 1, 0});
  if (tissue.around_k != 0) families_.push_back({around_, tissue.around_k, tissue.around_k2, 1, 0});
}

/// Yeoh: S = 2 dW/dI1 on every axis. Ogden: W = Σ μ/α (λ1^α + λ2^α + λ3^α − 3), S = μ λ^(α − 2) on each.
Triple Material::matrix(const Triple& c) const {
  const double x = c[0] + c[1] + c[2] - 3;
  if (tissue_.base == Base::ogden) {
    Triple S{};
    for (std::size_t a = 0; a < 3; ++a)
      S[a] = tissue_.mu_1 * std::pow(c[a], tissue_.alpha_1 / 2 - 1) +
             tissue_.mu_2 * std::pow(c[a], tissue_.alpha_2 / 2 - 1);
    return S;
  }
  double twice_matrix =
      tissue_.base == Base::yeoh ? 2 * (tissue_.c10 + x * (2 * tissue_.c20 + 3 * x * tissue_.c30)) : tissue_.mu;
  if (tissue_.stiffening != 0) twice_matrix *= std::exp(tissue_.stiffening * x);
  if (tissue_.inverse_limit != 0) {
    const double left = 1 - tissue_.inverse_limit * x;
    twice_matrix = left > 0 ? twice_matrix / left : std::numeric_limits<double>::quiet_NaN();
  }
  twice_matrix += 4 * tissue_.quadratic_matrix * x;
  return {twice_matrix, twice_matrix, twice_matrix};
}

Triple Material::elastic(const Triple& c) const {
  const double I1 = c[0] + c[1] + c[2];
  Triple S = matrix(c);
  for (const Family& family : families_) {
    const double E = contract(family.h, c) - 1;
    if (E <= 0) continue;
    double slope = 2 * family.strength * family.k * E * std::exp(family.k2 * E * E);
    if (family.power != 0) slope *= std::pow(E, family.power);
    for (std::size_t a = 0; a < 3; ++a) S[a] += slope * family.h[a];
  }
  if (tissue_.second_invariant != 0)
    for (std::size_t a = 0; a < 3; ++a) S[a] += 2 * tissue_.second_invariant * (I1 - c[a]);
  if (tissue_.tone != 0) {
    const double along = contract(around_, c);
    for (std::size_t a = 0; a < 3; ++a) S[a] += tissue_.tone * around_[a] / along;
  }
  if (tissue_.axial_stiffening != 0) {
    const double slope = 4 * tissue_.axial_stiffening * (contract(along_, c) - 1);
    for (std::size_t a = 0; a < 3; ++a) S[a] += slope * along_[a];
  }
  return S;
}

double Material::matrix_energy(const Triple& c) const {
  const double x = c[0] + c[1] + c[2] - 3;
  if (tissue_.base == Base::yeoh) return x * (tissue_.c10 + x * (tissue_.c20 + x * tissue_.c30));
  double W = 0.5 * tissue_.mu * x;
  if (tissue_.base == Base::ogden) {
    W = 0;
    for (const auto& [mu, alpha] : {std::pair(tissue_.mu_1, tissue_.alpha_1), std::pair(tissue_.mu_2, tissue_.alpha_2)})
      for (const double square : c) W += mu / alpha * (std::pow(square, alpha / 2) - 1);
  }
  if (tissue_.stiffening != 0) W = 0.5 * tissue_.mu / tissue_.stiffening * std::expm1(tissue_.stiffening * x);
  if (tissue_.inverse_limit != 0)
    W = -0.5 * tissue_.mu / tissue_.inverse_limit * std::log1p(-tissue_.inverse_limit * x);
  return W;
}

double Material::energy(const Triple& c) const {
  double W = matrix_energy(c);
  for (const Family& family : families_) {
    const double E = contract(family.h, c) - 1;
    if (E > 0) W += family.strength * family.k / (2 * family.k2) * std::expm1(family.k2 * E * E);
  }
  if (tissue_.second_invariant != 0) W += tissue_.second_invariant * (c[0] * c[1] + c[1] * c[2] + c[2] * c[0] - 3);
  if (tissue_.tone != 0) W += 0.5 * tissue_.tone * std::log(contract(around_, c));
  return W;
}

Triple Material::deviator(const Triple& S, const Triple& c) const {
  const double third = contract(S, c) / 3;
  return {S[0] - third / c[0], S[1] - third / c[1], S[2] - third / c[2]};
}

Memory Material::at_rest() const {
  const Triple unit{1, 1, 1};
  return {0, {}, deviator(elastic(unit), unit)};
}

/// Ogden–Roxburgh softening of the stress, then one Maxwell branch, dh/dt = g dS'/dt − h/τ, by an exponential midpoint
/// rule: second order in dt, exact for a jump.
Triple Material::with_memory(const Triple& c, const Memory& old, double dt, Memory* fresh) const {
  Triple S = elastic(c);
  Memory next = old;
  if (tissue_.softening != 0) {
    const double W = energy(c);
    next.highest = std::max(old.highest, W);
    if (next.highest > W) {
      const double eta =
          1 - tissue_.softening * std::erf((next.highest - W) / (tissue_.softening_width * next.highest));
      for (double& value : S) value *= eta;
    }
  }
  if (tissue_.branch != 0) {
    next.driver = deviator(S, c);
    const double half = std::exp(-dt / (2 * tissue_.relaxation));
    for (std::size_t a = 0; a < 3; ++a) {
      next.over[a] = half * (half * old.over[a] + tissue_.branch * (next.driver[a] - old.driver[a]));
      S[a] += next.over[a];
    }
  }
  if (fresh != nullptr) *fresh = next;
  return S;
}

}  // namespace blind
