// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

#include "tunica/test.hpp"

namespace tunica::record_errors {

/// The stretch of a strip and the channel of its stress: force over unloaded area P = stress · stretch^power.
struct Strip {
  std::size_t abscissa, channel;
  int power;
};
using Recorder = std::unique_ptr<Test> (*)(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip);

/// Force and length zeroed together at a stretch λ0 = 1 + a: of the recorded stretch m and force,
///
///   P_recorded(m) = P(λ0 m) − P(λ0).
std::unique_ptr<Test> zeroed_under_load(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip);

/// The machine takes a part of the stretch in proportion to the force: λ + a P(λ) = m.
std::unique_ptr<Test> given_way(std::unique_ptr<Test> base, const Parameter& amplitude, const Strip& strip);

}  // namespace tunica::record_errors
