// SPDX-License-Identifier: Apache-2.0
#include "uncertainty/valleys.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/eigenpairs.hpp"
#include "uncertainty/remedy.hpp"
#include "uncertainty/valley_words.hpp"

namespace tunica::uncertainty {
namespace {

constexpr double orthogonal = 1e-3;  // of a gradient's length

using Group = std::vector<Eigen::Index>;

/// The gradient of a combination in the unit box, by central differences; parameters at a bound stand still.
Vector gradient(const Combination& combination, const assembly::Assembly& assembly, std::span<const double> free,
                const Identifiability& found_so_far) {
  const auto& parameters = assembly.layout().parameters;
  Vector found = Vector::Zero(static_cast<Eigen::Index>(free.size()));
  std::vector<double> shifted(free.begin(), free.end());
  for (const std::size_t j : combination.arguments) {
    if (found_so_far.parameters[j].at_bound) continue;
    const double h = 1e-6 * (parameters[j].max - parameters[j].min);
    shifted[j] = free[j] + h;
    const double above = combination.value(shifted);
    shifted[j] = free[j] - h;
    const double below = combination.value(shifted);
    shifted[j] = free[j];
    found[static_cast<Eigen::Index>(j)] = (above - below) / (2 * h) * assembly.box().slope(j, free[j]);
  }
  return found;
}

/// Splits parameters into groups that weak directions connect; P = Σ v vᵀ is block-diagonal over them, whatever basis
/// of the weak space the decomposition has chosen.
std::vector<Group> connected(const Matrix& P) {
  std::vector<Group> groups;
  std::vector<bool> seen(static_cast<std::size_t>(P.rows()), false);
  for (Eigen::Index first = 0; first < P.rows(); ++first) {
    if (seen[static_cast<std::size_t>(first)] || P(first, first) < moved * moved) continue;
    Group group{first};
    seen[static_cast<std::size_t>(first)] = true;
    for (std::size_t k = 0; k < group.size(); ++k) {
      for (Eigen::Index j = 0; j < P.rows(); ++j) {
        if (seen[static_cast<std::size_t>(j)] || P(j, j) < moved * moved || std::abs(P(group[k], j)) < moved * moved)
          continue;
        seen[static_cast<std::size_t>(j)] = true;
        group.push_back(j);
      }
    }
    std::sort(group.begin(), group.end());
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Steps along the valley: the eigenvectors of the projector within the group, the largest component positive.
void add_directions(const Matrix& P, const Group& group, const assembly::Assembly& assembly,
                    std::span<const double> free, Valley& valley) {
  const auto [values, vectors] = numerics::eigenpairs(P(group, group));
  for (Eigen::Index k = values.size() - 1; k >= 0 && values[k] > 0.5; --k) {
    Vector v = vectors.col(k);
    Eigen::Index largest = 0;
    v.cwiseAbs().maxCoeff(&largest);
    if (v[largest] < 0) v = -v;
    auto& direction = valley.directions.emplace_back();
    for (std::size_t a = 0; a < group.size(); ++a) {
      const auto j = static_cast<std::size_t>(group[a]);
      const double step = v[static_cast<Eigen::Index>(a)];
      const assembly::FreeParameter& parameter = assembly.layout().parameters[j];
      if (std::abs(step) >= moved) direction.emplace_back(parameter.name, step * assembly.box().slope(j, free[j]));
    }
  }
}

/// The model's combinations that the data fix in this valley; returns what would fix the rest.
std::string add_combinations(const assembly::Assembly& assembly, std::span<const double> free, const Spectrum& spectrum,
                             const Group& group, const Identifiability& found, Valley& valley) {
  const Matrix unseen = spectrum.projector(Visibility::not_at_all) + spectrum.projector(Visibility::weakly);
  std::string remedy;
  for (const Combination& combination : assembly.layout().combinations) {
    const auto concerns = [&](std::size_t j) {
      return std::find(group.begin(), group.end(), static_cast<Eigen::Index>(j)) != group.end();
    };
    if (std::none_of(combination.arguments.begin(), combination.arguments.end(), concerns)) continue;
    const Vector g = gradient(combination, assembly, free, found);
    const double length = g.norm();
    if (!(length > 0) || !std::isfinite(length) || (unseen * g).norm() > orthogonal * length) continue;
    valley.fixed.push_back({combination.name, combination.unit, combination.value(free), spectrum.half_width(g)});
    if (remedy.empty()) remedy = combination.remedy;
  }
  return remedy;
}

/// The directions of a valley as changes of all free parameters.
std::vector<std::vector<double>> steps_along(const Valley& valley, const assembly::Assembly& assembly) {
  std::vector<std::vector<double>> steps;
  for (const auto& direction : valley.directions) {
    auto& step = steps.emplace_back(assembly.layout().parameters.size(), 0.0);
    for (const auto& [name, change] : direction)
      for (std::size_t j = 0; j < step.size(); ++j)
        if (assembly.layout().parameters[j].name == name) step[j] = change;
  }
  return steps;
}

}  // namespace

double Spectrum::half_width(const Vector& direction) const {
  return quantile * std::sqrt((V.transpose() * direction).cwiseAbs2().dot(variance));
}

Matrix Spectrum::projector(Visibility how) const {
  Matrix P = Matrix::Zero(V.rows(), V.rows());
  for (Eigen::Index k = 0; k < V.cols(); ++k) {
    if (seen[static_cast<std::size_t>(k)] == how) P += V.col(k) * V.col(k).transpose();
  }
  return P;
}

void add_valleys(const assembly::Assembly& assembly, std::span<const double> free, const Spectrum& spectrum,
                 Visibility how, Identifiability& found) {
  const Matrix P = spectrum.projector(how);
  for (const Group& group : connected(P)) {
    Valley valley;
    valley.exact = how == Visibility::not_at_all;
    // A weak direction may move a parameter by little enough to leave it a useful interval of its own.
    for (const bool all : {false, true}) {
      if (!valley.parameters.empty()) break;
      for (const Eigen::Index j : group) {
        const ParameterInterval& parameter = found.parameters[static_cast<std::size_t>(j)];
        if (all || !parameter.identified) valley.parameters.push_back(parameter.name);
      }
    }
    add_directions(P, group, assembly, free, valley);
    const std::string remedy = add_combinations(assembly, free, spectrum, group, found, valley);
    valley.sentence = in_words(valley, found.parameters, remedy);
    if (remedy.empty()) valley.sentence += remedy_in_words(assembly, free, steps_along(valley, assembly));
    found.valleys.push_back(std::move(valley));
  }
}

}  // namespace tunica::uncertainty
