// SPDX-License-Identifier: Apache-2.0
#include "stability/ellipticity.hpp"

#include <algorithm>
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

/// Directions n with an orthonormal frame e1, e2 of the plane normal to each: a Fibonacci spiral over the upper half of
/// the sphere, and the axes themselves. Rows of the tables hold the products of their components that belong to tt …
/// tr.
struct Directions {
  using Table = Eigen::Matrix<double, Eigen::Dynamic, 6>;
  std::vector<std::array<Eigen::Vector3d, 3>> frames;  ///< n, e1, e2
  Table normal, first, second;                         ///< n ⊗ n, e1 ⊗ n, e2 ⊗ n
};

/// a ⊗ b in such a row, so that it times the components of a symmetric tensor is their contraction.
Eigen::Matrix<double, 1, 6> row_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix<double, 1, 6> row = Eigen::Matrix<double, 1, 6>::Zero();
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      row[static_cast<int>(position[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)])] += a[i] * b[k];
  return row;
}

Directions spread_directions() {
  std::vector<Eigen::Vector3d> normals{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t k = 0; k < direction_count; ++k) {
    const double z = (static_cast<double>(k) + 0.5) / direction_count;
    const double r = std::sqrt(1 - z * z), angle = golden * static_cast<double>(k);
    normals.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
  }
  Directions found;
  const auto count = static_cast<Eigen::Index>(normals.size());
  for (Directions::Table* table : {&found.normal, &found.first, &found.second}) table->resize(count, 6);
  for (const Eigen::Vector3d& n : normals) {
    const auto row = static_cast<Eigen::Index>(found.frames.size());
    const Eigen::Vector3d e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    found.frames.push_back({n, e1, e2});
    found.normal.row(row) = row_of(n, n);
    found.first.row(row) = row_of(e1, n);
    found.second.row(row) = row_of(e2, n);
  }
  return found;
}

struct Weakest {
  double value = std::numeric_limits<double>::infinity();  ///< m·Q(n) m, kPa
  Eigen::Vector3d n = Eigen::Vector3d::Zero(), m = Eigen::Vector3d::Zero();
};

/// Stress F S Fᵀ and stiffness 2 ∂S/∂C, pushed forward by a diagonal F; none where the model has no answer.
struct Forward {
  Eigen::Matrix<double, 6, 1> stress;
  Eigen::Matrix<double, 6, 6> stiffness;
};

std::optional<Forward> pushed_forward(const Model& model, std::span<const double> parameters, const Deformation& at) {
  std::array<double, 6> C{}, S;
  std::array<double, 36> tangent;
  const auto& F = at.stretch;
  for (std::size_t a = 0; a < 3; ++a) C[a] = F[a] * F[a];
  if (!model.evaluate({1, C, parameters, {}, {}}, {{}, S, tangent, {}, {}}).ok()) return std::nullopt;
  // Pushed forward by the diagonal F:  σ_ik = F_i F_k S_IK,  c_ikjl = F_i F_k F_j F_l ℂ_IKJL
  std::array<double, 6> forward;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = i; k < 3; ++k) forward[position[i][k]] = F[i] * F[k];
  Forward found;
  for (std::size_t p = 0; p < 6; ++p) {
    found.stress[static_cast<int>(p)] = forward[p] * S[p];
    for (std::size_t q = 0; q < 6; ++q)
      found.stiffness(static_cast<int>(p), static_cast<int>(q)) = forward[p] * forward[q] * tangent[6 * p + q];
  }
  return found;
}

const Directions& all_directions() {
  static const Directions spread = spread_directions();
  return spread;
}

/// Over m normal to n, for all directions n; none where the response is not finite.
std::optional<Weakest> weakest_in_planes(const Forward& at) {
  const Directions& spread = all_directions();
  const auto& [stress, stiffness] = at;
  // In the plane normal to n, e_a·Q(n) e_b = (n·σ n) δ_ab + (e_a ⊗ n) : c : (e_b ⊗ n).
  const Directions::Table first = spread.first * stiffness, second = spread.second * stiffness;
  const Eigen::ArrayXd along = spread.normal * stress;
  const Eigen::ArrayXd aa = along + first.cwiseProduct(spread.first).rowwise().sum().array();
  const Eigen::ArrayXd ab = first.cwiseProduct(spread.second).rowwise().sum();
  const Eigen::ArrayXd bb = along + second.cwiseProduct(spread.second).rowwise().sum().array();
  const Eigen::ArrayXd least = 0.5 * (aa + bb) - (0.25 * (aa - bb).square() + ab.square()).sqrt();
  if (!least.allFinite()) return std::nullopt;
  // Of directions that are alike the first one.
  const double alike = 1e-12 * (aa.abs() + bb.abs()).maxCoeff();
  const double lowest = least.minCoeff();
  const auto weakest = static_cast<Eigen::Index>(
      std::find_if(least.begin(), least.end(), [&](double value) { return value <= lowest + alike; }) - least.begin());
  Eigen::Matrix2d plane;
  plane << aa[weakest], ab[weakest], ab[weakest], bb[weakest];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(plane);
  const auto& [n, e1, e2] = spread.frames[static_cast<std::size_t>(weakest)];
  return Weakest{least[weakest], n, eigen.eigenvectors()(0, 0) * e1 + eigen.eigenvectors()(1, 0) * e2};
}

/// Over all m: the least eigenvalue of Q(n), Q_ij = (n·σ n) δ_ij + (e_i ⊗ n) : c : (e_j ⊗ n).
Weakest weakest_along(const Forward& at, const Eigen::Vector3d& n) {
  Eigen::Matrix<double, 3, 6> rows;
  for (int i = 0; i < 3; ++i) rows.row(i) = row_of(Eigen::Vector3d::Unit(i), n);
  Eigen::Matrix3d Q = rows * at.stiffness * rows.transpose();
  Q.diagonal().array() += row_of(n, n).dot(at.stress.transpose());
  if (!Q.allFinite()) return {std::numeric_limits<double>::quiet_NaN(), n, n};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(Q);
  return {eigen.eigenvalues()[0], n, eigen.eigenvectors().col(0)};
}

/// The same over all n; the weakest one is refined by steps that are halved.
std::optional<Weakest> weakest_anywhere(const Forward& at) {
  Weakest weakest;
  for (const auto& frame : all_directions().frames) {
    const Weakest here = weakest_along(at, frame[0]);
    if (!std::isfinite(here.value)) return std::nullopt;
    if (here.value < weakest.value) weakest = here;
  }
  constexpr int most_steps = 100;
  double step = 0.1;
  for (int k = 0; k < most_steps && step > 1e-6; ++k) {
    const Eigen::Vector3d n = weakest.n, e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    const double before = weakest.value;
    for (const Eigen::Vector3d& turn : {e1, e2, Eigen::Vector3d(-e1), Eigen::Vector3d(-e2)}) {
      const Weakest here = weakest_along(at, (n + step * turn).normalized());
      if (here.value < weakest.value) weakest = here;
    }
    if (!(weakest.value < before)) step /= 2;
  }
  return weakest;
}

std::optional<Weakest> weakest_at(const Model& model, std::span<const double> parameters, const Deformation& at) {
  const std::optional<Forward> forward = pushed_forward(model, parameters, at);
  if (!forward) return std::nullopt;
  return model.describe().compressible ? weakest_anywhere(*forward) : weakest_in_planes(*forward);
}

void set_wave(const Weakest& wave, EllipticityVerdict& verdict) {
  for (int a = 0; a < 3; ++a) {
    verdict.n[static_cast<std::size_t>(a)] = wave.n[a];
    verdict.m[static_cast<std::size_t>(a)] = wave.m[a];
  }
}

}  // namespace

std::optional<double> least_wave_stiffness(const Model& model, std::span<const double> parameters,
                                           const std::array<double, 3>& stretches) {
  const std::optional<Weakest> found = weakest_at(model, parameters, {stretches, 0});
  return found ? std::optional(found->value) : std::nullopt;
}

void set_weakest_wave(const Model& model, std::span<const double> parameters, const Deformation& at,
                      EllipticityVerdict& verdict) {
  if (const std::optional<Weakest> found = weakest_at(model, parameters, at)) set_wave(*found, verdict);
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
        set_wave(*here, verdict);
      }
      if (lost) verdict.first_lost = at.along;
      verdict.weakest = std::min(verdict.weakest, here->value);
      if (here->value <= 0) break;
    }
  }
  return verdict;
}

}  // namespace tunica::stability
