// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "edges.hpp"
#include "field_rows.hpp"
#include "meshed.hpp"
#include "tunica/test.hpp"

namespace tunica::field {

/// What tests of one field share: rows, mesh and smoothed displacements. Immutable.
struct Prepared {
  explicit Prepared(const TestSetup& setup);

  Edges edges;
  std::size_t smoothing;  ///< degree along measured sides
  FieldRows rows;
  Meshed mesh;
};

/// Makes it, or takes what a living test was made with from the same options and rows: a diagnosis makes hundreds of
/// tests of one field. Throws InputError. Thread-safe.
std::shared_ptr<const Prepared> prepared(const TestSetup& setup);

}  // namespace tunica::field
