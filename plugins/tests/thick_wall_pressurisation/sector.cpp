// SPDX-License-Identifier: Apache-2.0
#include "sector.hpp"

#include <array>
#include <limits>

#include "tunica/detail/safeguarded_newton.hpp"

namespace tunica::thick_wall {
namespace {

/// A passive material has no stress at rest; what there is (active tone) plays no part in closing the sector, since
/// diameters refer to the unloaded, passive tube.
Status rest_stress(const Layers& layers, bool parameters, RestStress& rest) {
  constexpr std::array<double, 3> unit{1, 1, 1};
  std::array<double, 3> g;
  std::array<double, 6> hessian;
  for (std::size_t m = 0; m < layers.size(); ++m) {
    const std::size_t count = parameters ? layers.of(m).parameter_count() : 0;
    std::vector<double> g_p(3 * count);
    if (Status status = layers.of(m).evaluate(1, unit, g, hessian, g_p); !status.ok()) return status;
    rest.value.push_back(2 * (g[0] - g[2]));
    for (std::size_t j = 0; j < count; ++j) rest.by_parameter.push_back(2 * (g_p[3 * j] - g_p[3 * j + 2]));
  }
  return {};
}

/// Newton's method alone, which finds a sector that is hardly opened in a few steps; false where it does not contract.
template <class Function>
bool plain_newton(const Function& function, double& iota) {
  constexpr int iterations = 10;
  constexpr double tolerance = 1e-14, contraction = 0.5;
  double at = iota, before = std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const detail::Residual r = function(at);
    const double step = -r.value / r.slope, size = std::abs(step);
    if (!(r.slope > 0) || !(size < contraction * before)) return false;
    at += step;
    before = size;
    if (size > tolerance * (1 + std::abs(at))) continue;
    iota = at;
    return true;
  }
  return false;
}

/// ι for an opened sector (K ≠ 1) in equilibrium when closed.
Status solve(const std::string& test, const Layers& layers, const Rule& rule, Sections& sections, Wall& wall,
             SectorDerivative* derivative) {
  RestStress rest;
  if (Status status = rest_stress(layers, derivative != nullptr, rest); !status.ok()) return status;
  const Section closed{1, std::log(wall.Ri)};
  const auto evaluate = [&](double iota, bool parameters) {
    wall.iota = iota;
    sections.begin(layers, wall, rule);
    return sections.evaluate({&closed, 1}, parameters, {}, &rest);
  };
  // A larger sector is compressed by closing it: −p rises with ι.
  const auto residual = [&](double iota) {
    if (!evaluate(iota, false).ok()) return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
    const Jet p = sections.forces_jet(0).p;
    return detail::Residual{-p.a, -p.v[ln_sector]};
  };
  double iota = wall.iota;
  if (!plain_newton(residual, iota) && !detail::safeguarded_newton(residual, iota))
    return Status::failed(
        test + ": no stress-free sector with this opening angle closes to the unloaded tube; first needed at row 1");
  if (Status status = evaluate(iota, derivative != nullptr); !status.ok() || derivative == nullptr) return status;
  const Jet p = sections.forces_jet(0).p;
  derivative->by_closing = -p.v[closing] / p.v[ln_sector];
  // The measured outer radius stays: 2 Ri² dy = −dV.
  derivative->by_area = -(p.v[area] - p.v[ln_inner] / (2 * wall.Ri * wall.Ri)) / p.v[ln_sector];
  if (!wall.layered) derivative->by_ratio = -sections.by_ratio(0).p / p.v[ln_sector];
  for (std::size_t j = 0; j < layers.parameter_count(); ++j)
    derivative->by_parameter[j] = -sections.by_parameter(0, j).p / p.v[ln_sector];
  return {};
}

/// R_i = (K (Ro + Ri) − (Ro − Ri))/2 with Ri² = Ro² − V, from R_o² − R_i² = K V and R_o − R_i = Ro − Ri.
void as_thick_as_the_wall(const Wall& wall, SectorDerivative& derivative) {
  const double sector = std::exp(wall.iota);
  derivative.by_closing = 0.5 * (wall.Ro + wall.Ri) / sector;
  derivative.by_area = -0.5 * (wall.K + 1) / (2 * wall.Ri * sector);
}

}  // namespace

Status close_sector(const Tube& tube, const Layers& layers, const Rule& rule, Sections& sections, Wall& wall,
                    SectorDerivative* derivative) {
  if (!(wall.Ri > 0) || !std::isfinite(wall.iota))
    return Status::failed(tube.test + ": thickness error and opening angle leave no wall, at row 1");
  if (derivative != nullptr) {
    *derivative = {};
    derivative->by_parameter.assign(layers.parameter_count(), 0);
    as_thick_as_the_wall(wall, *derivative);
  }
  if (tube.same_thickness) return {};
  if (wall.K != 1) return solve(tube.test, layers, rule, sections, wall, derivative);
  if (derivative == nullptr) return {};
  // A sector of ±1e-4 degrees: what the mean of both sides leaves out is of that order squared.
  double mean = 0;
  for (const double angle : {1e-4, -1e-4}) {
    Wall opened = wall;
    opened.K = 360 / (360 - angle);
    opened.iota = std::log(0.5 * (opened.K * (wall.Ro + wall.Ri) - (wall.Ro - wall.Ri)));
    SectorDerivative side;
    side.by_parameter.assign(layers.parameter_count(), 0);
    if (Status status = solve(tube.test, layers, rule, sections, opened, &side); !status.ok()) return status;
    mean += 0.5 * side.by_closing;
  }
  derivative->by_closing = mean;
  return {};
}

}  // namespace tunica::thick_wall
