// SPDX-License-Identifier: Apache-2.0
#include "meshed.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "start.hpp"
#include "tunica/error.hpp"

namespace tunica::field {
namespace {

constexpr std::size_t most_to_begin = 3;  ///< degree of the edges before they are fitted
constexpr double most_spacings = 1.5;     ///< from a side to the nearest point

std::array<std::array<bool, 2>, 4> held(const Edges& edges) {
  std::array<std::array<bool, 2>, 4> is{};
  for (std::size_t side = 0; side < 4; ++side)
    for (std::size_t c = 0; c < 2; ++c) is[side][c] = edges[side][c] != Edge::free;
  return is;
}

}  // namespace

Meshed::Meshed(const FieldRows& rows, const Edges& edges, std::size_t smoothing, Mesh mesh)
    : rows_(rows), specimen_(std::move(mesh), held(edges)), modes_(field::modes(specimen_, edges, smoothing)) {
  std::size_t outside = 0;
  Vector first{};
  for (const Vector& point : rows_.points()) {
    const auto place = specimen_.find(point);
    if (!place && outside++ == 0) first = point;
    places_.push_back(place.value_or(Place{}));
  }
  if (outside > 0) {
    const auto corner = [&](std::size_t axis, std::size_t end) {
      return specimen_.mesh().nodes[specimen_.nodes_on(2 * axis + end).front()][axis];
    };
    throw InputError(fmt::format(
        "full_field: {} of {} points lie outside of the specimen, the first at ({:g}, {:g}) mm, which reaches from "
        "({:g}, {:g}) to ({:g}, {:g}) mm; leave them out with \"where\", or correct the mesh or its unit",
        outside, rows_.points().size(), first[0], first[1], corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)));
  }
  for (const FieldRows::Step& step : rows_.steps())
    beginnings_.push_back(field::beginning(specimen_, edges, step.frame, std::min(smoothing, most_to_begin)));
}

void Meshed::smooth(const std::vector<std::vector<double>>& reference) {
  starts_ = starts(specimen_, rows_, places_, modes_, reference);
}

void Meshed::refuse_unseen_sides() const {
  for (const FieldRows::Step& step : rows_.steps()) {
    const double spacing = std::sqrt(specimen_.area() / static_cast<double>(step.frame.points.size()));
    for (std::size_t side = 0; side < 4; ++side) {
      const double gap = specimen_.gap(side, step.frame.points);
      if (gap > most_spacings * spacing)
        throw InputError(
            fmt::format("full_field: step {:g}: the mesh reaches {:.3g} mm beyond the points on the {} side, and "
                        "points are {:.3g} mm "
                        "apart; give a shape that ends where the specimen does, or write \"unseen_sides\": "
                        "\"accept\" where it does",
                        step.value, gap, side_names[side], spacing));
    }
  }
}

/// A free side bears no force. A node where two sides meet that are both held bears what belongs to either: no one can
/// part it.
void Meshed::refuse_forces(const Edges& edges) const {
  for (const Channel channel : rows_.channels()) {
    if (!is_force(channel)) continue;
    const char* const name = channel_names[static_cast<std::size_t>(channel)];
    const std::size_t side = side_of(channel), axis = axis_of(side);
    if (edges[side][axis] == Edge::free)
      throw InputError(
          fmt::format("full_field: '{}' is mapped, and the {} side is free in {}, so that it bears none; say "
                      "in \"boundary\" how it moves, or take the force out",
                      name, side_names[side], axis == 0 ? "x" : "y"));
    for (std::size_t other = 2 * (1 - axis); other < 2 * (1 - axis) + 2; ++other) {
      if (edges[other][axis] == Edge::free) continue;
      for (const std::size_t node : specimen_.nodes_on(side))
        if (std::ranges::find(specimen_.nodes_on(other), node) != specimen_.nodes_on(other).end())
          throw InputError(fmt::format(
              "full_field: '{}' is mapped, and the {} side, which meets the {} one in a corner, is held in {} "
              "too; free it there, or take the force out",
              name, side_names[other], side_names[side], axis == 0 ? "x" : "y"));
    }
  }
}

double Meshed::at(std::size_t point, std::size_t component, const std::vector<double>& u) const {
  const Place& place = places_[point];
  double value = 0;
  for (std::size_t a = 0; a < 6; ++a) value += place.weights[a] * u[2 * place.nodes[a] + component];
  return value;
}

Eigen::VectorXd Meshed::at_points(const FieldRows::Step& step, const std::vector<double>& u) const {
  std::vector<double> values;
  for (std::size_t c = 0; c < 2; ++c) {
    std::size_t k = 0;  // in the frame
    for (const std::size_t i : step.rows)
      if (rows_.point(i) != FieldRows::none && std::isfinite(step.frame.displacements[c][k++]))
        values.push_back(at(rows_.point(i), c, u));
  }
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

void Meshed::read(const FieldRows::Step& step, const std::vector<double>& u, const std::vector<double>& f,
                  double thickness, std::span<double> values) const {
  const auto& channels = rows_.channels();
  for (std::size_t k = 0; k < channels.size(); ++k) {
    double force = 0;
    if (is_force(channels[k])) {
      const std::size_t side = side_of(channels[k]);
      for (const std::size_t a : specimen_.nodes_on(side)) force += f[2 * a + axis_of(side)];
      force *= outwards(side) * thickness;
    }
    for (const std::size_t i : step.rows) {
      double& value = values[k * rows_.rows().count + i];
      value = force;
      if (!is_force(channels[k]) && rows_.point(i) != FieldRows::none)
        value = at(rows_.point(i), static_cast<std::size_t>(channels[k]), u);
    }
  }
}

}  // namespace tunica::field
