// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tunica/detail/strip_start.hpp"
#include "uniaxial.hpp"

namespace tunica::uniaxial {

/// The free strip pulled along a material axis, for models with a principal-axes path: all rows at once, see
/// tunica/detail/solve_strip.hpp. The last Newton step is not evaluated again but applied to first order, which leaves
/// an error of its square.
class AxesPath {
 public:
  explicit AxesPath(const Strip& strip) : start_(strip.stretch) {}
  Status predict(const Strip& strip, const TestInput& input, const TestOutput& output) const;

 private:
  free_strip::Start start_;
};

}  // namespace tunica::uniaxial
