// SPDX-License-Identifier: Apache-2.0
#include "specimen.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {

double rounded(double value, double step) { return std::round(value / step) * step; }

/// From where the record stands to `to` in `rows` rows and `seconds`.
void leg(std::vector<double>& time, std::vector<double>& path, double to, int rows, double seconds) {
  const double from = path.back(), begun = time.back();
  for (int k = 1; k <= rows; ++k) {
    path.push_back(rounded(from + (to - from) * k / rows, 1e-6));
    time.push_back(rounded(begun + seconds * k / rows, 1e-6));
  }
}

/// Three cycles with rising maxima: slow, quick, and one with a hold. 45 rows in 112 s.
Strip strip(Material::First direction, double largest) {
  Strip made{direction, {0}, {1}};
  const auto to = [&](double share, int rows, double seconds) {
    leg(made.time, made.stretch, 1 + share * (largest - 1), rows, seconds);
  };
  to(0.45, 6, 12);
  to(0, 4, 12);
  to(0.75, 7, 4);
  to(0, 5, 4);
  to(1, 9, 30);
  to(1, 5, 40);
  to(0, 8, 10);
  return made;
}

/// Stretched, then two cycles of pressure: slow to half, quick to all of it. 19 rows in 80 s.
void inflate(Tube& tube, double largest) {
  tube.time = {0};
  tube.pressure = {0};
  const auto to = [&](double share, int rows, double seconds) {
    leg(tube.time, tube.pressure, share * largest, rows, seconds);
  };
  to(0.55, 4, 20);
  to(0, 4, 20);
  to(1, 5, 10);
  to(0, 5, 30);
}

/// Largest of 1.15, 1.16, … `most` at which the strip's stress stays below `bearable` kPa.
double largest_stretch(const Tissue& tissue, Material::First direction, double bearable, double most) {
  Strip probe{direction, {}, {}};
  for (double stretch = 1.15; stretch < most + 0.005; stretch += 0.01) {
    probe.stretch.push_back(rounded(stretch, 0.01));
    probe.time.push_back(stretch);
  }
  const auto stress = recorded_stress(probe, tissue, {});
  std::size_t last = 0;
  while (last + 1 < stress.size() && stress[last + 1] < bearable) ++last;
  return probe.stretch[last];
}

}  // namespace

double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<double>()(random);
}
double between_log(std::mt19937_64& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

/// Ranges of elastic and muscular arteries: Holzapfel, Gasser, Ogden 2000, table 1; Holzapfel, Sommer, Gasser, Regitnig
/// 2005, Am. J. Physiol. 289:H2048; Gasser, Ogden, Holzapfel 2006; Canales et al. 2023, table 6.
Specimen draw_specimen(std::mt19937_64& random) {
  Specimen made;
  Tissue& tissue = made.tissue;
  tissue.mu = between_log(random, 5, 30);
  tissue.k1 = between_log(random, 5, 50);
  tissue.k2 = between_log(random, 0.2, 3);
  tissue.theta = between(random, 35, 55);
  using enum Material::First;
  made.protocol.strips = {strip(circumferential, largest_stretch(tissue, circumferential, 150, 1.6)),
                          strip(axial, largest_stretch(tissue, axial, 150, 1.6))};
  const double inner = rounded(between_log(random, 1.5, 4), 0.01),
               thickness = rounded(between(random, 0.2, 0.5) * inner, 0.01);
  const double most = largest_stretch(tissue, axial, 80, 1.6);
  double pressure = 16;
  for (std::size_t i = 0; i < tube_count; ++i) {
    Tube& tube = made.protocol.tubes[i];
    tube.inner_radius = inner;
    tube.thickness = thickness;
    tube.axial_stretch = rounded(1 + (most - 1) * (1 + static_cast<double>(i)) / tube_count, 0.01);
    pressure = std::min(pressure, pressure_at(tube, tissue, 1.55));
  }
  for (Tube& tube : made.protocol.tubes) inflate(tube, std::max(1.0, rounded(pressure, 0.5)));
  return made;
}

}  // namespace blind
