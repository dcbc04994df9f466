// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/assembly.hpp"
#include "diagnosis/evidence/noise_statement.hpp"

namespace tunica::diagnosis {

/// The rows of the whitened residuals that belong to one fitted channel.
struct Curve {
  std::string test, channel;
  Eigen::Index first = 0, count = 0;
  std::vector<double> abscissa;   ///< of each row
  std::vector<double> x, y;       ///< of each row of a field, the abscissa its step; else empty
  std::vector<std::size_t> rows;  ///< of the test
  NoiseSource noise;
};

/// The rows of the whitened residuals by channel.
std::vector<Curve> curves_of(const assembly::Assembly& assembly, const std::vector<NoiseSource>& noise);

}  // namespace tunica::diagnosis
