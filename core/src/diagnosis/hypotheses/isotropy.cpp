// SPDX-License-Identifier: Apache-2.0
#include "diagnosis/hypotheses/isotropy.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

namespace tunica::diagnosis {
namespace {

constexpr int voigt[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
constexpr double of_rounding = 1e-7;

Eigen::Matrix3d tensor(const std::vector<double>& components, std::size_t n, std::size_t i) {
  Eigen::Matrix3d T;
  for (std::size_t c = 0; c < 6; ++c) T(voigt[c][0], voigt[c][1]) = T(voigt[c][1], voigt[c][0]) = components[c * n + i];
  return T;
}

void store(const Eigen::Matrix3d& T, std::vector<double>& components, std::size_t n, std::size_t i) {
  for (std::size_t c = 0; c < 6; ++c) components[c * n + i] = T(voigt[c][0], voigt[c][1]);
}

}  // namespace

bool is_isotropic(const Model& model) {
  // Small stretches along each axis and two at once: fibres along any of them are stretched in one of these.
  const std::vector<Eigen::Vector3d> stretches{{1.2, 1.05, 1 / 1.26}, {1 / 1.26, 1.2, 1.05}, {1.05, 1 / 1.26, 1.2}};
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.36, 0.48, 0.8)).toRotationMatrix();
  const std::size_t pairs = stretches.size(), n = 2 * pairs;
  std::vector<double> C(6 * n), S(6 * n), parameters;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Eigen::Matrix3d straight = stretches[i].array().square().matrix().asDiagonal();
    store(straight, C, n, 2 * i);
    store(Q * straight * Q.transpose(), C, n, 2 * i + 1);
  }
  for (const Parameter& parameter : model.describe().parameters) parameters.push_back(parameter.initial);
  if (!model.evaluate({n, C, parameters, {}, {}}, {{}, S, {}, {}, {}}).ok()) return false;
  for (std::size_t i = 0; i < pairs; ++i) {
    const Eigen::Matrix3d expected = Q * tensor(S, n, 2 * i) * Q.transpose(), found = tensor(S, n, 2 * i + 1);
    if (!((found - expected).norm() <= of_rounding * expected.norm())) return false;
  }
  return true;
}

}  // namespace tunica::diagnosis
