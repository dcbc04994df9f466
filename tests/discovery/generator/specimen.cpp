// SPDX-License-Identifier: Apache-2.0
#include "specimen.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "bases.hpp"

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

/// Ranges of elastic and muscular arteries: Holzapfel, Gasser, Ogden 2000, table 1; Holzapfel, Sommer, Gasser, Regitnig
/// 2005, Am. J. Physiol. 289:H2048; Gasser, Ogden, Holzapfel 2006; Canales et al. 2023, table 6.
void draw_wall(Tissue& tissue, std::mt19937_64& random) {
  tissue.mu = between_log(random, 5, 30);
  tissue.k1 = between_log(random, 5, 50);
  tissue.k2 = between_log(random, 0.2, 3);
  tissue.theta = between(random, 35, 55);
  switch (tissue.base) {
    case Base::gho:  // κ 0.226 of the iliac adventitia (Gasser, Ogden, Holzapfel 2006), 0.14 of Canales et al. 2023
      tissue.kappa = between(random, 0.05, 0.23);
      break;
    case Base::holzapfel_2015: {  // κ_ip 0.1–0.26, κ_op 0.46–0.49: Niestrawska et al. 2016, J. R. Soc. Interface 13
      const Scatter by = scatter_in_and_out(between(random, 1.2, 3), between_log(random, 6, 15));
      tissue.A = by.across;
      tissue.B = by.along - by.across;
      break;
    }
    case Base::four_fibre:  // axial and circumferential families of 2–30 kPa: Ferruzzi et al. 2013, Ann. Biomed. Eng.
                            // 41
      tissue.axial_k = between_log(random, 5, 30);
      tissue.axial_k2 = between_log(random, 0.1, 1);
      tissue.around_k = between_log(random, 5, 30);
      tissue.around_k2 = between_log(random, 0.1, 1);
      break;
    default:
      break;
  }
}

/// Vulcanised natural rubber: Yeoh's coefficients of unfilled and of filled rubber, Rubber Chem. Technol. 66:754
/// (1993); Ogden's terms of exponents 1.3 and −2, Proc. R. Soc. A 326:565 (1972), 0.63 and −0.01 MPa.
void draw_rubber(Tissue& rubber, std::mt19937_64& random) {
  if (rubber.base == Base::yeoh) {
    rubber.c10 = between_log(random, 120, 400);
    rubber.c20 = -between_log(random, 0.004, 0.02) * rubber.c10;
    rubber.c30 = between_log(random, 2e-4, 1e-3) * rubber.c10;
  } else {
    rubber.mu_1 = between_log(random, 400, 800);
    rubber.alpha_1 = between(random, 1.2, 2.4);
    rubber.mu_2 = -between_log(random, 8, 40);
    rubber.alpha_2 = between(random, -2.5, -1.5);
  }
}

void lay_out_artery(Specimen& made, std::mt19937_64& random) {
  const Tissue& tissue = made.tissue;
  using enum Material::First;
  made.protocol.strips = {strip(circumferential, largest_stretch(tissue, circumferential, 150, 1.6)),
                          strip(axial, largest_stretch(tissue, axial, 150, 1.6))};
  made.protocol.strips[0].name = "circumferential_strip";
  made.protocol.strips[1].name = "axial_strip";
  const double inner = rounded(between_log(random, 1.5, 4), 0.01),
               thickness = rounded(between(random, 0.2, 0.5) * inner, 0.01);
  const double most = largest_stretch(tissue, axial, 80, 1.6);
  double pressure = 16;
  for (const char* name : {"inflation_low", "inflation_middle", "inflation_high"}) {
    Tube& tube = made.protocol.tubes.emplace_back();
    tube.name = name;
    tube.inner_radius = inner;
    tube.thickness = thickness;
    tube.axial_stretch = rounded(1 + (most - 1) * static_cast<double>(made.protocol.tubes.size()) / 3, 0.01);
    pressure = std::min(pressure, pressure_at(tube, tissue, 1.55));
  }
  for (Tube& tube : made.protocol.tubes) inflate(tube, std::max(1.0, rounded(pressure, 0.5)));
}

/// Two cycles, slow to half and quick to all of it, with a hold: 22 rows in 88 s; both sides in proportion.
Sheet sheet(const std::string& name, Sheet::Kind kind, double around, double along) {
  Sheet made{name, kind, {0}, {}, {}};
  std::vector<double> share{0};
  leg(made.time, share, 0.5, 4, 10);
  leg(made.time, share, 0, 3, 10);
  leg(made.time, share, 1, 6, 8);
  leg(made.time, share, 1, 3, 40);
  leg(made.time, share, 0, 5, 20);
  for (const double part : share) {
    made.around.push_back(rounded(1 + part * (around - 1), 1e-6));
    made.along.push_back(rounded(1 + part * (along - 1), 1e-6));
  }
  return made;
}

/// Ratios of the strains as in Sacks, J. Elasticity 61:199 (2000), every sheet up to 120 kPa at most.
void lay_out_sheets(Specimen& made) {
  const std::vector<std::pair<double, double>> ratios{{1, 1}, {1, 0.75}, {0.75, 1}, {1, 0.4}, {0.4, 1}};
  const std::vector<std::string> names{"equal", "axial_three_quarters", "circumferential_three_quarters", "axial_less",
                                       "circumferential_less"};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const auto& [around, along] = ratios[i];
    double most = 0.1;
    for (double strain = 0.1; strain < 0.505; strain += 0.01) {
      const Sheet probe{"", Sheet::Kind::general, {0}, {1 + around * strain}, {1 + along * strain}};
      const auto stress = recorded_stresses(probe, made.tissue);
      if (!(std::max(stress[0][0], stress[1][0]) < 120)) break;
      most = strain;
    }
    made.protocol.sheets.push_back(
        sheet(names[i], Sheet::Kind::general, rounded(1 + around * most, 1e-3), rounded(1 + along * most, 1e-3)));
  }
}

/// Up to stretches before which natural rubber begins to crystallise.
void lay_out_rubber(Specimen& made, std::mt19937_64& random) {
  const auto largest = [&] { return rounded(between(random, 2.5, 3.5), 0.01); };
  made.protocol.strips = {strip(Material::First::circumferential, largest())};
  made.protocol.strips[0].name = "uniaxial";
  const double equal = largest(), shear = largest();
  made.protocol.sheets = {sheet("equibiaxial", Sheet::Kind::equibiaxial, equal, equal),
                          sheet("pure_shear", Sheet::Kind::pure_shear, shear, 1)};
}

}  // namespace

double between(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * std::uniform_real_distribution<double>()(random);
}
double between_log(std::mt19937_64& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

const std::vector<std::string>& protocol_names() {
  static const std::vector<std::string> all{"artery", "sheets", "rubber"};
  return all;
}

Specimen draw_specimen(std::mt19937_64& random, Base base, const std::string& protocol) {
  if (isotropic(base) != (protocol == "rubber"))
    throw std::invalid_argument("base " + name_of(base) + " with protocol " + protocol +
                                ": rubber is yeoh or ogden, and walls and sheets have fibres");
  Tissue tissue;
  tissue.base = base;
  isotropic(base) ? draw_rubber(tissue, random) : draw_wall(tissue, random);
  return laid_out(tissue, protocol, random);
}

Specimen laid_out(const Tissue& tissue, const std::string& protocol, std::mt19937_64& random) {
  Specimen made;
  made.tissue = tissue;
  if (protocol == "artery") lay_out_artery(made, random);
  if (protocol == "sheets") lay_out_sheets(made);
  if (protocol == "rubber") lay_out_rubber(made, random);
  return made;
}

}  // namespace blind
