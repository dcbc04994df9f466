// SPDX-License-Identifier: Apache-2.0
#include "stability/ellipticity.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "stability/transverse.hpp"

namespace tunica::stability {
namespace {

constexpr std::size_t points_a_path = 25, direction_count = 300;
constexpr std::array<std::array<std::size_t, 3>, 3> position{
    {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};  // of (I, K) in tt … tr

/// A Fibonacci spiral over the upper half of the sphere, and the axes themselves.
std::vector<Eigen::Vector3d> directions() {
  std::vector<Eigen::Vector3d> found{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t k = 0; k < direction_count; ++k) {
    const double z = (static_cast<double>(k) + 0.5) / direction_count;
    const double r = std::sqrt(1 - z * z), angle = golden * static_cast<double>(k);
    found.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  return found;
}

/// Q(n) at one point; `S` and `tangent` hold its six and thirty-six components.
Eigen::Matrix3d acoustic_tensor(const std::array<double, 3>& F, const std::array<double, 6>& S,
                                const std::array<double, 36>& tangent, const Eigen::Vector3d& n) {
  // With diagonal F and N = Fᵀ n:  Q_ij = δ_ij N·S N + F_i F_j N_K N_L ℂ_iKjL
  const Eigen::Vector3d N(F[0] * n[0], F[1] * n[1], F[2] * n[2]);
  double along = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) along += N[static_cast<int>(a)] * S[position[a][b]] * N[static_cast<int>(b)];
  Eigen::Matrix3d Q = along * Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l)
          Q(static_cast<int>(i), static_cast<int>(j)) += F[i] * F[j] * N[static_cast<int>(k)] * N[static_cast<int>(l)] *
                                                         tangent[6 * position[i][k] + position[j][l]];
  return Q;
}

struct Weakest {
  double value = std::numeric_limits<double>::infinity();  ///< m·Q(n) m, kPa
  Eigen::Vector3d n = Eigen::Vector3d::Zero(), m = Eigen::Vector3d::Zero();
};

/// Over all directions; none where the response is not finite.
std::optional<Weakest> weakest_at(const Model& model, std::span<const double> parameters, const Deformation& at) {
  static const std::vector<Eigen::Vector3d> spread = directions();
  std::array<double, 6> C{}, S;
  std::array<double, 36> tangent;
  for (std::size_t a = 0; a < 3; ++a) C[a] = at.stretch[a] * at.stretch[a];
  if (!model.evaluate({1, C, parameters, {}, {}}, {{}, S, tangent, {}, {}}).ok()) return std::nullopt;
  Weakest found;
  for (const Eigen::Vector3d& n : spread) {
    const Eigen::Matrix3d Q = acoustic_tensor(at.stretch, S, tangent, n);
    const Eigen::Vector3d e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    Eigen::Matrix2d plane;
    plane << e1.dot(Q * e1), e1.dot(Q * e2), e2.dot(Q * e1), e2.dot(Q * e2);
    if (!plane.allFinite()) return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(plane);
    if (eigen.eigenvalues()[0] >= found.value) continue;
    found = {eigen.eigenvalues()[0], n, eigen.eigenvectors()(0, 0) * e1 + eigen.eigenvectors()(1, 0) * e2};
  }
  return found;
}

}  // namespace

std::optional<double> least_wave_stiffness(const Model& model, std::span<const double> parameters,
                                           const std::array<double, 3>& stretches) {
  const std::optional<Weakest> found = weakest_at(model, parameters, {stretches, 0});
  return found ? std::optional(found->value) : std::nullopt;
}

std::vector<Path> homogeneous_paths(const Model& model, std::span<const double> parameters, double limit) {
  std::vector<double> stretches;
  for (std::size_t k = 1; k <= points_a_path; ++k)
    stretches.push_back(std::pow(limit, static_cast<double>(k) / points_a_path));
  std::vector<Path> paths;
  for (const std::size_t axis : {std::size_t{0}, std::size_t{1}}) {
    Path strip{axis == 0 ? "circumferential strip" : "axial strip", {}};
    for (const double stretch : stretches) {  // one by one, so that the path ends where the equilibrium does
      StripState state;
      if (!FreePath(model, axis, {stretch}).states(parameters, {&state, 1}).ok()) break;
      Deformation at{{}, stretch};
      at.stretch[axis] = stretch;
      at.stretch[1 - axis] = state.transverse;
      at.stretch[2] = state.normal;
      strip.points.push_back(at);
    }
    paths.push_back(std::move(strip));
  }
  Path equibiaxial{"equibiaxial extension", {}}, shear_t{"pure shear, circumferential", {}},
      shear_z{"pure shear, axial", {}};
  for (const double x : stretches) {
    equibiaxial.points.push_back({{x, x, 1 / (x * x)}, x});
    shear_t.points.push_back({{x, 1, 1 / x}, x});
    shear_z.points.push_back({{1, x, 1 / x}, x});
  }
  for (Path* path : {&equibiaxial, &shear_t, &shear_z}) paths.push_back(std::move(*path));
  return paths;
}

EllipticityVerdict judge_ellipticity(const Model& model, std::span<const double> parameters,
                                     const std::vector<Path>& paths) {
  EllipticityVerdict verdict;
  verdict.weakest = std::numeric_limits<double>::infinity();
  for (const Path& path : paths) {
    PathReach& followed = verdict.followed.emplace_back(PathReach{path.name});
    for (const Deformation& at : path.points) {
      const std::optional<Weakest> here = weakest_at(model, parameters, at);
      if (!here) break;
      followed.to = at.along;
      const bool lost = here->value <= 0 && (!verdict.first_lost || at.along < *verdict.first_lost);
      if (lost || (!verdict.first_lost && here->value < verdict.weakest)) {
        verdict.path = path.name;
        for (int a = 0; a < 3; ++a) {
          verdict.n[static_cast<std::size_t>(a)] = here->n[a];
          verdict.m[static_cast<std::size_t>(a)] = here->m[a];
        }
      }
      if (lost) verdict.first_lost = at.along;
      verdict.weakest = std::min(verdict.weakest, here->value);
      if (here->value <= 0) break;
    }
  }
  return verdict;
}

}  // namespace tunica::stability
