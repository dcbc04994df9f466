// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "assembly/assembly.hpp"

namespace tunica::comparison {

/// Values of the free parameters, in the assembly's order and base units, and where they are from in words: a
/// result.json (the run of that name, or the best-ranked one of that model) or {name: value}, where a text is a
/// quantity ("10.4 kPa"). What the file does not name keeps its initial value; in an assembly of several models names
/// without a model's are those of `model`. Throws InputError on an unknown name
/// (with the nearest one) and on a value that contradicts a fixed one.
std::pair<std::vector<double>, std::string> read_parameters(const std::filesystem::path& file, const std::string& model,
                                                            const std::string& run, const assembly::Assembly& assembly);

}  // namespace tunica::comparison
