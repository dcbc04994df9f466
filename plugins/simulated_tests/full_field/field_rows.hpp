// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "edges.hpp"
#include "tunica/test.hpp"

namespace tunica::field {

/// The quantities read from a simulated step; the number of a force minus 2 is that of its side.
enum class Channel : std::size_t { ux, uy, left, right, bottom, top };
constexpr std::array<const char*, 6> channel_names{"ux",          "uy",           "force_left",
                                                   "force_right", "force_bottom", "force_top"};
constexpr bool is_force(Channel channel) { return channel != Channel::ux && channel != Channel::uy; }
/// The side of a force.
constexpr std::size_t side_of(Channel channel) { return static_cast<std::size_t>(channel) - 2; }

/// The rows of a measured field. Each is a point of a step, or has the forces of a step. Copies what it keeps.
class FieldRows {
 public:
  struct Step {
    double value = 0;
    std::vector<std::size_t> rows;
    Frame frame;  ///< of its points, in the order of the rows
  };
  /// Throws InputError where rows have no step or no place, where nothing says how a moved side moves, and where a step
  /// has no points.
  FieldRows(const TestSetup& setup, const Edges& edges);
  FieldRows(const FieldRows&) = delete;
  FieldRows& operator=(const FieldRows&) = delete;

  [[nodiscard]] const TestRows& rows() const { return rows_; }
  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }      ///< by rising value
  [[nodiscard]] const std::vector<Vector>& points() const { return points_; }  ///< each place once
  /// Which of points() a row is; none where it has forces.
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  [[nodiscard]] std::size_t point(std::size_t row) const { return point_[row]; }
  /// The displacements that were measured in a step, x before y, mm.
  [[nodiscard]] static Eigen::VectorXd measured(const Step& step);

 private:
  void take_rows(const TestSetup& setup);
  void take_frames(const TestSetup& setup, const Edges& edges);
  std::array<std::vector<double>, 3> abscissae_;  ///< step, x, y
  TestRows rows_;
  std::vector<Channel> channels_;
  std::vector<Step> steps_;
  std::vector<Vector> points_;
  std::vector<std::size_t> point_;
};

}  // namespace tunica::field
