// SPDX-License-Identifier: Apache-2.0
#include "sensitivity.hpp"

#include <numeric>

namespace tunica::fe {
namespace {

constexpr double difference = 1e-5;  ///< of the thickness

std::unique_ptr<Assembly> with_thickness(const Mesh& mesh, double factor) {
  Mesh other = mesh;
  other.inner = mesh.outer - factor * (mesh.outer - mesh.inner);
  return Assembly::make(other);
}

}  // namespace

Sensitivity::Sensitivity(Solver& solver)
    : solver_(solver),
      thinner_(with_thickness(solver.mesh(), 1 - difference)),
      thicker_(with_thickness(solver.mesh(), 1 + difference)) {}

void Sensitivity::begin(const Material& material) {
  material_ = &material;
  end_.clear();
  forces_.resize(material.parameter_count() * solver_.rest().x.size());
}

void Sensitivity::move_ends(std::size_t direction, std::vector<double>& moved) const {
  const Mesh& mesh = solver_.mesh();
  const std::size_t count = material_->parameter_count(), end = mesh.planes() - 1;
  moved.clear();
  const bool reference_moves = direction == count + thickness && mesh.ends == Ends::clamped;
  if (direction == count + stretch) moved.assign(solver_.by_stretch().begin(), solver_.by_stretch().end());
  if (end_.empty() && !reference_moves) return;
  if (moved.empty()) moved.assign(solver_.rest().x.size(), 0);
  for (std::size_t i = 0; i < mesh.across(); ++i) {
    double& r = moved[2 * mesh.node(i, end)];
    r = !end_.empty() ? end_[direction][i] : mesh.radius(i) - mesh.outer;  // R = Ro − t (1 + g) (1 − i/n)
  }
}

Status Sensitivity::equations(const Path& path, std::size_t direction) {
  const std::size_t count = material_->parameter_count(), size = solver_.rest().x.size();
  right_.clear(), dilation_.clear();
  if (direction < count) {
    right_.resize(size);
    for (std::size_t i = 0; i < size; ++i) right_[i] = -forces_[direction * size + i];
  } else if (direction == count + pressure) {
    right_.assign(solver_.by_pressure().begin(), solver_.by_pressure().end());
  } else if (direction == count + thickness) {
    // The condensed right-hand side of another mesh at the same positions, with the coupling of this one.
    const State& state = path.state();
    probe_.coupling = solver_.system().coupling, probe_.gamma = solver_.system().gamma;
    if (Status status = thicker_->assemble(*material_, state, path.load().pressure, false, probe_); !status.ok())
      return status;
    right_ = probe_.right, dilation_ = probe_.dilation;
    if (Status status = thinner_->assemble(*material_, state, path.load().pressure, false, probe_); !status.ok())
      return status;
    for (std::size_t i = 0; i < size; ++i) right_[i] = (right_[i] - probe_.right[i]) / (2 * difference);
    for (std::size_t i = 0; i < dilation_.size(); ++i)
      dilation_[i] = (dilation_[i] - probe_.dilation[i]) / (2 * difference);
  }
  move_ends(direction, moved_);
  return {};
}

Status Sensitivity::hold(const Path& path) {
  const Mesh& mesh = solver_.mesh();
  const std::size_t count = material_->parameter_count() + own;
  std::vector<std::vector<double>> moved(count);
  end_.clear();
  Status status = solver_.assembly().by_parameters(*material_, path.state(), forces_);
  for (std::size_t j = 0; j < count && status.ok(); ++j) {
    moved[j].assign(mesh.across(), 0);
    if (j == material_->parameter_count() + pressure) continue;  // held before the pressure comes
    status = equations(path, j);
    solver_.derive(right_, moved_, derivative_);
    solver_.refine(dilation_, derivative_);
    for (std::size_t i = 0; i < mesh.across(); ++i) moved[j][i] = derivative_.x[2 * mesh.node(i, mesh.planes() - 1)];
  }
  end_ = std::move(moved);
  return status;
}

Status Sensitivity::sample(const Path& path, Sample& sample) {
  const std::size_t count = material_->parameter_count() + own;
  sample.value = path.observed();
  sample.by.assign(count, {});
  using enum Solver::Observable;
  for (const auto what : {outer_radius, inner_radius, axial_force})
    solver_.weigh(what, weights_[static_cast<std::size_t>(what)]);
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {  // b may be empty
    return std::inner_product(b.begin(), b.end(), a.begin(), 0.0);
  };
  Status status = solver_.assembly().by_parameters(*material_, path.state(), forces_);
  for (std::size_t j = 0; j < count && status.ok(); ++j) {
    status = equations(path, j);
    for (std::size_t k = 0; k < weights_.size(); ++k)
      sample.by[j][k] =
          dot(weights_[k].right, right_) + dot(weights_[k].dilation, dilation_) + dot(weights_[k].moved, moved_);
  }
  return status;
}

}  // namespace tunica::fe
