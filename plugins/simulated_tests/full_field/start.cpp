// SPDX-License-Identifier: Apache-2.0
#include "start.hpp"

#include <cmath>
#include <map>

#include <Eigen/QR>

#include "smoothing.hpp"

namespace tunica::field {
namespace {

/// One component of one step, at the points that measured it.
struct Reading {
  std::size_t step, component;
  std::vector<double> values;
};

/// Readings by their set of points; each set is thus smoothed once.
std::map<std::vector<std::size_t>, std::vector<Reading>> readings(const FieldRows& rows) {
  std::map<std::vector<std::size_t>, std::vector<Reading>> found;
  for (std::size_t s = 0; s < rows.steps().size(); ++s) {
    const FieldRows::Step& step = rows.steps()[s];
    for (std::size_t c = 0; c < 2; ++c) {
      std::vector<std::size_t> points;
      std::vector<double> values;
      std::size_t k = 0;  // in the frame
      for (const std::size_t i : step.rows) {
        if (rows.point(i) == FieldRows::none) continue;
        const double value = step.frame.displacements[c][k++];
        if (!std::isfinite(value)) continue;
        points.push_back(rows.point(i));
        values.push_back(value);
      }
      if (!points.empty()) found[points].push_back({s, c, std::move(values)});
    }
  }
  return found;
}

Eigen::MatrixXd columns(const std::vector<Reading>& readings) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(readings.front().values.size()),
                      static_cast<Eigen::Index>(readings.size()));
  for (std::size_t r = 0; r < readings.size(); ++r)
    all.col(static_cast<Eigen::Index>(r)) = Eigen::Map<const Eigen::VectorXd>(readings[r].values.data(), all.rows());
  return all;
}

double at_place(const Place& place, std::size_t component, const std::vector<double>& u) {
  double value = 0;
  for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[2 * place.nodes[a] + component];
  return value;
}

/// Displacements of held dofs as the nearest sum of modes.
class HeldEdges {
 public:
  HeldEdges(const Specimen& specimen, const std::vector<Mode>& modes) {
    for (std::size_t dof = 0; dof < specimen.dofs(); ++dof)
      if (specimen.held(dof)) dofs_.push_back(dof);
    A_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(dofs_.size()), static_cast<Eigen::Index>(modes.size()));
    std::map<std::size_t, Eigen::Index> row;
    for (const std::size_t dof : dofs_) row.emplace(dof, static_cast<Eigen::Index>(row.size()));
    for (std::size_t k = 0; k < modes.size(); ++k)
      for (const auto& [dof, value] : modes[k]) A_(row.at(dof), static_cast<Eigen::Index>(k)) = value;
    if (!modes.empty()) factor_.compute(A_);
  }
  void hold(std::vector<double>& u) const {
    Eigen::VectorXd held(A_.rows());
    for (std::size_t k = 0; k < dofs_.size(); ++k) held[static_cast<Eigen::Index>(k)] = u[dofs_[k]];
    held = A_.cols() > 0 ? Eigen::VectorXd(A_ * factor_.solve(held)) : Eigen::VectorXd::Zero(A_.rows()).eval();
    for (std::size_t k = 0; k < dofs_.size(); ++k) u[dofs_[k]] = held[static_cast<Eigen::Index>(k)];
  }

 private:
  std::vector<std::size_t> dofs_;
  Eigen::MatrixXd A_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor_;
};

}  // namespace

std::vector<std::vector<double>> starts(const Specimen& specimen, const FieldRows& rows,
                                        const std::vector<Place>& places, const std::vector<Mode>& modes,
                                        const std::vector<std::vector<double>>& reference) {
  std::vector<std::vector<double>> all = reference;
  all.resize(rows.steps().size(), std::vector<double>(specimen.dofs(), 0.0));
  const Smoothing smoothing(specimen);
  double wavelength = 0;
  for (const auto& [points, of_points] : readings(rows)) {
    std::vector<Place> at;
    for (const std::size_t point : points) at.push_back(places[point]);
    Eigen::MatrixXd values = columns(of_points);
    for (std::size_t r = 0; r < of_points.size(); ++r)
      for (std::size_t k = 0; k < at.size(); ++k)
        values(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(r)) -=
            at_place(at[k], of_points[r].component, all[of_points[r].step]);
    if (wavelength == 0) wavelength = smoothing.wavelength(at, values.col(values.cols() - 1));
    const Eigen::MatrixXd smooth = smoothing.at_nodes(at, values, wavelength);
    for (std::size_t r = 0; r < of_points.size(); ++r)
      for (Eigen::Index node = 0; node < smooth.rows(); ++node)
        all[of_points[r].step][2 * static_cast<std::size_t>(node) + of_points[r].component] +=
            smooth(node, static_cast<Eigen::Index>(r));
  }
  const HeldEdges edges(specimen, modes);
  for (std::vector<double>& u : all) edges.hold(u);
  return all;
}

}  // namespace tunica::field
