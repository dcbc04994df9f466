// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/strip_start.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The free strip pulled along a material axis, for models with memory in principal axes (tunica/axis_step.hpp).
///
/// All rows at once: the elastic response is evaluated in one batch, then memory runs along the rows. Newton's method
/// solves the lateral equilibria of all rows together. Row i depends on the rows before it through the state only, so
/// the exact step of the whole path follows by substitution along it, with one more direction that the state carries.
/// Derivatives by all parameters come from one more pass.
class MemoryPath {
 public:
  explicit MemoryPath(const Strip& strip) : start_(strip.stretch) {}
  /// `failed` where Newton's method does not end; the path on tensors may still get there.
  Status predict(const Strip& strip, const TestInput& input, const TestOutput& output) const;

 private:
  free_strip::Start start_;
};

}  // namespace tunica::uniaxial
