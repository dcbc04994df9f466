// SPDX-License-Identifier: Apache-2.0
#include "agreement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace tunica::fe {
namespace {

/// σt − σr and σz − σr of a layer at squared stretches, without the pressure that makes them stresses.
Status stress_differences(const Material& material, std::size_t layer, double ct, double cz, double& tangential,
                          double& axial) {
  const double cr = 1 / (ct * cz);
  std::array<double, Material::firsts> W{};
  const std::array<double, 4> C{ct, cz, cr, 0};
  Status status = material.evaluate_layer(layer, 1, C, W);
  tangential = 2 * (ct * W[0] - cr * W[2]);
  axial = 2 * (cz * W[1] - cr * W[2]);
  return status;
}

struct LongTube {
  double pressure = 0, force = 0;
};

/// Over the sector, layer by layer: p = ∫ (σt − σr) R dR/(K λz r²),  F = π ∫ (2 (σz − σr) − (σt − σr)) R dR/(K λz).
Status long_tube(const thick_wall::Wall& wall, const Material& material, double stretch, double outer,
                 LongTube& found) {
  constexpr int intervals = 2000;
  std::vector<thick_wall::Jet> edges;
  wall.edges(edges);
  found = {};
  const double end = std::exp(edges.back().a);
  for (std::size_t layer = 0; layer < wall.layer_count(); ++layer) {
    const double from = std::exp(edges[layer].a), h = (std::exp(edges[layer + 1].a) - from) / intervals;
    for (int k = 0; k <= intervals; ++k) {
      const double R = from + k * h, r2 = outer * outer - (end * end - R * R) / (wall.K * stretch);
      double t = 0, z = 0;
      Status status = stress_differences(material, material.layer_count() == 1 ? 0 : layer,
                                         wall.K * wall.K * r2 / (R * R), stretch * stretch, t, z);
      if (!status.ok()) return status;
      const double weight = wall.factor(layer) *
                            (k == 0 || k == intervals ? 1
                             : k % 2 == 1             ? 4
                                                      : 2) *
                            h / 3 * R / (wall.K * stretch);
      found.pressure += weight * t / r2;
      found.force += std::numbers::pi * weight * (2 * z - t);
    }
  }
  return {};
}

/// A strip of one layer pulled along the axis: one element of a ring far from the axis.
Status strip(const Tube& sliding, const Material& material, std::size_t layer, const Material& alone, double stretch,
             double& error) {
  Tube patch = sliding;
  patch.interfaces.clear();
  patch.radial = patch.axial = 1;
  patch.inner = 1e4;
  patch.outer = 1e4 + 1;
  patch.length = 2;
  const std::array<Load, 1> pulled{Load{stretch, 0}};
  std::vector<Sample> samples;
  std::size_t failed_at = 0;
  if (Status status = Simulation(patch).run(alone, pulled, {}, samples, failed_at); !status.ok()) return status;
  // σt = σr at the ring's stretch, λt = r/R in the middle of the wall.
  const double lateral = (samples[0].value[0] + samples[0].value[1]) / (patch.outer + patch.inner), step = 1e-6;
  double here = 0, beyond = 0, unused = 0;
  const double cz = stretch * stretch;
  for (const auto& [at, into] : {std::pair{lateral, &here}, std::pair{lateral + step, &beyond}})
    if (Status status = stress_differences(material, layer, at * at, cz, *into, unused); !status.ok()) return status;
  error = std::max(error, std::abs(here / (beyond - here) * step));
  return {};
}

}  // namespace

Status check_agreement(const Tube& tube, const thick_wall::Wall& wall, const Material& material, const TestInput& input,
                       std::span<const Load> loads, std::vector<Agreement>& found) {
  const Load top = *std::ranges::max_element(loads, {}, &Load::pressure);
  Tube sliding = tube;
  sliding.ends = Ends::sliding;
  sliding.axial = 2;
  sliding.grading = 1;  // nothing varies along it
  const std::array<Load, 3> at{Load{top.stretch, 0}, Load{top.stretch, top.pressure / 2}, top};
  std::vector<Sample> samples;
  std::size_t failed_at = 0;
  if (Status status = Simulation(sliding).run(material, at, {}, samples, failed_at); !status.ok()) return status;
  double stretch_error = 0, force_error = 0, largest_force = 0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double outer = samples[i].value[0], step = 1e-6 * outer;
    LongTube here, beyond;
    for (const auto& [radius, into] : {std::pair{outer, &here}, std::pair{outer + step, &beyond}})
      if (Status status = long_tube(wall, material, top.stretch, radius, *into); !status.ok()) return status;
    const double by_radius = (beyond.pressure - here.pressure) / step;
    stretch_error = std::max(stretch_error, std::abs((here.pressure - at[i].pressure) / by_radius) / tube.outer);
    force_error = std::max(force_error, std::abs(here.force - samples[i].value[2]));
    largest_force = std::max(largest_force, std::abs(here.force));
  }
  // Errors of second and third order in the size of an element.
  const double size = 1 / static_cast<double>(tube.radial);
  const double expected = tube.order == 1 ? size * size : size * size * size;
  found.push_back(
      {"the semi-analytic long tube, ends sliding: outer diameter stretch", stretch_error, "1", 0.1 * expected});
  found.push_back(
      {"the semi-analytic long tube, ends sliding: axial force", force_error, "mN", 0.5 * expected * largest_force});

  double error = 0;
  std::size_t first = 0;
  for (std::size_t layer = 0; layer < material.layer_count(); ++layer) {
    const Model& model = input.layers.empty() ? input.model : *input.layers[layer];
    const auto parameters = input.model_parameters.subspan(first, model.describe().parameters.size());
    first += parameters.size();
    if (Status status = strip(sliding, material, layer, Material(model, parameters), top.stretch, error); !status.ok())
      return status;
  }
  found.push_back({"an axial strip, one element far from the axis: transverse stretch", error, "1", 1e-6});
  return {};
}

}  // namespace tunica::fe
