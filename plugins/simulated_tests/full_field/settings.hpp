// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "edges.hpp"
#include "mesh.hpp"
#include "tunica/test.hpp"

namespace tunica::field {

/// The options "mesh", "shape" and "boundary"; throws InputError.
Mesh mesh_of(const TestSetup& setup);
Edges edges_of(const Options& given);

}  // namespace tunica::field
