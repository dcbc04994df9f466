// SPDX-License-Identifier: Apache-2.0
#include "sector.hpp"

#include <algorithm>
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

Status no_sector(const std::string& test) {
  return Status::failed(
      test + ": no stress-free sector with this opening angle closes to the unloaded tube; first needed at row 1");
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
    return sections.evaluate({&closed, 1}, {.parameters = parameters}, {}, &rest);
  };
  // A larger sector is compressed by closing it: −p rises with ι.
  const auto residual = [&](double iota) {
    if (!evaluate(iota, false).ok()) return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
    return detail::Residual{-sections.forces(0).p, -*sections.by_geometry(false).p[ln_sector]};
  };
  double iota = wall.iota;
  if (!plain_newton(residual, iota) && !detail::safeguarded_newton(residual, iota)) return no_sector(test);
  if (Status status = evaluate(iota, derivative != nullptr); !status.ok() || derivative == nullptr) return status;
  const GeometricDerivatives by = sections.by_geometry(false);
  const auto sector_change = [p_sector = *by.p[ln_sector]](double p_change) { return -p_change / p_sector; };
  derivative->by_closing = sector_change(*by.p[closing]);
  // The measured outer radius stays: 2 Ri² dy = −dV.
  derivative->by_area = sector_change(*by.p[area] - *by.p[ln_inner] / (2 * wall.Ri * wall.Ri));
  double change = 0;
  if (!wall.layered) {
    sections.by_ratio(&change, nullptr);
    derivative->by_ratio = sector_change(change);
  }
  sections.prepare_parameters(false);
  for (std::size_t j = 0; j < layers.parameter_count(); ++j) {
    sections.by_parameter(j, &change, nullptr);
    derivative->by_parameter[j] = sector_change(change);
  }
  return {};
}

/// dT/dc of T = σt − σr where c is a little below and above 1, of each layer: fibres switch on at rest.
struct RestSlopes {
  double below, above;
};

/// T_c = 2 (g_t + c (H_tt − c_r² H_tr) + c_r² (c_r H_rr + g_r) − c_r H_tr) with c_z = 1, c_r = 1/c; continued to c = 1.
Status rest_slopes(const Layers& layers, std::vector<RestSlopes>& found) {
  constexpr double nearby = 1e-6;
  constexpr std::size_t n = 4;
  constexpr std::array<double, n> away{-nearby, -2 * nearby, nearby, 2 * nearby};
  std::array<double, 3 * n> c, g;
  std::array<double, 6 * n> H;
  for (std::size_t k = 0; k < n; ++k) {
    c[k] = 1 + away[k];
    c[n + k] = 1;
    c[2 * n + k] = 1 / c[k];
  }
  for (std::size_t m = 0; m < layers.size(); ++m) {
    if (Status status = layers.of(m).evaluate(n, c, g, H, {}); !status.ok()) return status;
    const auto slope = [&](std::size_t k) {
      const double ct = c[k], cr = c[2 * n + k], Htr = H[5 * n + k];
      return 2 * (g[k] + ct * (H[k] - cr * cr * Htr) + cr * cr * (cr * H[2 * n + k] + g[2 * n + k]) - cr * Htr);
    };
    found.push_back({2 * slope(0) - slope(1), 2 * slope(2) - slope(3)});
  }
  return {};
}

/// dι/dK of a sector that is hardly opened. To first order in K − 1, with q = 2 dι/dK − 1 and s = Ri²/R²,
///
///   c − 1 = (K − 1)(1 − q s),   0 = p = Σ ∫ dT/dc (c − 1) dx,   ∫ (1 − q s) dx = x + q s/2,   x = ln R.
///
/// Where c passes 1, the slope of T may jump; on which side it has which depends on the sign of K − 1.
class OpeningSlope {
 public:
  OpeningSlope(const Wall& wall, const Layers& layers, std::span<const RestSlopes> slopes) {
    std::vector<Jet> edges;
    wall.edges(edges);
    const auto at = [&wall, &edges](std::size_t k) {
      const double x = edges[k].a - wall.iota;  // ln R/Ri
      return Edge{x, std::exp(-2 * x)};
    };
    for (std::size_t layer = 0; layer < wall.layer_count(); ++layer) {
      const auto [below, above] = slopes[layers.size() == 1 ? 0 : layer];
      all_.push_back({at(layer), at(layer + 1), wall.factor(layer) * below, wall.factor(layer) * above});
    }
  }

  /// False where no root is found.
  bool solve(bool opened, double& by_closing) const {
    const auto residual = [this, opened](double q) {
      if (!(q > 0)) return detail::Residual{std::numeric_limits<double>::quiet_NaN(), 0};
      const Edge turn{0.5 * std::log(q), 1 / q};  // where c − 1 = 0
      detail::Residual sum{0, 0};
      const auto add = [&](const Edge& from, const Edge& to, double slope) {
        if (!(from.x < to.x)) return;
        sum.value -= slope * (to.x - from.x + 0.5 * q * (to.s - from.s));
        sum.slope -= slope * 0.5 * (to.s - from.s);
      };
      for (const Part& part : all_) {
        add(part.from, part.to.x < turn.x ? part.to : turn, opened ? part.below : part.above);
        add(part.from.x > turn.x ? part.from : turn, part.to, opened ? part.above : part.below);
      }
      return sum;
    };
    const Edge& outside = all_.back().to;
    double q = 2 * outside.x / (1 - outside.s);  // the root where no slope jumps
    if (!plain_newton(residual, q) && !detail::safeguarded_newton(residual, q)) return false;
    by_closing = 0.5 * (1 + q);
    return true;
  }

 private:
  struct Edge {
    double x, s;
  };
  struct Part {
    Edge from, to;
    double below, above;
  };
  std::vector<Part> all_;
};

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
  std::vector<RestSlopes> slopes;
  if (Status status = rest_slopes(layers, slopes); !status.ok()) return status;
  double opened, overlapping;
  const OpeningSlope sides(wall, layers, slopes);
  if (!sides.solve(true, opened) || !sides.solve(false, overlapping)) return no_sector(tube.test);
  derivative->by_closing = 0.5 * (opened + overlapping);
  return {};
}

}  // namespace tunica::thick_wall
