// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "tunica/test.hpp"

namespace tunica::record_errors {

/// All channels come late by a: what is recorded is y − a dy/dt, with differences over the rows beside. Throws
/// InputError where the data have no time.
std::unique_ptr<Test> late(std::unique_ptr<Test> base, const Parameter& amplitude);

}  // namespace tunica::record_errors
