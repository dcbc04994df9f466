// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>
#include <vector>

#include "world.hpp"

namespace blind {

/// One of the specimens that the benchmark tests, and how a laboratory would test it: stretches and pressures up to
/// what the tissue bears.
struct Specimen {
  Tissue tissue;
  Protocol protocol;
};
Specimen draw_specimen(std::mt19937_64& random, Base base = Base::hgo, const std::string& protocol = "artery");
/// The tests of a protocol on this tissue, each up to what it bears.
Specimen laid_out(const Tissue& tissue, const std::string& protocol, std::mt19937_64& random);
/// artery, sheets, rubber.
const std::vector<std::string>& protocol_names();

double between(std::mt19937_64& random, double low, double high);
double between_log(std::mt19937_64& random, double low, double high);

}  // namespace blind
