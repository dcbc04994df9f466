// SPDX-License-Identifier: Apache-2.0
#include "imperfections.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace tunica::field {
namespace {

constexpr double border = 0.04;  ///< half the width over which a half turns into the other, of the box
constexpr double per_degree = std::numbers::pi / 180;

bool moved(Edge edge) { return edge == Edge::uniform || edge == Edge::measured; }
constexpr std::size_t opposite(std::size_t side) { return side ^ 1; }

/// Whether no side along this one says anything of a component: a plane of symmetry would.
bool unguided(const Edges& edges, std::size_t side, std::size_t c) {
  const std::size_t across = 2 * (1 - axis_of(side));
  return edges[across][c] == Edge::free && edges[across + 1][c] == Edge::free;
}

bool slips(const Edges& edges, std::size_t side) {
  return edges[side][0] == Edge::fixed && edges[side][1] == Edge::fixed && moved(edges[opposite(side)][axis_of(side)]);
}

bool tilts(const Edges& edges, std::size_t side) {
  const std::size_t c = axis_of(side);
  return edges[side][c] == Edge::uniform && edges[opposite(side)][c] != Edge::free && unguided(edges, side, c);
}

bool goes_astray(const Edges& edges, std::size_t side) {
  const std::size_t c = axis_of(side);
  return moved(edges[side][c]) && edges[side][1 - c] == Edge::fixed && edges[opposite(side)][c] != Edge::free &&
         unguided(edges, side, 1 - c);
}

/// ξ along a direction φ, and by φ.
struct Along {
  double cosine, sine, length;
  const Specimen& specimen;
  Along(const Specimen& of, double phi) : cosine(std::cos(phi)), sine(std::sin(phi)), specimen(of) {
    length = std::hypot(of.extent(0) * cosine, of.extent(1) * sine);
  }
  [[nodiscard]] double at(const Vector& place) const {
    return ((place[0] - specimen.middle(0)) * cosine + (place[1] - specimen.middle(1)) * sine) / length;
  }
  [[nodiscard]] double by_phi(const Vector& place) const {
    const double x = specimen.extent(0), y = specimen.extent(1);
    return (-(place[0] - specimen.middle(0)) * sine + (place[1] - specimen.middle(1)) * cosine) / length -
           at(place) * (y * y - x * x) * sine * cosine / (length * length);
  }
};

}  // namespace

std::vector<FlawParameter> all_flaws() {
  const auto linear = [](const char* name, const char* unit, double reach, const char* doc) {
    return Parameter{name, unit, 0, -reach, reach, Scale::linear, doc, ""};
  };
  return {
      {Flaw::clamp_slip,
       {"clamp_slip", "1", 0, 0, 0.5, Scale::linear,
        "How far the specimen slips out of a fixed side, over how far the opposite side has moved.", ""}},
      {Flaw::grip_tilt, linear("grip_tilt", "1", 0.5,
                               "How much farther the upper or right end of a uniform side has moved than its middle, "
                               "over how far it has moved.")},
      {Flaw::oblique_pull,
       linear("oblique_pull", "deg", 20,
              "From the normal of a moved side, held along itself, to the way it goes; above 0 where its ux and uy "
              "have the same sign.")},
      {Flaw::thickness_gradient, linear("thickness_gradient", "1", 1,
                                        "How much thicker the specimen is at one end than at the other, over its "
                                        "thickness in the middle.")},
      {Flaw::thickness_gradient_direction,
       linear("thickness_gradient_direction", "deg", 180, "From x counter-clockwise to where it becomes thicker.")},
      {Flaw::stiffer_half,
       linear("stiffer_half", "1", 0.8, "Stiffness of one half less that of the other, over their sum.")},
      {Flaw::stiffer_half_direction,
       linear("stiffer_half_direction", "deg", 180, "From x counter-clockwise to the middle of that half.")},
  };
}

std::vector<FlawParameter> flaws_between(const Edges& edges) {
  const auto somewhere = [&edges](auto on) {
    for (std::size_t side = 0; side < 4; ++side)
      if (on(edges, side)) return true;
    return false;
  };
  std::vector<FlawParameter> found = all_flaws();
  std::erase_if(found, [&](const FlawParameter& one) {
    if (one.flaw == Flaw::clamp_slip) return !somewhere(slips);
    if (one.flaw == Flaw::grip_tilt) return !somewhere(tilts);
    if (one.flaw == Flaw::oblique_pull) return !somewhere(goes_astray);
    return false;
  });
  return found;
}

FlawedSheet::FlawedSheet(const Specimen& specimen, const Edges& edges, const std::vector<Mode>& modes,
                         const std::vector<FlawParameter>& flaws, std::span<const double> values)
    : specimen_(specimen), flaws_(flaws), values_(values.begin(), values.end()), modes_(modes) {
  find_patterns(edges);
  for (Mode& mode : modes_) {
    const std::map<std::size_t, double> at(mode.begin(), mode.end());
    for (const Pattern& pattern : patterns_) {
      double way = 0;
      for (const auto& [dof, weight] : pattern.way)
        if (const auto found = at.find(dof); found != at.end()) way += weight * found->second;
      const double size = share(pattern) * way;
      if (size == 0) continue;
      for (const auto& [dof, one] : pattern.moves) mode.emplace_back(dof, size * one);
    }
  }
  const double gradient = value(Flaw::thickness_gradient), half = value(Flaw::stiffer_half);
  if (gradient == 0 && half == 0) return;
  const Along slope(specimen, per_degree * value(Flaw::thickness_gradient_direction)),
      across(specimen, per_degree * value(Flaw::stiffer_half_direction));
  for (const Vector& place : specimen.gauss_places())
    weights_.push_back((1 + gradient * slope.at(place)) * (1 + half * std::tanh(across.at(place) / border)));
}

double FlawedSheet::value(Flaw flaw) const {
  for (std::size_t q = 0; q < values_.size(); ++q)
    if (flaws_[q].flaw == flaw) return values_[q];
  return 0;
}

/// Of L, by which the edge moves.
double FlawedSheet::share(const Pattern& pattern) const {
  const double size = values_[pattern.flaw];
  return flaws_[pattern.flaw].flaw == Flaw::oblique_pull ? std::tan(per_degree * size) : size;
}

void FlawedSheet::find_patterns(const Edges& edges) {
  for (std::size_t side = 0; side < 4; ++side) {
    const std::size_t c = axis_of(side);
    const auto add = [&](Flaw flaw, std::size_t pulled, auto moves) {
      const auto found = std::ranges::find(flaws_, flaw, &FlawParameter::flaw);
      if (found == flaws_.end()) return;
      Pattern pattern{static_cast<std::size_t>(found - flaws_.begin()), {}, std::move(moves)};
      for (const std::size_t end : {pulled, opposite(pulled)}) {
        if (!moved(edges[end][c])) continue;
        const std::vector<std::size_t> nodes = moved_nodes(specimen_, edges, end, c);
        for (const std::size_t a : nodes)
          pattern.way.emplace_back(2 * a + c, (end == pulled ? 1.0 : -1.0) / static_cast<double>(nodes.size()));
      }
      patterns_.push_back(std::move(pattern));
    };
    if (slips(edges, side)) {
      Mode all;
      for (const std::size_t a : moved_nodes(specimen_, edges, side, c)) all.emplace_back(2 * a + c, 1.0);
      add(Flaw::clamp_slip, opposite(side), std::move(all));
    }
    if (goes_astray(edges, side)) {
      Mode all;
      for (const std::size_t a : moved_nodes(specimen_, edges, side, 1 - c)) all.emplace_back(2 * a + 1 - c, 1.0);
      add(Flaw::oblique_pull, side, std::move(all));
    }
    if (tilts(edges, side)) {
      const std::vector<std::size_t> nodes = moved_nodes(specimen_, edges, side, c);
      double mean = 0;
      for (const std::size_t a : nodes) mean += specimen_.mesh().nodes[a][1 - c] / static_cast<double>(nodes.size());
      Mode lever;
      for (const std::size_t a : nodes)
        lever.emplace_back(2 * a + c, 2 * (specimen_.mesh().nodes[a][1 - c] - mean) / specimen_.extent(1 - c));
      add(Flaw::grip_tilt, side, std::move(lever));
    }
  }
}

namespace {

double product(const Mode& way, const std::vector<double>& u) {
  double sum = 0;
  for (const auto& [dof, weight] : way) sum += weight * u[dof];
  return sum;
}

}  // namespace

void FlawedSheet::move_edges(std::vector<double>& u) const {
  for (const Pattern& pattern : patterns_) {
    const double size = share(pattern);
    if (size == 0) continue;
    const double way = product(pattern.way, u);
    for (const auto& [dof, one] : pattern.moves) u[dof] += size * way * one;
  }
}

std::vector<double> FlawedSheet::weights_by(std::size_t q) const {
  const Flaw flaw = flaws_[q].flaw;
  const double gradient = value(Flaw::thickness_gradient), half = value(Flaw::stiffer_half);
  const bool of_gradient = flaw == Flaw::thickness_gradient || flaw == Flaw::thickness_gradient_direction;
  const bool of_direction = flaw == Flaw::thickness_gradient_direction || flaw == Flaw::stiffer_half_direction;
  const bool of_weights = of_gradient || flaw == Flaw::stiffer_half || flaw == Flaw::stiffer_half_direction;
  if (!of_weights || (of_direction && (of_gradient ? gradient : half) == 0)) return {};
  const Along slope(specimen_, per_degree * value(Flaw::thickness_gradient_direction)),
      across(specimen_, per_degree * value(Flaw::stiffer_half_direction));
  std::vector<double> change;
  for (const Vector& place : specimen_.gauss_places()) {
    const double step = std::tanh(across.at(place) / border);
    if (of_gradient)
      change.push_back((of_direction ? gradient * per_degree * slope.by_phi(place) : slope.at(place)) *
                       (1 + half * step));
    else
      change.push_back((of_direction ? half * per_degree * (1 - step * step) / border * across.by_phi(place) : step) *
                       (1 + gradient * slope.at(place)));
  }
  return change;
}

Mode FlawedSheet::edges_by(std::size_t q, const std::vector<double>& u) const {
  Mode all;
  for (const Pattern& pattern : patterns_) {
    if (pattern.flaw != q) continue;
    double slope = 1;
    if (flaws_[q].flaw == Flaw::oblique_pull) {
      const double tangent = std::tan(per_degree * values_[q]);
      slope = per_degree * (1 + tangent * tangent);
    }
    const double way = slope * product(pattern.way, u);
    for (const auto& [dof, one] : pattern.moves) all.emplace_back(dof, way * one);
  }
  return all;
}

}  // namespace tunica::field
