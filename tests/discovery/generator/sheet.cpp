// SPDX-License-Identifier: Apache-2.0
#include "sheet.hpp"

namespace blind {
namespace {

constexpr int sheet_substeps = 24;  ///< between two rows, where the material remembers

}  // namespace

std::vector<std::vector<double>> recorded_stresses(const Sheet& sheet, const Tissue& tissue) {
  const Material material(tissue, Material::First::circumferential, 0);
  Memory memory = material.at_rest();
  std::vector<std::vector<double>> stress(sheet.channel_count());
  double around = 1, along = 1, clock = 0;
  for (std::size_t i = 0; i < sheet.time.size(); ++i) {
    const double dt = sheet.time[i] - clock;
    const int steps = material.remembers() && dt > 0 ? sheet_substeps : 1;
    Triple c{}, S{};
    for (int k = 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps, t = around + share * (sheet.around[i] - around),
                   z = along + share * (sheet.along[i] - along);
      c = {t * t, z * z, 1 / (t * t * z * z)};
      if (material.remembers()) {
        const Memory old = memory;
        S = material.with_memory(c, old, dt / steps, &memory);
      } else {
        S = material.elastic(c);
      }
    }
    const double radial = c[2] * S[2], first = c[0] * S[0] - radial, second = c[1] * S[1] - radial;
    stress[0].push_back(sheet.kind == Sheet::Kind::equibiaxial ? (first + second) / 2 : first);
    if (sheet.kind == Sheet::Kind::general) stress[1].push_back(second);
    around = sheet.around[i];
    along = sheet.along[i];
    clock = sheet.time[i];
  }
  return stress;
}

}  // namespace blind
