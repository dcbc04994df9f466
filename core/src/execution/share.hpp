// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace tunica::execution {

/// Part k of N of a list: every N-th entry, from the k-th. Parts are disjoint and cover the list. The result of an
/// entry does not depend on its part.
struct Share {
  std::size_t part = 1, of = 1;

  [[nodiscard]] bool holds(std::size_t entry) const { return entry % of == part - 1; }
};

/// "2/7". Throws InputError.
Share parse_share(const std::string& text);

}  // namespace tunica::execution
