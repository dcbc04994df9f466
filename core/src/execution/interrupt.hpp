// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tunica::execution {

/// Ctrl-C (SIGINT) and SIGTERM while this object lives: the first one raises a flag, so that the run can save and
/// leave; a second one ends the process at once, as it would have without us. A file-size limit is reported as a
/// failed write instead of killing the process. One object at a time.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  [[nodiscard]] static bool interrupted();
};

}  // namespace tunica::execution
