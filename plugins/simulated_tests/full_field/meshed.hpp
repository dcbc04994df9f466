// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "edges.hpp"
#include "field_rows.hpp"
#include "specimen.hpp"

namespace tunica::field {

/// A mesh and the measured field on it. Immutable, shared by all threads.
class Meshed {
 public:
  /// `smoothing`: degree along measured sides. Keeps the rows by reference. Throws InputError where points lie outside.
  Meshed(const FieldRows& rows, const Edges& edges, std::size_t smoothing, Mesh mesh);

  [[nodiscard]] const Specimen& specimen() const { return specimen_; }
  [[nodiscard]] const std::vector<Mode>& modes() const { return modes_; }  ///< in which edges may move
  [[nodiscard]] const FieldRows& rows() const { return rows_; }
  /// The smoothed measured displacements of a step, by dof.
  [[nodiscard]] bool has_starts() const { return !starts_.empty(); }
  [[nodiscard]] const std::vector<double>& start(std::size_t step) const { return starts_[step]; }
  /// Where the edges of a step begin, by dof.
  [[nodiscard]] const std::vector<double>& beginning(std::size_t step) const { return beginnings_[step]; }
  /// Displacements by dof where they were measured in a step, as FieldRows::measured().
  [[nodiscard]] Eigen::VectorXd at_points(const FieldRows::Step& step, const std::vector<double>& u) const;
  /// Writes what the channels read off displacements and nodal forces into the rows of a step; 0 where a channel has
  /// nothing to read. `thickness` in mm.
  void read(const FieldRows::Step& step, const std::vector<double>& u, const std::vector<double>& f, double thickness,
            std::span<double> values) const;

  /// Smooths the measured displacements, once; `reference` is what they are about, by step and dof, or empty.
  void smooth(const std::vector<std::vector<double>>& reference);

  /// Throws InputError where a side lies far from the points of a step: a mesh that reaches beyond the specimen takes
  /// the load of what is not there.
  void refuse_unseen_sides() const;
  /// Throws InputError where a force is mapped that a side does not bear, or shares with another in a corner.
  void refuse_forces(const Edges& edges) const;

 private:
  [[nodiscard]] double at(std::size_t point, std::size_t component, const std::vector<double>& u) const;
  const FieldRows& rows_;
  Specimen specimen_;
  std::vector<std::vector<double>> beginnings_, starts_;
  std::vector<Mode> modes_;
  std::vector<Place> places_;  ///< of the points of the rows
};

}  // namespace tunica::field
