// SPDX-License-Identifier: Apache-2.0
// The kernels of tunica::Hyperelastic, compiled once for all plugins that link tunica::sdk.
#include "tunica/detail/hyperelastic_kernels.hpp"

#define TUNICA_KERNEL
#include "tunica/detail/hyperelastic_kernels_here.hpp"
