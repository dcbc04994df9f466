// SPDX-License-Identifier: Apache-2.0
#include "sensitivity.hpp"

#include <algorithm>
#include <numbers>

namespace tunica::fe {
void Sensitivity::begin(const Material& material, const Wanted& wanted) {
  material_ = &material;
  wanted_ = wanted;
  end_.clear();
  free_.clear();
}

/// r, z of the end's nodes; empty where nothing moves.
void Sensitivity::move_ends(std::size_t direction, std::vector<double>& moved) const {
  const Mesh& mesh = solver_.mesh();
  const std::size_t count = material_->parameter_count();
  moved.clear();
  const bool reference_moves = direction == count + along_thickness && mesh.ends == Ends::clamped;
  if (direction != count + along_stretch && end_.empty() && !reference_moves) return;
  moved.assign(2 * mesh.across(), 0);
  for (std::size_t i = 0; i < mesh.across(); ++i) {
    if (direction == count + along_stretch) moved[2 * i + 1] = mesh.half_length();
    if (!end_.empty()) moved[2 * i] = end_[direction][i];
    if (reference_moves) moved[2 * i] = mesh.radius(i) - mesh.outer;  // R = Ro − t (1 + g) (1 − i/n)
  }
}

/// −right · ∂(∂Π/∂x)/∂p + dilation · ∂c/∂p of observable k, the parameters being those of Changes.
double Sensitivity::contracted(std::size_t parameter, std::size_t k) const {
  const Weights& weight = weights_[k];
  const std::size_t size = weight.right.size();
  const double by_force = -dot(weight.right, std::span(changes_.force).subspan(parameter * size, size));
  const bool thickness = parameter == material_->parameter_count() + by_thickness;
  return thickness ? by_force + dot(weight.dilation, changes_.dilation) : by_force;
}

Status Sensitivity::derive(const Path& path, std::span<const std::size_t> positions, bool axial_force,
                           std::vector<double>& by) {
  const std::size_t count = material_->parameter_count(), wanted = positions.size() + (axial_force ? 1 : 0);
  const Mesh& mesh = solver_.mesh();
  if (Status status = solver_.weigh(path.load(), path.state(), positions, axial_force, weights_, changes_);
      !status.ok())
    return status;
  const bool closed = material_->closing() != nullptr && material_->closing()->differentiated();
  by.assign((count + direction_count) * wanted, 0);
  for (std::size_t j = 0; j < count + direction_count; ++j) {
    move_ends(j, moved_);
    for (std::size_t k = 0; k < wanted; ++k) {
      double& derivative = by[j * wanted + k];
      if (j < count) derivative = contracted(j, k);
      if (j == count + along_thickness) derivative = contracted(count + by_thickness, k);
      if (closed && j == count + along_closing) derivative = contracted(count + by_closing, k);
      if (closed && j == count + along_sector) derivative = contracted(count + by_sector, k);
      if (closed && j == count + along_ratio) derivative = contracted(count + by_ratio, k);
      if (j == count + along_pressure) {
        const std::span<const double> right = solver_.by_pressure();
        for (std::size_t plane = 0; plane < mesh.planes(); ++plane)
          for (std::size_t d = 0; d < 2; ++d)
            derivative += weights_[k].right[2 * mesh.node(0, plane) + d] * right[2 * mesh.node(0, plane) + d];
      }
      for (std::size_t i = 0; i < moved_.size(); ++i) derivative += weights_[k].moved[i] * moved_[i];
    }
  }
  if (!solver_.assembly().support.free.empty()) add_support(path, wanted, axial_force, by);
  return {};
}

/// By κ, and by what moves the free radii ρ. The axial force has −2π h at mid-length in it.
void Sensitivity::add_support(const Path& path, std::size_t wanted, bool axial_force, std::vector<double>& by) {
  const std::size_t count = material_->parameter_count();
  const Support& support = solver_.assembly().support;
  const double r = solver_.outer_radius(path.state()), rho = support.free.front();
  by_free_.resize(support.free.size());
  for (std::size_t k = 0; k < wanted; ++k) {
    double by_slope = solver_.assembly().contract(path.state(), weights_[k], by_free_);
    if (axial_force && k + 1 == wanted) {
      by_slope -= 2 * std::numbers::pi * Support::stored(r, rho);
      by_free_.front() -= 2 * std::numbers::pi * support.slope * Support::by_free(r, rho);
    }
    by[(count + along_support) * wanted + k] = by_slope;
    for (std::size_t j = 0; j < free_.size(); ++j)
      for (std::size_t plane = 0; plane < by_free_.size(); ++plane)
        by[j * wanted + k] += by_free_[plane] * free_[j][plane];
  }
}

/// Positions together, some at a time.
Status Sensitivity::follow(const Path& path, std::span<const std::size_t> positions,
                           std::vector<std::vector<double>>& moved) {
  const std::size_t together = Solver::together(solver_.mesh());
  const std::size_t directions = material_->parameter_count() + direction_count;
  std::vector<std::vector<double>> found(directions, std::vector<double>(positions.size()));
  for (std::size_t from = 0; from < positions.size(); from += together) {
    const auto some = positions.subspan(from, std::min(together, positions.size() - from));
    if (Status status = derive(path, some, false, by_); !status.ok()) return status;
    for (std::size_t j = 0; j < directions; ++j)
      if (j != material_->parameter_count() + along_pressure)  // they are of the tube without pressure
        std::copy_n(&by_[j * some.size()], some.size(), &found[j][from]);
  }
  moved = std::move(found);
  return {};
}

Status Sensitivity::support(const Path& path) {
  const Mesh& mesh = solver_.mesh();
  std::vector<std::size_t> positions(mesh.planes());
  for (std::size_t k = 0; k < mesh.planes(); ++k) positions[k] = 2 * mesh.node(mesh.across() - 1, k);
  free_.clear();
  return follow(path, positions, free_);
}

Status Sensitivity::hold(const Path& path) {
  const Mesh& mesh = solver_.mesh();
  std::vector<std::size_t> positions(mesh.across());
  for (std::size_t i = 0; i < mesh.across(); ++i) positions[i] = 2 * mesh.node(i, mesh.planes() - 1);
  end_.clear();
  return follow(path, positions, end_);
}

Status Sensitivity::sample(const Path& path, Sample& sample) {
  std::vector<std::size_t> positions, place;
  for (std::size_t c = 0; c < wanted_.size(); ++c) {
    if (wanted_[c]) place.push_back(c);
    if (wanted_[c] && c < 2) positions.push_back(c == 0 ? solver_.outer() : solver_.inner());
  }
  if (Status status = derive(path, positions, wanted_[2], by_); !status.ok()) return status;
  sample.value = path.observed();
  for (std::size_t k = 0; k < place.size(); ++k)
    sample.value[place[k]] =
        solver_.defects()[k] + (place[k] == 2 ? solver_.force_of_support() : sample.value[place[k]]);
  sample.by.assign(material_->parameter_count() + direction_count, {});
  for (std::size_t i = 0; i < by_.size(); ++i) sample.by[i / place.size()][place[i % place.size()]] = by_[i];
  return {};
}

}  // namespace tunica::fe
