// SPDX-License-Identifier: Apache-2.0
#include "stability/drucker.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "stability/axes_view.hpp"

namespace tunica::stability {
namespace {

struct AtPoint {
  std::array<double, 3> gradient;
  std::array<double, 6> hessian;
};

bool evaluate(const AxesView& view, std::span<const double> parameters, const std::array<double, 3>& stretch,
              AtPoint& at) {
  std::array<double, 3> c;
  for (std::size_t a = 0; a < 3; ++a) c[a] = stretch[a] * stretch[a];
  return view.evaluate_axes({1, c, parameters}, {{}, at.gradient, at.hessian, {}}).ok() &&
         std::all_of(at.gradient.begin(), at.gradient.end(), [](double g) { return std::isfinite(g); }) &&
         std::all_of(at.hessian.begin(), at.hessian.end(), [](double h) { return std::isfinite(h); });
}

}  // namespace

bool is_isotropic(const Model& model, std::span<const double> parameters) {
  const AxesView view(model);
  for (const double x : {1.05, 1.1, 1.2}) {
    AtPoint at, turned;
    if (!evaluate(view, parameters, {x, 1 / std::sqrt(x), 1 / std::sqrt(x)}, at) ||
        !evaluate(view, parameters, {1 / std::sqrt(x), x, 1 / std::sqrt(x)}, turned))
      return false;
    const double scale = std::abs(at.gradient[0]) + std::abs(at.gradient[1]) + 1e-300;
    if (std::abs(at.gradient[0] - turned.gradient[1]) > 1e-9 * scale ||
        std::abs(at.gradient[1] - turned.gradient[0]) > 1e-9 * scale ||
        std::abs(at.gradient[2] - turned.gradient[2]) > 1e-9 * scale ||
        std::abs(at.gradient[1] - at.gradient[2]) > 1e-9 * scale)
      return false;
  }
  return true;
}

std::optional<double> least_drucker(const Model& model, std::span<const double> parameters,
                                    const std::array<double, 3>& stretch) {
  AtPoint at;
  if (!evaluate(AxesView(model), parameters, stretch, at)) return std::nullopt;
  // τ_a = 2 c_a g_a;  ∂²W/∂ε_a∂ε_b = 4 c_a c_b H_ab + 4 c_a g_a δ_ab =: K_ab
  std::array<double, 3> c;
  for (std::size_t a = 0; a < 3; ++a) c[a] = stretch[a] * stretch[a];
  const auto& h = at.hessian;
  const auto K = [&](std::size_t a, std::size_t b, double mixed) {
    return 4 * c[a] * c[b] * mixed + (a == b ? 4 * c[a] * at.gradient[a] : 0);
  };
  const double k11 = K(0, 0, h[0]), k22 = K(1, 1, h[1]), k33 = K(2, 2, h[2]), k12 = K(0, 1, h[3]), k23 = K(1, 2, h[4]),
               k13 = K(0, 2, h[5]);
  if (model.describe().compressible) {
    Eigen::Matrix3d D;
    D << k11, k12, k13, k12, k22, k23, k13, k23, k33;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(D, Eigen::EigenvaluesOnly).eigenvalues()[0];
  }
  // ε3 = −ε1 − ε2:  D_ab = K_ab − K_a3 − K_3b + K_33
  const double d11 = k11 - 2 * k13 + k33, d22 = k22 - 2 * k23 + k33, d12 = k12 - k13 - k23 + k33;
  return 0.5 * (d11 + d22) - std::hypot(0.5 * (d11 - d22), d12);
}

DruckerVerdict judge_drucker(const Model& model, std::span<const double> parameters, const std::vector<Path>& paths) {
  DruckerVerdict verdict;
  verdict.weakest = std::numeric_limits<double>::infinity();
  for (const Path& path : paths) {
    PathReach& followed = verdict.followed.emplace_back(PathReach{path.name});
    for (const Deformation& point : path.points) {
      const std::optional<double> least = least_drucker(model, parameters, point.stretch);
      if (!least) break;
      followed.to = point.along;
      if (*least < verdict.weakest) {
        verdict.weakest = *least;
        if (!verdict.first_lost) verdict.path = path.name;
      }
      if (*least > 0) continue;
      if (!verdict.first_lost || point.along < *verdict.first_lost) {
        verdict.first_lost = point.along;
        verdict.path = path.name;
      }
      break;
    }
  }
  return verdict;
}

}  // namespace tunica::stability
