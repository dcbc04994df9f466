// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "tunica/detail/vector_level.hpp"

namespace tunica::testing {

/// Runs `work` with the kernel on every level that the processor has, and goes back to the one before.
template <class Work>
void for_every_level(const Work& work) {
  const detail::VectorLevel before = detail::vector_level();
  for (std::size_t k = 0; k < detail::vector_level_names.size(); ++k) {
    detail::use_vector_level(static_cast<detail::VectorLevel>(k));
    if (static_cast<std::size_t>(detail::vector_level()) != k) continue;
    SCOPED_TRACE(detail::vector_level_names[k]);
    work();
  }
  detail::use_vector_level(before);
}

}  // namespace tunica::testing
